/* The suite every storage back end must pass. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/job.h"
#include "tests/server/support.h"

#include <math.h>

enum { ATTEMPTS = 3 };

static const char *const id_of[] = {
    "00000000-0000-7000-8000-000000000000", "00000000-0000-7000-8000-000000000001",
    "00000000-0000-7000-8000-000000000002", "00000000-0000-7000-8000-000000000003",
    "00000000-0000-7000-8000-000000000004"};

static struct store_session *writer(const struct fixture *f)
{
    return f->store->ops->writer(f->store);
}

static void begin(const struct fixture *f)
{
    assert_int_equal(writer(f)->ops->begin(writer(f)), STORE_OK);
}

static void commit(const struct fixture *f)
{
    assert_int_equal(writer(f)->ops->commit(writer(f)), STORE_OK);
}

static struct service_submitted submit(const struct fixture *f, int i, const char *hash)
{
    const struct service_submit item = sample(hash);
    struct service_submitted out = {.reused = false};
    begin(f);
    assert_int_equal(writer(f)->ops->submit(writer(f), &item, id_of[i], 100 + i, &out), STORE_OK);
    commit(f);
    return out;
}

static enum store_status claim(const struct fixture *f, const char *owner, struct store_ticket *t)
{
    struct store_claim c = {.attempt = 0};
    begin(f);
    const enum store_status st = writer(f)->ops->claim(writer(f), owner, 1000, 2000, &c);
    commit(f);
    if (st == STORE_OK) {
        assert_int_equal(c.kind, CASE_SIMULATION);
        assert_string_equal(c.case_json, "{\"schema_version\":1}");
        *t = c.ticket;
    }
    free(c.case_json);
    return st;
}

static struct job_record get(const struct fixture *f, const char *id)
{
    struct job_record job = {.attempt = -1};
    struct store_session *r = f->store->ops->reader_take(f->store);
    assert_non_null(r);
    assert_int_equal(r->ops->get(r, id, &job), STORE_OK);
    f->store->ops->reader_give(f->store, r);
    assert_true(job_invariant(&job, !job_is_final(job.state)));
    return job;
}

static int64_t depth(const struct fixture *f)
{
    int64_t n = -1;
    assert_int_equal(writer(f)->ops->depth(writer(f), &n), STORE_OK);
    return n;
}

static enum store_status publish(const struct fixture *f, const struct store_ticket *t,
                                 const struct store_series *series)
{
    const struct store_document document[] = {{"summary", "{\"a\":1}"}, {"modes", "[]"}};
    const struct store_result result = {
        .verdict = "stable", .cpu_s = 0.5, .n_document = 2, .document = document, .series = series};
    begin(f);
    const enum store_status st = writer(f)->ops->publish(writer(f), t, &result, 3000);
    if (st == STORE_OK) {
        commit(f);
    } else {
        writer(f)->ops->rollback(writer(f));
    }
    return st;
}

/* -- life of a job
 * ----------------------------------------------------------------------------------- */

static void test_submit_claim_publish(void **state)
{
    const struct fixture *f = *state;
    const struct service_submitted s = submit(f, 0, "h0");
    assert_false(s.reused);
    assert_int_equal(s.state, JOB_QUEUED);
    assert_string_equal(s.id, id_of[0]);
    assert_int_equal(depth(f), 1);

    struct store_ticket t;
    assert_int_equal(claim(f, "p1", &t), STORE_OK);
    assert_string_equal(t.id, id_of[0]);
    assert_int_equal(t.fence, 1);
    assert_int_equal(get(f, t.id).state, JOB_RUNNING);
    struct store_ticket none;
    assert_int_equal(claim(f, "p1", &none), STORE_NONE);

    assert_int_equal(publish(f, &t, NULL), STORE_OK);
    const struct job_record job = get(f, t.id);
    assert_int_equal(job.state, JOB_DONE);
    assert_string_equal(job.verdict, "stable");
    assert_string_equal(job.name, "sample");
    assert_int_equal(job.attempt, 1);
    assert_int_equal(job.started_us, 1000);
    assert_int_equal(job.finished_us, 3000);
    assert_int_equal(depth(f), 0);
    assert_int_equal(publish(f, &t, NULL), STORE_CONFLICT); /* a result exists once */
}

