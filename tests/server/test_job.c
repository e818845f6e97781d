#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/job.h"

#include <string.h>

/* The whole table, written once more by hand. */
static void test_moves(void **state)
{
    (void)state;
    static const char *const allowed[JOB_STATE_COUNT] = {
        [JOB_QUEUED] = "-r--fx", [JOB_RUNNING] = "q-cdf-", [JOB_CANCELLING] = "-----x",
        [JOB_DONE] = "------",   [JOB_FAILED] = "------",  [JOB_CANCELLED] = "------"};
    for (int from = 0; from < JOB_STATE_COUNT; from++) {
        for (int to = 0; to < JOB_STATE_COUNT; to++) {
            assert_int_equal(job_move_allowed((enum job_state)from, (enum job_state)to),
                             allowed[from][to] != '-');
        }
    }
}

static void test_final_and_reusable(void **state)
{
    (void)state;
    for (int s = 0; s < JOB_STATE_COUNT; s++) {
        const enum job_state js = (enum job_state)s;
        assert_int_equal(job_is_final(js),
                         js == JOB_DONE || js == JOB_FAILED || js == JOB_CANCELLED);
        /* A job that can still be done, and is not being thrown away, answers an equal case. */
        assert_int_equal(job_is_reusable(js),
                         js == JOB_DONE || js == JOB_QUEUED || js == JOB_RUNNING);
    }
}

static void test_invariant(void **state)
{
    (void)state;
    struct job_record queued = {.state = JOB_QUEUED, .created_us = 1};
    assert_true(job_invariant(&queued, true));
    assert_false(job_invariant(&queued, false));

    struct job_record done = {
        .state = JOB_DONE, .attempt = 1, .created_us = 1, .started_us = 2, .finished_us = 3};
    assert_true(job_invariant(&done, false));
    assert_false(job_invariant(&done, true));
    done.finished_us = 0;
    assert_false(job_invariant(&done, false));
    done.finished_us = 3;
    done.attempt = 0;
    done.started_us = 0;
    assert_false(job_invariant(&done, false)); /* done without ever having run */

    struct job_record failed = done;
    failed.state = JOB_FAILED;
    failed.attempt = 1;
    failed.started_us = 2;
    assert_false(job_invariant(&failed, false)); /* no reason given */
    (void)strcpy(failed.error_code, "lost");
    assert_true(job_invariant(&failed, false));
}

static void test_kinds(void **state)
{
    (void)state;
    for (int k = 0; k < JOB_KIND_COUNT; k++) {
        int back = -1;
        assert_true(job_kind_parse(job_kind_name(k), &back));
        assert_int_equal(back, k);
    }
    assert_string_equal(job_kind_name(JOB_STUDY), "study");
    int unused;
    assert_false(job_kind_parse("Simulation", &unused));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_moves),
        cmocka_unit_test(test_final_and_reusable),
        cmocka_unit_test(test_invariant),
        cmocka_unit_test(test_kinds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
