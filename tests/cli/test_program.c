/* The program as its users meet it: help, exit codes, silence in a pipe, a bar on a terminal, Ctrl-C. */
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "cli/program.h"
#include "deck/scratch.h"
#include "hypofab.h"
#include "support/sand.h"

#define EXAMPLE(name) HYPOFAB_SOURCE_DIR "/examples/" name

static void expect(const program_run *run, int exit_code, const char *in_out, const char *in_err) {
  if (run->exit_code != exit_code || !strstr(run->out, in_out) || !strstr(run->err, in_err))
    fail_msg("exit code %d, expected %d; output\n%s\nexpected ... %s ...; errors\n%s\nexpected ... %s ...",
             run->exit_code, exit_code, run->out, in_out, run->err, in_err);
}

static void expect_silence(const program_run *run) {
  if (*run->err) fail_msg("unexpected on the error stream: %s", run->err);
}

static void help_and_version_are_printed(void **state) {
  (void)state;
  program_run run = program("--version", NULL);
  expect(&run, 0, hypofab_version(), "");
  run_free(&run);
  run = program("--help", NULL);
  const char *const commands[] = {"run",       "envelope", "check",   "materials", "fabric",
                                  "stiffness", "fit-c",    "changes", "delta",     "stability"};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
    char line[32];
    snprintf(line, sizeof line, "\n  %-10s ", commands[i]);
    expect(&run, 0, line, "");
    program_run help = program(commands[i], "--help", NULL);
    char example[64];
    snprintf(example, sizeof example, "Usage: hypofab %s ", commands[i]);
    expect(&help, 0, example, "");
    expect(&help, 0, "Examples:", "");
    snprintf(example, sizeof example, "\n  hypofab %s ", commands[i]);
    expect(&help, 0, example, "");
    expect_silence(&help);
    run_free(&help);
  }
  run_free(&run);
}

