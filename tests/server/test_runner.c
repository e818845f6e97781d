/* Cases through the real core: what a run leaves to be stored. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/runner.h"
#include "tests/server/cases.h"

#include <math.h>
#include <string.h>

static struct library *library;

static const char *document(const struct run_outcome *o, const char *name)
{
    for (int i = 0; i < o->result.n_document; i++) {
        if (strcmp(o->document[i].name, name) == 0) {
            return o->document[i].json;
        }
    }
    return NULL;
}

static void test_simulation(void **state)
{
    (void)state;
    struct run_outcome o;
    _Atomic double progress = 0.0;
    const struct sim_control control = {.progress = &progress};
    char text[CASE_TEXT];
    case_text(text, 3.0, 1.0);
    runner_run(library, text, &control, &o);
    assert_int_equal(o.end, RUN_DONE);
    assert_true(progress == 1.0);
    assert_true(o.result.cpu_s > 0.0);
    assert_true(strlen(o.result.verdict) > 0);
    assert_non_null(strstr(document(&o, "summary"), o.result.verdict));
    static const char *const expected[] = {"summary", "damping", "loads", "modes", "section"};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        assert_non_null(document(&o, expected[i]));
    }
    run_outcome_done(&o);
}

/* The stored columns are the core's, in presented units. */
static void test_series_equal_the_core(void **state)
{
    (void)state;
    struct run_outcome o;
    const struct sim_control control = {.cancel = NULL};
    char text[CASE_TEXT];
    case_text(text, 3.0, 1.0);
    runner_run(library, text, &control, &o);
    assert_int_equal(o.end, RUN_DONE);
    const struct store_series *s = o.result.series;
    assert_int_equal(s->n, 5001);
    assert_int_equal(s->n_column, 5);
    assert_true(s->step == 2e-4);
    assert_string_equal(s->column[1].name, "tip_twist_deg");
    assert_string_equal(s->column[4].name, "modal_amplitude[3]");

    struct api_case *c = parse_case(library, text);
    struct sim *sim = NULL;
    struct failure fail;
    assert_int_equal(sim_create(api_case_def(c), &sim, &fail), ST_OK);
    assert_int_equal(sim_run(sim, &control, &fail), ST_OK);
    double value[SERIES_CHUNK];
    for (int j = 0; j < s->n_column; j++) {
        const double *raw = sim_column(sim, j);
        const double scale = j == 1 ? 180.0 / acos(-1.0) : 1.0;
        assert_int_equal(series_decode(&s->column[j].chunk[0], value), ST_OK);
        for (int i = 0; i < SERIES_CHUNK; i++) {
            assert_true(fabs(value[i] - raw[i] * scale) <= 1e-15 * fabs(raw[i] * scale));
        }
        assert_int_equal(series_decode(&s->column[j].chunk[1], value), ST_OK);
        assert_true(fabs(value[904] - raw[5000] * scale) <= 1e-15 * fabs(raw[5000] * scale));
    }
    sim_destroy(sim);
    api_case_destroy(c);
    run_outcome_done(&o);
}

static void test_section_has_no_series(void **state)
{
    (void)state;
    struct run_outcome o;
    const struct sim_control control = {.cancel = NULL};
    runner_run(library, section_case, &control, &o);
    assert_int_equal(o.end, RUN_DONE);
    assert_null(o.result.series);
    assert_string_equal(o.result.verdict, "");
    assert_non_null(document(&o, "section"));
    assert_null(document(&o, "damping"));
    run_outcome_done(&o);
}

static void test_cancelled(void **state)
{
    (void)state;
    struct run_outcome o;
    const atomic_bool cancel = true;
    const struct sim_control control = {.cancel = &cancel};
    char text[CASE_TEXT];
    case_text(text, 3.0, 100.0);
    runner_run(library, text, &control, &o);
    assert_int_equal(o.end, RUN_STOPPED);
    run_outcome_done(&o);
}

/* A stored case that the rules of today refuse fails with the field, and nothing else happens. */
static void test_refused_case(void **state)
{
    (void)state;
    struct run_outcome o;
    const struct sim_control control = {.cancel = NULL};
    char text[CASE_TEXT];
    case_text(text, -6.0, 1.0);
    runner_run(library, text, &control, &o);
    assert_int_equal(o.end, RUN_FAILED);
    assert_true(strlen(o.code) > 0);
    assert_non_null(strstr(o.detail, "/flow/speed_m_s"));
    run_outcome_done(&o);
    runner_run(library, "{", &control, &o);
    assert_int_equal(o.end, RUN_FAILED);
    run_outcome_done(&o);
}

static int setup(void **state)
{
    (void)state;
    struct failure fail;
    sim_process_init();
    return library_create_builtin(&library, &fail) == ST_OK ? 0 : -1;
}

static int teardown(void **state)
{
    (void)state;
    library_destroy(library);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_simulation),
        cmocka_unit_test(test_series_equal_the_core),
        cmocka_unit_test(test_section_has_no_series),
        cmocka_unit_test(test_cancelled),
        cmocka_unit_test(test_refused_case),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
