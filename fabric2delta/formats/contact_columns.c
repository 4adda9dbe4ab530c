/* Which columns are looked for: what the user names, laid over what is usual. */
#define _GNU_SOURCE /* strtok_r */
#include "fabric2delta/formats/contact_columns.h"

#include <stdlib.h>
#include <string.h>

#include "base/message.h"

/* Beside the names of the roles themselves: those of YADE scripts. Nothing ambiguous: a column "x" may be anything. */
const char *const contact_table_names[CONTACT_ROLES][TABLE_OTHER_NAMES + 1] = {
    [ROLE_NX] = {"nx"},
    [ROLE_NX + 1] = {"ny"},
    [ROLE_NX + 2] = {"nz"},
    [ROLE_ID1] = {"id1"},
    [ROLE_ID2] = {"id2"},
    [ROLE_BX] = {"bx", "branch_x"},
    [ROLE_BX + 1] = {"by", "branch_y"},
    [ROLE_BX + 2] = {"bz", "branch_z"},
    [ROLE_PX] = {"px", "cpx", "position_x"},
    [ROLE_PX + 1] = {"py", "cpy", "position_y"},
    [ROLE_PX + 2] = {"pz", "cpz", "position_z"},
    [ROLE_FX] = {"fx", "force_x"},
    [ROLE_FX + 1] = {"fy", "force_y"},
    [ROLE_FX + 2] = {"fz", "force_z"},
    [ROLE_FNX] = {"fnx", "Fnx", "normal_force_x"},
    [ROLE_FNX + 1] = {"fny", "Fny", "normal_force_y"},
    [ROLE_FNX + 2] = {"fnz", "Fnz", "normal_force_z"},
    [ROLE_FSX] = {"fsx", "Fsx", "shear_force_x"},
    [ROLE_FSX + 1] = {"fsy", "Fsy", "shear_force_y"},
    [ROLE_FSX + 2] = {"fsz", "Fsz", "shear_force_z"},
    [ROLE_CELL_X] = {"cell_x", "cellDist_x"},
    [ROLE_CELL_X + 1] = {"cell_y", "cellDist_y"},
    [ROLE_CELL_X + 2] = {"cell_z", "cellDist_z"},
    [ROLE_X1] = {"x1"},
    [ROLE_X1 + 1] = {"y1"},
    [ROLE_X1 + 2] = {"z1"},
    [ROLE_X2] = {"x2"},
    [ROLE_X2 + 1] = {"y2"},
    [ROLE_X2 + 2] = {"z2"},
    [ROLE_FN] = {"fn", "Fn", "normal_force"},
    [ROLE_AREA] = {"area"},
    [ROLE_R1] = {"r1"},
    [ROLE_FT] = {"ft"},
    [ROLE_TX] = {"tx"},
    [ROLE_TX + 1] = {"ty"},
    [ROLE_TX + 2] = {"tz"},
};

/* A name that no column has: requests without a usual name are not looked for. */
static const char nothing[] = "\n";

static const char *expected_of(int role) {
  if (role < ROLE_BX) return "a component of a unit vector";
  if (role == ROLE_ID1 || role == ROLE_ID2) return "a particle id: a whole number, 0 or more";
  if (role >= ROLE_CELL_X && role < ROLE_X1) return "the number of a periodic image: a whole number";
  if (role == ROLE_AREA) return "an area";
  return (role >= ROLE_FX && role < ROLE_CELL_X) || role == ROLE_FN ? "a force" : "a number";
}

static int find_role(const char *name, size_t length) {
  for (int role = 0; role < CONTACT_ROLES; role++)
    if (strlen(contact_role_names[role]) == length && !strncmp(contact_role_names[role], name, length)) return role;
  return -1;
}

/* One "role=column" of the list. */
static hypofab_status enter(contact_columns *columns, char *pair) {
  char *equals = strchr(pair, '=');
  const int role = equals ? find_role(pair, (size_t)(equals - pair)) : -1;
  if (role < 0 || equals[1] == '\0')
    return hypofab_fail(
        HYPOFAB_BAD_ARGUMENT,
        "columns: '%s'; expected ROLE=COLUMN with one of the roles id1, id2, nx, ny, nz, bx .. (branch), "
        "px .. (contact point), fn, fx .. (force), fnx .. (normal force), fsx .. (shear force), area, "
        "cell_x .. (image), x1 .., x2 .. (centres), r1",
        pair);
  columns->requests[role].name = equals + 1;
  columns->requests[role].required = true;
  memset(columns->requests[role].other_names, 0, sizeof columns->requests[role].other_names);
  return HYPOFAB_OK;
}

hypofab_status contact_columns_make(contact_columns *columns, const hypofab_contact_format *format,
                                    const char *const (*usual)[TABLE_OTHER_NAMES + 1]) {
  columns->names = NULL;
  for (int role = 0; role < CONTACT_ROLES; role++) {
    const bool id = role == ROLE_ID1 || role == ROLE_ID2, image = role >= ROLE_CELL_X && role < ROLE_X1;
    const bool walls_are_told = format->walls != HYPOFAB_WALLS_UNKNOWN;
    table_request *request = &columns->requests[role];
    *request = (table_request){.role = contact_role_names[role],
                               .name = usual && usual[role][0] ? usual[role][0] : nothing,
                               .expected = expected_of(role),
                               .whole = id || image,
                               .may_be_negative = image || (id && walls_are_told),
                               .may_be_infinite = true};
    for (int i = 0; usual && i < TABLE_OTHER_NAMES; i++) request->other_names[i] = usual[role][i + 1];
  }
  const char *const named[][2] = {
      {"id1", format->id1}, {"id2", format->id2}, {"nx", format->nx}, {"ny", format->ny}, {"nz", format->nz}};
  for (size_t i = 0; i < sizeof named / sizeof *named; i++) {
    if (!named[i][1]) continue;
    table_request *request = &columns->requests[find_role(named[i][0], strlen(named[i][0]))];
    request->name = named[i][1];
    request->required = true;
    memset(request->other_names, 0, sizeof request->other_names);
  }
  if (!format->columns) return HYPOFAB_OK;
  columns->names = strdup(format->columns);
  if (!columns->names) return hypofab_fail(HYPOFAB_NO_MEMORY, "columns: out of memory");
  char *rest = NULL;
  for (char *pair = strtok_r(columns->names, ",", &rest); pair; pair = strtok_r(NULL, ",", &rest)) {
    hypofab_status status = enter(columns, pair);
    if (status) {
      contact_columns_free(columns);
      return status;
    }
  }
  return HYPOFAB_OK;
}

void contact_columns_free(contact_columns *columns) {
  free(columns->names);
  columns->names = NULL;
}
