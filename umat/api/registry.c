/* The models of this process: those of the library, and what was registered behind them. */
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"
#include "umat/api/rows.h"

enum { MOST_REGISTERED = 64 };

static const hypofab_model *const built_in[] = {&hypofab_sand_model};
enum { N_BUILT_IN = sizeof built_in / sizeof *built_in };

/* Grows only: a row is stored before the count that shows it. */
static _Atomic(const hypofab_model *) registered[MOST_REGISTERED];
static atomic_int n_registered;
static atomic_flag is_growing = ATOMIC_FLAG_INIT;

int hypofab_model_count(void) { return N_BUILT_IN + atomic_load(&n_registered); }

const hypofab_model *hypofab_model_at(int index) {
  if (index < 0 || index >= hypofab_model_count()) return NULL;
  return index < N_BUILT_IN ? built_in[index] : atomic_load(&registered[index - N_BUILT_IN]);
}

const hypofab_model *hypofab_model_find(const char *name) {
  const hypofab_model *model;
  for (int i = 0; (model = hypofab_model_at(i)); i++)
    if (strcmp(model->info.name, name) == 0) return model;
  return NULL;
}

const hypofab_model_info *hypofab_model_describe(const hypofab_model *model) { return &model->info; }

/* Does every variable lie inside the numbers? */
static int variables_fit(const hypofab_model *row) {
  int has_void_ratio = 0, has_memory = row->info.memory < 0;
  for (int i = 0; i < row->info.n_variables; i++) {
    const hypofab_variable_info *v = &row->variables[i];
    if (v->place < 0 || v->place + (int)v->kind > row->info.n_numbers) return 0;
    has_void_ratio |= v->place == row->info.void_ratio && v->kind == HYPOFAB_IS_SCALAR;
    has_memory |= v->place == row->info.memory && v->kind == HYPOFAB_IS_TENSOR;
  }
  return has_void_ratio && has_memory;
}

static int is_complete(const hypofab_model *row) {
  const hypofab_model_info *info = &row->info;
  return row->size >= sizeof *row && info->name && info->description && info->n_parameters > 0 &&
         info->n_parameters <= HYPOFAB_MAX_PARAMETERS && info->n_numbers > 0 &&
         info->n_numbers <= HYPOFAB_MAX_NUMBERS && info->n_variables <= HYPOFAB_MAX_NUMBERS && row->variables &&
         variables_fit(row) && row->parameter && row->check_material && row->check_state && row->rate &&
         row->linear_parts && row->variable_rates && row->derivatives && row->update && row->strain_scale &&
         (info->memory < 0 || (row->memory_size && row->memory_off && row->growth));
}

static hypofab_status append(const hypofab_model *row) {
  const int n = atomic_load(&n_registered);
  if (hypofab_model_find(row->info.name))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "there is a model '%s' already, expected another name", row->info.name);
  if (n == MOST_REGISTERED) return hypofab_fail(HYPOFAB_NO_MEMORY, "more than %d models, expected less", n);
  atomic_store(&registered[n], row);
  atomic_store(&n_registered, n + 1);
  return HYPOFAB_OK;
}

hypofab_status hypofab_model_register(const hypofab_model *row) {
  if (!row || !is_complete(row))
    return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "the row of a model is not complete, see hypofab_model_row.h");
  while (atomic_flag_test_and_set(&is_growing)) continue;
  const hypofab_status status = append(row);
  atomic_flag_clear(&is_growing);
  return status;
}

static hypofab_status refuse_index(const char *what, int index, int n) {
  return hypofab_fail(HYPOFAB_BAD_ARGUMENT, "%s number %d does not exist, expected 0 to %d", what, index, n - 1);
}

hypofab_status hypofab_model_parameter(const hypofab_model *model, int index, hypofab_parameter_info *info) {
  if (index < 0 || index >= model->info.n_parameters) return refuse_index("parameter", index, model->info.n_parameters);
  model->parameter(index, info);
  return HYPOFAB_OK;
}

