/**
 * @file contact_formats.h
 * @brief A contact file opened in the format it has.
 */
#ifndef HYPOFAB_FABRIC2DELTA_CONTACT_FORMATS_H
#define HYPOFAB_FABRIC2DELTA_CONTACT_FORMATS_H

#include "fabric2delta/formats/contact_reader.h"

/** Open a file with the format it shows or the one that is asked for; contact_reader_close frees it. */
hypofab_status contact_reader_open(contact_reader *reader, const char *path, const hypofab_contact_format *format);

#endif
