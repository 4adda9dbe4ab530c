#include "deck/source/schema.h"

#include <pthread.h>
#include <stddef.h>

#define OPTIONAL CYAML_FLAG_OPTIONAL
#define OPTIONAL_POINTER (CYAML_FLAG_OPTIONAL | CYAML_FLAG_POINTER)
#define OPTIONAL_STRICT (CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT)

/* A text of at least one character, required or not. */
#define TEXT(key, structure, member) \
  CYAML_FIELD_STRING_PTR(key, CYAML_FLAG_POINTER, structure, member, 1, CYAML_UNLIMITED)
#define OPTIONAL_TEXT(key, structure, member) \
  CYAML_FIELD_STRING_PTR(key, OPTIONAL_POINTER, structure, member, 1, CYAML_UNLIMITED)
#define SIX_NUMBERS(key, structure, member) \
  CYAML_FIELD_SEQUENCE_FIXED(key, OPTIONAL_POINTER, structure, member, &number, 6)
#define CHOICE(key, structure, member, names) \
  CYAML_FIELD_ENUM_PTR(key, OPTIONAL_STRICT, structure, member, names, CYAML_ARRAY_LEN(names))

static const cyaml_strval_t unit_names[] = {{"Pa", DECK_PA}, {"kPa", DECK_KPA}, {"MPa", DECK_MPA}};
static const cyaml_strval_t sign_names[] = {{"tension_positive", DECK_TENSION_POSITIVE},
                                            {"compression_positive", DECK_COMPRESSION_POSITIVE}};
static const cyaml_strval_t integrator_names[] = {{"erk", HYPOFAB_ERK}, {"cvode", HYPOFAB_CVODE}, {"ida", HYPOFAB_IDA}};
static const cyaml_strval_t frame_names[] = {
    {"xyz", DECK_FRAME_XYZ}, {"stress", DECK_FRAME_STRESS}, {"delta", DECK_FRAME_DELTA}};
static const cyaml_strval_t imposed_names[] = {{"strain", HYPOFAB_IMPOSE_STRAIN}, {"stress", HYPOFAB_IMPOSE_STRESS}};
static const cyaml_strval_t keep_names[] = {
    {"all", HYPOFAB_KEEP_ALL}, {"reversals", HYPOFAB_KEEP_REVERSALS}, {"end", HYPOFAB_KEEP_END}};
static const cyaml_strval_t ends_names[] = {{"step", 0}, {"test", 1}};
static const cyaml_strval_t measure_names[] = {
    {"level", HYPOFAB_LEVEL}, {"change", HYPOFAB_CHANGE}, {"double_amplitude", HYPOFAB_DOUBLE_AMPLITUDE}};
static const cyaml_strval_t axis_names[] = {{"x", 0}, {"y", 1}, {"z", 2}};
/* libcyaml's own booleans take any text but "false", "no" and "0" for true. */
static const cyaml_strval_t boolean_names[] = {{"false", 0}, {"true", 1}};

static const cyaml_schema_value_t number = {CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, double)};

static const cyaml_schema_field_t material_fields[] = {
    TEXT("name", deck_material, name),
    OPTIONAL_TEXT("model", deck_material, choice.model),
    OPTIONAL_TEXT("sand", deck_material, choice.sand),
    OPTIONAL_TEXT("set", deck_material, choice.set),
    CYAML_FIELD_IGNORE("parameters", OPTIONAL), /* numbers.h */
    CHOICE("intergranular", deck_material, intergranular, boolean_names),
    CYAML_FIELD_END};

static const cyaml_schema_field_t columns_fields[] = {
    OPTIONAL_TEXT("id1", deck_columns, id1), OPTIONAL_TEXT("id2", deck_columns, id2),
    OPTIONAL_TEXT("nx", deck_columns, nx),   OPTIONAL_TEXT("ny", deck_columns, ny),
    OPTIONAL_TEXT("nz", deck_columns, nz),   CYAML_FIELD_END};

