/* Worker threads over a real store, writer and core. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/clock.h"
#include "server/job.h"
#include "server/worker.h"
#include "tests/server/cases.h"
#include "tests/server/support.h"

#include <time.h>

static const struct log quiet = {.fd = -1, .level = LOG_LEVEL_ERROR};

struct rig {
    struct fixture *fixture;
    struct library *library;
    struct dispatch *dispatch;
    struct writer *writer;
    struct worker_env env;
    struct workers *workers;
};

static struct rig start(struct fixture *f, int n)
{
    struct rig r = {.fixture = f};
    struct failure fail;
    assert_int_equal(library_create_builtin(&r.library, &fail), ST_OK);
    r.dispatch = dispatch_create(n, 0);
    assert_non_null(r.dispatch);
    assert_int_equal(writer_create(f->store, &quiet, &r.writer), STORE_OK);
    r.env = (struct worker_env){.store = f->store,
                                .writer = r.writer,
                                .dispatch = r.dispatch,
                                .library = r.library,
                                .log = &quiet,
                                .owner = "me",
                                .attempts_max = 3};
    assert_int_equal(workers_start(&r.env, &r.workers), STORE_OK);
    return r;
}

static void stop(struct rig *r)
{
    workers_stop(r->workers);
    writer_destroy(r->writer);
    dispatch_destroy(r->dispatch);
    library_destroy(r->library);
}

/* Any operation of the store, run by the writer. */
struct call {
    struct write_request base;
    const struct service_submit *submit;
    const char *id;
    struct job_record job;
    const char *recover_as;
    int64_t recover_now;
    struct store_recovered recovered;
};

static enum store_status call_apply(struct write_request *r, struct store_session *s)
{
    struct call *c = (struct call *)r;
    if (c->submit != NULL) {
        struct service_submitted out;
        return s->ops->submit(s, c->submit, c->id, 1, &out);
    }
    if (c->recover_as != NULL) {
        return s->ops->recover(s, c->recover_as, c->recover_now, 3, &c->recovered);
    }
    return s->ops->cancel(s, c->id, clock_wall_us(), &c->job);
}

static void submit(const struct rig *r, const char *id, const char *hash, const char *text)
{
    struct service_submit item = sample(hash);
    item.case_json = text;
    struct call c = {.base = {.apply = call_apply}, .submit = &item, .id = id};
    assert_int_equal(writer_call(r->writer, &c.base), STORE_OK);
    dispatch_depth_add(r->dispatch, 1);
    dispatch_ring(r->dispatch);
}

static struct job_record get(const struct rig *r, const char *id)
{
    struct job_record job = {.attempt = -1};
    struct store *st = r->fixture->store;
    struct store_session *s = st->ops->reader_take(st);
    assert_non_null(s);
    assert_int_equal(s->ops->get(s, id, &job), STORE_OK);
    st->ops->reader_give(st, s);
    assert_true(job_invariant(&job, !job_is_final(job.state)));
    return job;
}

static struct job_record await(const struct rig *r, const char *id, enum job_state state,
                               int attempt)
{
    const int64_t until = clock_mono_us() + 60 * INT64_C(1000000);
    struct job_record job = get(r, id);
    while ((job.state != state || job.attempt < attempt) && clock_mono_us() < until) {
        const struct timespec t = {.tv_nsec = 1000000};
        (void)nanosleep(&t, NULL);
        job = get(r, id);
    }
    assert_int_equal(job.state, state);
    assert_int_equal(job.attempt, attempt);
    return job;
}

/* The depth counts a job off shortly after its end is visible. */
static void await_depth(const struct rig *r, int64_t depth)
{
    const int64_t until = clock_mono_us() + 10 * INT64_C(1000000);
    while (dispatch_depth(r->dispatch) != depth && clock_mono_us() < until) {
        const struct timespec t = {.tv_nsec = 1000000};
        (void)nanosleep(&t, NULL);
    }
    assert_int_equal(dispatch_depth(r->dispatch), depth);
}

