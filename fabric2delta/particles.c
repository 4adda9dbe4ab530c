#include "fabric2delta/particles.h"

#include "base/message.h"
#include "fabric2delta/table.h"

static hypofab_status enter_id(const table *data, id_counts *ids) {
  int64_t id;
  hypofab_status status = table_id(data, 0, &id);
  if (status) return status;
  if (id_counts_find(ids, id)) return table_refuse(data, 0, "stands twice in the list", "one row per particle");
  if (!id_counts_enter(ids, id)) return hypofab_fail(HYPOFAB_NO_MEMORY, "%s: out of memory", data->input->path);
  return HYPOFAB_OK;
}

static hypofab_status read_rows(lines *input, id_counts *ids, bool *has_ids, int64_t *count) {
  static const table_request requests[1] = {{.role = "id", .name = "id"}};
  table data;
  hypofab_status status = table_open(&data, input, 0, "particle", requests, 1);
  if (status) return status;
  *has_ids = data.column[0] > 0;
  bool more = true;
  while (!(status = table_next(&data, &more)) && more)
    if (*has_ids && (status = enter_id(&data, ids))) break;
  *count = data.rows;
  table_close(&data);
  return status;
}

hypofab_status particles_read(const char *path, int64_t *count, id_counts *ids, bool *has_ids) {
  lines input;
  hypofab_status status = lines_open(&input, path);
  if (status) return status;
  status = read_rows(&input, ids, has_ids, count);
  lines_close(&input);
  return status;
}
