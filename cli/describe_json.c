/* A description as JSON. Tensors of the plane have the components xx, yy, xy alone; their names stand in
 * component_order and component_order_rank4. */
#include <stdbool.h>

#include "cli/cmd_fabric.h"
#include "cli/describe_report.h"
#include "cli/report.h"
#include "cli/uncertainty_options.h"

static bool in_plane(const char *name) {
  for (; *name; name++)
    if (*name == 'z') return false;
  return true;
}

/* The components of a tensor that its dimension has. */
static json_t *tensor(int dimension, int rank, const double *components) {
  json_t *array = json_array();
  const char *name;
  for (int i = 0; (name = hypofab_component_name(rank, i)); i++)
    if (dimension == 3 || in_plane(name)) json_array_append_new(array, number_to_json(components[i]));
  return array;
}

static json_t *component_names(int dimension, int rank) {
  json_t *array = json_array();
  const char *name;
  for (int i = 0; (name = hypofab_component_name(rank, i)); i++)
    if (dimension == 3 || in_plane(name)) json_array_append_new(array, json_string(name));
  return array;
}

static json_t *matrix(int dimension, const double components[3][3]) {
  json_t *array = json_array();
  for (int i = 0; i < dimension; i++) json_array_append_new(array, numbers_to_json(components[i], dimension));
  return array;
}

static json_t *directions(int dimension, const hypofab_direction_fabric *fabric) {
  if (!fabric->count) return json_null();
  return json_pack(
      "{s:I, s:o, s:{s:o, s:o}, s:{s:o, s:o}, s:{s:o, s:o}, s:o, s:o, s:o, s:o, s:o}",                                //
      "count", (json_int_t)fabric->count, "total_weight", number_to_json(fabric->total),                              //
      "first_kind", "rank2", tensor(dimension, 2, fabric->first2), "rank4", tensor(dimension, 4, fabric->first4),     //
      "second_kind", "rank2", tensor(dimension, 2, fabric->second2), "rank4", tensor(dimension, 4, fabric->second4),  //
      "third_kind", "rank2", tensor(dimension, 2, fabric->third2), "rank4", tensor(dimension, 4, fabric->third4),     //
      "anisotropy", number_to_json(fabric->anisotropy), "deviator_fabric", number_to_json(fabric->deviator),          //
      "principal_values", numbers_to_json(fabric->principal_values, dimension), "principal_directions",
      matrix(dimension, fabric->principal_directions), "angle", number_to_json(fabric->angle));
}

static json_t *harmonics(int dimension, const hypofab_harmonics *series) {
  json_t *degrees = json_array();
  for (int k = 0, i = 0; k < HYPOFAB_N_DEGREES; k++) {
    const int end = dimension == 3 ? (2 * k + 1) * (k + 1) : 2 * k + 1;
    json_array_append_new(
        degrees, json_pack("{s:i, s:o, s:o, s:o, s:o, s:o, s:i, s:o}",                                          //
                           "degree", 2 * k, "coefficients", numbers_to_json(series->coefficient + i, end - i),  //
                           "power", number_to_json(series->power[k]), "isotropy_p",
                           number_to_json(series->isotropy_p[k]),  //
                           "r_squared", number_to_json(series->r_squared[k]), "chi_squared",
                           number_to_json(series->chi_squared[k]),  //
                           "degrees_of_freedom", series->degrees_of_freedom[k], "chi_squared_p",
                           number_to_json(series->chi_squared_p[k])));
    i = end;
  }
  return json_pack("{s:i, s:o}", "bins", series->bins, "degrees", degrees);
}

static json_t *anisotropy(int dimension, const hypofab_force_anisotropy *a) {
  return json_pack(
      "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
      "mean_normal_force", number_to_json(a->mean_normal_force),                         //
      "a_n", number_to_json(a->a_n), "a_f", number_to_json(a->a_f),                      //
      "a_t", number_to_json(a->a_t), "a_b", number_to_json(a->a_b),                      //
      "phi_n", number_to_json(a->phi_n), "phi_f", number_to_json(a->phi_f),              //
      "phi_t", number_to_json(a->phi_t),                                                 //
      "direction_n", numbers_to_json(a->direction_n, dimension),                         //
      "direction_f", numbers_to_json(a->direction_f, dimension),                         //
      "direction_t", numbers_to_json(a->direction_t, dimension),                         //
      "contact_tensor", tensor(dimension, 2, a->contact), "normal_force_tensor",         //
      tensor(dimension, 2, a->normal), "tangential_force_tensor",                        //
      tensor(dimension, 2, a->tangential), "branch_length_tensor",                       //
      tensor(dimension, 2, a->branch), "sin_phi", number_to_json(a->sin_phi),            //
      "sin_phi_short", number_to_json(a->sin_phi_short), "q_over_p",                     //
      number_to_json(a->q_over_p), "q_over_p_short", number_to_json(a->q_over_p_short),  //
      "sin_phi_coaxial", number_to_json(a->sin_phi_coaxial), "sin_phi_coaxial_short",    //
      number_to_json(a->sin_phi_coaxial_short));
}

