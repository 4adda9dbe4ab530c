/**
 * @file contact_columns.h
 * @brief Which columns are looked for.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_COLUMNS_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_COLUMNS_H

#include "fabric2delta/formats/contact_layout.h"

/** The names under which the roles are looked for: those of the format given, else the usual ones. */
typedef struct contact_columns {
  table_request requests[CONTACT_ROLES];
  char *names; /**< owned */
} contact_columns;

/**
 * @brief What the user says about columns, laid over what is usual in a file format.
 * @param usual names by role; NULL entries, and NULL itself: only the names of the user
 */
hypofab_status contact_columns_make(contact_columns *columns, const hypofab_contact_format *format,
                                    const char *const (*usual)[TABLE_OTHER_NAMES + 1]);

/** Free the memory. */
void contact_columns_free(contact_columns *columns);

/** Names usual in tables of contacts. */
extern const char *const contact_table_names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1];

#endif
