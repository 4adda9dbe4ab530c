/* One laboratory test of a calibration file: what is compared, and the state it began from. */
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "base/message.h"
#include "deck/calibration/calibration_resolve.h"
#include "deck/resolve/resolve.h"

static const double degree = HYPOFAB_PI / 180.0;

static hypofab_status check_number(const deck_source *source, unsigned entry, const char *key, const double *value,
                                   double least, const char *expected) {
  if (!value || *value > least) return HYPOFAB_OK;
  return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].%s", entry, key), "%g, expected %s", *value,
                     expected);
}

static hypofab_status check_numbers(const deck_source *source, const deck_lab_test *given, unsigned entry) {
  const struct {
    const char *key;
    const double *value;
  } positive[] = {{"sigma1", given->sigma1},         {"sigma3", given->sigma3}, {"K0", given->K0},
                  {"void_ratio", given->void_ratio}, {"weight", given->weight}, {"reversal", given->reversal}};
  hypofab_status status = HYPOFAB_OK;
  for (size_t i = 0; i < sizeof positive / sizeof *positive && !status; ++i)
    status = check_number(source, entry, positive[i].key, positive[i].value, 0.0, "a number > 0");
  for (int q = 0; given->compare && q < HYPOFAB_N_LAB && !status; ++q) {
    const double *weight = given->compare->value[q];
    const deck_key key = deck_key_format("tests[%u].compare.%s", entry, hypofab_laboratory_quantity_name(q));
    if (!weight) continue;
    if (!(*weight >= 0.0))
      status = deck_refuse(source, HYPOFAB_BAD_FILE, key, "%g, expected 0 or more", *weight);
    else if (*weight > 0.0 && !given->columns->quantity[q])
      status = deck_refuse(source, HYPOFAB_BAD_FILE, key,
                           "%g, but the test has no such column, expected one under "
                           "'columns'",
                           *weight);
  }
  if (!status && given->reversal && !(*given->reversal < 1.0))
    status = deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].reversal", entry),
                         "%g, expected a share below 1 of the range of what the test follows", *given->reversal);
  if (!status && given->points && (*given->points < 2 || *given->points > 100000))
    status = deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].points", entry),
                         "%u, expected 2 to 100000 rows", *given->points);
  const double *pair = given->free_void_ratio;
  if (!status && pair && !(pair[0] > 0.0 && pair[1] > pair[0]))
    status = deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].free_void_ratio", entry),
                         "[%g, %g], expected [lower, upper] with 0 < lower < upper", pair[0], pair[1]);
  if (!status && pair && given->use && !*given->use)
    status = deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u].free_void_ratio", entry),
                         "given for a test with 'use: check', expected 'void_ratio', as nothing of it is fitted");
  return status;
}

/* A value of the first row, or NaN. */
static double first(const hypofab_laboratory_test *test, int quantity) {
  return test->measured[quantity] ? test->measured[quantity][0] : NAN;
}

/* Axial and lateral stress: keys first, then the first row. */
static void find_stress(const hypofab_calibration *c, const deck_lab_test *given, hypofab_laboratory_test *test) {
  if (test->kind == HYPOFAB_LAB_OEDOMETER) {
    test->sigma1 = given->sigma1 ? *given->sigma1 : first(test, HYPOFAB_LAB_SIGMA1);
    test->sigma3 = (given->K0 ? *given->K0 : 1.0 - sin(degree * calibration_friction(c))) * test->sigma1;
    return;
  }
  double lateral = given->sigma3 ? *given->sigma3 : NAN;
  if (isnan(lateral) && test->measured[HYPOFAB_LAB_P]) {
    lateral = first(test, HYPOFAB_LAB_P);
    if (test->measured[HYPOFAB_LAB_Q]) lateral -= first(test, HYPOFAB_LAB_Q) / 3.0;
  }
  test->sigma1 = test->sigma3 = lateral;
}

static hypofab_status find_state(const hypofab_calibration *c, const deck_source *source, const deck_lab_test *given,
                                 unsigned entry, hypofab_laboratory_test *test) {
  find_stress(c, given, test);
  const bool oedometer = test->kind == HYPOFAB_LAB_OEDOMETER;
  if (!(test->sigma1 > 0.0 && test->sigma3 > 0.0))
    return deck_refuse(source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u]", entry),
                       isnan(test->sigma1) ? "the effective stress at the start is not known, expected '%s' or column "
                                             "%s"
                                           : "the first row has no pressure, expected '%s' or a positive first row of "
                                             "column %s",
                       oedometer ? "sigma1" : "sigma3", oedometer ? "sigma1" : "p");
  const double *pair = given->free_void_ratio;
  test->void_ratio = given->void_ratio ? *given->void_ratio : first(test, HYPOFAB_LAB_E);
  if (isnan(test->void_ratio) && pair) test->void_ratio = 0.5 * (pair[0] + pair[1]);
  if (isnan(test->void_ratio))
    return deck_refuse(
        source, HYPOFAB_BAD_FILE, deck_key_format("tests[%u]", entry),
        "the void ratio at the start is not known, expected 'void_ratio', column e, or 'free_void_ratio: "
        "[lower, upper]'");
  return HYPOFAB_OK;
}

hypofab_status calibration_resolve_test(hypofab_calibration *c, const deck_source *source, unsigned entry,
                                        unsigned test) {
  const deck_lab_test *given = &c->given->tests[entry];
  hypofab_laboratory_test *made = &c->tests[test];
  const deck_key name = deck_key_format("tests[%u].name", entry);
  if (!study_is_plain_name(given->name))
    return deck_refuse(source, HYPOFAB_BAD_FILE, name, "'%s', expected letters, digits, - _ . alone", given->name);
  for (unsigned i = 0; i < entry; ++i)
    if (strcmp(c->given->tests[i].name, given->name) == 0)
      return deck_refuse(source, HYPOFAB_BAD_FILE, name,
                         "'%s' is also the name of tests[%u], expected a name of its own", given->name, i);
  hypofab_status status = check_numbers(source, given, entry);
  if (!status) status = calibration_read(c, source, entry, test);
  if (status) return status;
  made->name = given->name;
  made->kind = (hypofab_laboratory_kind)given->kind;
  made->start = given->start ? (hypofab_laboratory_start)*given->start : HYPOFAB_START_MOBILISED;
  made->weight = given->weight ? *given->weight : 0.0;
  made->drive = given->drive ? *given->drive + 1 : 0;
  made->reversal = given->reversal ? *given->reversal : 0.0;
  made->points = given->points ? (int)*given->points : 0;
  for (int q = 0; q < HYPOFAB_N_LAB; ++q)
    made->quantity[q] = given->compare && given->compare->value[q] ? *given->compare->value[q] : 0.0;
  return find_state(c, source, given, entry, made);
}