static void wrong_usage_has_exit_code_2(void **state) {
  (void)state;
  const struct {
    const char *arguments[4];
    const char *message;
  } wrong[] = {{{NULL}, "Usage: hypofab COMMAND"},
               {{"fly"}, "'fly' is not a command"},
               {{"run"}, "no deck given"},
               {{"check"}, "no deck given"},
               {{"envelope"}, "no deck given"},
               {{"run", "a.yaml", "b.yaml"}, "one deck at a time"},
               {{"run", "a.yaml", "--fast"}, "unrecognized option"},
               {{"run", "a.yaml", "-o"}, "requires an argument"},
               {{"check", "a.yaml", "-o", "x"}, "invalid option"},
               {{"stability"}, "give either a deck or --sand"},
               {{"stability", "--sand", "hochstetten"}, "--void-ratio"},
               {{"stability", "--stress", "-1,-1,-1"}, "3 numbers"},
               {{"materials", "sahara"}, "sahara"},
               {{"materials", "toyoura", "hostun"}, "one sand at a time"},
               {{"materials", "--yaml"}, "expected the NAME of a sand"},
               {{"run", "absent.yaml"}, "absent.yaml: No such file"},
               {{"run", EXAMPLE("response_envelopes.yaml")}, "no tests in this deck"},
               {{"envelope", EXAMPLE("oedometer.yaml")}, "no envelopes in this deck"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    const char *const *a = wrong[i].arguments;
    program_run run = program(a[0], a[1], a[2], a[3], NULL);
    expect(&run, 2, "", wrong[i].message);
    run_free(&run);
    assert_int_equal(scratch_count(scratch_path(".")), 2); /* the two streams and nothing else */
  }
}

static void bad_decks_are_refused_and_nothing_is_written(void **state) {
  (void)state;
  scratch_write("bad.yaml",
                "materials:\n  - {name: s, sand: paper000}\nstates:\n"
                "  - {name: a, material: s, p: 100, void_ratio: -2.5, delta: {zero: true}}\n"
                "tests:\n  - {name: t, state: a, steps: []}\n");
  const char *const commands[] = {"run", "envelope", "check"};
  for (int i = 0; i < 3; ++i) {
    program_run run = program(commands[i], "bad.yaml", NULL);
    expect(&run, 2, "", "hypofab: bad.yaml:6: tests[0].steps: an empty list, expected at least 1 entry\n");
    run_free(&run);
    assert_int_equal(scratch_count(scratch_path(".")), 3);
  }
}

static const char *const element_tests[] = {
    EXAMPLE("undrained_triaxial.yaml"), EXAMPLE("triaxial_paths.yaml"),  EXAMPLE("biaxial.yaml"),
    EXAMPLE("simple_shear.yaml"),       EXAMPLE("hollow_cylinder.yaml"), EXAMPLE("undrained_cyclic.yaml"),
    EXAMPLE("general_control.yaml"),
};

static void every_example_passes_the_check(void **state) {
  (void)state;
  const char *const examples[] = {EXAMPLE("directional_stiffness.yaml"),
                                  EXAMPLE("directional_stiffness_dem.yaml"),
                                  EXAMPLE("response_envelopes.yaml"),
                                  EXAMPLE("oedometer.yaml"),
                                  EXAMPLE("own_sand.yaml"),
                                  EXAMPLE("strain_probes.yaml"),
                                  EXAMPLE("stress_probes.yaml"),
                                  EXAMPLE("response_surfaces.yaml")};
  const size_t n = sizeof examples / sizeof *examples, more = sizeof element_tests / sizeof *element_tests;
  for (size_t i = 0; i < n + more; ++i) {
    program_run run = program("check", i < n ? examples[i] : element_tests[i - n], NULL);
    expect(&run, 0, "is good\n", "");
    expect_silence(&run);
    run_free(&run);
  }
  assert_int_equal(scratch_count(scratch_path(".")), 2);
}

static void example_decks_of_element_tests_run_to_their_ends(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof element_tests / sizeof *element_tests; ++i) {
    program_run run = program("run", element_tests[i], "-o", "results", NULL);
    expect(&run, 0, "done; end: p = ", "");
    expect_silence(&run);
    run_free(&run);
  }
}

static void presets_are_listed_with_their_parameters(void **state) {
  (void)state;
  program_run run = program("presets", NULL);
  expect(&run, 0, "simple_shear_constant_stiffness\n", "");
  expect(&run, 0, "    axis normal [rate] [drive] stiffness\n", "");
  run_free(&run);
  run = program("presets", "all", NULL);
  expect(&run, 2, "", "expected no argument");
  run_free(&run);
}

static void results_go_where_asked_or_beside_the_user(void **state) {
  (void)state;
  program_run run = program("run", EXAMPLE("oedometer.yaml"), NULL);
  expect(&run, 0, "oedometer    done; end: p = ", "");
  expect(&run, 0, "oedometer_out/oedometer.csv\n", "");
  expect_silence(&run);
  run_free(&run);
  assert_int_equal(scratch_count(scratch_path("oedometer_out")), 2);
  run = program("run", "-o", "here/and/there", EXAMPLE("own_sand.yaml"), NULL);
  expect(&run, 0, "here/and/there/excavation.csv", "");
  run_free(&run);
  assert_int_equal(scratch_count(scratch_path("here/and/there")), 3);
  run = program("envelope", EXAMPLE("response_envelopes.yaml"), NULL);
  expect(&run, 0, "figure_1     done; response_envelopes_out/figure_1.csv\n", "");
  expect(&run, 0, "\n  without    360 of 360 probes; stiffness ", "");
  expect_silence(&run);
  run_free(&run);
  table t = table_read(scratch_path("response_envelopes_out/figure_1.csv"));
  assert_int_equal(t.rows, 3 * 360);
  table_free(&t);
}