int hypofab_model_parameter_find(const hypofab_model *model, const char *name) {
  hypofab_parameter_info info;
  for (int i = 0; i < model->info.n_parameters; i++) {
    model->parameter(i, &info);
    if (strcmp(info.name, name) == 0) return i;
  }
  return -1;
}

hypofab_status hypofab_model_variable(const hypofab_model *model, int index, hypofab_variable_info *info) {
  if (index < 0 || index >= model->info.n_variables) return refuse_index("variable", index, model->info.n_variables);
  *info = model->variables[index];
  return HYPOFAB_OK;
}

int hypofab_model_variable_find(const hypofab_model *model, const char *name) {
  for (int i = 0; i < model->info.n_variables; i++)
    if (strcmp(model->variables[i].name, name) == 0) return i;
  return -1;
}

/* Values of set number index; NULL past the last. */
static const double *set_at(const hypofab_model *model, int index, hypofab_set_info *info) {
  return model->set ? model->set(index, info) : NULL;
}

int hypofab_model_set_count(const hypofab_model *model) {
  hypofab_set_info info;
  int n = 0;
  while (set_at(model, n, &info)) n++;
  return n;
}

hypofab_status hypofab_model_set(const hypofab_model *model, int index, hypofab_set_info *info) {
  if (index < 0 || !set_at(model, index, info))
    return refuse_index("parameter set", index, hypofab_model_set_count(model));
  return HYPOFAB_OK;
}

hypofab_status hypofab_material_built_in(const char *name, hypofab_material *material) {
  char known[HYPOFAB_MESSAGE_SIZE] = "";
  size_t used = 0;
  const hypofab_model *model;
  hypofab_set_info set;
  const double *value;
  for (int i = 0; (model = hypofab_model_at(i)); i++)
    for (int k = 0; (value = set_at(model, k, &set)); k++) {
      if (strcmp(set.name, name) == 0) {
        *material = (hypofab_material){.model = model};
        memcpy(material->value, value, (size_t)model->info.n_parameters * sizeof *value);
        return HYPOFAB_OK;
      }
      if (used < sizeof known) used += (size_t)snprintf(known + used, sizeof known - used, " %s", set.name);
    }
  return hypofab_fail_about(HYPOFAB_BAD_MATERIAL, HYPOFAB_ABOUT_ARGUMENT, -1, "name",
                            "there is no built-in parameter set \"%s\", expected one of:%s", name, known);
}

void hypofab_material_start(const hypofab_model *model, hypofab_material *material) {
  hypofab_parameter_info info;
  *material = (hypofab_material){.model = model};
  for (int i = 0; i < model->info.n_parameters; i++) {
    model->parameter(i, &info);
    material->value[i] = info.start;
  }
}

double *hypofab_material_parameter(hypofab_material *material, const char *name) {
  const int index = hypofab_model_parameter_find(material->model, name);
  return index < 0 ? NULL : &material->value[index];
}

double *hypofab_state_variable(const hypofab_model *model, hypofab_state *state, const char *name) {
  const int index = hypofab_model_variable_find(model, name);
  return index < 0 ? NULL : &state->variable[model->variables[index].place];
}

double *hypofab_memory(const hypofab_model *model, hypofab_state *state) {
  return model->info.memory < 0 ? NULL : &state->variable[model->info.memory];
}

double *hypofab_void_ratio(const hypofab_model *model, hypofab_state *state) {
  return &state->variable[model->info.void_ratio];
}

void hypofab_state_start(const hypofab_model *model, hypofab_state *state) {
  *state = (hypofab_state){0};
  for (int i = 0; i < model->info.n_variables; i++)
    for (int k = 0; k < (int)model->variables[i].kind; k++)
      state->variable[model->variables[i].place + k] = model->variables[i].start;
}
