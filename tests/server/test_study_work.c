/* What a worker does with a unit of a study, over a real store, writer and core, without threads.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "api/pack.h"
#include "api/study.h"
#include "server/study_work.h"
#include "tests/server/cases.h"
#include "tests/server/store_support.h"

static const struct log quiet = {.fd = -1, .level = LOG_LEVEL_ERROR};

enum { STUDY_TEXT = 2048, ATTEMPTS = 3, CELLS = 4 };

/* Two angles by two speeds. */
static void study_text(char out[STUDY_TEXT], const char *name, double second_speed)
{
    char text[CASE_TEXT];
    case_text(text, 4.0, 0.02);
    (void)snprintf(out, STUDY_TEXT,
                   "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"name\":\"%s\","
                   "\"case\":%s,\"vary\":[{\"pointer\":\"/flow/speed_m_s\",\"values\":[3,%.9g]},"
                   "{\"pointer\":\"/beam/section/layup/0/angle_deg\",\"values\":[-45,0]}]}",
                   name, text, second_speed);
}

static void submit_text(const struct fixture *f, int i, const char *hash, const char *text)
{
    const struct study_plan plan = {.n_cell = CELLS, .run = CELLS, .unit = CELLS};
    struct service_submit item = sample(hash);
    struct service_submitted out;
    item.kind = JOB_STUDY;
    item.case_json = text;
    item.plan = &plan;
    begin(f);
    assert_int_equal(writer(f)->ops->submit(writer(f), &item, id_of[i], 1, &out), STORE_OK);
    commit(f);
}

static struct store_claim claim_text(const struct fixture *f)
{
    struct store_claim c = {.attempt = 0};
    begin(f);
    assert_int_equal(writer(f)->ops->claim_unit(writer(f), "me", 1000, 2000, &c), STORE_OK);
    commit(f);
    return c;
}

/* Works on the claim as a worker would; true when the study has ended. */
static bool work(const struct fixture *f, struct store_claim *claim, bool cancelled)
{
    struct library *library = NULL;
    struct failure why;
    struct worker_env env = {.store = f->store,
                             .log = &quiet,
                             .dispatch = dispatch_create(1, 1),
                             .owner = "me",
                             .attempts_max = ATTEMPTS};
    assert_int_equal(library_create_builtin(&library, &why), ST_OK);
    assert_int_equal(writer_create(f->store, &quiet, &env.writer), STORE_OK);
    env.library = library;
    struct study_work *w = study_work_create();
    assert_non_null(w);
    dispatch_enter(env.dispatch, 0, &claim->ticket);
    if (cancelled) {
        (void)dispatch_cancel(env.dispatch, claim->ticket.id, 0);
    }
    const bool ended = study_work_unit(w, &env, 0, claim);
    dispatch_leave(env.dispatch, 0);
    study_work_destroy(w);
    writer_destroy(env.writer);
    dispatch_destroy(env.dispatch);
    library_destroy(library);
    free(claim->case_json);
    return ended;
}

static struct service_study progress_of(const struct fixture *f, int i)
{
    struct service_study s = {.n_cell = -1};
    assert_int_equal(writer(f)->ops->get_study(writer(f), id_of[i], &s), STORE_OK);
    return s;
}

/* Cell `number` of a study; its summary is the caller's. */
static struct service_cell cell_of(const struct fixture *f, int i, int number)
{
    struct store_cell_row *row = NULL;
    int n = 0;
    assert_int_equal(writer(f)->ops->get_cells(writer(f), id_of[i], number, 1, true, &row, &n),
                     STORE_OK);
    assert_int_equal(n, 1);
    struct service_cell c = row[0].cell;
    if (row[0].packed != NULL) {
        c.summary = unpack_text(row[0].packed, row[0].packed_size, row[0].size);
        assert_non_null(c.summary);
    }
    free(row[0].packed);
    free(row);
    return c;
}

static void test_to_the_end_and_reused(void **state)
{
    const struct fixture *f = *state;
    char text[STUDY_TEXT];
    study_text(text, "first", 6.0);
    submit_text(f, 0, "a", text);
    struct store_claim c = claim_text(f);
    assert_true(work(f, &c, false));
    assert_int_equal(get(f, id_of[0]).state, JOB_DONE);
    assert_int_equal(progress_of(f, 0).done, CELLS);
    assert_int_equal(progress_of(f, 0).reused, 0);
    for (int k = 0; k < CELLS; k++) {
        struct service_cell cell = cell_of(f, 0, k);
        assert_int_equal(cell.state, STUDY_CELL_DONE);
        assert_true(strlen(cell.verdict) > 0);
        assert_non_null(strstr(cell.summary, "\"means\""));
        free(cell.summary);
    }
    study_text(text, "second", 5.0);
    submit_text(f, 1, "b", text);
    c = claim_text(f);
    assert_true(work(f, &c, false));
    assert_int_equal(progress_of(f, 1).done, CELLS);
    assert_int_equal(progress_of(f, 1).reused, 2);
}

/* The cell that was being computed when a worker was lost, too often, is given up; not the study.
 */
static void test_a_lost_cell_is_given_up(void **state)
{
    const struct fixture *f = *state;
    char text[STUDY_TEXT];
    study_text(text, "", 6.0);
    submit_text(f, 0, "a", text);
    struct store_claim c;
    for (int i = 0; i < ATTEMPTS; i++) {
        struct store_recovered r;
        c = claim_text(f);
        free(c.case_json);
        begin(f);
        assert_int_equal(writer(f)->ops->recover(writer(f), "next", 1, ATTEMPTS, &r), STORE_OK);
        commit(f);
        assert_int_equal(r.units, 1);
    }
    c = claim_text(f);
    assert_int_equal(c.lost, ATTEMPTS);
    assert_true(work(f, &c, false));
    const struct service_study s = progress_of(f, 0);
    assert_int_equal(s.failed, 1);
    assert_int_equal(s.done, CELLS - 1);
    const struct service_cell cell = cell_of(f, 0, 0);
    assert_int_equal(cell.state, STUDY_CELL_FAILED);
    assert_string_equal(cell.error_code, "lost");
    assert_null(cell.summary);
}

static void test_what_no_longer_parses_fails(void **state)
{
    const struct fixture *f = *state;
    submit_text(
        f, 0, "a",
        "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"case\":{},\"vary\":[]}");
    struct store_claim c = claim_text(f);
    assert_true(work(f, &c, false));
    const struct job_record job = get(f, id_of[0]);
    assert_int_equal(job.state, JOB_FAILED);
    assert_non_null(strstr(job.error_detail, "/case"));
}

static void test_stopped_work_waits_again(void **state)
{
    const struct fixture *f = *state;
    char text[STUDY_TEXT];
    study_text(text, "", 6.0);
    submit_text(f, 0, "a", text);
    struct store_claim c = claim_text(f);
    assert_false(work(f, &c, true));
    assert_int_equal(get(f, id_of[0]).state, JOB_RUNNING);
    assert_int_equal(progress_of(f, 0).done, 0);
    c = claim_text(f);
    assert_int_equal(c.lost, 0);
    assert_int_equal(c.next, 0);
    assert_true(work(f, &c, false));
    assert_int_equal(progress_of(f, 0).done, CELLS);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_setup, fixture_teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_to_the_end_and_reused),
        TEST(test_a_lost_cell_is_given_up),
        TEST(test_what_no_longer_parses_fails),
        TEST(test_stopped_work_waits_again),
    };
    sim_process_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
