#include "fabric2delta/fabric/exact_sum.h"

#include <math.h>

static const int64_t base = INT64_C(1) << 32;

void exact_sum_carry(exact_sum *sum) {
  for (int i = 0; i + 1 < EXACT_SUM_DIGITS; i++) {
    int64_t carry = sum->digit[i] / base;
    if (sum->digit[i] % base < 0) carry--; /* rounds down, so that the digit left is not negative */
    sum->digit[i] -= carry * base;
    sum->digit[i + 1] += carry;
  }
  sum->waiting = 0;
}

void exact_sum_merge(exact_sum *sum, const exact_sum *other) {
  exact_sum addend = *other;
  exact_sum_carry(sum);
  exact_sum_carry(&addend);
  for (int i = 0; i < EXACT_SUM_DIGITS; i++) sum->digit[i] += addend.digit[i];
  exact_sum_carry(sum);
}

double exact_sum_value(const exact_sum *sum) {
  exact_sum copy = *sum;
  exact_sum_carry(&copy);
  /* A negative sum has a negative last digit and positive ones below, which would cancel: its opposite has not. */
  const int sign = copy.digit[EXACT_SUM_DIGITS - 1] < 0 ? -1 : 1;
  if (sign < 0) {
    for (int i = 0; i < EXACT_SUM_DIGITS; i++) copy.digit[i] = -copy.digit[i];
    exact_sum_carry(&copy);
  }
  double value = 0.0;
  for (int i = 0; i < EXACT_SUM_DIGITS; i++) value += ldexp((double)copy.digit[i], 32 * i - 1074);
  return sign * value;
}