static void test_oldest_first(void **state)
{
    const struct fixture *f = *state;
    static const char *const hash[] = {"a", "b", "c"};
    for (int i = 0; i < 3; i++) {
        (void)submit(f, i, hash[i]);
    }
    for (int i = 0; i < 3; i++) {
        struct store_ticket t;
        assert_int_equal(claim(f, "p", &t), STORE_OK);
        assert_string_equal(t.id, id_of[i]);
    }
}

static void test_reuse(void **state)
{
    const struct fixture *f = *state;
    (void)submit(f, 0, "h");
    struct service_submitted s = submit(f, 1, "h"); /* queued */
    assert_true(s.reused);
    assert_string_equal(s.id, id_of[0]);
    struct store_ticket t;
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    s = submit(f, 1, "h"); /* running */
    assert_true(s.reused);
    assert_int_equal(s.state, JOB_RUNNING);
    assert_int_equal(publish(f, &t, NULL), STORE_OK);
    s = submit(f, 1, "h"); /* done */
    assert_true(s.reused);
    assert_int_equal(s.state, JOB_DONE);
    assert_int_equal(depth(f), 0);
}

static void test_failed_and_cancelled_are_not_reused(void **state)
{
    const struct fixture *f = *state;
    struct job_record job;
    struct store_ticket t;
    (void)submit(f, 0, "h");
    begin(f);
    assert_int_equal(writer(f)->ops->cancel(writer(f), id_of[0], 5, &job), STORE_OK);
    commit(f);
    assert_int_equal(job.state, JOB_CANCELLED);
    assert_false(submit(f, 1, "h").reused);
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    assert_string_equal(t.id, id_of[1]);
    begin(f);
    assert_int_equal((writer(f)->ops->fail)(writer(f), &t, "singular", "at 3 s", 7), STORE_OK);
    commit(f);
    job = get(f, id_of[1]);
    assert_int_equal(job.state, JOB_FAILED);
    assert_string_equal(job.error_code, "singular");
    assert_string_equal(job.error_detail, "at 3 s");
    assert_false(submit(f, 2, "h").reused);
}

static void test_undo_leaves_nothing(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    const struct service_submit a = sample("a"), b = sample("b");
    struct service_submitted out;
    begin(f);
    assert_int_equal(s->ops->mark(s), STORE_OK);
    assert_int_equal(s->ops->submit(s, &a, id_of[0], 1, &out), STORE_OK);
    assert_int_equal(s->ops->undo(s), STORE_OK);
    assert_int_equal(s->ops->mark(s), STORE_OK);
    assert_int_equal(s->ops->submit(s, &b, id_of[1], 1, &out), STORE_OK);
    assert_int_equal(s->ops->release(s), STORE_OK);
    commit(f);
    struct job_record job;
    assert_int_equal(s->ops->get(s, id_of[0], &job), STORE_NONE);
    assert_int_equal(s->ops->get(s, id_of[1], &job), STORE_OK);
    assert_int_equal(depth(f), 1);
}

/* -- cancel
 * ------------------------------------------------------------------------------------------ */

static void test_cancel_running(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    struct job_record job;
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    begin(f);
    assert_int_equal(s->ops->stopped(s, &t, 9), STORE_CONFLICT); /* nobody asked for it */
    for (int i = 0; i < 2; i++) {                                /* idempotent */
        assert_int_equal(s->ops->cancel(s, t.id, 9, &job), STORE_OK);
        assert_int_equal(job.state, JOB_CANCELLING);
    }
    assert_int_equal(s->ops->hand_back(s, &t), STORE_CONFLICT);
    commit(f);
    assert_false(submit(f, 1, "h").reused); /* a dying job answers nothing */
    assert_int_equal(publish(f, &t, NULL), STORE_CONFLICT);
    begin(f);
    assert_int_equal(s->ops->stopped(s, &t, 9), STORE_OK);
    assert_int_equal(s->ops->cancel(s, t.id, 10, &job), STORE_OK);
    commit(f);
    assert_int_equal(job.state, JOB_CANCELLED);
    assert_int_equal(job.finished_us, 9);
    assert_int_equal(depth(f), 1); /* the other one */
    begin(f);
    assert_int_equal(s->ops->cancel(s, "no-such-id", 1, &job), STORE_NONE);
    commit(f);
}

