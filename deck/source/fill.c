#include "deck/source/fill.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"
#include "deck/source/form.h"

/* What libcyaml has to say, for the case that it refuses what deck_check_form let pass. */
static void keep_log(cyaml_log_t level, void *context, const char *format, va_list arguments) {
  (void)level;
  char *text = context;
  const size_t used = strlen(text);
  vsnprintf(text + used, HYPOFAB_MESSAGE_SIZE / 2 - used, format, arguments);
  for (char *c = text + used; *c; ++c)
    if (isspace((unsigned char)*c)) *c = ' ';
}

static cyaml_config_t cyaml_configuration(char *log) {
  return (cyaml_config_t){
      .log_fn = log ? keep_log : NULL, .log_ctx = log, .mem_fn = cyaml_mem, .log_level = CYAML_LOG_ERROR};
}

hypofab_status deck_fill(const deck_source *source, const cyaml_schema_value_t *schema, void **filled) {
  hypofab_status status = deck_check_form(source, schema);
  if (status) return status;
  char log[HYPOFAB_MESSAGE_SIZE / 2] = "";
  const cyaml_config_t configuration = cyaml_configuration(log);
  cyaml_data_t *data = NULL;
  const cyaml_err_t error =
      cyaml_load_data((const uint8_t *)source->text, source->length, &configuration, schema, &data, NULL);
  if (error == CYAML_ERR_OOM) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", source->path);
  if (error || !data) return hypofab_fail(HYPOFAB_BAD_FILE, "%s: %s: %s", source->path, cyaml_strerror(error), log);
  *filled = data;
  return HYPOFAB_OK;
}

void deck_release(const cyaml_schema_value_t *schema, void *filled) {
  const cyaml_config_t configuration = cyaml_configuration(NULL);
  if (filled) cyaml_free(&configuration, schema, filled, 0);
}
