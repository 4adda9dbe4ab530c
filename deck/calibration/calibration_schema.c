#include "deck/calibration/calibration_schema.h"

#include "deck/source/json_schema.h"

#define OPTIONAL CYAML_FLAG_OPTIONAL
#define OPTIONAL_POINTER (CYAML_FLAG_OPTIONAL | CYAML_FLAG_POINTER)
#define OPTIONAL_STRICT (CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT)
#define TEXT(key, structure, member) \
  CYAML_FIELD_STRING_PTR(key, CYAML_FLAG_POINTER, structure, member, 1, CYAML_UNLIMITED)
#define NAME(key, structure, member) \
  CYAML_FIELD_STRING_PTR(key, OPTIONAL_POINTER, structure, member, 1, CYAML_UNLIMITED)
#define NUMBER(key, structure, member) CYAML_FIELD_FLOAT_PTR(key, OPTIONAL, structure, member)
#define COUNT(key, structure, member) CYAML_FIELD_UINT_PTR(key, OPTIONAL, structure, member)
#define CHOICE(key, structure, member, names) \
  CYAML_FIELD_ENUM_PTR(key, OPTIONAL_STRICT, structure, member, names, CYAML_ARRAY_LEN(names))
#define PAIR(key, structure, member) \
  CYAML_FIELD_SEQUENCE_FIXED(key, OPTIONAL_POINTER, structure, member, &number_value, 2)

static const cyaml_strval_t unit_names[] = {{"Pa", DECK_PA}, {"kPa", DECK_KPA}, {"MPa", DECK_MPA}};
static const cyaml_strval_t boolean_names[] = {{"false", 0}, {"true", 1}};
static const cyaml_strval_t use_names[] = {{"check", 0}, {"fit", 1}};
static const cyaml_strval_t derivative_names[] = {{"exact", HYPOFAB_EXACT}, {"differences", HYPOFAB_DIFFERENCES}};
static const cyaml_strval_t start_names[] = {
    {"mobilised", HYPOFAB_START_MOBILISED}, {"zero", HYPOFAB_START_ZERO}, {"shearing", HYPOFAB_START_SHEARING}};
static const cyaml_strval_t quantity_names[] = {{"eps1", HYPOFAB_LAB_EPS1}, {"eps_v", HYPOFAB_LAB_EPS_V},
                                                {"q", HYPOFAB_LAB_Q},       {"p", HYPOFAB_LAB_P},
                                                {"e", HYPOFAB_LAB_E},       {"sigma1", HYPOFAB_LAB_SIGMA1}};
static const cyaml_strval_t kind_names[] = {{"oedometer", HYPOFAB_LAB_OEDOMETER},
                                            {"isotropic_compression", HYPOFAB_LAB_ISOTROPIC_COMPRESSION},
                                            {"drained_compression", HYPOFAB_LAB_DRAINED_COMPRESSION},
                                            {"drained_extension", HYPOFAB_LAB_DRAINED_EXTENSION},
                                            {"drained_cyclic", HYPOFAB_LAB_DRAINED_CYCLIC},
                                            {"undrained_compression", HYPOFAB_LAB_UNDRAINED_COMPRESSION},
                                            {"undrained_extension", HYPOFAB_LAB_UNDRAINED_EXTENSION},
                                            {"undrained_cyclic", HYPOFAB_LAB_UNDRAINED_CYCLIC}};

static const cyaml_schema_value_t number_value = {CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, double)};
static const cyaml_schema_value_t name_value = {CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char, 1, CYAML_UNLIMITED)};

static const cyaml_schema_field_t column_fields[] = {TEXT("column", deck_lab_column, column),
                                                     NUMBER("factor", deck_lab_column, factor), CYAML_FIELD_END};

/* In the order of hypofab_laboratory_quantity. */
#define COLUMN(index, name) \
  CYAML_FIELD_MAPPING_PTR(name, OPTIONAL_POINTER, deck_lab_columns, quantity[index], column_fields)
static const cyaml_schema_field_t columns_fields[] = {COLUMN(0, "eps1"), COLUMN(1, "eps_v"), COLUMN(2, "q"),
                                                      COLUMN(3, "p"),    COLUMN(4, "e"),     COLUMN(5, "sigma1"),
                                                      CYAML_FIELD_END};

