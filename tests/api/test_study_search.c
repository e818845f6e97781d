/* Boundaries, optima and samples through the study document, on frequencies of a beam, which go
 * with one over the square of its length. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "api/study_fields.h"
#include "api/study_run.h"
#include "tests/support/near.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 4096 };

#define CASE(kind, more)                                                                           \
    "{\"schema_version\":1,\"kind\":\"" kind "\",\"beam\":{\"length_m\":0.37,\"elements\":4,"      \
    "\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["                                  \
    "{\"material\":\"AS4/3501-6\",\"angle_deg\":-45,\"thickness_m\":0.00013},"                     \
    "{\"material\":\"foam\",\"thickness_m\":0.00387}]}}" more "}"
#define MODES CASE("modes", ",\"solver\":{\"modes\":2}")
#define SIMULATION                                                                                 \
    CASE("simulation", ",\"flow\":{\"speed_m_s\":6,\"incidence_deg\":5},"                          \
                       "\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","                       \
                       "\"dynamic\":{\"type\":\"attached\"}},"                                     \
                       "\"solver\":{\"modes\":2,\"duration_s\":1}")
#define ANGLE "/beam/section/layup/0/angle_deg"
#define LENGTH "/beam/length_m"
#define OVER "\"over\":[{\"pointer\":\"" ANGLE "\",\"values\":[-45,0]}]"
#define FIELD(from, to)                                                                            \
    "\"field\":{\"pointer\":\"" LENGTH "\",\"from\":" from ",\"to\":" to ",\"tolerance\":1e-5}"
#define ABOVE_4_HZ "\"criterion\":{\"value\":\"modes.0.frequency_hz\",\"level\":4}"

static struct library *library;

static int build_library(void **state)
{
    struct failure fail;
    (void)state;
    return library_create_builtin(&library, &fail) == ST_OK ? 0 : -1;
}

static int free_library(void **state)
{
    (void)state;
    library_destroy(library);
    return 0;
}

static void text_of(char out[TEXT], const char *type, const char *c, const char *members)
{
    (void)snprintf(out, TEXT,
                   "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"%s\",\"case\":%s,%s}", type,
                   c, members);
}

static struct study *parse(const char *type, const char *c, const char *members)
{
    char text[TEXT];
    struct study *s = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    text_of(text, type, c, members);
    if (study_parse(library, text, strlen(text), &s, problems) != ST_OK) {
        print_error("%s: %s\n", problems->item[0].pointer, problems->item[0].detail);
        fail();
    }
    free(problems);
    return s;
}

static double no_clock(void)
{
    return 0.0;
}

/* The answer of a cell, alone in a runner of its own. */
static cJSON *answer(struct study *s, int cell)
{
    char hash[LIMIT_HASH];
    struct study_cell_result result;
    struct study_runner *r = study_runner_create(s, no_clock);
    assert_int_equal(study_runner_begin(r, cell, hash), ST_OK);
    assert_int_equal(study_runner_compute(r, NULL, &result), ST_OK);
    assert_int_equal(result.state, STUDY_CELL_DONE);
    assert_string_equal(result.hash, hash);
    cJSON *tree = cJSON_Parse(result.summary);
    assert_non_null(tree);
    study_cell_result_done(&result);
    study_runner_destroy(r);
    return tree;
}

static const cJSON *item(const cJSON *of, const char *key)
{
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(of, key);
    if (found == NULL) {
        fail_msg("no \"%s\"", key);
    }
    return found;
}

static double number(const cJSON *of, const char *key)
{
    return cJSON_GetNumberValue(item(of, key));
}

static const char *word(const cJSON *of, const char *key)
{
    return cJSON_GetStringValue(item(of, key));
}

/* First frequency at a length, from the case itself. */
static double frequency(const char *angle)
{
    char members[TEXT];
    (void)snprintf(members, sizeof members,
                   "\"vary\":[{\"pointer\":\"" ANGLE "\",\"values\":[%s]}]", angle);
    struct study *s = parse("grid", MODES, members);
    cJSON *a = answer(s, 0);
    const double f = number(cJSON_GetArrayItem(item(a, "modes"), 0), "frequency_hz");
    cJSON_Delete(a);
    study_destroy(s);
    return f;
}

