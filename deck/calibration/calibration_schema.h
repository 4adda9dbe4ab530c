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

typedef struct deck_index_tests {
  double *repose, *e_min, *e_max;
} deck_index_tests;

/** `parameters`, `bounds` and `ratios` are read once the model is known: deck/source/numbers.h. */
typedef struct deck_calibration {
  char *title;
  int *unit;
  deck_choice choice;
  int *estimate;
  deck_index_tests *index_tests;
  int *intergranular;
  char **free;
  unsigned free_count;
  deck_lab_test *tests;
  unsigned tests_count;
  unsigned *starts, *max_iterations, *threads;
  double *tolerance;
  int *derivatives;
} deck_calibration;

/** Schema of a calibration file. */
extern const cyaml_schema_value_t deck_calibration_schema;

#endif