#define WEIGHT(index, name) NUMBER(name, deck_lab_weights, value[index])
static const cyaml_schema_field_t weight_fields[] = {WEIGHT(0, "eps1"), WEIGHT(1, "eps_v"), WEIGHT(2, "q"),
                                                     WEIGHT(3, "p"),    WEIGHT(4, "e"),     WEIGHT(5, "sigma1"),
                                                     CYAML_FIELD_END};

static const cyaml_schema_field_t test_fields[] = {
    TEXT("name", deck_lab_test, name),
    CYAML_FIELD_ENUM("kind", CYAML_FLAG_STRICT, deck_lab_test, kind, kind_names, CYAML_ARRAY_LEN(kind_names)),
    TEXT("file", deck_lab_test, file),
    CYAML_FIELD_MAPPING_PTR("columns", CYAML_FLAG_POINTER, deck_lab_test, columns, columns_fields),
    NUMBER("sigma1", deck_lab_test, sigma1),
    NUMBER("sigma3", deck_lab_test, sigma3),
    NUMBER("K0", deck_lab_test, K0),
    NUMBER("void_ratio", deck_lab_test, void_ratio),
    PAIR("free_void_ratio", deck_lab_test, free_void_ratio),
    NUMBER("from_sigma1", deck_lab_test, from_sigma1),
    CHOICE("start", deck_lab_test, start, start_names),
    CHOICE("use", deck_lab_test, use, use_names),
    NUMBER("weight", deck_lab_test, weight),
    CYAML_FIELD_MAPPING_PTR("compare", OPTIONAL_POINTER, deck_lab_test, compare, weight_fields),
    CHOICE("drive", deck_lab_test, drive, quantity_names),
    NUMBER("reversal", deck_lab_test, reversal),
    COUNT("points", deck_lab_test, points),
    CYAML_FIELD_END};
static const cyaml_schema_value_t test_value = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_lab_test, test_fields)};

static const cyaml_schema_field_t index_fields[] = {NUMBER("repose", deck_index_tests, repose),
                                                    NUMBER("e_min", deck_index_tests, e_min),
                                                    NUMBER("e_max", deck_index_tests, e_max), CYAML_FIELD_END};

static const cyaml_schema_field_t calibration_fields[] = {
    TEXT("calibration", deck_calibration, title),
    CHOICE("unit", deck_calibration, unit, unit_names),
    NAME("model", deck_calibration, choice.model),
    NAME("sand", deck_calibration, choice.sand),
    NAME("set", deck_calibration, choice.set),
    CHOICE("estimate", deck_calibration, estimate, boolean_names),
    CYAML_FIELD_MAPPING_PTR("index_tests", OPTIONAL_POINTER, deck_calibration, index_tests, index_fields),
    CYAML_FIELD_IGNORE("parameters", OPTIONAL), /* as bounds and ratios: deck/source/numbers.h */
    CHOICE("intergranular", deck_calibration, intergranular, boolean_names),
    CYAML_FIELD_SEQUENCE("free", CYAML_FLAG_POINTER, deck_calibration, free, &name_value, 0, CYAML_UNLIMITED),
    CYAML_FIELD_IGNORE("bounds", OPTIONAL),
    CYAML_FIELD_IGNORE("ratios", OPTIONAL),
    CYAML_FIELD_SEQUENCE("tests", CYAML_FLAG_POINTER, deck_calibration, tests, &test_value, 1, CYAML_UNLIMITED),
    COUNT("starts", deck_calibration, starts),
    COUNT("max_iterations", deck_calibration, max_iterations),
    COUNT("threads", deck_calibration, threads),
    NUMBER("tolerance", deck_calibration, tolerance),
    CHOICE("derivatives", deck_calibration, derivatives, derivative_names),
    CYAML_FIELD_END};

const cyaml_schema_value_t deck_calibration_schema = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, deck_calibration, calibration_fields)};

char *hypofab_calibration_schema(void) {
  return json_schema_text(&deck_calibration_schema, "hypofab calibration",
                          "Parameters from laboratory tests: docs/calibration.md");
}
