#include "fabric2delta/formats/contact_layout.h"

#include <math.h>
#include <string.h>

#include "base/message.h"

const double contact_length_tolerance = 1e-3;

const char *const contact_role_names[CONTACT_ROLES] = {
    "nx",  "ny",  "nz",  "bx",  "by",  "bz",  "px",     "py",     "pz",     "fx", "fy", "fz",
    "fnx", "fny", "fnz", "fsx", "fsy", "fsz", "cell_x", "cell_y", "cell_z", "x1", "y1", "z1",
    "x2",  "y2",  "z2",  "id1", "id2", "fn",  "area",   "r1",     "ft",     "tx", "ty", "tz"};

static const int vectors[] = {ROLE_NX,  ROLE_BX,     ROLE_PX, ROLE_FX, ROLE_FNX,
                              ROLE_FSX, ROLE_CELL_X, ROLE_X1, ROLE_X2, ROLE_TX};

static hypofab_status check_pair(const contact_layout *layout, const char *path, int first, int second) {
  if (layout->has_role[first] == layout->has_role[second]) return HYPOFAB_OK;
  const bool left = layout->has_role[first];
  return hypofab_fail(HYPOFAB_BAD_FILE, "%s: a column of %s%s, but none %s; expected both or none", path,
                      first == ROLE_ID1 ? "ids " : "", contact_role_names[left ? first : second],
                      contact_role_names[left ? second : first]);
}

hypofab_status contact_layout_settle(contact_layout *layout, const char *path) {
  bool *has = layout->has_role;
  for (size_t v = 0; v < sizeof vectors / sizeof *vectors; v++) {
    const int x = vectors[v];
    if (layout->plane) has[x + 2] = has[x + 2] || (has[x] && has[x + 1]); /* z may be missing and is not used */
    hypofab_status status = check_pair(layout, path, x, x + 1);
    if (!status) status = check_pair(layout, path, x, x + 2);
    if (status) return status;
  }
  hypofab_status status = check_pair(layout, path, ROLE_ID1, ROLE_ID2);
  if (!status) status = check_pair(layout, path, ROLE_X1, ROLE_X2);
  if (status) return status;
  const bool branch = has[ROLE_BX] || has[ROLE_X1];
  if (!has[ROLE_NX] && !branch)
    return hypofab_fail(HYPOFAB_BAD_FILE,
                        "%s: no columns give the normals; expected nx, ny, nz, or a branch vector bx, by, bz, or the "
                        "centres x1, y1, z1, x2, y2, z2",
                        path);
  layout->has = (has[ROLE_ID1] ? CONTACT_HAS_IDS : 0) | (branch ? CONTACT_HAS_BRANCH : 0) |
                (has[ROLE_PX] || (has[ROLE_X1] && has[ROLE_R1]) ? CONTACT_HAS_POSITION : 0) |
                (has[ROLE_FX] || has[ROLE_FNX] || has[ROLE_FN] ? CONTACT_HAS_FORCE : 0) |
                (has[ROLE_FX] || has[ROLE_FSX] || (has[ROLE_FT] && has[ROLE_TX]) ? CONTACT_HAS_SHEAR : 0) |
                (has[ROLE_AREA] ? CONTACT_HAS_AREA : 0) | (has[ROLE_CELL_X] ? CONTACT_HAS_CELL : 0);
  return HYPOFAB_OK;
}

static inline double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void take(const contact_layout *layout, const table_value *values, int role, double sign, double x[3]) {
  x[0] = sign * values[role].real;
  x[1] = sign * values[role + 1].real;
  x[2] = layout->plane ? 0.0 : sign * values[role + 2].real;
}

/* x2 - x1, by the image given or else the nearest one. */
static void branch_of_centres(const contact_layout *layout, const table_value *values, contact *one) {
  double x1[3], x2[3];
  take(layout, values, ROLE_X1, 1.0, x1);
  take(layout, values, ROLE_X2, 1.0, x2);
  for (int i = 0; i < 3; i++) {
    const double length = layout->length[i];
    double branch = x2[i] - x1[i];
    if (length > 0.0) branch += length * (one->has & CONTACT_HAS_CELL ? one->cell[i] : -nearbyint(branch / length));
    one->branch[i] = branch;
  }
}