static const cyaml_schema_field_t delta_fields[] = {
    CHOICE("zero", deck_delta, zero, boolean_names),
    SIX_NUMBERS("components", deck_delta, components),
    SIX_NUMBERS("mobilised", deck_delta, mobilised),
    SIX_NUMBERS("fabric", deck_delta, fabric),
    OPTIONAL_TEXT("contacts", deck_delta, contacts),
    CYAML_FIELD_FLOAT_PTR("c", OPTIONAL, deck_delta, c),
    OPTIONAL_TEXT("weight", deck_delta, weight),
    OPTIONAL_TEXT("particles", deck_delta, particles),
    CYAML_FIELD_MAPPING_PTR("columns", OPTIONAL_POINTER, deck_delta, columns, columns_fields),
    OPTIONAL_TEXT("separator", deck_delta, separator),
    CYAML_FIELD_END};

static const cyaml_schema_field_t state_fields[] = {
    TEXT("name", deck_state, name),
    TEXT("material", deck_state, material),
    SIX_NUMBERS("stress", deck_state, stress),
    CYAML_FIELD_FLOAT_PTR("p", OPTIONAL, deck_state, p),
    CYAML_FIELD_FLOAT("void_ratio", CYAML_FLAG_DEFAULT, deck_state, void_ratio),
    CYAML_FIELD_IGNORE("variables", OPTIONAL), /* numbers.h */
    CYAML_FIELD_MAPPING_PTR("delta", OPTIONAL_POINTER, deck_state, delta, delta_fields),
    CYAML_FIELD_END};

static const cyaml_schema_field_t mark_fields[] = {TEXT("quantity", deck_mark, quantity),
                                                   CYAML_FIELD_FLOAT("value", CYAML_FLAG_DEFAULT, deck_mark, value),
                                                   CYAML_FIELD_END};

static const cyaml_schema_field_t component_fields[] = {
    CYAML_FIELD_FLOAT_PTR("strain_rate", OPTIONAL, deck_component, strain_rate),
    CYAML_FIELD_FLOAT_PTR("stress_rate", OPTIONAL, deck_component, stress_rate), CYAML_FIELD_END};

#define COMPONENT(index, name, flags) \
  CYAML_FIELD_MAPPING_PTR(name, flags, deck_control, component[index], component_fields)
static const cyaml_schema_field_t control_fields[] = {COMPONENT(0, "xx", CYAML_FLAG_POINTER),
                                                      COMPONENT(1, "yy", CYAML_FLAG_POINTER),
                                                      COMPONENT(2, "zz", CYAML_FLAG_POINTER),
                                                      COMPONENT(3, "xy", OPTIONAL_POINTER),
                                                      COMPONENT(4, "xz", OPTIONAL_POINTER),
                                                      COMPONENT(5, "yz", OPTIONAL_POINTER),
                                                      CYAML_FIELD_END};

static const cyaml_schema_field_t condition_fields[] = {
    OPTIONAL_TEXT("quantity", deck_condition, quantity), SIX_NUMBERS("stress", deck_condition, stress),
    SIX_NUMBERS("strain", deck_condition, strain), CYAML_FIELD_FLOAT_PTR("rate", OPTIONAL, deck_condition, rate),
    CYAML_FIELD_END};
static const cyaml_schema_value_t condition_value = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_condition, condition_fields)};

static const cyaml_schema_value_t quantity_name = {CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char, 1, CYAML_UNLIMITED)};
static const cyaml_schema_field_t table_fields[] = {
    TEXT("file", deck_table, file),
    CYAML_FIELD_SEQUENCE("columns", OPTIONAL_POINTER, deck_table, columns, &quantity_name, 1, CYAML_UNLIMITED),
    CYAML_FIELD_SEQUENCE("hold", OPTIONAL_POINTER, deck_table, hold, &quantity_name, 0, CYAML_UNLIMITED),
    CYAML_FIELD_END};

static const cyaml_schema_field_t water_fields[] = {
    CHOICE("held", deck_water, held, axis_names), CYAML_FIELD_FLOAT_PTR("K_w", OPTIONAL, deck_water, K_w),
    CYAML_FIELD_FLOAT_PTR("porosity", OPTIONAL, deck_water, porosity), CYAML_FIELD_END};

