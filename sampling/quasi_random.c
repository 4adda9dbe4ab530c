/* Quasi-random sequences, those of GSL by name. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_qrng.h>
#include <string.h>

#include "base/message.h"
#include "base/name_list.h"

/* GSL's Sobol sequence has this many points less one; the others go on. */
static const int64_t points_of_sobol = INT64_C(1) << 30;

static const struct sequence {
  const char *name;
  const gsl_qrng_type *const *type;
} sequences[] = {
    {"sobol", &gsl_qrng_sobol},
    {"halton", &gsl_qrng_halton},
    {"reverse_halton", &gsl_qrng_reversehalton},
    {"niederreiter", &gsl_qrng_niederreiter_2},
};

enum { N_SEQUENCES = sizeof sequences / sizeof *sequences };

const char *hypofab_sequence_name(int index) {
  return index >= 0 && index < N_SEQUENCES ? sequences[index].name : NULL;
}

int hypofab_sequence_dimensions(int index) {
  return index >= 0 && index < N_SEQUENCES ? (int)(*sequences[index].type)->max_dimension : 0;
}

static hypofab_status find(const char *name, const struct sequence **found) {
  name_list known = {""};
  for (int i = 0; i < N_SEQUENCES; i++) {
    *found = &sequences[i];
    if (name && !strcmp(name, sequences[i].name)) return HYPOFAB_OK;
    name_list_add(&known, sequences[i].name);
  }
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "quasi-random sequence '%s', expected one of %s", name ? name : "",
                      known.text);
}

static hypofab_status check(const struct sequence *sequence, int dimension, int64_t skip, int64_t n) {
  const int most = (int)(*sequence->type)->max_dimension;
  if (dimension < 1 || dimension > most)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%d dimensions of the sequence '%s', expected 1 to %d", dimension,
                        sequence->name, most);
  if (n < 1) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%lld points, expected 1 or more", (long long)n);
  if (skip < 0) return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%lld points left out, expected 0 or more", (long long)skip);
  if (n >= points_of_sobol || skip >= points_of_sobol - n)
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT,
                        "%lld points after %lld that are left out, expected fewer than 2^30 together", (long long)n,
                        (long long)skip);
  return HYPOFAB_OK;
}

hypofab_status hypofab_quasi_random(const char *sequence, int dimension, int64_t skip, int64_t n, double *points) {
  const struct sequence *known;
  hypofab_status status = find(sequence, &known);
  if (!status) status = check(known, dimension, skip, n);
  if (status) return status;
  gsl_qrng *generator = gsl_qrng_alloc(*known->type, (unsigned)dimension);
  if (!generator) return hypofab_fail(HYPOFAB_NO_MEMORY, "no memory for a sequence of %d dimensions", dimension);
  /* Points left out are written to the place of the first one. */
  for (int64_t i = -skip; i < n && !status; i++)
    if (gsl_qrng_get(generator, points + (i > 0 ? i : 0) * dimension))
      status = hypofab_fail(HYPOFAB_INTERNAL_ERROR, "the sequence '%s' ended at point %lld", known->name,
                            (long long)(skip + i));
  gsl_qrng_free(generator);
  return status;
}
