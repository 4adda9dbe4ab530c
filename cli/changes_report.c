#include "cli/changes_report.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>

#include "cli/report.h"

static const char *const mechanisms[HYPOFAB_N_MECHANISMS] = {"loss", "gain", "reorientation"};
static const char *const components[6] = {"xx", "yy", "zz", "xy", "xz", "yz"};

/* ------------------------------------------------------------------- table */

static double trace(const double tensor[6]) { return tensor[0] + tensor[1] + tensor[2]; }

static void print_estimate(const char *name, hypofab_estimate one) {
  if (isfinite(one.error))
    printf("  %s = %.4g +- %.2g", name, one.value, one.error);
  else
    printf("  %s = %.4g", name, one.value);
}

static void print_response(const changes_result *result) {
  const hypofab_fabric_response *response = &result->response;
  printf("\nfit (value +- standard error):\n");
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) {
    const hypofab_mechanism_fit *one = &response->mechanism[m];
    const hypofab_estimate numbers[] = {one->B, one->C, one->D, one->E, one->G};
    printf("%-14s", mechanisms[m]);
    for (int k = 0; k < 5; k++) {
      const bool used = m != HYPOFAB_REORIENTATION || k == 1 || k == 3;
      if (used) print_estimate((const char *[]){"B", "C", "D", "E", "G"}[k], numbers[k]);
    }
    putchar('\n');
  }
  printf("%-14s", "total");
  for (int k = 0; k < 5; k++) print_estimate((const char *[]){"a1", "a2", "a3", "a4", "a5"}[k], response->a[k]);
  printf("\nincrementally linear if zero:");
  static const char *const conditions[] = {"B^g-B^l", "D^g-D^l", "G^g-G^l+G^r"};
  for (int k = 0; k < 3; k++) print_estimate(conditions[k], response->linear[k]);
  printf("\nexpected in an isotropic sample: no gain from %.2f to %.2f deg, no loss from %.2f to %.2f deg\n",
         result->no_gain[0], result->no_gain[1], result->no_loss[0], result->no_loss[1]);
}

int changes_print_table(const changes_result *result) {
  const hypofab_fabric_change *first = &result->items[0].change;
  printf("%-34s %s\n%-34s %lld\n%-34s %lld\n%-34s %.6f\n\n", "before", result->before, "contacts N_c",
         (long long)first->contacts_before, "particles N_p", (long long)first->particles, "Z = tr F",
         trace(first->fabric_before));
  const bool probes = result->strain > 0.0;
  printf("%8s %8s %8s %10s %12s %12s %12s %12s", "lost", "gained", "persist", "turn [deg]", "dZ", "dF_xx", "dF_yy",
         "dF_zz");
  if (probes)
    printf("  %8s %10s %10s %10s %10s %10s", "alpha", "dZ* loss", "dZ* gain", "dA* loss", "dA* gain", "dA* turn");
  printf("  after\n");
  for (unsigned i = 0; i < result->n_items; i++) {
    const compared *one = &result->items[i];
    const hypofab_fabric_change *change = &one->change;
    printf("%8lld %8lld %8lld %10.4f", (long long)change->contacts[0], (long long)change->contacts[1],
           (long long)change->contacts[2], change->turn);
    printf(" %12.5g %12.5g %12.5g %12.5g", trace(change->change), change->change[0], change->change[1],
           change->change[2]);
    const hypofab_fabric_probe *probe = &one->probe;
    if (probes && one->is_probe)
      printf("  %8g %10.4g %10.4g %10.4g %10.4g %10.4g", probe->angle, probe->dZ[0], probe->dZ[1], probe->dA[0],
             probe->dA[1], probe->dA[2]);
    else if (probes)
      printf("  %8s %10s %10s %10s %10s %10s", "hold", "", "", "", "", "");
    printf("  %s\n", one->file);
  }
  if (result->fitted) print_response(result);
  return cli_finish_output();
}

/* --------------------------------------------------------------------- CSV */

/* A field of a CSV file (RFC 4180): quoted where it must be. */
static void print_field(const char *text) {
  bool plain = true;
  for (const char *c = text; *c; c++) plain = plain && *c != ',' && *c != '"' && *c != '\n' && *c != '\r';
  if (plain) {
    fputs(text, stdout);
    return;
  }
  putchar('"');
  for (const char *c = text; *c; c++) {
    if (*c == '"') putchar('"');
    putchar(*c);
  }
  putchar('"');
}

static void print_header(void) {
  fputs("after,contacts_before,contacts_after,particles,lost,gained,persisting,turn,angle,strain", stdout);
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) printf(",dZ_%s", mechanisms[m]);
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) printf(",dA_%s", mechanisms[m]);
  for (int i = 0; i < 6; i++) printf(",dF_%s", components[i]);
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++)
    for (int i = 0; i < 6; i++) printf(",dF_%s_%s", mechanisms[m], components[i]);
  putchar('\n');
}

/* A number, "nan" when it is not known. */
static void print_value(double value) {
  if (isfinite(value))
    printf(",%.17g", value);
  else
    fputs(",nan", stdout);
}

