/**
 * @file fields.h
 * @brief The fields of a line: what separates them, where each one ends. Headers and rows are split here alone.
 */
#ifndef HYPOFAB_BASE_FIELDS_H
#define HYPOFAB_BASE_FIELDS_H

#include <stdbool.h>
#include <string.h>

/** Separates fields that are more than one blank apart, or a tab: names with blanks in columns under each other. */
#define FIELDS_WIDE_BLANKS 'w'

static inline bool field_blank(char c) { return c == ' ' || c == '\t'; }

/** The first character that is no blank. */
static inline const char *field_skip_blanks(const char *p, const char *end) {
  while (p < end && field_blank(*p)) p++;
  return p;
}

/** From inside a field to its end; one that begins with a quote ends behind the closing one. */
static inline const char *field_end(char separator, const char *p, const char *end) {
  if (p < end && *p == '"') {
    do p++;
    while (p < end && *p != '"');
    while (p + 1 < end && p[1] == '"') /* a doubled quote is part of the text */
      for (p += 2; p < end && *p != '"'; p++) continue;
  }
  if (separator == ' ')
    while (p < end && !field_blank(*p)) p++;
  else if (separator == FIELDS_WIDE_BLANKS)
    while (p < end && *p != '\t' && !(*p == ' ' && (p + 1 == end || field_blank(p[1])))) p++;
  else
    while (p < end && *p != separator) p++;
  return p;
}

/** The fields of a line, one after the other. */
typedef struct fields {
  const char *next, *end; /**< next NULL: the line is done */
  char separator;         /**< ',' ';' '\t', ' ' (runs of blanks and tabs), FIELDS_WIDE_BLANKS */
} fields;

/** Begin with a line that ends at `end`, where a newline or 0 stands. */
static inline fields fields_of(const char *line, const char *end, char separator) {
  if (end > line && end[-1] == '\r') end--;
  return (fields){line, end, separator};
}

/** The next field from *begin to *behind, without blanks around it and without quotes. @return false: none is left */
static inline bool field_next(fields *f, const char **begin, const char **behind) {
  if (!f->next) return false;
  const bool blanks = f->separator == ' ' || f->separator == FIELDS_WIDE_BLANKS;
  if (blanks && (f->next = field_skip_blanks(f->next, f->end)) == f->end) return false;
  const char *p = blanks || f->separator == '\t' ? f->next : field_skip_blanks(f->next, f->end);
  const char *stop = field_end(f->separator, p, f->end);
  f->next = stop < f->end ? stop + 1 : NULL;
  while (stop > p && field_blank(stop[-1])) stop--;
  if (stop - p >= 2 && *p == '"' && stop[-1] == '"') p++, stop--;
  *begin = p;
  *behind = stop;
  return true;
}

#endif