static json_t *stress(int dimension, const hypofab_contact_stress *s) {
  return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",                                         //
                   "total", matrix(dimension, s->total), "normal", matrix(dimension, s->normal),            //
                   "tangential", matrix(dimension, s->tangential), "p", number_to_json(s->p),               //
                   "q", number_to_json(s->q), "q_over_p", number_to_json(s->q_over_p),                      //
                   "sin_phi", number_to_json(s->sin_phi), "normal_share", number_to_json(s->normal_share),  //
                   "tangential_share", number_to_json(s->tangential_share));
}

static json_t *network(int dimension, const hypofab_network *n) {
  return json_pack("{s:o, s:o, s:o, s:o}", "fraction", number_to_json(n->fraction), "mean_normal_force",
                   number_to_json(n->mean_normal_force), "fabric", directions(dimension, &n->fabric), "stress",
                   matrix(dimension, n->stress));
}

/* The test against isotropy of `hypofab fabric`; its numbers are those of space. */
static void add_significance(const hypofab_description *d, json_t *object) {
  uncertainty found = {0};
  found.has_significance =
      d->dimension == 3 && hypofab_fabric_significance(&d->fabric, &found.significance) == HYPOFAB_OK;
  uncertainty_to_json(&found, false, object);
}

json_t *description_to_json(const char *file, const hypofab_description *d) {
  const int dim = d->dimension;
  json_t *object = json_object();
  json_t *fabric = fabric_to_json(&d->fabric);
  json_t *more = json_pack(
      "{s:s, s:i, s:o, s:o, s:{s:o, s:o, s:o, s:o}, s:o, s:o, s:o, s:o, s:o, s:{s:o, s:o, s:o}, s:o, s:o, s:{s:o, "
      "s:o}, s:o}",
      "file", file, "dimension", dim,                                                                //
      "component_order", component_names(dim, 2), "component_order_rank4", component_names(dim, 4),  //
      "weighted", "number", directions(dim, &d->weighted[HYPOFAB_BY_NUMBER]), "normal_force",
      directions(dim, &d->weighted[HYPOFAB_BY_NORMAL_FORCE]), "area", directions(dim, &d->weighted[HYPOFAB_BY_AREA]),
      "branch_length", directions(dim, &d->weighted[HYPOFAB_BY_BRANCH_LENGTH]),            //
      "branch", directions(dim, &d->branch), "long_axes", directions(dim, &d->long_axes),  //
      "mean_branch_length", number_to_json(d->mean_branch_length),                         //
      "mean_normal_force", number_to_json(d->mean_normal_force),                           //
      "mean_shear_force", number_to_json(d->mean_shear_force),                             //
      "per_particle", "fabric", tensor(dim, 2, d->fabric_per_particle), "anisotropy",
      number_to_json(d->anisotropy_per_particle), "rattlers",
      d->fabric.rattlers >= 0 ? json_integer(d->fabric.rattlers) : json_null(),                                  //
      "harmonics", harmonics(dim, &d->harmonics), "stress", stress(dim, &d->stress),                             //
      "forces", "from_moments", anisotropy(dim, &d->from_moments), "from_bins", anisotropy(dim, &d->from_bins),  //
      "networks",
      json_pack("{s:o, s:o, s:o}", "strong", network(dim, &d->strong), "weak", network(dim, &d->weak), "sliding",
                network(dim, &d->sliding)));
  if (!object || json_object_update(object, fabric) || json_object_update(object, more)) {
    json_decref(object);
    object = NULL;
  }
  json_decref(fabric);
  json_decref(more);
  add_significance(d, object);
  return object;
}