/* -- leases, fences, recovery
 * ------------------------------------------------------------------------ */

static struct store_recovered recover(const struct fixture *f, const char *owner, int64_t now)
{
    struct store_recovered r = {0};
    begin(f);
    assert_int_equal(writer(f)->ops->recover(writer(f), owner, now, ATTEMPTS, &r), STORE_OK);
    commit(f);
    return r;
}

static void test_fence_refuses_the_late_worker(void **state)
{
    const struct fixture *f = *state;
    struct store_ticket late, now;
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "p", &late), STORE_OK);
    assert_int_equal(recover(f, "p", 1500).queued, 0); /* the lease runs until 2000 */
    assert_int_equal(recover(f, "p", 2500).queued, 1);
    assert_int_equal(publish(f, &late, NULL), STORE_CONFLICT); /* nobody holds it */
    assert_int_equal(claim(f, "p", &now), STORE_OK);
    assert_int_equal(now.fence, late.fence + 1);
    assert_int_equal(publish(f, &late, NULL), STORE_CONFLICT);
    begin(f);
    assert_int_equal(writer(f)->ops->heartbeat(writer(f), &late, 9000), STORE_CONFLICT);
    assert_int_equal(writer(f)->ops->heartbeat(writer(f), &now, 9000), STORE_OK);
    commit(f);
    assert_int_equal(recover(f, "p", 2500).queued, 0); /* the heartbeat counted */
    assert_int_equal(publish(f, &now, NULL), STORE_OK);
    assert_int_equal(get(f, id_of[0]).attempt, 2);
}

static void test_lost_attempts_are_bounded(void **state)
{
    const struct fixture *f = *state;
    struct store_ticket t;
    (void)submit(f, 0, "h");
    for (int i = 1; i < ATTEMPTS; i++) {
        assert_int_equal(claim(f, "old", &t), STORE_OK);
        assert_int_equal(recover(f, "new", 1500).queued, 1); /* another owner's lease */
    }
    assert_int_equal(claim(f, "old", &t), STORE_OK);
    assert_int_equal(recover(f, "new", 1500).failed, 1);
    const struct job_record job = get(f, id_of[0]);
    assert_int_equal(job.state, JOB_FAILED);
    assert_string_equal(job.error_code, "lost");
    assert_int_equal(depth(f), 0);
}

static void test_handing_back_costs_no_attempt(void **state)
{
    const struct fixture *f = *state;
    (void)submit(f, 0, "h");
    for (int i = 0; i < 2 * ATTEMPTS; i++) {
        struct store_ticket t;
        assert_int_equal(claim(f, "p", &t), STORE_OK);
        begin(f);
        assert_int_equal(writer(f)->ops->hand_back(writer(f), &t), STORE_OK);
        commit(f);
        assert_int_equal(get(f, id_of[0]).state, JOB_QUEUED);
    }
    assert_int_equal(recover(f, "new", 1500).failed, 0);
}

static void test_cancelling_job_of_a_dead_process(void **state)
{
    const struct fixture *f = *state;
    struct store_ticket t;
    struct job_record job;
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "old", &t), STORE_OK);
    begin(f);
    assert_int_equal(writer(f)->ops->cancel(writer(f), t.id, 9, &job), STORE_OK);
    commit(f);
    assert_int_equal(recover(f, "new", 1500).cancelled, 1);
    assert_int_equal(get(f, t.id).state, JOB_CANCELLED);
}

/* -- results
 * ----------------------------------------------------------------------------------------- */

enum { SAMPLES = 2 * SERIES_CHUNK + 100 };

struct recorded {
    double value[2][SAMPLES];
    struct series_chunk chunk[2][3];
    struct store_column column[2];
    struct store_series series;
    char *buffer[6];
};

static struct recorded *make_series(void)
{
    struct recorded *r = calloc(1, sizeof *r);
    assert_non_null(r);
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < SAMPLES; i++) {
            r->value[j][i] = sin(0.001 * i + j);
        }
        for (int k = 0; k < 3; k++) {
            char *buffer = malloc(series_bound());
            assert_non_null(buffer);
            r->buffer[3 * j + k] = buffer;
            series_encode(&r->value[j][k * SERIES_CHUNK], k < 2 ? SERIES_CHUNK : 100, buffer,
                          &r->chunk[j][k]);
        }
        (void)snprintf(r->column[j].name, sizeof r->column[j].name, j == 0 ? "cl" : "cm");
        r->column[j].chunk = r->chunk[j];
    }
    r->series = (struct store_series){
        .t0 = 0.0, .step = 2e-4, .n = SAMPLES, .n_column = 2, .column = r->column};
    return r;
}

