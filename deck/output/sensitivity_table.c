#include "deck/output/sensitivity_table.h"

#include "deck/output/output.h"

void sensitivity_table_header(const hypofab_study *study, int test, FILE *stream) {
  const hypofab_model *model = hypofab_study_model(study, test);
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  const int columns = hypofab_model_columns(model, 0, column);
  const char *name;
  char text[HYPOFAB_QUANTITY_NAME_SIZE];
  fputs("time,step", stream);
  for (int k = 0; (name = hypofab_study_sensitivity_name(study, test, k)); ++k)
    for (int i = 0; i < columns; ++i)
      fprintf(stream, ",d%s/d%s", hypofab_model_quantity_name(model, column[i], text), name);
  fputs(",event\n", stream);
}

void sensitivity_table_row(const hypofab_study *study, int test, const hypofab_row *row, const double *derivative,
                           int n, FILE *stream) {
  const hypofab_model *model = hypofab_study_model(study, test);
  hypofab_quantity column[HYPOFAB_N_QUANTITIES];
  const int columns = hypofab_model_columns(model, 0, column);
  char number[OUTPUT_NUMBER_SIZE];
  output_number(number, ' ', row->value[HYPOFAB_TIME]);
  fprintf(stream, "%s,%d", number + 1, row->step + 1);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < columns; ++i) {
      const double sign = study_quantity_sign(study, model, column[i]);
      output_number(number, ',', sign * derivative[k * HYPOFAB_N_QUANTITIES + (int)column[i]]);
      fputs(number, stream);
    }
  fprintf(stream, ",%d\n", row->event);
}