static void read_geometry(const contact_layout *layout, const table_value *values, double sense, contact *one) {
  const bool *has = layout->has_role;
  if (has[ROLE_CELL_X])
    for (int i = 0; i < 3; i++) one->cell[i] = (int)values[ROLE_CELL_X + i].whole;
  if (has[ROLE_BX])
    take(layout, values, ROLE_BX, sense, one->branch);
  else if (has[ROLE_X1])
    branch_of_centres(layout, values, one);
  if (has[ROLE_NX])
    take(layout, values, ROLE_NX, sense, one->normal);
  else
    memcpy(one->normal, one->branch, sizeof one->normal);
  if (has[ROLE_PX]) take(layout, values, ROLE_PX, 1.0, one->position);
}

static void read_forces(const contact_layout *layout, const table_value *values, double sense, contact *one) {
  const bool *has = layout->has_role;
  double force[3];
  if (has[ROLE_FX]) {
    take(layout, values, ROLE_FX, sense, force);
    one->normal_force = dot(force, one->normal);
    for (int i = 0; i < 3; i++) one->shear_force[i] = force[i] - one->normal_force * one->normal[i];
  }
  if (has[ROLE_FNX]) {
    take(layout, values, ROLE_FNX, sense, force);
    one->normal_force = dot(force, one->normal);
  } else if (has[ROLE_FN]) {
    one->normal_force = values[ROLE_FN].real;
  }
  if (has[ROLE_FSX]) {
    take(layout, values, ROLE_FSX, sense, one->shear_force);
  } else if (has[ROLE_FT] && has[ROLE_TX]) {
    take(layout, values, ROLE_TX, sense * values[ROLE_FT].real, one->shear_force);
  }
}

static bool all_finite(const contact *one) {
  const double sum = one->normal[0] + one->normal[1] + one->normal[2] + one->branch[0] + one->branch[1] +
                     one->branch[2] + one->position[0] + one->position[1] + one->position[2] + one->normal_force +
                     one->shear_force[0] + one->shear_force[1] + one->shear_force[2] + one->area;
  return isfinite(sum);
}

contact_problem contact_of_row(const contact_layout *layout, const table_value values[CONTACT_ROLES], contact *one) {
  const bool *has = layout->has_role;
  memset(one, 0, sizeof *one);
  one->id1 = one->id2 = -1;
  one->has = layout->has;
  if (has[ROLE_ID1]) {
    one->id1 = values[ROLE_ID1].whole;
    one->id2 = values[ROLE_ID2].whole;
  }
  const double wall = layout->walls_reversed && one->id2 < 0 ? -1.0 : 1.0;
  read_geometry(layout, values, layout->from_2_to_1 ? -wall : wall, one);
  const double length = sqrt(dot(one->normal, one->normal));
  const bool any_length = layout->normalise || !has[ROLE_NX];
  contact_problem problem = CONTACT_FINE;
  if (!(fabs(length - 1.0) <= contact_length_tolerance) && !(any_length && length > 0.0 && isfinite(length)))
    problem = !(isfinite(one->normal[0]) && isfinite(one->normal[1]) && isfinite(one->normal[2])) ? CONTACT_NOT_FINITE
              : length == 0.0                                                                     ? CONTACT_ZERO_NORMAL
                                                                                                  : CONTACT_NOT_UNIT;
  const double inverse = 1.0 / length;
  for (int i = 0; i < 3; i++) one->normal[i] *= inverse;
  read_forces(layout, values, layout->force_on_1 ? -wall : wall, one);
  if (has[ROLE_AREA]) one->area = values[ROLE_AREA].real;
  if (has[ROLE_X1] && has[ROLE_R1] && !has[ROLE_PX]) {
    take(layout, values, ROLE_X1, 1.0, one->position);
    for (int i = 0; i < 3; i++) one->position[i] += values[ROLE_R1].real * one->normal[i];
  }
  if (problem) return problem;
  /* A normal of finite length is finite. */
  if (layout->has & ~(CONTACT_HAS_IDS | CONTACT_HAS_CELL) && !all_finite(one)) return CONTACT_NOT_FINITE;
  if (has[ROLE_ID1] && one->id1 == one->id2 && !(one->cell[0] || one->cell[1] || one->cell[2]))
    return CONTACT_WITH_ITSELF;
  if (layout->both_sides && one->id2 >= 0 && one->id1 > one->id2) return CONTACT_LEFT_OUT;
  return CONTACT_FINE;
}