static void probes_without_answer_are_told(void **state) {
  (void)state;
  scratch_write(
      "far.yaml",
      "materials:\n  - {name: s, sand: paper000}\nstates:\n"
      "  - {name: a, material: s, p: 100, void_ratio: 0.7, delta: {zero: true}}\n"
      "envelopes:\n  - {name: e, axis: y, probes: 8, size: 0.02, unload: true, series: [{name: x, state: a}]}\n");
  program_run run = program("envelope", "far.yaml", "-o", "probes", NULL);
  expect(&run, 1, "e            done; probes/e.csv\n  x          ", "hypofab: envelope 'e', series 'x': ");
  expect(&run, 1, " of 8 probes; ", " of 8 probes have no answer; the first is probe ");
  run_free(&run);
  assert_int_equal(scratch_count(scratch_path("probes")), 2);
}

static void a_place_that_cannot_be_written_has_exit_code_3(void **state) {
  (void)state;
  scratch_write("file", "");
  program_run run = program("run", "-o", "file", EXAMPLE("oedometer.yaml"), NULL);
  expect(&run, 3, "", "hypofab: file: is a file, expected a folder");
  run_free(&run);
}

static void a_physical_stop_has_exit_code_1_and_says_so(void **state) {
  (void)state;
  scratch_write("overload.yaml",
                "materials:\n  - {name: sand, sand: hochstetten}\n"
                "states:\n  - {name: s, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}\n"
                "tests:\n  - name: overload\n    state: s\n    steps:\n"
                "      - control: {xx: {stress_rate: 0}, yy: {stress_rate: 0}, zz: {stress_rate: -100}}\n"
                "        until: {quantity: sig_zz, value: -10000}\n        every: {quantity: sig_zz, value: 10}\n");
  program_run run = program("run", "overload.yaml", NULL);
  expect(&run, 1, "overload     loss of controllability", "test 'overload' stopped early in step 1: ");
  expect(&run, 1, "", "rows so far are in overload_out/overload.csv\n");
  run_free(&run);
  table t = table_read(scratch_path("overload_out/overload.csv"));
  assert_true(t.rows > 5);
  table_free(&t);
}

/* So many cycles that it takes minutes. */
static void write_endless_deck(void) {
  FILE *file = fopen(scratch_path("endless.yaml"), "w");
  assert_non_null(file);
  fputs(
      "materials:\n  - {name: sand, sand: karlsruhe_fine}\n"
      "states:\n  - {name: s, material: sand, p: 200, void_ratio: 0.85, delta: {zero: true}}\n"
      "tests:\n  - name: endless\n    state: s\n    steps:\n",
      file);
  for (int i = 0; i < 2000; ++i)
    fprintf(file,
            "      - {preset: oedometer_%sloading, axis: z, until: {quantity: eps_zz, value: %s}, rows: 1000000}\n",
            i % 2 ? "un" : "", i % 2 ? "-0.001" : "-0.01");
  fputs(
      "  - name: never\n    state: s\n    steps:\n"
      "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -0.01}}\n",
      file);
  fclose(file);
}

static void ctrl_c_keeps_the_rows_and_says_so(void **state) {
  (void)state;
  write_endless_deck();
  const pid_t pid = program_start((const char *const[]){"run", "endless.yaml", NULL});
  /* The temporary file is there once the test runs. */
  for (int i = 0; i < 1000 && scratch_count(scratch_path("endless_out")) < 1; ++i) usleep(10000);
  usleep(50000);
  assert_int_equal(kill(pid, SIGINT), 0);
  program_run run = program_wait(pid);
  expect(&run, 1, "endless      interrupted", "hypofab: interrupted in test 'endless'; its ");
  expect(&run, 1, "never        not run: interrupted\n", " rows so far are in endless_out/endless.csv\n");
  run_free(&run);
  assert_int_equal(scratch_count(scratch_path("endless_out")), 2);
  json_t *summary = summary_read(scratch_path("endless_out"));
  const json_t *test = summary_test(summary, 0);
  assert_int_equal(json_integer_value(json_object_get(test, "status")), HYPOFAB_INTERRUPTED);
  /* Every row is whole: as many lines as the summary says, and the header. */
  FILE *file = fopen(scratch_path("endless_out/endless.csv"), "r");
  assert_non_null(file);
  long lines = 0;
  int last = 0;
  for (int c; (c = fgetc(file)) != EOF; last = c) lines += c == '\n';
  fclose(file);
  assert_int_equal(last, '\n');
  assert_int_equal(lines, json_integer_value(json_object_get(test, "rows")) + 1);
  assert_true(lines > 2);
  json_decref(summary);
}