static void free_series(struct recorded *r)
{
    for (int i = 0; i < 6; i++) {
        free(r->buffer[i]);
    }
    free(r);
}

static void test_series_come_back_bit_for_bit(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    struct recorded *r = make_series();
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    assert_int_equal(publish(f, &t, &r->series), STORE_OK);

    struct series_data data;
    assert_int_equal(s->ops->get_series(s, t.id, &data), STORE_OK);
    assert_int_equal(data.n, SAMPLES);
    assert_int_equal(data.n_column, 2);
    assert_string_equal(data.column[1].name, "cm");
    assert_true(data.step == 2e-4);
    series_data_done(&data);
    static const struct {
        int from, n;
    } window[] = {{0, SAMPLES}, {0, 1}, {SERIES_CHUNK - 1, 2}, {SAMPLES - 1, 1}, {17, 5000}};
    double *back = malloc(SAMPLES * sizeof *back);
    assert_non_null(back);
    for (size_t i = 0; i < sizeof window / sizeof window[0]; i++) {
        const int from = window[i].from, n = window[i].n;
        assert_int_equal(s->ops->get_samples(s, t.id, 1, from, n, back), STORE_OK);
        assert_memory_equal(back, &r->value[1][from], (size_t)n * sizeof *back);
    }
    assert_int_equal(s->ops->get_samples(s, t.id, 2, 0, 1, back), STORE_CORRUPT); /* no column */
    free(back);
    free_series(r);
}

static void test_damaged_chunk_is_refused(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    struct recorded *r = make_series();
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    r->chunk[0][1].checksum ^= 1; /* as if the disk had changed a bit since */
    assert_int_equal(publish(f, &t, &r->series), STORE_OK);
    double value[10];
    assert_int_equal(s->ops->get_samples(s, t.id, 0, 0, 10, value), STORE_OK);
    assert_int_equal(s->ops->get_samples(s, t.id, 0, SERIES_CHUNK, 10, value), STORE_CORRUPT);
    free_series(r);
}

static void test_documents(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    char *json = NULL;
    struct series_data data;
    assert_int_equal(s->ops->get_document(s, id_of[0], "summary", &json), STORE_NONE);
    (void)submit(f, 0, "h");
    assert_int_equal(s->ops->get_document(s, id_of[0], "summary", &json), STORE_NOT_READY);
    assert_int_equal(s->ops->get_series(s, id_of[0], &data), STORE_NOT_READY);
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    assert_int_equal(publish(f, &t, NULL), STORE_OK);
    assert_int_equal(s->ops->get_document(s, t.id, "summary", &json), STORE_OK);
    assert_string_equal(json, "{\"a\":1}");
    free(json);
    assert_int_equal(s->ops->get_document(s, t.id, "damping", &json), STORE_NONE);
    assert_int_equal(s->ops->get_series(s, t.id, &data), STORE_NONE);
    assert_int_equal(s->ops->get_case(s, t.id, &json), STORE_OK);
    assert_string_equal(json, "{\"schema_version\":1}");
    free(json);
}

/* -- lists
 * ------------------------------------------------------------------------------------------- */

static int list(const struct fixture *f, const struct service_filter *filter, const char *expect)
{
    struct store_session *s = writer(f);
    struct job_record *rows = NULL;
    int n = 0;
    bool more = false;
    assert_int_equal(s->ops->list(s, filter, &rows, &n, &more), STORE_OK);
    char got[16] = "";
    for (int i = 0; i < n; i++) {
        got[i] = rows[i].id[35];
    }
    free(rows);
    assert_string_equal(got, expect);
    return more;
}