static void test_a_boundary(void **state)
{
    (void)state;
    static const char *const angles[] = {"-45", "0"};
    struct study *s = parse("boundary", MODES, OVER "," FIELD("0.2", "0.8") "," ABOVE_4_HZ);
    assert_int_equal(study_cells(s), 2);
    for (int cell = 0; cell < 2; cell++) {
        cJSON *a = answer(s, cell);
        const double exact = 0.37 * sqrt(frequency(angles[cell]) / 4.0);
        assert_string_equal(word(a, "outcome"), "found");
        assert_near_abs(number(a, "boundary"), exact, 1e-5);
        assert_true(number(a, "upper") - number(a, "lower") <= 1e-5);
        assert_true(cJSON_IsTrue(item(a, "holds_below")));
        /* 0.15 to 1e-5 takes 14 halvings. */
        assert_true(number(a, "evaluations") <= 5 + 7);
        assert_int_equal(cJSON_GetArraySize(item(a, "samples")), (int)number(a, "evaluations"));
        assert_true(number(a, "runs") == number(a, "evaluations"));
        cJSON_Delete(a);
    }
    study_destroy(s);
}

/* An evaluation is the run of a case that could be posted: its identity is that of a grid's cell.
 */
static void test_evaluations_are_cases(void **state)
{
    (void)state;
    char hash[LIMIT_HASH];
    struct study *s = parse("boundary", MODES, OVER "," FIELD("0.2", "0.8") "," ABOVE_4_HZ);
    struct study *g = parse("grid", MODES,
                            "\"vary\":[{\"pointer\":\"" ANGLE "\",\"values\":[-45]},"
                            "{\"pointer\":\"" LENGTH "\",\"values\":[0.2,0.8]}]");
    struct study_runner *r = study_runner_create(g, no_clock);
    cJSON *a = answer(s, 0);
    assert_int_equal(study_runner_begin(r, 0, hash), ST_OK);
    const cJSON *first = cJSON_GetArrayItem(item(a, "samples"), 0);
    assert_string_equal(word(first, "content_hash"), hash);
    assert_true(number(first, "x") == 0.2);
    /* The search of a cell has an identity of its own, which another definition changes. */
    struct study *finer = parse("boundary", MODES, OVER "," FIELD("0.2", "0.9") "," ABOVE_4_HZ);
    struct study_runner *one = study_runner_create(s, no_clock);
    struct study_runner *other = study_runner_create(finer, no_clock);
    char mine[LIMIT_HASH], theirs[LIMIT_HASH];
    assert_int_equal(study_runner_begin(one, 0, mine), ST_OK);
    assert_int_equal(study_runner_begin(other, 0, theirs), ST_OK);
    assert_string_not_equal(mine, theirs);
    assert_string_not_equal(mine, hash);
    study_runner_destroy(r);
    study_runner_destroy(one);
    study_runner_destroy(other);
    cJSON_Delete(a);
    study_destroy(finer);
    study_destroy(g);
    study_destroy(s);
}

/* Answers in the order they were kept, and how often one was found. */
struct answers {
    int n, found;
    char hash[BOUNDARY_SAMPLES_MAX][LIMIT_HASH];
    char *summary[BOUNDARY_SAMPLES_MAX];
};

static char *find_answer(void *context, const char *hash)
{
    struct answers *shelf = context;
    for (int i = 0; i < shelf->n; i++) {
        if (strcmp(shelf->hash[i], hash) == 0) {
            shelf->found++;
            return strdup(shelf->summary[i]);
        }
    }
    return NULL;
}

static void keep_answer(void *context, const char *hash, const char *verdict, const char *summary,
                        double cpu_s)
{
    struct answers *shelf = context;
    (void)verdict;
    (void)cpu_s;
    assert_true(shelf->n < BOUNDARY_SAMPLES_MAX);
    (void)snprintf(shelf->hash[shelf->n], LIMIT_HASH, "%s", hash);
    shelf->summary[shelf->n++] = strdup(summary);
}

