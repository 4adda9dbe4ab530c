#include "deck/output/sensitivity_table.h"

#include "deck/output/output.h"

void sensitivity_table_header(const hypofab_study *study, int test, FILE *stream) {
  const char *name;
  fputs("time,step", stream);
  for (int k = 0; (name = hypofab_study_sensitivity_name(study, test, k)); ++k)
    for (int i = 0; i < HYPOFAB_FIRST_STABILITY; ++i)
      fprintf(stream, ",d%s/d%s", hypofab_quantity_name((hypofab_quantity)i), name);
  fputs(",event\n", stream);
}

void sensitivity_table_row(const hypofab_study *study, const hypofab_row *row, const double *derivative, int n,
                           FILE *stream) {
  char number[OUTPUT_NUMBER_SIZE];
  output_number(number, ' ', row->value[HYPOFAB_TIME]);
  fprintf(stream, "%s,%d", number + 1, row->step + 1);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < HYPOFAB_FIRST_STABILITY; ++i) {
      const double sign = study_quantity_sign(study, (hypofab_quantity)i);
      output_number(number, ',', sign * derivative[k * HYPOFAB_N_QUANTITIES + i]);
      fputs(number, stream);
    }
  fprintf(stream, ",%d\n", row->event);
}