int changes_print_csv(const changes_result *result) {
  print_header();
  for (unsigned i = 0; i < result->n_items; i++) {
    const compared *one = &result->items[i];
    const hypofab_fabric_change *change = &one->change;
    print_field(one->file);
    const int64_t counts[] = {change->contacts_before, change->contacts_after, change->particles,
                              change->contacts[0],     change->contacts[1],    change->contacts[2]};
    for (int k = 0; k < 6; k++) printf(",%lld", (long long)counts[k]);
    print_value(change->turn);
    print_value(one->is_probe ? one->probe.angle : (double)NAN);
    print_value(one->is_probe ? result->strain : (double)NAN);
    for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) print_value(one->is_probe ? one->probe.dZ[m] : (double)NAN);
    for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) print_value(one->is_probe ? one->probe.dA[m] : (double)NAN);
    for (int k = 0; k < 6; k++) print_value(change->change[k]);
    for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++)
      for (int k = 0; k < 6; k++) print_value(change->by_mechanism[m][k]);
    putchar('\n');
  }
  return cli_finish_output();
}

/* -------------------------------------------------------------------- JSON */

static json_t *rose_object(const hypofab_rose *rose) {
  json_t *counts = json_array();
  for (int i = 0; i < rose->bins; i++) json_array_append_new(counts, json_integer((json_int_t)rose->count[i]));
  return json_pack("{s:i, s:I, s:o, s:o, s:o}", "bins", rose->bins, "contacts", (json_int_t)rose->contacts, "count",
                   counts, "anisotropy", number_to_json(rose->anisotropy), "direction",
                   number_to_json(rose->direction));
}

static json_t *mechanism_object(const compared *one, int m) {
  const hypofab_fabric_change *change = &one->change;
  json_t *object = json_pack("{s:I, s:o}", "contacts", (json_int_t)change->contacts[m], "change",
                             numbers_to_json(change->by_mechanism[m], 6));
  if (one->is_probe) {
    json_object_set_new(object, "dZ", number_to_json(one->probe.dZ[m]));
    json_object_set_new(object, "dA", number_to_json(one->probe.dA[m]));
  }
  if (m == HYPOFAB_REORIENTATION)
    json_object_set_new(object, "turn", number_to_json(change->turn));
  else
    json_object_set_new(object, "rose", rose_object(&change->rose[m]));
  return object;
}

static json_t *snapshot_object(const compared *one) {
  json_t *object =
      json_pack("{s:s, s:I, s:o, s:o}", "file", one->file, "contacts", (json_int_t)one->change.contacts_after, "fabric",
                numbers_to_json(one->change.fabric_after, 6), "change", numbers_to_json(one->change.change, 6));
  json_object_set_new(object, "angle", number_to_json(one->is_probe ? one->probe.angle : (double)NAN));
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++) json_object_set_new(object, mechanisms[m], mechanism_object(one, m));
  return object;
}

static json_t *estimate_object(hypofab_estimate one) {
  return json_pack("{s:o, s:o}", "value", number_to_json(one.value), "error", number_to_json(one.error));
}

static json_t *estimates_array(const hypofab_estimate *items, int n) {
  json_t *array = json_array();
  for (int i = 0; i < n; i++) json_array_append_new(array, estimate_object(items[i]));
  return array;
}

static json_t *fit_object(const hypofab_mechanism_fit *one) {
  return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "B", estimate_object(one->B), "C",
                   estimate_object(one->C), "D", estimate_object(one->D), "E", estimate_object(one->E), "G",
                   estimate_object(one->G), "dZ_extension", estimate_object(one->dZ_extension), "dZ_shear",
                   estimate_object(one->dZ_shear), "dZ_compression", estimate_object(one->dZ_compression), "r2_dZ",
                   number_to_json(one->r2_dZ), "r2_dA", number_to_json(one->r2_dA));
}

static json_t *response_object(const hypofab_fabric_response *response) {
  json_t *object = json_object();
  for (int m = 0; m < HYPOFAB_N_MECHANISMS; m++)
    json_object_set_new(object, mechanisms[m], fit_object(&response->mechanism[m]));
  json_object_set_new(object, "a", estimates_array(response->a, 5));
  json_object_set_new(object, "linear_if_zero", estimates_array(response->linear, 3));
  return object;
}

int changes_print_json(const changes_result *result) {
  const hypofab_fabric_change *first = &result->items[0].change;
  json_t *snapshots = json_array();
  for (unsigned i = 0; i < result->n_items; i++) json_array_append_new(snapshots, snapshot_object(&result->items[i]));
  json_t *object =
      json_pack("{s:s, s:I, s:I, s:o, s:s, s:o, s:o}", "before", result->before, "contacts_before",
                (json_int_t)first->contacts_before, "particles", (json_int_t)first->particles, "fabric_before",
                numbers_to_json(first->fabric_before, 6), "plane", result->plane, "strain",
                number_to_json(result->strain > 0.0 ? result->strain : (double)NAN), "snapshots", snapshots);
  if (result->fitted) {
    json_object_set_new(object, "response", response_object(&result->response));
    json_object_set_new(object, "no_gain", numbers_to_json(result->no_gain, 2));
    json_object_set_new(object, "no_loss", numbers_to_json(result->no_loss, 2));
  }
  return print_json(object);
}
