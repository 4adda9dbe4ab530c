/**
 * @file vtk_sections.h
 * @brief What a legacy VTK text file holds, and where: found by walking through it once.
 */
#ifndef HYPOFAB_FABRIC2DELTA_VTK_SECTIONS_H
#define HYPOFAB_FABRIC2DELTA_VTK_SECTIONS_H

#include "base/text/lines.h"

enum { VTK_MAX_ARRAYS = 32, VTK_NAME = 64 };

/** An array of numbers. */
typedef struct vtk_array {
  char name[VTK_NAME]; /**< "" for the points and the lines */
  bool of_points;      /**< of POINT_DATA, else of CELL_DATA */
  int parts;           /**< numbers per point or cell */
  int64_t count;       /**< points or cells */
  int64_t line;        /**< of the file, before the first number */
} vtk_array;

/** All arrays of a file. */
typedef struct vtk_sections {
  vtk_array points; /**< count 0: none */
  vtk_array lines;  /**< LINES; parts is 0 as their numbers are not equal in number */
  vtk_array arrays[VTK_MAX_ARRAYS];
  int n_arrays;
} vtk_sections;

/** Reads numbers one after the other, across lines. */
typedef struct vtk_numbers {
  lines input;
  const char *next; /**< in the line at hand */
} vtk_numbers;

/** Walk through a file whose first line comes next. @return HYPOFAB_BAD_FILE for binary files and damaged ones */
hypofab_status vtk_sections_find(lines *input, vtk_sections *sections);

/** Open a file at an array; to be closed by lines_close(&numbers->input) in any case. */
hypofab_status vtk_numbers_open(vtk_numbers *numbers, const char *path, const vtk_array *array);

/** The next number. */
hypofab_status vtk_number_next(vtk_numbers *numbers, double *value);

#endif
