/**
 * @file exact_sum.h
 * @brief Sums of doubles without rounding: equal bit for bit in any order and in any number of parts.
 *
 * A fixed-point number wide enough for every double (after Neal, "Fast exact summation using small and large
 * superaccumulators", 2015): 67 digits to the base 2^32, kept in 64 bits so that carries may wait.
 */
#ifndef HYPOFAB_FABRIC2DELTA_EXACT_SUM_H
#define HYPOFAB_FABRIC2DELTA_EXACT_SUM_H

#include <stdint.h>
#include <string.h>

enum { EXACT_SUM_DIGITS = 67, EXACT_SUM_CARRY = 1 << 10 };

/** A sum. All zero is an empty, usable one. Digit i counts 2^(32 i - 1074). */
typedef struct exact_sum {
  int64_t digit[EXACT_SUM_DIGITS];
  int waiting; /**< numbers added since the last carry */
} exact_sum;

/** Bring every digit but the last into [0, 2^32): then equal sums have equal digits. */
void exact_sum_carry(exact_sum *sum);

/** Add a finite number. */
static inline void exact_sum_add(exact_sum *sum, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  const int exponent = (int)(bits >> 52 & 0x7ff);
  uint64_t mantissa = bits & UINT64_C(0xfffffffffffff);
  /* x = mantissa 2^(shift - 1074); numbers below 2^-1022 have no hidden bit. */
  const int shift = exponent ? exponent - 1 : 0;
  if (exponent) mantissa |= UINT64_C(1) << 52;
  const int low = shift & 31, digit = shift >> 5;
  const int64_t first = (int64_t)(mantissa << low & UINT64_C(0xffffffff));
  const int64_t rest = (int64_t)(mantissa >> (32 - low)); /* at most 53 bits */
  const int64_t sign = (int64_t)(bits >> 63 ? -1 : 1);
  sum->digit[digit] += sign * first;
  sum->digit[digit + 1] += sign * rest;
  if (++sum->waiting == EXACT_SUM_CARRY) exact_sum_carry(sum);
}

/** Add another sum. */
void exact_sum_merge(exact_sum *sum, const exact_sum *other);

/** The sum, rounded to double (within two units of its last place; always the same for the same sum). */
double exact_sum_value(const exact_sum *sum);

#endif