static void a_bar_is_shown_on_a_terminal_only(void **state) {
  (void)state;
  program_run run = program_on_terminal((const char *const[]){"run", EXAMPLE("directional_stiffness.yaml"), NULL});
  assert_int_equal(run.exit_code, 0);
  assert_non_null(strstr(run.err, " 50 % A-90"));
  assert_non_null(strstr(run.err, "[########################################] 100 % I-90"));
  assert_string_equal(run.err + strlen(run.err) - 4, "\r\033[K"); /* wiped off at the end */
  run_free(&run);
  run = program("run", EXAMPLE("directional_stiffness.yaml"), NULL);
  expect(&run, 0, "A-0 ", "");
  expect_silence(&run);
  run_free(&run);
}

static void sands_are_listed_and_shown(void **state) {
  (void)state;
  program_run list = program("materials", NULL), json = program("materials", "--json", NULL);
  json_t *sands = json_loads(json.out, 0, NULL);
  assert_int_equal(json_array_size(sands), hypofab_model_set_count(hypofab_model_find("sand")));
  for (int i = 0; i < hypofab_model_set_count(hypofab_model_find("sand")); ++i) {
    hypofab_set_info info;
    hypofab_material material;
    assert_int_equal(hypofab_model_set(hypofab_model_find("sand"), i, &info), HYPOFAB_OK);
    assert_int_equal(hypofab_material_built_in(info.name, &material), HYPOFAB_OK);
    expect(&list, 0, info.name, "");
    expect(&list, 0, info.source, "");
    const json_t *sand = json_array_get(sands, (size_t)i), *values = json_object_get(sand, "parameters");
    assert_string_equal(json_string_value(json_object_get(sand, "name")), info.name);
    assert_int_equal(json_object_size(values), SAND_N_PARAMETERS);
    assert_true(json_number_value(json_object_get(values, "h_s")) == material.value[SAND_H_S]);

    /* The piece of a deck that --yaml prints is one. */
    program_run yaml = program("materials", info.name, "--yaml", NULL);
    expect(&yaml, 0, "materials:\n", "");
    char *deck = malloc(strlen(yaml.out) + 400);
    assert_non_null(deck);
    sprintf(deck, "%s%s", yaml.out,
            "states:\n  - {name: s, material: my_sand, p: 100, void_ratio: 0.6, delta: {zero: true}}\n"
            "tests:\n  - name: t\n    state: s\n    steps:\n"
            "      - {preset: oedometer_loading, axis: z, until: {quantity: eps_zz, value: -1.0e-5}, rows: 1}\n");
    scratch_write("piece.yaml", deck);
    program_run run = program("run", "piece.yaml", NULL);
    expect(&run, 0, "t            done", "");
    json_t *summary = summary_read(scratch_path("piece_out"));
    const json_t *used = json_object_get(summary_test(summary, 0), "material");
    for (int k = 0; k < SAND_N_PARAMETERS; ++k) {
      hypofab_parameter_info parameter;
      assert_int_equal(hypofab_model_parameter(hypofab_model_find("sand"), k, &parameter), HYPOFAB_OK);
      assert_true(json_number_value(json_object_get(used, parameter.name)) ==
                  json_number_value(json_object_get(values, parameter.name)));
    }
    json_decref(summary);
    free(deck);
    run_free(&run);
    run_free(&yaml);
  }
  json_decref(sands);
  run_free(&list);
  run_free(&json);
  program_run one = program("materials", "hochstetten", NULL);
  expect(&one, 0, "Niemunis", "");
  expect(&one, 0, " 1e+06 kPa ", "");
  run_free(&one);
}