/* An interrupted search is repeated with what it has left behind, and ends with the same answer. */
static void test_what_is_known_is_not_run_again(void **state)
{
    (void)state;
    struct answers shelf = {.n = 0};
    const struct study_memory memory = {&shelf, find_answer, keep_answer};
    char *first = NULL;
    struct study *s = parse("boundary", MODES, OVER "," FIELD("0.2", "0.8") "," ABOVE_4_HZ);
    for (int left = 0; left < 3; left++) { /* nothing, all, four of them known */
        char hash[LIMIT_HASH];
        struct study_cell_result result;
        struct study_runner *r = study_runner_create(s, no_clock);
        study_runner_remember(r, &memory);
        const int before = shelf.n;
        shelf.found = 0;
        assert_int_equal(study_runner_begin(r, 0, hash), ST_OK);
        assert_int_equal(study_runner_compute(r, NULL, &result), ST_OK);
        if (first == NULL) {
            first = strdup(result.summary);
        }
        assert_string_equal(result.summary, first);
        assert_int_equal(shelf.found, before);
        study_cell_result_done(&result);
        study_runner_destroy(r);
        const int whole = shelf.n;
        shelf.n = left == 1 ? 4 : shelf.n;
        for (int i = shelf.n; i < whole; i++) {
            free(shelf.summary[i]);
        }
    }
    assert_true(shelf.n > 5);
    for (int i = 0; i < shelf.n; i++) {
        free(shelf.summary[i]);
    }
    free(first);
    study_destroy(s);
}

static void test_nothing_changes(void **state)
{
    (void)state;
    struct study *s = parse("boundary", MODES, OVER "," FIELD("0.1", "0.2") "," ABOVE_4_HZ);
    cJSON *a = answer(s, 0);
    assert_string_equal(word(a, "outcome"), "not_bracketed");
    assert_true(cJSON_IsNull(item(a, "boundary")));
    assert_true(cJSON_IsTrue(item(a, "holds_below")));
    assert_true(number(a, "lower") == 0.1 && number(a, "upper") == 0.2);
    const cJSON *samples = item(a, "samples");
    assert_int_equal(cJSON_GetArraySize(samples), 5);
    assert_true(number(cJSON_GetArrayItem(samples, 0), "value") > 0.0);
    assert_true(number(cJSON_GetArrayItem(samples, 4), "value") > 0.0);
    cJSON_Delete(a);
    study_destroy(s);
    /* A value that is not there: each evaluation says so. */
    s = parse("boundary", MODES,
              OVER "," FIELD("0.2", "0.8") ",\"criterion\":{\"value\":\"modes.7.frequency_hz\"}");
    a = answer(s, 0);
    assert_string_equal(word(a, "outcome"), "failed");
    assert_true(number(a, "failed_evaluations") == 5);
    assert_string_equal(word(cJSON_GetArrayItem(item(a, "samples"), 0), "error"), "no_value");
    cJSON_Delete(a);
    study_destroy(s);
}

/* Both ways: the upward search is that of a march from the state before, so its first evaluation
 * alone is a plain case. */