static void test_lists(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    static const char *const hash[] = {"a", "b", "c", "d", "e"};
    begin(f);
    for (int i = 0; i < 5; i++) {
        struct service_submit item = sample(hash[i]);
        item.kind = i == 3 ? CASE_MODES : CASE_SIMULATION;
        item.name = i % 2 == 0 ? "even" : "odd";
        struct service_submitted out;
        assert_int_equal(s->ops->submit(s, &item, id_of[i], i, &out), STORE_OK);
    }
    struct job_record job;
    assert_int_equal(s->ops->cancel(s, id_of[2], 9, &job), STORE_OK);
    commit(f);
    const struct service_filter all = {.limit = 10, .kind = -1, .state = -1};
    assert_false(list(f, &all, "43210"));
    struct service_filter page = {.limit = 2, .kind = -1, .state = -1};
    assert_true(list(f, &page, "43"));
    page.after = id_of[3];
    assert_true(list(f, &page, "21"));
    page.after = id_of[1];
    assert_false(list(f, &page, "0"));
    const struct service_filter even = {.limit = 10, .kind = -1, .state = -1, .name = "even"};
    assert_false(list(f, &even, "420"));
    const struct service_filter queued = {
        .limit = 10, .kind = CASE_SIMULATION, .state = JOB_QUEUED, .name = "even"};
    assert_false(list(f, &queued, "40"));
    const struct service_filter modes = {.limit = 10, .kind = CASE_MODES, .state = -1};
    assert_false(list(f, &modes, "3"));
    const struct service_filter cancelled = {.limit = 10, .kind = -1, .state = JOB_CANCELLED};
    assert_false(list(f, &cancelled, "2"));
    struct job_record *rows;
    int n;
    bool more;
    page.after = "unknown";
    assert_int_equal(s->ops->list(s, &page, &rows, &n, &more), STORE_NONE);
}

/* -- the file
 * ---------------------------------------------------------------------------------------- */

static void test_second_opening_is_refused(void **state)
{
    const struct fixture *f = *state;
    struct store *other = NULL;
    char why[STORE_MESSAGE] = "";
    assert_int_equal(store_open(f->url, &other, why), STORE_LOCKED);
    assert_null(other);
    char pid[32];
    (void)snprintf(pid, sizeof pid, "process %ld", (long)getpid());
    assert_non_null(strstr(why, pid));
}

static void test_reopening_finds_everything(void **state)
{
    struct fixture *f = *state;
    (void)submit(f, 0, "h");
    store_close(f->store);
    fixture_open(f);
    assert_int_equal(get(f, id_of[0]).state, JOB_QUEUED);
    char id[JOB_ID_SIZE];
    assert_int_equal(writer(f)->ops->newest_id(writer(f), id), STORE_OK);
    assert_string_equal(id, id_of[0]);
}

static void test_readers_cannot_write(void **state)
{
    const struct fixture *f = *state;
    const struct service_submit item = sample("h");
    struct service_submitted out;
    struct store_session *r = f->store->ops->reader_take(f->store);
    assert_non_null(r);
    assert_int_not_equal(r->ops->submit(r, &item, id_of[0], 1, &out), STORE_OK);
    f->store->ops->reader_give(f->store, r);
    assert_int_equal(depth(f), 0);
}

static void test_bad_locations(void **state)
{
    (void)state;
    static const char *const bad[] = {"", "sqlite:", "postgres://x", "sqlite:/dev/null/a.db"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct store *st = NULL;
        char why[STORE_MESSAGE] = "";
        assert_int_equal(store_open(bad[i], &st, why), STORE_REFUSED);
        assert_true(strlen(why) > 0);
    }
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, fixture_setup, fixture_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_submit_claim_publish),
        TEST(test_oldest_first),
        TEST(test_reuse),
        TEST(test_failed_and_cancelled_are_not_reused),
        TEST(test_undo_leaves_nothing),
        TEST(test_cancel_running),
        TEST(test_fence_refuses_the_late_worker),
        TEST(test_lost_attempts_are_bounded),
        TEST(test_handing_back_costs_no_attempt),
        TEST(test_cancelling_job_of_a_dead_process),
        TEST(test_series_come_back_bit_for_bit),
        TEST(test_damaged_chunk_is_refused),
        TEST(test_documents),
        TEST(test_lists),
        TEST(test_second_opening_is_refused),
        TEST(test_reopening_finds_everything),
        TEST(test_readers_cannot_write),
        cmocka_unit_test(test_bad_locations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
