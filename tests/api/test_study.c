/* Studies: what is refused, the order of the cells, their cases, and what they compute. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "api/result.h"
#include "api/study_run.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 4096 };

#define CASE(kind, more)                                                                           \
    "{\"schema_version\":1,\"kind\":\"" kind "\",\"name\":\"beam\",\"beam\":{\"length_m\":0.37,"   \
    "\"elements\":4,\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["                   \
    "{\"material\":\"AS4/3501-6\",\"angle_deg\":-45,\"thickness_m\":0.00013},"                     \
    "{\"material\":\"foam\",\"thickness_m\":0.00387}]}}," more "}"
#define SIMULATION                                                                                 \
    CASE("simulation", "\"flow\":{\"speed_m_s\":6,\"incidence_deg\":5},"                           \
                       "\"aerodynamics\":{\"polar\":\"plate-4pct-channel\"},"                      \
                       "\"solver\":{\"modes\":2,\"duration_s\":0.02}")
#define ANGLE "/beam/section/layup/0/angle_deg"

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

static void study_text(char out[TEXT], const char *vary)
{
    (void)snprintf(out, TEXT,
                   "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"name\":\"map\","
                   "\"case\":%s,\"vary\":%s}",
                   SIMULATION, vary);
}

static struct study *parse(const char *vary)
{
    char text[TEXT];
    struct study *s = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_non_null(problems);
    study_text(text, vary);
    if (study_parse(library, text, strlen(text), &s, problems) != ST_OK) {
        print_error("%s: %s\n", problems->item[0].pointer, problems->item[0].detail);
        fail();
    }
    free(problems);
    return s;
}

/* -- refused ---------------------------------------------------------------------------- */

static void expect_refused(const char *text, const char *pointer, const char *code,
                           const char *says)
{
    struct study *s = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_non_null(problems);
    assert_int_equal(study_parse(library, text, strlen(text), &s, problems), ST_INVALID);
    const struct failure *f = &problems->item[0];
    if (strcmp(f->pointer, pointer) != 0 || strcmp(f->code, code) != 0 ||
        strstr(f->detail, says) == NULL) {
        print_error("%s %s: %s\n", f->pointer, f->code, f->detail);
    }
    assert_string_equal(f->pointer, pointer);
    assert_string_equal(f->code, code);
    assert_non_null(strstr(f->detail, says));
    free(problems);
}

