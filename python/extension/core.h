/**
 * @file core.h
 * @brief What _core.pyf wraps: the C interface of hypofab with numbers, arrays and texts alone.
 *
 * f2py knows no structs, no callbacks and no returned texts; each function here stands for one of hypofab.h or
 * hypofab_describe.h and does no more than to pack and unpack. Nothing here calls back into Python, so every function
 * runs without the interpreter's lock.
 *
 * A text that goes in ends with a zero byte; its length follows at the end of the argument list, as f2py has it. A text
 * that comes out fills a buffer of the length that follows, cut if need be.
 */
#ifndef HYPOFAB_PYTHON_CORE_H
#define HYPOFAB_PYTHON_CORE_H

#include <stddef.h>

#include "hypofab.h"
#include "sizes.h"

/** Numbers of a fabric: see core_pack_fabric. */
#define CORE_FABRIC 30

/** Numbers of a fitted ellipsoid: see core_probe_fit. */
#define CORE_ELLIPSOID 58

/** Behind each of several texts in one: f2py takes a zero byte for the end of all. */
#define CORE_UNIT_SEPARATOR "\x1f"

/** Copy a text (NULL: none) to a buffer of `size` characters, filled up with zeros. */
void core_text(const char *text, char *buffer, size_t size);

/** The state of core_state_size numbers, and back. */
hypofab_state core_unpack_state(const double *numbers);
void core_pack_state(const hypofab_state *state, double *numbers);

/** The material of core_material_size numbers, and back. */
hypofab_material core_unpack_material(const double *numbers);
void core_pack_material(const hypofab_material *material, double *numbers);

/** CORE_FABRIC numbers: contacts, particles, rattlers, N, F, a, principal values and directions, Z, mechanical Z. */
void core_pack_fabric(const hypofab_fabric *fabric, double *numbers);

/**
 * How a contact file is to be read. texts: id1, id2, nx, ny, nz, kind, particle file, columns, particle columns, wall
 * ids, each with CORE_UNIT_SEPARATOR behind it; choices: dimension, wrong, duplicates, walls, normalise, threads. The
 * format points into *owned, to be freed; HYPOFAB_NO_MEMORY otherwise.
 */
int core_unpack_format(const char *texts, int separator, const int *choices, long long particles,
                       hypofab_contact_format *format, char **owned);

/** Does the caller's flag, which another thread may set, ask to stop? The type of hypofab_progress; user: the flag. */
int core_asked_to_stop(const char *what, double fraction, void *user);

/* Messages, sands, parameters. */
void core_message(char *text, size_t size);
void core_status_text(int status, char *text, size_t size);
void core_version(char *text, size_t size);
void core_quantity_name(int index, char *text, size_t size);
/** core_material_size and core_state_size. */
void core_sizes(int *numbers);
/** Number of the first measure of stability: these are the last of the quantities that every model has. */
int core_first_stability(void);
/** numbers: parameters, state variables, their numbers, place of the intergranular strain, of the void ratio. */
int core_model(int index, char *name, char *description, int *numbers, size_t name_size, size_t description_size);
int core_set(int model, int index, double *material, char *name, char *description, char *source, size_t name_size,
             size_t description_size, size_t source_size);
/** bounds: lower, upper, start. */
int core_parameter(int model, int index, double *bounds, int *role, char *name, char *unit, char *description,
                   size_t name_size, size_t unit_size, size_t description_size);
/** numbers: kind, place, whether it has a sign. */
int core_variable(int model, int index, int *numbers, double *start, char *name, char *unit, char *description,
                  size_t name_size, size_t unit_size, size_t description_size);
double core_memory_size(const double *material);
void core_memory_off(const double *material, double *without);
void core_limiting_void_ratios(const double *material, int n, const double *p, double *limits);

/* The model at one point, and at many. */
int core_material_check(const double *material);
int core_state_check(const double *material, const double *state);
int core_rate(const double *material, const double *state, const double *stretching, double *rate, int *branch);
int core_linear_parts(const double *material, const double *state, double *reversal, double *jump, double *direction,
                      int *branch);
int core_update(const double *material, const double *start, const double *strain, double tolerance,
                int max_evaluations, int wants_tangent, double *end, double *tangent, double *substep, int *report);
int core_update_batch(const double *material, double tolerance, int max_evaluations, int threads, int n, double *stress,
                      double *numbers, const double *strain, int *statuses, long long *report, char *instructions,
                      size_t instructions_size);
double core_friction_angle(const double *stress);