static const char a[] = "00000000-0000-7000-8000-00000000000a";
static const char b[] = "00000000-0000-7000-8000-00000000000b";

static void test_runs_and_fails(void **state)
{
    struct rig r = start(*state, 2);
    char good[CASE_TEXT], bad[CASE_TEXT];
    case_text(good, 3.0, 0.1);
    case_text(bad, 0.0, 0.1);
    submit(&r, a, "a", good);
    submit(&r, b, "b", bad);
    assert_true(strlen(await(&r, a, JOB_DONE, 1).verdict) > 0);
    assert_non_null(strstr(await(&r, b, JOB_FAILED, 1).error_detail, "/flow/speed_m_s"));
    await_depth(&r, 0);
    stop(&r);
}

static void test_cancel_stops_the_run(void **state)
{
    struct rig r = start(*state, 1);
    char text[CASE_TEXT];
    case_text(text, 3.0, 250.0);
    submit(&r, a, "a", text);
    (void)await(&r, a, JOB_RUNNING, 1);
    struct call c = {.base = {.apply = call_apply}, .id = a};
    assert_int_equal(writer_call(r.writer, &c.base), STORE_OK);
    assert_int_equal(c.job.state, JOB_CANCELLING);
    assert_true(dispatch_cancel(r.dispatch, a, 0));
    (void)await(&r, a, JOB_CANCELLED, 1);
    await_depth(&r, 0);
    stop(&r);
}

static void test_stop_hands_back(void **state)
{
    struct rig r = start(*state, 1);
    char text[CASE_TEXT];
    case_text(text, 3.0, 250.0);
    submit(&r, a, "a", text);
    (void)await(&r, a, JOB_RUNNING, 1);
    workers_stop(r.workers);
    r.workers = NULL;
    (void)await(&r, a, JOB_QUEUED, 1);
    assert_int_equal(dispatch_depth(r.dispatch), 1);
    stop(&r);
}

/* Another process takes the lease away while we run: our end changes nothing, and the heartbeat
 * stops our run. */
static void test_lost_lease(void **state)
{
    struct rig r = start(*state, 1);
    char text[CASE_TEXT];
    case_text(text, 3.0, 250.0);
    submit(&r, a, "a", text);
    (void)await(&r, a, JOB_RUNNING, 1);
    struct call c = {.base = {.apply = call_apply}, .recover_as = "another"};
    assert_int_equal(writer_call(r.writer, &c.base), STORE_OK);
    assert_int_equal(c.recovered.queued, 1);
    assert_int_equal(get(&r, a).state, JOB_QUEUED);
    workers_keep(r.workers);
    /* The run is cut off and its end refused; the job is claimed anew as attempt 2. */
    (void)await(&r, a, JOB_RUNNING, 2);
    stop(&r);
}

static void test_heartbeat_keeps_the_lease(void **state)
{
    struct rig r = start(*state, 1);
    char text[CASE_TEXT];
    case_text(text, 3.0, 250.0);
    submit(&r, a, "a", text);
    const struct job_record job = await(&r, a, JOB_RUNNING, 1);
    const struct timespec t = {.tv_nsec = 50000000};
    (void)nanosleep(&t, NULL);
    workers_keep(r.workers);
    /* A moment after the first lease ends, the job is still ours. */
    struct call c = {.base = {.apply = call_apply},
                     .recover_as = "me",
                     .recover_now = job.started_us + LEASE_S * INT64_C(1000000) + 1000};
    assert_int_equal(writer_call(r.writer, &c.base), STORE_OK);
    assert_int_equal(c.recovered.queued, 0);
    assert_int_equal(get(&r, a).attempt, 1);
    stop(&r);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, fixture_setup, fixture_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_runs_and_fails), TEST(test_cancel_stops_the_run),      TEST(test_stop_hands_back),
        TEST(test_lost_lease),     TEST(test_heartbeat_keeps_the_lease),
    };
    sim_process_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
