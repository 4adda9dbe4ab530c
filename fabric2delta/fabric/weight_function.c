/* A new weight function is one function and one row of the table. It must be 0 at a = 0, grow, and tend to 1; with the
 * slope 1/c at a = 0, c means the same for all of them as long as a is small. */
#include "fabric2delta/fabric/weight_function.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "base/name_list.h"

/* Paper 000, Eq. 7. */
static double exponential(double a, double c) { return 1.0 - exp(-a / c); }

/* The others are ours, to see how much the choice matters: towards 1 slower, faster, and with a sharp bend. */
static double rational(double a, double c) { return isinf(a / c) ? 1.0 : a / c / (1.0 + a / c); }
static double hyperbolic(double a, double c) { return tanh(a / c); }
static double linear(double a, double c) { return fmin(a / c, 1.0); }

/* df/dx of f as a function of x = a/c. */
static double exponential_slope(double x) { return exp(-x); }
static double rational_slope(double x) { return 1.0 / ((1.0 + x) * (1.0 + x)); }
static double hyperbolic_slope(double x) { return 1.0 / (cosh(x) * cosh(x)); }
static double linear_slope(double x) { return x < 1.0 ? 1.0 : 0.0; }

static const struct weight_function {
  const char *name, *formula;
  double (*value)(double a, double c);
  double (*slope)(double x);
} functions[] = {
    {"exponential", "1 - exp(-a/c)", exponential, exponential_slope},
    {"rational", "a/(a + c)", rational, rational_slope},
    {"tanh", "tanh(a/c)", hyperbolic, hyperbolic_slope},
    {"linear", "min(a/c, 1)", linear, linear_slope},
};

enum { N_FUNCTIONS = sizeof functions / sizeof *functions };

const char *hypofab_weight_name(int index) { return index >= 0 && index < N_FUNCTIONS ? functions[index].name : NULL; }

const char *hypofab_weight_formula(int index) {
  return index >= 0 && index < N_FUNCTIONS ? functions[index].formula : NULL;
}

hypofab_status weight_function_value(const char *name, double a, double c, double *value, double *slope) {
  name_list known = {""};
  for (int i = 0; i < N_FUNCTIONS; i++) {
    if (!name || !strcmp(name, functions[i].name)) {
      const double x = a / c;
      *value = functions[i].value(a, c);
      if (slope) *slope = isinf(x) ? 0.0 : -functions[i].slope(x) * x / c;
      return HYPOFAB_OK;
    }
    name_list_add(&known, functions[i].name);
  }
  return hypofab_fail_about(HYPOFAB_BAD_ARGUMENT, HYPOFAB_ABOUT_ARGUMENT, -1, "weight",
                            "weight function '%s'; expected one of %s", name, known.text);
}