#define TWO_NUMBERS(key, structure, member) \
  CYAML_FIELD_SEQUENCE_FIXED(key, OPTIONAL_POINTER, structure, member, &number, 2)
static const cyaml_schema_field_t cycle_fields[] = {TEXT("quantity", deck_cycle, quantity),
                                                    CYAML_FIELD_FLOAT_PTR("amplitude", OPTIONAL, deck_cycle, amplitude),
                                                    TWO_NUMBERS("between", deck_cycle, between),
                                                    TWO_NUMBERS("from_start", deck_cycle, from_start),
                                                    CYAML_FIELD_UINT_PTR("count", OPTIONAL, deck_cycle, count),
                                                    CHOICE("keep", deck_cycle, keep, keep_names),
                                                    CYAML_FIELD_UINT_PTR("every", OPTIONAL, deck_cycle, every),
                                                    CYAML_FIELD_END};

static const cyaml_schema_field_t stop_fields[] = {
    TEXT("quantity", deck_stop, quantity), CYAML_FIELD_FLOAT("value", CYAML_FLAG_DEFAULT, deck_stop, value),
    CHOICE("measure", deck_stop, measure, measure_names), CHOICE("ends", deck_stop, ends, ends_names), CYAML_FIELD_END};
static const cyaml_schema_value_t stop_value = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_stop, stop_fields)};

/* With room for those of presets, which go behind (deck_schema). */
enum { MOST_STEP_FIELDS = 32 + DECK_MOST_PRESET_KEYS };
static cyaml_schema_field_t step_fields[MOST_STEP_FIELDS] = {
    OPTIONAL_TEXT("name", deck_step, name),
    OPTIONAL_TEXT("preset", deck_step, preset),
    CHOICE("axis", deck_step, axis, axis_names),
    CHOICE("normal", deck_step, normal, axis_names),
    CYAML_FIELD_MAPPING_PTR("control", OPTIONAL_POINTER, deck_step, control, control_fields),
    CYAML_FIELD_SEQUENCE("conditions", OPTIONAL_POINTER, deck_step, conditions, &condition_value, 1, CYAML_UNLIMITED),
    CYAML_FIELD_MAPPING_PTR("table", OPTIONAL_POINTER, deck_step, table, table_fields),
    CYAML_FIELD_MAPPING_PTR("pore_water", OPTIONAL_POINTER, deck_step, pore_water, water_fields),
    CYAML_FIELD_MAPPING_PTR("until", OPTIONAL_POINTER, deck_step, until, mark_fields),
    CYAML_FIELD_SEQUENCE("stop", OPTIONAL_POINTER, deck_step, stop, &stop_value, 1, CYAML_UNLIMITED),
    CYAML_FIELD_MAPPING_PTR("cycle", OPTIONAL_POINTER, deck_step, cycle, cycle_fields),
    CYAML_FIELD_UINT_PTR("rows", OPTIONAL, deck_step, rows),
    CYAML_FIELD_MAPPING_PTR("every", OPTIONAL_POINTER, deck_step, every, mark_fields),
    CYAML_FIELD_FLOAT_PTR("max_time", OPTIONAL, deck_step, max_time),
    CYAML_FIELD_END};
static const cyaml_schema_value_t step_value = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_step, step_fields)};

static const cyaml_schema_field_t test_fields[] = {
    TEXT("name", deck_test, name),
    TEXT("state", deck_test, state),
    CHOICE("integrator", deck_test, integrator, integrator_names),
    CHOICE("stability", deck_test, stability, boolean_names),
    CYAML_FIELD_FLOAT_PTR("tolerance", OPTIONAL, deck_test, tolerance),
    CYAML_FIELD_SEQUENCE("sensitivities", OPTIONAL_POINTER, deck_test, sensitivities, &quantity_name, 1,
                         HYPOFAB_MAX_VARIATIONS),
    CYAML_FIELD_SEQUENCE("steps", CYAML_FLAG_POINTER, deck_test, steps, &step_value, 1, CYAML_UNLIMITED),
    CYAML_FIELD_END};

