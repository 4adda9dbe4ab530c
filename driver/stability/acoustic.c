#include "driver/stability/acoustic.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multimin.h>
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "driver/tensor.h"

/* Planes of the first search, about 6 degrees apart: the determinant is a polynomial of degree 6 in the normal. */
enum { N_PLANES = 600 };
/* The best of them that are this far apart start a refined search: cosine of 20 degrees. */
enum { N_STARTS = 5 };
static const double apart = 0.94;

/* Index of component ij in a six-vector. */
static const int voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

void acoustic_tensor(const double stiffness[36], const double normal[3], double Q[9]) {
  double traction[36]; /* n C as 3x6 */
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 6; c++) {
      traction[6 * i + c] = 0.0;
      for (int j = 0; j < 3; j++) traction[6 * i + c] += normal[j] * stiffness[6 * voigt[i][j] + c];
    }
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) {
      Q[3 * i + k] = 0.0; /* columns of shear hold C_ijkl + C_ijlk */
      for (int l = 0; l < 3; l++) Q[3 * i + k] += (k == l ? 1.0 : 0.5) * normal[l] * traction[6 * i + voigt[k][l]];
    }
}

static double determinant(const double Q[9]) {
  return Q[0] * (Q[4] * Q[8] - Q[5] * Q[7]) - Q[1] * (Q[3] * Q[8] - Q[5] * Q[6]) + Q[2] * (Q[3] * Q[7] - Q[4] * Q[6]);
}

/* x = Q^-1 b by Cramer's rule; the determinant is not zero. */
static void solve(const double Q[9], const double b[3], double x[3]) {
  const double all = determinant(Q);
  for (int k = 0; k < 3; k++) {
    double replaced[9];
    memcpy(replaced, Q, sizeof replaced);
    for (int i = 0; i < 3; i++) replaced[3 * i + k] = b[i];
    x[k] = determinant(replaced) / all;
  }
}

static void symmetric_dyad(const double a[3], const double b[3], double dyad[6]) {
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++) dyad[voigt[i][j]] = 0.5 * (a[i] * b[j] + a[j] * b[i]);
}

/* What is minimised over planes: one branch of the stiffness. */
typedef struct search {
  const linear_parts *parts;
  hypofab_branch branch;
  double stiffness[36]; /* of the branch; L of the plain model */
  double centre[3], across[2][3];
} search;

/* sym(r (x) n) of the plain model. */
static void plain_mode(const linear_parts *parts, const double Q[9], const double normal[3], double mode[6]) {
  double traction[3], r[3];
  for (int i = 0; i < 3; i++) {
    traction[i] = 0.0;
    for (int j = 0; j < 3; j++) traction[i] += parts->jump[voigt[i][j]] * normal[j];
  }
  solve(Q, traction, r);
  symmetric_dyad(r, normal, mode);
}

static double determinant_on(const search *s, const double normal[3]) {
  double Q[9];
  acoustic_tensor(s->stiffness, normal, Q);
  const double linear = determinant(Q);
  if (s->branch != HYPOFAB_PLAIN || !(linear > 0.0)) return linear;
  double mode[6];
  plain_mode(s->parts, Q, normal, mode);
  return linear * (1.0 - tensor_norm(mode));
}

/* Unit normal at coordinates on the tangent plane of the sphere at s->centre. */
static void place_normal(const search *s, double x, double y, double normal[3]) {
  double size = 0.0;
  for (int i = 0; i < 3; i++) {
    normal[i] = s->centre[i] + x * s->across[0][i] + y * s->across[1][i];
    size += normal[i] * normal[i];
  }
  for (int i = 0; i < 3; i++) normal[i] /= sqrt(size);
}

static double objective(const gsl_vector *at, void *parameters) {
  double normal[3];
  place_normal(parameters, gsl_vector_get(at, 0), gsl_vector_get(at, 1), normal);
  return determinant_on(parameters, normal);
}

static void set_centre(search *s, const double normal[3]) {
  int least = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(normal[i]) < fabs(normal[least])) least = i;
  double size = 0.0;
  for (int i = 0; i < 3; i++) {
    s->centre[i] = normal[i];
    s->across[0][i] = (i == least) - normal[least] * normal[i];
    size += s->across[0][i] * s->across[0][i];
  }
  for (int i = 0; i < 3; i++) s->across[0][i] /= sqrt(size);
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    s->across[1][i] = normal[j] * s->across[0][k] - normal[k] * s->across[0][j];
  }
}