/* The state of a deck and the same state by options give the same numbers; a plane strain state near failure warns.
 */
static void stability_of_a_deck_and_of_options(void **state) {
  (void)state;
  scratch_write("deck.yaml",
                "sign: compression_positive\n"
                "materials:\n  - {name: sand, sand: hochstetten, intergranular: false}\n"
                "states:\n  - {name: a, material: sand, stress: [60, 140, 320, 0, 0, 0],"
                " void_ratio: 0.7}\n"
                "  - {name: b, material: sand, p: 100, void_ratio: 0.7}\n"
                "tests:\n  - name: t\n    state: a\n    steps:\n"
                "      - {preset: oedometer_loading, axis: z, until: {quantity: time, value: 1e-3}}\n");
  char deck[256]; /* scratch_path serves others soon */
  snprintf(deck, sizeof deck, "%s", scratch_path("deck.yaml"));
  program_run by_deck = program("stability", deck, "--json", NULL);
  program_run by_options = program("stability", "--sand", "hochstetten", "--plain", "--stress", "60,140,320,0,0,0",
                                   "--void-ratio", "0.7", "--compression-positive", "--json", NULL);
  expect(&by_deck, 0, "", "");
  expect(&by_options, 0, "", "");
  json_t *a = json_loads(by_deck.out, 0, NULL), *b = json_loads(by_options.out, 0, NULL);
  json_t *first = json_array_get(json_object_get(a, "states"), 0),
         *other = json_array_get(json_object_get(b, "states"), 0);
  assert_int_equal(json_array_size(json_object_get(a, "states")), 2);
  const char *const parts[] = {"second_order_work", "localisation", "bound"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
    assert_true(json_equal(json_object_get(first, parts[i]), json_object_get(other, parts[i])));
  assert_string_equal(json_string_value(json_object_get(b, "sign")), "compression_positive");
  const json_t *direction = json_object_get(json_object_get(first, "second_order_work"), "direction");
  assert_true(json_number_value(json_array_get(direction, 2)) > 0.5); /* shortening along z is positive here */
  json_decref(a);
  json_decref(b);
  run_free(&by_deck);
  run_free(&by_options);
  program_run text = program("stability", deck, "--state", "a", NULL);
  expect(&text, 0, "NOT positive", "");
  expect(&text, 0, "a band CAN form", "");
  run_free(&text);
  text = program("stability", deck, "--state", "c", NULL);
  expect(&text, 2, "", "no state 'c'");
  run_free(&text);
}

int main(void) {
#define TEST(f) cmocka_unit_test_setup_teardown(f, scratch_make, scratch_remove)
  const struct CMUnitTest tests[] = {
      TEST(help_and_version_are_printed),
      TEST(wrong_usage_has_exit_code_2),
      TEST(bad_decks_are_refused_and_nothing_is_written),
      TEST(every_example_passes_the_check),
      TEST(example_decks_of_element_tests_run_to_their_ends),
      TEST(presets_are_listed_with_their_parameters),
      TEST(results_go_where_asked_or_beside_the_user),
      TEST(probes_without_answer_are_told),
      TEST(a_place_that_cannot_be_written_has_exit_code_3),
      TEST(a_physical_stop_has_exit_code_1_and_says_so),
      TEST(ctrl_c_keeps_the_rows_and_says_so),
      TEST(a_bar_is_shown_on_a_terminal_only),
      TEST(sands_are_listed_and_shown),
      TEST(stability_of_a_deck_and_of_options),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