static void test_sweeps(void **state)
{
    (void)state;
    struct study *s = parse("boundary", SIMULATION,
                            "\"over\":[{\"pointer\":\"" ANGLE "\",\"values\":[-45]}],"
                            "\"field\":{\"pointer\":\"/flow/speed_m_s\",\"from\":4,\"to\":30,"
                            "\"tolerance\":4,\"scan\":4},\"hysteresis\":true,"
                            "\"criterion\":{\"verdict\":\"stable\"}");
    cJSON *a = answer(s, 0);
    const cJSON *up = item(a, "samples"), *down = item(item(a, "down"), "samples");
    assert_true(number(cJSON_GetArrayItem(up, 0), "x") == 4.0);
    assert_true(number(cJSON_GetArrayItem(down, 0), "x") == 30.0);
    assert_true(cJSON_IsString(item(cJSON_GetArrayItem(up, 0), "content_hash")));
    assert_true(cJSON_IsNull(item(cJSON_GetArrayItem(up, 1), "content_hash")));
    assert_string_equal(word(cJSON_GetArrayItem(up, 0), "verdict"), "stable");
    assert_string_not_equal(word(cJSON_GetArrayItem(down, 0), "verdict"), "stable");
    assert_string_equal(word(a, "outcome"), "found");
    cJSON_Delete(a);
    study_destroy(s);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The cells of an uncertainty are those of a grid at sampled values, which a canonical text names
 * again. */
static void test_samples(void **state)
{
    (void)state;
    enum { N = 64 };
    const char *members = "\"tolerances\":[{\"pointer\":\"" LENGTH "\",\"spread\":0.02},"
                          "{\"pointer\":\"" ANGLE "\",\"distribution\":\"normal\",\"spread\":2}],"
                          "\"samples\":64,\"result\":\"modes.0.frequency_hz\"";
    struct study *s = parse("uncertainty", MODES, members), *again = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_int_equal(study_open(library, study_canonical(s), &again, problems), ST_OK);
    assert_string_equal(study_canonical(again), study_canonical(s));
    assert_int_equal(study_cells(s), N);
    struct study_map a = {.n_cell = 0}, b = {.n_cell = 0};
    study_map_axes(s, &a);
    study_map_axes(again, &b);
    assert_int_equal(a.n_axis, 2);
    assert_int_equal(a.n_dimension, 1);
    double length[N];
    for (int i = 0; i < N; i++) {
        assert_true(a.axis[0].value[i] == b.axis[0].value[i]);
        assert_true(a.axis[1].value[i] == b.axis[1].value[i]);
        length[i] = a.axis[0].value[i];
    }
    qsort(length, N, sizeof length[0], by_size);
    for (int i = 0; i < N; i++) { /* one in each 64th of the width */
        assert_true(length[i] > 0.35 + 0.04 * i / N && length[i] < 0.35 + 0.04 * (i + 1) / N);
    }
    cJSON *cell = answer(s, 3);
    assert_string_equal(word(cell, "kind"), "modes");
    cJSON_Delete(cell);
    free(problems);
    study_destroy(again);
    study_destroy(s);
}

/* The longest beam of at least 4 Hz, and the angle that lets it be longest. */
static void test_an_optimum(void **state)
{
    (void)state;
    const double exact = 0.37 * sqrt(frequency("0") / 4.0);
    struct study *s = parse("optimum", MODES,
                            "\"variables\":[{\"pointer\":\"" LENGTH "\",\"from\":0.2,\"to\":0.8},"
                            "{\"pointer\":\"" ANGLE "\",\"from\":-50,\"to\":40,\"start\":-30}],"
                            "\"minimise\":\"section.mass_kg_m\",\"starts\":1,\"constraints\":["
                            "{\"value\":\"modes.0.frequency_hz\",\"min\":4,\"max\":5}]");
    cJSON *a = answer(s, 0);
    /* The mass per length knows neither length nor angle: any feasible point is as good. */
    assert_true(cJSON_IsTrue(item(item(a, "best"), "feasible")));
    assert_int_equal(cJSON_GetArraySize(item(item(a, "best"), "excess")), 2);
    assert_true(number(a, "runs") == number(a, "evaluations"));
    cJSON_Delete(a);
    study_destroy(s);
    s = parse("optimum", MODES,
              "\"variables\":[{\"pointer\":\"" ANGLE "\",\"from\":-50,\"to\":40,\"start\":-30}],"
              "\"maximise\":\"boundary\",\"starts\":1,\"tolerance\":0.01,"
              "\"evaluations_max\":40," FIELD("0.2", "0.8") "," ABOVE_4_HZ);
    a = answer(s, 0);
    assert_string_equal(word(a, "outcome"), "found");
    assert_near_abs(number(a, "objective"), exact, 2e-4);
    assert_near_abs(number(item(item(a, "best"), "point"), ANGLE), 0.0, 2.0);
    assert_int_equal(cJSON_GetArraySize(item(a, "history")), (int)number(a, "evaluations"));
    assert_true(number(a, "runs") > 5 * number(a, "evaluations"));
    cJSON_Delete(a);
    study_destroy(s);
}

static void test_no_feasible_point(void **state)
{
    (void)state;
    struct study *s = parse("optimum", MODES,
                            "\"variables\":[{\"pointer\":\"" LENGTH "\",\"from\":0.2,\"to\":0.8}],"
                            "\"minimise\":\"modes.1.frequency_hz\",\"starts\":1,\"constraints\":["
                            "{\"value\":\"modes.0.frequency_hz\",\"min\":1000}]");
    cJSON *a = answer(s, 0);
    assert_string_equal(word(a, "outcome"), "infeasible");
    const cJSON *best = item(a, "best");
    assert_true(cJSON_IsFalse(item(best, "feasible")));
    assert_near_abs(number(item(best, "point"), LENGTH), 0.2, 2e-3); /* the stiffest */
    assert_near_abs(number(best, "violation"), 1.0 - frequency("-45") * 0.37 * 0.37 / 0.04 / 1000.0,
                    1e-3);
    cJSON_Delete(a);
    study_destroy(s);
}

#define VARIABLES "\"variables\":[{\"pointer\":\"" LENGTH "\",\"from\":0.2,\"to\":0.8}]"
static const struct {
    const char *type, *c, *members, *pointer;
} refusals[] = {
    {"boundary", MODES, OVER "," ABOVE_4_HZ, "/field"},
    {"boundary", MODES, OVER "," FIELD("0.8", "0.2") "," ABOVE_4_HZ, "/field/to"},
    {"boundary", MODES, OVER "," FIELD("-1", "0.2") "," ABOVE_4_HZ, "/field/from"},
    {"boundary", MODES, OVER "," FIELD("0.2", "0.8"), "/criterion"},
    {"boundary", MODES, OVER "," FIELD("0.2", "0.8") ",\"criterion\":{\"verdict\":\"stable\"}",
     "/criterion/verdict"},
    {"boundary", SIMULATION, OVER "," FIELD("0.2", "0.8") ",\"criterion\":{\"verdict\":\"steady\"}",
     "/criterion/verdict"},
    {"boundary", MODES,
     OVER ",\"field\":{\"pointer\":\"/beam/span_m\",\"from\":1,\"to\":2,"
          "\"tolerance\":0.1}," ABOVE_4_HZ,
     "/field/pointer"},
    {"boundary", MODES,
     OVER ",\"field\":{\"pointer\":\"" ANGLE "\",\"from\":1,\"to\":2,"
          "\"tolerance\":0.1}," ABOVE_4_HZ,
     "/field/pointer"},
    {"boundary", MODES, OVER "," FIELD("0.2", "0.8") "," ABOVE_4_HZ ",\"hysteresis\":true",
     "/hysteresis"},
    {"boundary", MODES, FIELD("0.2", "0.8") "," ABOVE_4_HZ, "/over"},
    {"boundary", MODES, OVER "," FIELD("0.2", "0.8") "," ABOVE_4_HZ ",\"vary\":[]", "/vary"},
    {"uncertainty", MODES,
     "\"tolerances\":[{\"pointer\":\"" LENGTH "\",\"spread\":0.4}],"
     "\"result\":\"modes.0.frequency_hz\"",
     "/tolerances/0"},
    {"uncertainty", MODES,
     "\"tolerances\":[{\"pointer\":\"" LENGTH "\",\"spread\":-1}],"
     "\"result\":\"modes.0.frequency_hz\"",
     "/tolerances/0/spread"},
    {"uncertainty", MODES, "\"tolerances\":[{\"pointer\":\"" LENGTH "\",\"spread\":0.01}]",
     "/field"},
    {"uncertainty", MODES,
     "\"tolerances\":[{\"pointer\":\"" LENGTH "\",\"spread\":0.01}],\"quantiles\":[1.5],"
     "\"result\":\"modes.0.frequency_hz\"",
     "/quantiles/0"},
    {"optimum", MODES, VARIABLES, "/maximise"},
    {"optimum", MODES, VARIABLES ",\"maximise\":\"boundary\"", "/field"},
    {"optimum", MODES, VARIABLES ",\"maximise\":\"a\"," FIELD("0.2", "0.8"), "/field"},
    {"optimum", MODES,
     VARIABLES ",\"maximise\":\"a\",\"constraints\":[{\"value\":\"b\",\"min\":2,\"max\":1}]",
     "/constraints/0"},
    {"optimum", MODES, VARIABLES ",\"maximise\":\"a\",\"constraints\":[{\"value\":\"b\"}]",
     "/constraints/0"},
    {"optimum", MODES,
     "\"variables\":[{\"pointer\":\"" LENGTH "\",\"from\":0.8,\"to\":0.2}],"
     "\"maximise\":\"a\"",
     "/variables/0/to"},
    {"optimum", MODES, VARIABLES ",\"maximise\":\"a\",\"method\":\"newton\"", "/method"},
};

static void test_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++) {
        char text[TEXT];
        struct study *s = NULL;
        struct failure_list *problems = calloc(1, sizeof *problems);
        text_of(text, refusals[i].type, refusals[i].c, refusals[i].members);
        assert_int_equal(study_parse(library, text, strlen(text), &s, problems), ST_INVALID);
        if (strcmp(problems->item[0].pointer, refusals[i].pointer) != 0) {
            fail_msg("%zu: %s instead of %s: %s", i, problems->item[0].pointer, refusals[i].pointer,
                     problems->item[0].detail);
        }
        free(problems);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_boundary),
        cmocka_unit_test(test_evaluations_are_cases),
        cmocka_unit_test(test_what_is_known_is_not_run_again),
        cmocka_unit_test(test_nothing_changes),
        cmocka_unit_test(test_sweeps),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_an_optimum),
        cmocka_unit_test(test_no_feasible_point),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, build_library, free_library);
}