/* Refine a plane by the simplex method of Nelder and Mead: two coordinates, and plain_mode has no simple gradient. */
static double refine(search *s, double normal[3]) {
  double start[2] = {0.0, 0.0}, first[2] = {0.05, 0.05};
  set_centre(s, normal);
  gsl_multimin_function function = {objective, 2, s};
  gsl_vector_view x = gsl_vector_view_array(start, 2), size = gsl_vector_view_array(first, 2);
  double found = determinant_on(s, normal);
  gsl_multimin_fminimizer *simplex = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
  if (!simplex) return found; /* no memory: the plane of the first search stands */
  int failed = gsl_multimin_fminimizer_set(simplex, &function, &x.vector, &size.vector);
  for (int i = 0; i < 200 && !failed; i++) {
    failed = gsl_multimin_fminimizer_iterate(simplex);
    if (gsl_multimin_fminimizer_size(simplex) < 1e-7) break;
  }
  const double lowest = gsl_multimin_fminimizer_minimum(simplex);
  if (lowest < found) {
    found = lowest;
    place_normal(s, gsl_vector_get(simplex->x, 0), gsl_vector_get(simplex->x, 1), normal);
  }
  gsl_multimin_fminimizer_free(simplex);
  return found;
}

/* Plane number k of a half sphere: a Fibonacci lattice. */
static void lattice(int k, double normal[3]) {
  const double golden = HYPOFAB_PI * (3.0 - sqrt(5.0)), z = 1.0 - (k + 0.5) / N_PLANES, r = sqrt(1.0 - z * z);
  normal[0] = r * cos(golden * k);
  normal[1] = r * sin(golden * k);
  normal[2] = z;
}

/* The smallest determinant of one branch. */
static double minimise(search *s, double best[3]) {
  double value[N_PLANES], starts[N_STARTS][3], lowest = INFINITY;
  for (int k = 0; k < N_PLANES; k++) {
    double normal[3];
    lattice(k, normal);
    value[k] = determinant_on(s, normal);
  }
  for (int n = 0; n < N_STARTS; n++) {
    int chosen = -1;
    for (int k = 0; k < N_PLANES; k++) {
      double normal[3];
      if (chosen >= 0 && !(value[k] < value[chosen])) continue;
      lattice(k, normal);
      int is_near = 0;
      for (int m = 0; m < n; m++)
        is_near |= fabs(normal[0] * starts[m][0] + normal[1] * starts[m][1] + normal[2] * starts[m][2]) > apart;
      if (!is_near) chosen = k;
    }
    if (chosen < 0) break;
    lattice(chosen, starts[n]);
    double normal[3];
    memcpy(normal, starts[n], sizeof normal);
    const double found = refine(s, normal);
    if (found < lowest) lowest = found, memcpy(best, normal, sizeof normal);
  }
  return lowest;
}

/* The right singular vector of the smallest singular value: the mode in which the plane gives way first. */
static void weakest_mode(const double Q[9], double mode[3]) {
  double U[9], V[9], singular[3], work[3];
  memcpy(U, Q, sizeof U);
  gsl_matrix_view u = gsl_matrix_view_array(U, 3, 3), v = gsl_matrix_view_array(V, 3, 3);
  gsl_vector_view s = gsl_vector_view_array(singular, 3), w = gsl_vector_view_array(work, 3);
  gsl_linalg_SV_decomp(&u.matrix, &v.matrix, &s.vector, &w.vector);
  for (int i = 0; i < 3; i++) mode[i] = V[3 * i + 2];
}

/* The acoustic tensor of the critical plane, on the branch (for the plain model: the direction) that is critical. */
static void critical_tensor(const search *s, const double normal[3], double Q[9]) {
  acoustic_tensor(s->stiffness, normal, Q);
  if (s->branch != HYPOFAB_PLAIN) return;
  double mode[6], stiffness[36];
  plain_mode(s->parts, Q, normal, mode);
  const double size = tensor_norm(mode);
  if (!(size > 0.0)) return;
  for (int i = 0; i < 6; i++) mode[i] /= -size;
  linear_branch(s->parts, mode, stiffness);
  acoustic_tensor(stiffness, normal, Q);
}

void acoustic_minimise(const linear_parts *parts, acoustic_minimum *minimum) {
  const hypofab_branch branches[2] = {parts->model, HYPOFAB_REVERSAL};
  const int n_branches = parts->model == HYPOFAB_PLAIN ? 1 : 2;
  minimum->determinant = INFINITY;
  for (int b = 0; b < n_branches; b++) {
    search s = {.parts = parts, .branch = branches[b]};
    linear_branch(parts, branches[b] == HYPOFAB_LOADING ? parts->direction : NULL, s.stiffness);
    double normal[3], Q[9], linear[9];
    const double lowest = minimise(&s, normal);
    if (!(lowest < minimum->determinant)) continue;
    minimum->determinant = lowest;
    minimum->branch = branches[b];
    memcpy(minimum->normal, normal, sizeof normal);
    critical_tensor(&s, normal, Q);
    weakest_mode(Q, minimum->mode);
    acoustic_tensor(parts->linear, normal, linear);
    minimum->ratio = lowest / determinant(linear);
  }
}
