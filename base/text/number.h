/**
 * @file number.h
 * @brief Numbers in text: the double nearest to what is written, whatever the locale is.
 */
#ifndef HYPOFAB_FABRIC2DELTA_NUMBER_H
#define HYPOFAB_FABRIC2DELTA_NUMBER_H

#include <stdbool.h>
#include <stdint.h>

/**
 * @brief Read a real number at the beginning of a text.
 *
 * Every result is correctly rounded, as strtod's is. Up to 19 digits and a power of ten of at most 27 take a short
 * way: digits and power are exact, so that one operation rounds once (Clinger 1990); beyond 15 digits it is made in
 * long double, and the rare results halfway between two doubles go to strtod like everything else.
 * Exponents are marked by e, E, or d, D as Fortran writes them.
 * @param text   ends, at the latest, with a byte that belongs to no number (0, a newline)
 * @param value  set; may be infinite or NaN, when that is written or the number is too large
 * @return behind the number; NULL when there is none
 */
const char *number_read(const char *text, double *value);

/** The same with another decimal mark: ',' where text has decimal commas. */
const char *number_read_as(const char *text, char decimal, double *value);

/** Read a whole number, without sign or with '-', that fits 64 bits. @return behind it; NULL when there is none */
const char *whole_number_read(const char *text, int64_t *value);

#endif
