#define _GNU_SOURCE /* strtod_l */
#include "base/text/number.h"

#include <float.h>
#include <locale.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static locale_t c_locale;
static pthread_once_t locale_once = PTHREAD_ONCE_INIT;

static void make_locale(void) { c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0); }

/* By the C library. It would skip white space, and so read on in the next line: the caller has excluded that. */
static const char *read_slowly(const char *text, double *value) {
  char *end;
  pthread_once(&locale_once, make_locale);
  *value = c_locale ? strtod_l(text, &end, c_locale) : strtod(text, &end);
  return end == text ? NULL : end;
}

/* The same where the C library would not read on at a decimal comma or at the exponent of Fortran: by a copy. */
static const char *read_foreign(const char *text, char decimal, double *value) {
  char copy[400];
  size_t n = 0;
  for (; n < sizeof copy - 1 && text[n] && strchr("+-0123456789.,eEdD", text[n]); n++) {
    const char c = text[n];
    if (c == (decimal == ',' ? '.' : ',')) break;
    copy[n] = c == ',' ? '.' : c == 'd' || c == 'D' ? 'e' : c;
  }
  copy[n] = '\0';
  const char *end = read_slowly(copy, value);
  return end ? text + (end - copy) : NULL;
}

/* Exact powers of ten: 10^22 is the largest in double, 10^27 in the long double of x86. */
static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

#if LDBL_MANT_DIG == 64 && (defined(__x86_64__) || defined(__i386__))
static const long double long_powers[] = {1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
                                          1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
                                          1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};

/* digits 10^power, unless its 64 bits lie halfway between two doubles: then it is not known which is nearer. */
static bool scale_long(uint64_t digits, int power, double *value) {
  if (power < -27 || power > 27) return false;
  long double x = power < 0 ? (long double)digits / long_powers[-power] : (long double)digits * long_powers[power];
  uint64_t mantissa;
  memcpy(&mantissa, &x, sizeof mantissa); /* x86: the first eight bytes */
  if ((mantissa & 0x7ff) == 0x400) return false;
  *value = (double)x;
  return true;
}
#else
static bool scale_long(uint64_t digits, int power, double *value) {
  (void)digits, (void)power, (void)value;
  return false;
}
#endif

static bool scale(uint64_t digits, int power, double *value) {
  if (digits > (UINT64_C(1) << 53) || power < -22 || power > 22) return scale_long(digits, power, value);
  *value = power < 0 ? (double)digits / powers[-power] : (double)digits * powers[power];
  return true;
}

static inline bool is_exponent(char c) { return c == 'e' || c == 'E' || c == 'd' || c == 'D'; }

static inline bool is_digit(char c) { return (unsigned)(c - '0') < 10; }

static inline const char *read_number(const char *text, char decimal, double *value) {
  const char *p = text;
  const bool negative = *p == '-';
  if (negative || *p == '+') p++;
  uint64_t digits = 0;
  const char *first = p;
  while (is_digit(*p)) digits = 10 * digits + (uint64_t)(*p++ - '0');
  int count = (int)(p - first), power = 0;
  if (*p == decimal) {
    first = ++p;
    while (is_digit(*p)) digits = 10 * digits + (uint64_t)(*p++ - '0');
    power = (int)(first - p);
    count -= power;
  }
  /* More digits would not fit; no digits: nan, inf, or no number. 0x and other beginnings stop at a letter. */
  if (count == 0 && *p != 'n' && *p != 'N' && *p != 'i' && *p != 'I') return NULL;
  bool foreign = decimal != '.';
  if (count == 0 || *p == 'x' || *p == 'X') return read_slowly(text, value);
  if (is_exponent(*p)) {
    foreign |= *p == 'd' || *p == 'D';
    const char *mark = p++;
    const bool down = *p == '-';
    if (down || *p == '+') p++;
    int exponent = 0;
    if (!is_digit(*p)) p = mark;
    while (p != mark && is_digit(*p)) exponent = exponent < 10000 ? 10 * exponent + (*p++ - '0') : (p++, exponent);
    power += down ? -exponent : exponent;
  }
  if (count > 19 || !scale(digits, power, value))
    return foreign ? read_foreign(text, decimal, value) : read_slowly(text, value);
  if (negative) *value = -*value;
  return p;
}

const char *number_read(const char *text, double *value) { return read_number(text, '.', value); }

const char *number_read_as(const char *text, char decimal, double *value) {
  return decimal == '.' ? read_number(text, '.', value) : read_number(text, ',', value);
}

const char *whole_number_read(const char *text, int64_t *value) {
  const char *p = text;
  const bool negative = *p == '-';
  p += negative;
  uint64_t digits = 0;
  const char *first = p;
  while (is_digit(*p)) {
    uint64_t digit = (uint64_t)(*p - '0');
    if (digits > (INT64_MAX - digit) / 10) return NULL;
    digits = 10 * digits + digit;
    p++;
  }
  if (p == first) return NULL;
  *value = negative ? -(int64_t)digits : (int64_t)digits;
  return p;
}
