#include "fabric2delta/formats/npy_head.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"

enum { LONGEST_HEAD = 1 << 16 };

static hypofab_status refuse(const lines *input, const char *problem) {
  return hypofab_fail(HYPOFAB_BAD_FILE,
                      "%s: %s; expected a NumPy file (.npy) with a two-dimensional array of numbers, or an array of "
                      "records, little-endian and in C order; `hypofab contacts` makes it of others",
                      input->path, problem);
}

/* The text behind "'key':" in the head, which is a Python dictionary; NULL when it is not there. */
static const char *value_of(const char *text, const char *key) {
  char quoted[32];
  snprintf(quoted, sizeof quoted, "'%s':", key);
  const char *found = strstr(text, quoted);
  if (!found) return NULL;
  found += strlen(quoted);
  return found + strspn(found, " ");
}

/* "'<f8'" and the like: kind and size. Returns behind it, or NULL. */
static const char *read_kind(const char *p, npy_field *field) {
  if (*p != '\'') return NULL;
  const char order = p[1];
  field->kind = p[2];
  char *end;
  field->size = (int)strtol(p + 3, &end, 10);
  if (end == p + 3 || *end != '\'' || !strchr("fiuV", field->kind)) return NULL;
  if (field->kind == 'V') return field->size > 0 && order == '|' ? end + 1 : NULL; /* padding */
  const bool known = field->kind == 'f' ? field->size == 4 || field->size == 8
                                        : field->size == 1 || field->size == 2 || field->size == 4 || field->size == 8;
  return known && (order == '<' || (order == '|' && field->size == 1)) ? end + 1 : NULL;
}

/* Lengths in brackets, "(10, 5)" or "(10,)": up to two. Returns behind it, or NULL. */
static const char *read_lengths(const char *p, int64_t lengths[2], int *count) {
  if (*p++ != '(') return NULL;
  for (*count = 0; *p && *p != ')'; p += strspn(p, " ,")) {
    char *end;
    if (*count == 2) return NULL;
    lengths[*count] = strtoll(p, &end, 10);
    if (end == p || lengths[(*count)++] < 0) return NULL;
    p = end;
  }
  return *p == ')' ? p + 1 : NULL;
}

static bool add_field(npy_head *head, const npy_field *field, int parts) {
  for (int part = 0; part < parts; part++) {
    if (head->n_fields == NPY_MAX_FIELDS) return false;
    npy_field *added = &head->fields[head->n_fields++];
    *added = *field;
    added->offset = head->row;
    if (parts > 1) {
      char name[NPY_NAME];
      if (snprintf(name, sizeof name, "%.40s[%d]", field->name, part) >= NPY_NAME) return false;
      strcpy(added->name, name);
    }
    head->row += (size_t)field->size;
  }
  return true;
}

/* "[('id1', '<i8'), ('normal', '<f8', (3,))]" */
static bool read_records(const char *p, npy_head *head) {
  for (p++; *p != ']'; p += strspn(p, " ,")) {
    npy_field field = {0};
    if (*p++ != '(' || *p++ != '\'') return false;
    const size_t length = strcspn(p, "'");
    if (length >= NPY_NAME) return false;
    memcpy(field.name, p, length);
    p += length;
    if (*p++ != '\'') return false;
    p += strspn(p, ", ");
    if (!(p = read_kind(p, &field))) return false;
    p += strspn(p, ", ");
    int64_t lengths[2] = {1, 1};
    int count = 0;
    if (*p == '(' && (!(p = read_lengths(p, lengths, &count)) || count != 1 || lengths[0] > 9)) return false;
    if (*p++ != ')') return false;
    if (field.kind == 'V')
      head->row += (size_t)field.size;
    else if (!add_field(head, &field, (int)lengths[0]))
      return false;
  }
  return true;
}

static hypofab_status read_dictionary(const lines *input, const char *text, npy_head *head) {
  const char *kind = value_of(text, "descr"), *order = value_of(text, "fortran_order"),
             *shape = value_of(text, "shape");
  int64_t lengths[2];
  int count;
  if (!kind || !order || !shape || !read_lengths(shape, lengths, &count)) return refuse(input, "a damaged head");
  const bool records = *kind == '[';
  if (strncmp(order, "False", 5) && count > 1) return refuse(input, "an array in Fortran order");
  if (count != (records ? 1 : 2)) return refuse(input, "an array of another shape");
  head->rows = lengths[0];
  if (records) return read_records(kind, head) ? HYPOFAB_OK : refuse(input, "records of an unknown kind");
  npy_field field = {0};
  if (!read_kind(kind, &field) || field.kind == 'V') return refuse(input, "numbers of an unknown kind");
  if (lengths[1] < 1 || lengths[1] > NPY_MAX_FIELDS) return refuse(input, "no columns, or too many");
  for (int64_t i = 0; i < lengths[1]; i++) add_field(head, &field, 1);
  return HYPOFAB_OK;
}

hypofab_status npy_head_read(lines *input, npy_head *head) {
  unsigned char start[12];
  size_t got;
  *head = (npy_head){0};
  hypofab_status status = lines_bytes(input, start, 10, &got);
  if (status) return status;
  if (got < 10 || memcmp(start, "\x93NUMPY", 6)) return refuse(input, "no NumPy file");
  size_t length = start[8] + 256u * start[9];
  if (start[6] > 1) { /* versions 2 and 3 have four bytes for the length */
    if ((status = lines_bytes(input, start + 10, 2, &got))) return status;
    length += 65536u * start[10] + 16777216u * start[11];
  }
  if (length > LONGEST_HEAD) return refuse(input, "a head that is too long");
  char *text = malloc(length + 1);
  if (!text) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", input->path);
  status = lines_bytes(input, text, length, &got);
  text[got] = '\0';
  if (!status) status = got < length ? refuse(input, "a head that is cut off") : read_dictionary(input, text, head);
  free(text);
  return status;
}
