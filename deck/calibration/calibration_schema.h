/**
 * @file calibration_schema.h
 * @brief What a calibration file may say, as C structs filled by libcyaml. docs/calibration.md describes every key.
 */
#ifndef HYPOFAB_DECK_CALIBRATION_SCHEMA_H
#define HYPOFAB_DECK_CALIBRATION_SCHEMA_H

#include "deck/source/schema.h"

/** Where a measured quantity is in a file. */
typedef struct deck_lab_column {
  char *column;
  double *factor; /**< to ratio or to the unit of stress, compression positive; 1 */
} deck_lab_column;

typedef struct deck_lab_columns {
  deck_lab_column *quantity[HYPOFAB_N_LAB];
} deck_lab_columns;

/** A number for each quantity of laboratory tests. */
typedef struct deck_lab_weights {
  double *value[HYPOFAB_N_LAB];
} deck_lab_weights;

typedef struct deck_lab_test {
  char *name;
  int kind;
  char *file;
  deck_lab_columns *columns;
  double *sigma1, *sigma3, *K0, *void_ratio;
  double *free_void_ratio; /**< its bounds */
  double *from_sigma1;
  int *start;
  int *use; /**< 1: fitted; 0: only compared */
  double *weight;
  deck_lab_weights *compare;
  int *drive;
  double *reversal;
  unsigned *points;
} deck_lab_test;

/** Bounds by parameter, in the order of hypofab_material. */
typedef struct deck_bounds {
  double *pair[HYPOFAB_MAX_PARAMETERS];
} deck_bounds;

typedef struct deck_ratios {
  double *e_d0, *e_i0;
} deck_ratios;

typedef struct deck_index_tests {
  double *repose, *e_min, *e_max;
} deck_index_tests;

typedef struct deck_calibration {
  char *title;
  int *unit;
  char *sand;
  int *estimate;
  deck_index_tests *index_tests;
  deck_parameters *parameters;
  int *intergranular;
  char **free;
  unsigned free_count;
  deck_bounds *bounds;
  deck_ratios *ratios;
  deck_lab_test *tests;
  unsigned tests_count;
  unsigned *starts, *max_iterations, *threads;
  double *tolerance;
  int *derivatives;
} deck_calibration;

/** Schema of a calibration file. */
extern const cyaml_schema_value_t deck_calibration_schema;

#endif
