/* The suites every storage back end must pass: jobs, leases, fences, recovery. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/server/store_support.h"

enum { ATTEMPTS = 3 };

/* -- life of a job ---------------------------------------------------------------------- */

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

/* -- cancel ----------------------------------------------------------------------------- */

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

/* -- leases, fences, recovery ----------------------------------------------------------- */

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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
