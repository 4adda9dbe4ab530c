/** @file sample_report.h @brief How a sample is shown beside its fabric. */
#ifndef HYPOFAB_CLI_SAMPLE_REPORT_H
#define HYPOFAB_CLI_SAMPLE_REPORT_H

#include <jansson.h>

#include "hypofab.h"

/** Add what is known of a sample to the JSON object of its fabric. */
void sample_to_json(const hypofab_sample *sample, const hypofab_fabric *fabric, json_t *object);

/** What was found while reading contacts, as a JSON object. NULL when memory ran out. */
json_t *reading_to_json(const hypofab_contact_report *report);

/** Print what is known of a sample below its fabric. */
void print_sample(const hypofab_sample *sample, const hypofab_fabric *fabric);

#endif