static void test_bad_axes(void **state)
{
    (void)state;
    static const struct {
        const char *vary, *pointer, *code, *says;
    } bad[] = {
        {"[]", "/vary", "empty_list", "empty"},
        {"[{\"pointer\":\"/flow/sped_m_s\",\"values\":[1]}]", "/vary/0/pointer", "unknown_pointer",
         "\"sped_m_s\" is not there"},
        {"[{\"pointer\":\"/beam/section/layup/7/angle_deg\",\"values\":[1]}]", "/vary/0/pointer",
         "unknown_pointer", "\"7\""},
        {"[{\"pointer\":\"flow\",\"values\":[1]}]", "/vary/0/pointer", "not_a_pointer", "flow"},
        {"[{\"pointer\":\"/flow\",\"values\":[1]}]", "/vary/0/pointer", "wrong_type", "/flow"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"values\":[\"fast\"]}]", "/vary/0/pointer",
         "wrong_type", "type"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"values\":[]}]", "/vary/0/values", "empty_list", "0"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"values\":[1,\"2\"]}]", "/vary/0/values/1",
         "wrong_type", "number"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"from\":1,\"to\":2}]", "/vary/0", "required",
         "not complete"},
        {"[{\"pointer\":\"/flow/speed_m_s\"}]", "/vary/0", "required", "no values"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"from\":1,\"to\":2,\"count\":1}]", "/vary/0",
         "contradictory", "range of 1"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"from\":2,\"to\":2,\"count\":3}]", "/vary/0",
         "contradictory", "range of 3"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"from\":1,\"values\":[3]}]", "/vary/0",
         "contradictory", "a list and a range"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"values\":[3]},"
         "{\"pointer\":\"/flow/speed_m_s\",\"values\":[4]}]",
         "/vary/1/pointer", "duplicate_value", "twice"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"values\":[3,4],\"zip\":\"a\"},"
         "{\"pointer\":\"/flow/incidence_deg\",\"values\":[4],\"zip\":\"a\"}]",
         "/vary/1", "wrong_length", "zipped"},
        {"[{\"pointer\":\"/flow/speed_m_s\",\"from\":1,\"to\":2,\"count\":1000},"
         "{\"pointer\":\"/flow/incidence_deg\",\"from\":1,\"to\":2,\"count\":101}]",
         "/vary", "too_many_cells", "101000"},
        /* A value and a corner that no case can have. */
        {"[{\"pointer\":\"/flow/speed_m_s\",\"values\":[3,-4]}]", "/vary/0", "out_of_range",
         "/flow/speed_m_s = -4"},
        {"[{\"pointer\":\"" ANGLE "\",\"values\":[3]},"
         "{\"pointer\":\"/aerodynamics/polar\",\"values\":[\"plate-4pct-channel\",\"none\"]}]",
         "/vary/1", "unknown_polar", "= \"none\""},
        {"[{\"pointer\":\"/solver/modes\",\"values\":[2,2.5]}]", "/vary/0", "wrong_type", "= 2.5"},
        {"[{\"pointer\":\"/solver/duration_s\",\"values\":[0.02,200]},"
         "{\"pointer\":\"/solver/time_step_s\",\"values\":[0.0002,0.00001]}]",
         "/vary/0", "too_long", "/solver/duration_s = 200, /solver/time_step_s = 1e-05"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[TEXT];
        study_text(text, bad[i].vary);
        expect_refused(text, bad[i].pointer, bad[i].code, bad[i].says);
    }
}

static void test_bad_documents(void **state)
{
    (void)state;
#define VARY "\"vary\":[{\"pointer\":\"/flow/speed_m_s\",\"values\":[3]}]"
    expect_refused("{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\"," VARY "}", "/case",
                   "required", "missing");
    expect_refused("{\"schema_version\":1,\"kind\":\"study\",\"type\":\"circle\"," VARY
                   ",\"case\":" SIMULATION "}",
                   "/type", "unknown_value", "known");
    expect_refused("{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\"," VARY
                   ",\"case\":{\"schema_version\":1,\"kind\":\"section\",\"beam\":{}}}",
                   "/case/beam/section", "required", "missing");
    expect_refused("{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"wary\":1," VARY
                   ",\"case\":" SIMULATION "}",
                   "/wary", "unknown_key", "no such key");
    expect_refused(
        "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\"," VARY
        ",\"case\":{\"schema_version\":1,\"kind\":\"training\",\"training\":{"
        "\"network\":\"small\",\"dataset\":\"plate-4pct\",\"polar\":\"plate-4pct-channel\"}}}",
        "/case", "unexpected", "training");
}

/* -- axes and cells --------------------------------------------------------------------- */

static double value_in(struct study *s, int cell, const char *a, const char *b)
{
    struct api_case *c = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_non_null(problems);
    assert_int_equal(study_case(s, cell, &c, problems), ST_OK);
    cJSON *tree = cJSON_Parse(api_case_canonical(c));
    const cJSON *at = cJSON_GetObjectItem(cJSON_GetObjectItem(tree, a), b);
    const double value = cJSON_GetNumberValue(at);
    cJSON_Delete(tree);
    api_case_destroy(c);
    free(problems);
    return value;
}

static void test_crossed_and_zipped(void **state)
{
    (void)state;
    struct study *s =
        parse("[{\"pointer\":\"/flow/speed_m_s\",\"from\":2,\"to\":3,\"count\":3},"
              "{\"pointer\":\"/solver/duration_s\",\"values\":[0.1,0.2],\"zip\":\"z\"},"
              "{\"pointer\":\"/flow/incidence_deg\",\"values\":[7,-1],\"zip\":\"z\"}]");
    struct study_map m = {.value_name = "cl"};
    study_map_axes(s, &m);
    assert_int_equal(study_cells(s), 6);
    assert_int_equal(m.n_dimension, 2);
    assert_int_equal(m.shape[0], 3);
    assert_int_equal(m.shape[1], 2);
    assert_int_equal(m.axis[2].dimension, 1);
    for (int cell = 0; cell < 6; cell++) {
        assert_true(value_in(s, cell, "flow", "speed_m_s") == 2.0 + 0.5 * (cell / 2));
        assert_true(value_in(s, cell, "solver", "duration_s") == (cell % 2 ? 0.2 : 0.1));
        assert_true(value_in(s, cell, "flow", "incidence_deg") == (cell % 2 ? -1.0 : 7.0));
    }
    study_destroy(s);
}

/* Round steps give round values, the same as a list of them: their cells are those of equal cases.
 */
static void test_range_of_round_steps(void **state)
{
    (void)state;
    struct study *range =
        parse("[{\"pointer\":\"" ANGLE "\",\"from\":-90,\"to\":90,\"count\":37}]");
    struct study_map m = {.value_name = "verdict"};
    study_map_axes(range, &m);
    assert_int_equal(m.axis[0].n, 37);
    for (int i = 0; i < 37; i++) {
        assert_true(m.axis[0].value[i] == -90.0 + 5.0 * i);
    }
    study_destroy(range);
}

static void test_canonical_text(void **state)
{
    (void)state;
    struct study *s =
        parse("[{\"pointer\":\"/flow/density_kg_m3\",\"from\":1,\"to\":1.3,\"count\":4},"
              "{\"pointer\":\"/aerodynamics/polar\",\"values\":[\"flat-plate-linear\"],"
              "\"zip\":\"\"}]");
    struct study *again = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    const char *text = study_canonical(s);
    assert_int_equal(study_parse(library, text, strlen(text), &again, problems), ST_OK);
    assert_string_equal(study_canonical(again), text);
    assert_string_equal(study_hash(again), study_hash(s));
    assert_non_null(strstr(text, "\"kinematic_viscosity_m2_s\"")); /* a default */
    study_destroy(again);
    struct study *opened = NULL;
    assert_int_equal(study_open(library, text, &opened, problems), ST_OK);
    assert_int_equal(study_cells(opened), 4);
    assert_true(value_in(opened, 3, "flow", "density_kg_m3") == 1.3);
    study_destroy(opened);
    struct study *other = parse("[{\"pointer\":\"/flow/density_kg_m3\",\"values\":[1]}]");
    assert_string_not_equal(study_hash(other), study_hash(s));
    study_destroy(other);
    study_destroy(s);
    free(problems);
}

/* Whatever the order of the axes, cells on one structure are neighbours, and each comes once. */
static void test_order(void **state)
{
    (void)state;
    struct study *s = parse("[{\"pointer\":\"/flow/speed_m_s\",\"from\":2,\"to\":3,\"count\":5},"
                            "{\"pointer\":\"" ANGLE "\",\"from\":-90,\"to\":90,\"count\":7},"
                            "{\"pointer\":\"/flow/incidence_deg\",\"values\":[1,2,3]}]");
    const struct study_plan plan = study_plan_of(s);
    bool seen[5 * 7 * 3] = {false};
    int changes = 0;
    assert_int_equal(plan.n_cell, 105);
    for (int place = 0; place < plan.n_cell; place++) {
        const int cell = study_cell_at(s, place);
        assert_false(seen[cell]);
        seen[cell] = true;
        changes += place > 0 && !study_same_structure(s, cell, study_cell_at(s, place - 1));
    }
    assert_int_equal(changes, 6);
    assert_true(study_same_structure(s, 0, 1));
    assert_false(study_same_structure(s, 0, 3));
    assert_true(study_same_structure(s, 0, 21));
    study_destroy(s);
}

static void check_plan(const char *vary, int run, int most)
{
    struct study *s = parse(vary);
    const struct study_plan plan = study_plan_of(s);
    assert_int_equal(plan.run, run);
    assert_in_range(plan.unit, 1, most);
    study_destroy(s);
}

static void test_plan(void **state)
{
    (void)state;
    /* Cheap cells: units go across structures, but leave something for eight workers. */
    check_plan("[{\"pointer\":\"" ANGLE "\",\"from\":-90,\"to\":90,\"count\":70},"
               "{\"pointer\":\"/flow/speed_m_s\",\"values\":[2,3]}]",
               140, 140 / 8);
    /* Long runs: a unit is part of one. */
    check_plan("[{\"pointer\":\"" ANGLE "\",\"from\":-90,\"to\":90,\"count\":37},"
               "{\"pointer\":\"/flow/speed_m_s\",\"from\":2,\"to\":9,\"count\":1000}]",
               1000, 500);
}

/* Whatever a byte of a good text becomes: a study, or problems that name a place. */
static void test_damaged_texts(void **state)
{
    (void)state;
    static const char bytes[] = "0123456789-.eE\"{}[],:/~ azAZ_\\\x80";
    char good[TEXT], text[TEXT];
    unsigned long long random = 1;
    int accepted = 0, refused = 0;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_non_null(problems);
    study_text(good, "[{\"pointer\":\"" ANGLE "\",\"from\":-45,\"to\":45,\"count\":3},"
                     "{\"pointer\":\"/aerodynamics/polar\",\"values\":[\"plate-4pct-channel\"]},"
                     "{\"pointer\":\"/flow/speed_m_s\",\"values\":[3,4,5],\"zip\":\"a\"},"
                     "{\"pointer\":\"/flow/incidence_deg\",\"values\":[1,2,3],\"zip\":\"a\"}]");
    for (int i = 0; i < 1500; i++) {
        struct study *s = NULL;
        memcpy(text, good, sizeof text);
        random = random * 6364136223846793005ULL + 1442695040888963407ULL;
        text[(random >> 33) % strlen(good)] = bytes[(random >> 17) % (sizeof bytes - 1)];
        problems->count = problems->total = 0;
        if (study_parse(library, text, strlen(text), &s, problems) == ST_OK) {
            assert_int_equal(problems->total, 0);
            assert_in_range(study_cells(s), 1, STUDY_CELLS_MAX);
            accepted++;
            study_destroy(s);
        } else {
            assert_true(problems->total > 0);
            assert_true(problems->item[0].code[0] != '\0');
            refused++;
        }
    }
    assert_true(accepted > 20);
    assert_true(refused > 1000);
    free(problems);
}

/* -- computed --------------------------------------------------------------------------- */

static double no_clock(void)
{
    return 0.0;
}

/* The summary as a run of its own gives it. */
static char *alone(struct study *s, int cell)
{
    struct api_case *c = NULL;
    struct sim *sim = NULL;
    struct failure fail;
    const struct run_timing timing = {.cpu_s = 0.0};
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_int_equal(study_case(s, cell, &c, problems), ST_OK);
    assert_int_equal(sim_create(api_case_def(c), &sim, &fail), ST_OK);
    assert_int_equal(sim_run(sim, NULL, &fail), ST_OK);
    char *text = result_document("summary", c, sim_result(sim), &timing);
    sim_destroy(sim);
    api_case_destroy(c);
    free(problems);
    return text;
}

static void test_cells_are_runs(void **state)
{
    (void)state;
    struct study *s = parse("[{\"pointer\":\"" ANGLE "\",\"values\":[-45,0]},"
                            "{\"pointer\":\"/flow/speed_m_s\",\"values\":[2,6,4]}]");
    struct study_runner *r = study_runner_create(s, no_clock);
    assert_non_null(r);
    for (int cell = 0; cell < study_cells(s); cell++) {
        char hash[LIMIT_HASH];
        struct study_cell_result result;
        assert_int_equal(study_runner_begin(r, cell, hash), ST_OK);
        assert_int_equal(study_runner_compute(r, NULL, &result), ST_OK);
        assert_int_equal(result.state, STUDY_CELL_DONE);
        assert_string_equal(result.hash, hash);
        char *text = alone(s, cell);
        assert_string_equal(result.summary, text);
        free(text);
        study_cell_result_done(&result);
    }
    study_runner_destroy(r);
    study_destroy(s);
}

/* A kind without a beam. */
static void test_loops(void **state)
{
    (void)state;
    static const char text[] =
        "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"case\":{\"schema_version\":1,"
        "\"kind\":\"loop\",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\",\"dynamic\":"
        "{\"type\":\"attached\"}},\"motion\":{\"type\":\"sine\",\"mean_deg\":2,\"amplitude_deg\":3,"
        "\"frequency_c_v\":0.1,\"cycles\":2}},\"vary\":["
        "{\"pointer\":\"/motion/mean_deg\",\"values\":[0,4]},"
        "{\"pointer\":\"/motion/frequency_c_v\",\"values\":[0.05,0.1]}]}";
    struct study *s = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_int_equal(study_parse(library, text, strlen(text), &s, problems), ST_OK);
    struct study_runner *r = study_runner_create(s, no_clock);
    for (int cell = 0; cell < 4; cell++) {
        char hash[LIMIT_HASH];
        struct study_cell_result result;
        assert_int_equal(study_runner_begin(r, cell, hash), ST_OK);
        assert_int_equal(study_runner_compute(r, NULL, &result), ST_OK);
        char *single = alone(s, cell);
        assert_string_equal(result.summary, single);
        free(single);
        study_cell_result_done(&result);
    }
    study_runner_destroy(r);
    study_destroy(s);
    free(problems);
}

/* Corners are fine, a cell between them is not: it fails with its reason. */
static void test_a_bad_cell(void **state)
{
    (void)state;
    char values[4096] = "";
    size_t used = 0;
    for (int i = 0; i < 1100; i++) { /* one of more values than are tried */
        used += (size_t)snprintf(values + used, sizeof values - used, "%s%d", i > 0 ? "," : "",
                                 i == 555 ? -1 : i % 9 + 1);
    }
    char *text = calloc(1, 3 * TEXT);
    assert_non_null(text);
    (void)snprintf(
        text, 3 * TEXT,
        "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"case\":%s,\"vary\":["
        "{\"pointer\":\"/flow/speed_m_s\",\"values\":[%s]}]}",
        SIMULATION, values);
    struct study *s = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    assert_int_equal(study_open(library, text, &s, problems), ST_OK);
    struct study_runner *r = study_runner_create(s, no_clock);
    char hash[LIMIT_HASH];
    struct study_cell_result result;
    assert_int_equal(study_runner_begin(r, 555, hash), ST_OK);
    assert_string_equal(hash, "");
    assert_int_equal(study_runner_compute(r, NULL, &result), ST_OK);
    assert_int_equal(result.state, STUDY_CELL_FAILED);
    assert_string_equal(result.code, "out_of_range");
    assert_non_null(strstr(result.detail, "/flow/speed_m_s"));
    assert_null(result.summary);
    study_runner_destroy(r);
    study_destroy(s);
    free(problems);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_axes),
        cmocka_unit_test(test_bad_documents),
        cmocka_unit_test(test_crossed_and_zipped),
        cmocka_unit_test(test_range_of_round_steps),
        cmocka_unit_test(test_canonical_text),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_plan),
        cmocka_unit_test(test_cells_are_runs),
        cmocka_unit_test(test_a_bad_cell),
        cmocka_unit_test(test_loops),
        cmocka_unit_test(test_damaged_texts),
    };
    return cmocka_run_group_tests(tests, build_library, free_library);
}