/* Decks. A handle is the address of a study or of collected rows; Python frees each once. */
int core_study_load(const char *path, long long *handle, size_t path_length);
int core_study_parse(const char *text, const char *path, long long *handle, size_t text_length, size_t path_length);
void core_study_free(long long handle);
void core_study_size(long long handle, int *counts);
void core_study_name(long long handle, int list, int index, char *text, size_t size);
void core_study_unit(long long handle, char *text, size_t size);
int core_study_test_state(long long handle, int index);
int core_study_state(long long handle, int index, double *material, double *state);
int core_study_test_run(long long handle, int index, int *stop, long long *rows, long long *report);
void core_study_column(long long handle, int test, int index, char *text, size_t size);
void core_study_sensitivity_name(long long handle, int test, int index, char *text, size_t size);
void core_derivatives_take(long long rows, int numbers, int quantities, int n, double *values);
void core_rows_take(long long rows, int n, int width, double *values);
void core_rows_free(long long rows);
int core_study_stiffness(long long handle, const long long *options, double level, int *stop, int n, double *results);
int core_study_fit_c(long long handle, const char *tests, int n, const double *stiffness, const double *options,
                     double *numbers, double *computed, int *open, size_t length);
int core_study_run(long long handle, const char *directory, int *stop, size_t length);
int core_study_envelopes(long long handle, const char *directory, int *stop, size_t length);

/* Probes and stability. */
int core_subspace(int kind, int axis, const double *first, const double *second, int *dimension, double *basis);
int core_directions(int dimension, const double *basis, int n, double *directions);
int core_triangles(int n, int n_triangles, int *triangles);
int core_probe(const double *material, const double *state, int imposed, double size, int unload, double tolerance,
               int threads, int n, const double *directions, int *stop, double *answers, double *measures,
               int *statuses);
int core_probe_fit(int dimension, const double *basis, int n, const double *answers, const int *statuses, int part,
                   double *ellipsoid, double *distances);
int core_stability(const double *material, const double *state, double *numbers, int *branches);

/* Contact fabric. */
int core_fabric_of_contacts(int dimension, int n, const double *normals, int n_ids, const long long *id1,
                            const long long *id2, long long particles, double *fabric);
int core_fabric_read(const char *path, const char *texts, int separator, const int *choices, long long particles,
                     double *fabric, long long *report, size_t path_length, size_t texts_length);
int core_fabric_from_tensor(const double *tensor, double *fabric);
int core_fabric_rotate(const double *fabric, const double *rotation, double *turned);
int core_fabric_significance(const double *fabric, double *numbers);
int core_fabric_correct(const double *fabric, double noise2, double *corrected);
int core_fabric_to_delta(const double *fabric, double R, double c, const char *weight, double *numbers, size_t length);
int core_snapshot_read(const char *path, const char *texts, int separator, const int *choices, long long particles,
                       int ignore_images, long long *handle, size_t path_length, size_t texts_length);
void core_snapshot_free(long long handle);
int core_snapshot_compare(long long handle, const char *path, const char *texts, int separator, const int *choices,
                          long long particles, const long long *options, long long *counts, double *tensors,
                          double *numbers, long long *roses, size_t path_length, size_t texts_length);
int core_fabric_fit(int n, const double *probes, int printed, double *fits, double *totals);
int core_contact_directions(const char *path, const char *texts, int separator, const int *choices, long long particles,
                            int wanted, int room, int *count, double *bins, size_t path_length, size_t texts_length);
int core_bootstrap(const char *paths, const char *texts, int separator, const int *choices, long long particles,
                   const long long *options, const double *map, const char *weight, int n, double *fabric,
                   double *numbers, long long *units, double *replicates, size_t paths_length, size_t texts_length,
                   size_t weight_length);
void core_weight(int index, char *name, char *formula, size_t name_size, size_t formula_size);

/* Designs of many runs. */
int core_quasi_random(const char *sequence, long long skip, int n, int dimension, double *points, size_t length);
int core_quantiles(int shape, const double *parameters, int n, const double *probabilities, double *values);
int core_probabilities(int shape, const double *parameters, int n, const double *values, double *probabilities);

/* Calibrations; a handle is the address of one, Python frees each once. A report is taken once, which frees it. */
int core_calibration_load(const char *path, long long *handle, size_t path_length);
int core_calibration_parse(const char *text, const char *path, long long *handle, size_t text_length,
                           size_t path_length);
void core_calibration_free(long long handle);
void core_calibration_size(long long handle, int *counts);
void core_calibration_parameter(long long handle, int index, double *numbers, char *name, size_t size);
int core_calibration_distance(long long handle, int n, const double *values, int n_tests, double *distance,
                              double *of_tests);
int core_calibration_run(long long handle, int *stop);
int core_calibration_report(long long handle, long long *text);
void core_report_take(long long text, int n, signed char *bytes);
int core_calibration_write(long long handle, const char *directory, size_t length);

#endif
