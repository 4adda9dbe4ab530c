/* A description as JSON. Tensors of the plane have the components xx, yy, xy alone; their names stand in
 * component_order and component_order_rank4. */
#include <stdbool.h>

#include "cli/cmd_fabric.h"
#include "cli/describe_report.h"
#include "cli/report.h"
#include "cli/sample_report.h"
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

static json_t *sample(const hypofab_description *d) {
  return json_pack("{s:o, s:o, s:o, s:o}", "volume", number_to_json(d->sample.volume), "solid_volume",
                   number_to_json(d->sample.solid_volume), "void_ratio", number_to_json(d->sample.void_ratio),
                   "rattlers", d->fabric.rattlers >= 0 ? json_integer(d->fabric.rattlers) : json_null());
}

static json_t *weighted(const hypofab_description *d) {
  static const char *const names[HYPOFAB_N_WEIGHTS] = {"number", "normal_force", "area", "branch_length"};
  json_t *object = json_object();
  for (int k = 0; k < HYPOFAB_N_WEIGHTS; k++)
    json_object_set_new(object, names[k], directions(d->dimension, &d->weighted[k]));
  return object;
}

static json_t *per_particle(const hypofab_description *d) {
  return json_pack("{s:o, s:o, s:o}", "fabric", tensor(d->dimension, 2, d->fabric_per_particle), "anisotropy",
                   number_to_json(d->anisotropy_per_particle), "fabric_by_solid_volume",
                   tensor(d->dimension, 2, d->fabric_by_solid_volume));
}

json_t *description_to_json(const char *file, const hypofab_description *d) {
  const int dim = d->dimension;
  const struct {
    const char *key;
    json_t *value;
  } members[] = {
      {"file", json_string(file)},
      {"dimension", json_integer(dim)},
      {"component_order", component_names(dim, 2)},
      {"component_order_rank4", component_names(dim, 4)},
      {"sample", sample(d)},
      {"reading", reading_to_json(&d->sample.report)},
      {"weighted", weighted(d)},
      {"branch", directions(dim, &d->branch)},
      {"long_axes", directions(dim, &d->long_axes)},
      {"mean_branch_length", number_to_json(d->mean_branch_length)},
      {"mean_normal_force", number_to_json(d->mean_normal_force)},
      {"mean_shear_force", number_to_json(d->mean_shear_force)},
      {"per_particle", per_particle(d)},
      {"harmonics", harmonics(dim, &d->harmonics)},
      {"forces", json_pack("{s:o, s:o}", "from_moments", anisotropy(dim, &d->from_moments), "from_bins",
                           anisotropy(dim, &d->from_bins))},
      {"stress", stress(dim, &d->stress)},
      {"networks", json_pack("{s:o, s:o, s:o}", "strong", network(dim, &d->strong), "weak", network(dim, &d->weak),
                             "sliding", network(dim, &d->sliding))},
  };
  json_t *object = fabric_to_json(&d->fabric);
  int failed = !object;
  /* Setting to NULL, where memory ran out, fails; setting releases the value in any case. */
  for (size_t i = 0; i < sizeof members / sizeof *members; i++)
    failed |= json_object_set_new(object, members[i].key, members[i].value);
  if (failed) {
    json_decref(object);
    return NULL;
  }
  const uncertainty found = uncertainty_of(&d->fabric);
  uncertainty_to_json(&found, false, object);
  return object;
}