static const cyaml_schema_field_t series_fields[] = {TEXT("name", deck_series, name),
                                                     OPTIONAL_TEXT("state", deck_series, state),
                                                     OPTIONAL_TEXT("after", deck_series, after),
                                                     CYAML_FIELD_UINT_PTR("step", OPTIONAL, deck_series, step),
                                                     CHOICE("intergranular", deck_series, intergranular, boolean_names),
                                                     CYAML_FIELD_END};
static const cyaml_schema_value_t series_value = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_series, series_fields)};

#define TENSOR(key, structure, member) \
  CYAML_FIELD_SEQUENCE_FIXED(key, CYAML_FLAG_POINTER, structure, member, &number, 6)
static const cyaml_schema_field_t plane_fields[] = {TENSOR("first", deck_plane, first),
                                                    TENSOR("second", deck_plane, second), CYAML_FIELD_END};

static const cyaml_schema_field_t envelope_fields[] = {
    TEXT("name", deck_envelope, name),
    CHOICE("axis", deck_envelope, axis, axis_names),
    CYAML_FIELD_MAPPING_PTR("plane", OPTIONAL_POINTER, deck_envelope, plane, plane_fields),
    CHOICE("principal", deck_envelope, principal, frame_names),
    CHOICE("all_components", deck_envelope, all_components, boolean_names),
    CHOICE("impose", deck_envelope, impose, imposed_names),
    CYAML_FIELD_UINT_PTR("probes", OPTIONAL, deck_envelope, probes),
    CYAML_FIELD_FLOAT_PTR("size", OPTIONAL, deck_envelope, size),
    CHOICE("unload", deck_envelope, unload, boolean_names),
    CYAML_FIELD_FLOAT_PTR("tolerance", OPTIONAL, deck_envelope, tolerance),
    CYAML_FIELD_UINT_PTR("threads", OPTIONAL, deck_envelope, threads),
    CHOICE("vtk", deck_envelope, vtk, boolean_names),
    CYAML_FIELD_SEQUENCE("series", CYAML_FLAG_POINTER, deck_envelope, series, &series_value, 1, CYAML_UNLIMITED),
    CYAML_FIELD_END};

static const cyaml_schema_value_t material_value = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_material, material_fields)};
static const cyaml_schema_value_t state_value = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_state, state_fields)};
static const cyaml_schema_value_t test_value = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_test, test_fields)};
static const cyaml_schema_value_t envelope_value = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, deck_envelope, envelope_fields)};

static const cyaml_schema_field_t deck_fields[] = {
    OPTIONAL_TEXT("title", deck, title),
    CHOICE("unit", deck, unit, unit_names),
    CHOICE("sign", deck, sign, sign_names),
    CYAML_FIELD_SEQUENCE("materials", CYAML_FLAG_POINTER, deck, materials, &material_value, 1, CYAML_UNLIMITED),
    CYAML_FIELD_SEQUENCE("states", CYAML_FLAG_POINTER, deck, states, &state_value, 1, CYAML_UNLIMITED),
    CYAML_FIELD_SEQUENCE("tests", OPTIONAL_POINTER, deck, tests, &test_value, 0, CYAML_UNLIMITED),
    CYAML_FIELD_SEQUENCE("envelopes", OPTIONAL_POINTER, deck, envelopes, &envelope_value, 0, CYAML_UNLIMITED),
    CYAML_FIELD_END};

static void complete_schema(void) {
  int n = 0;
  while (step_fields[n].key) ++n;
  deck_add_preset_keys(offsetof(deck_step, parameter), step_fields + n);
}

const cyaml_schema_value_t *deck_schema(void) {
  static const cyaml_schema_value_t whole = {CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, deck, deck_fields)};
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  pthread_once(&once, complete_schema);
  return &whole;
}

const char *deck_unit_name(deck_unit unit) { return unit_names[unit].str; }

const char *deck_frame_name(deck_frame frame) { return frame_names[frame].str; }

const char *deck_sign_name(deck_sign sign) { return sign_names[sign].str; }
