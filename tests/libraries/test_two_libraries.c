/*
 * Two UMAT libraries in one process: libhypofab_umat and another one, whose modules have the same names but where pi
 * is 3. Whichever is loaded first, for all to see or not, each gives the numbers that it gives alone.
 */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */

typedef void umat_function(double *, double *, double *, double *, double *, double *, double *, double *, double *,
                           double *, const double *, const double *, const double *, const double *, const double *,
                           const double *, const double *, const double *, const char *, const int *, const int *,
                           const int *, const int *, const double *, const int *, const double *, const double *,
                           double *, const double *, const double *, const double *, const int *, const int *,
                           const int *, const int *, const int *, const int *);

/* Axial stress after 0.1 % of oedometric compression; NAN if the library cannot be asked. */
static double axial_stress(void *library) {
  umat_function *umat = NULL;
  if (library) *(void **)&umat = dlsym(library, "umat_");
  if (!umat) return NAN;
  const double props[16] = {33, 0, 1e6, .25, .55, .95, 1.05, .25, 1.5, 5, 2, 1e-4, .5, 6, 0, .7};
  const double dstran[6] = {0, 0, -1e-3};
  const int ndi = 3, nshr = 3, ntens = 6, nstatv = 13, nprops = 16;
  double stress[6] = {-100, -100, -100}, statev[13] = {0}, ddsdde[36], pnewdt = 1;
  umat(stress, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, dstran, NULL, NULL, NULL, NULL, NULL,
       NULL, NULL, &ndi, &nshr, &ntens, &nstatv, props, &nprops, NULL, NULL, &pnewdt, NULL, NULL, NULL, NULL, NULL,
       NULL, NULL, NULL, NULL);
  return pnewdt < 1 ? NAN : stress[2];
}

/* The stress of each library in a process of its own that loads one after the other; second may be NULL. */
static void in_a_process(const char *first, const char *second, int flags, double stress[2]) {
  int ends[2];
  assert_int_equal(pipe(ends), 0);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    void *one = dlopen(first, RTLD_NOW | flags), *two = second ? dlopen(second, RTLD_NOW | flags) : NULL;
    if (!one || (second && !two)) fprintf(stderr, "%s\n", dlerror());
    const double both[2] = {axial_stress(one), axial_stress(two)};
    _exit(write(ends[1], both, sizeof both) != sizeof both);
  }
  close(ends[1]);
  assert_int_equal(read(ends[0], stress, 2 * sizeof *stress), 2 * sizeof *stress);
  close(ends[0]);
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_int_equal(status, 0);
}

static void test_each_gives_its_own_numbers(void **unused) {
  (void)unused;
  double own[2], other[2], both[2];
  in_a_process(HYPOFAB_UMAT, NULL, RTLD_LOCAL, own);
  in_a_process(OTHER_UMAT, NULL, RTLD_LOCAL, other);
  print_message("sigma_axial alone: %.6f and %.6f kPa\n", own[0], other[0]);
  assert_true(fabs(own[0] - other[0]) > 1);
  const int flags[] = {RTLD_GLOBAL, RTLD_LOCAL};
  for (int i = 0; i < 2; i++) {
    in_a_process(OTHER_UMAT, HYPOFAB_UMAT, flags[i], both);
    assert_true(both[0] == other[0] && both[1] == own[0]);
    in_a_process(HYPOFAB_UMAT, OTHER_UMAT, flags[i], both);
    assert_true(both[0] == own[0] && both[1] == other[0]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_gives_its_own_numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
