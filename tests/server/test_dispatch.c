#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/clock.h"
#include "server/dispatch.h"

#include <pthread.h>
#include <string.h>

static void test_slots(void **state)
{
    (void)state;
    struct dispatch *d = dispatch_create(2, 5);
    assert_non_null(d);
    const struct store_ticket a = {.id = "a", .fence = 1}, b = {.id = "b", .fence = 7};
    const struct sim_control control = dispatch_control(d, 1);
    double progress = -1.0;
    assert_false(dispatch_progress(d, "", &progress)); /* idle slots are nobody's */
    dispatch_enter(d, 0, &a);
    dispatch_enter(d, 1, &b);
    atomic_store(control.progress, 0.25);
    assert_true(dispatch_progress(d, "b", &progress));
    assert_true(progress == 0.25);
    assert_false(dispatch_cancel(d, "b", 6)); /* another claim of the job */
    assert_false(atomic_load(control.cancel));
    assert_true(dispatch_cancel(d, "b", 7));
    assert_true(atomic_load(control.cancel));
    struct store_ticket t[2];
    assert_int_equal(dispatch_tickets(d, t), 2);
    dispatch_leave(d, 0);
    assert_int_equal(dispatch_tickets(d, t), 1);
    assert_string_equal(t[0].id, "b");
    dispatch_enter(d, 1, &a); /* the flag does not stick to the next job */
    assert_false(atomic_load(control.cancel));
    dispatch_depth_add(d, -2);
    assert_int_equal(dispatch_depth(d), 3);
    dispatch_destroy(d);
}

/* Units of one study in several slots: a cancel reaches all, a lost lease only its own. */
static void test_units(void **state)
{
    (void)state;
    struct dispatch *d = dispatch_create(3, 1);
    assert_non_null(d);
    const struct store_ticket unit[] = {{.id = "s", .unit = 1, .fence = 4},
                                        {.id = "s", .unit = 2, .fence = 5},
                                        {.id = "other", .unit = 1, .fence = 4}};
    for (int i = 0; i < 3; i++) {
        dispatch_enter(d, i, &unit[i]);
    }
    double progress = -1.0;
    assert_false(dispatch_progress(d, "s", &progress)); /* that of a study is stored */
    assert_true(dispatch_cancel(d, "s", 5));
    assert_false(atomic_load(dispatch_control(d, 0).cancel));
    assert_true(atomic_load(dispatch_control(d, 1).cancel));
    assert_true(dispatch_cancel(d, "s", 0));
    assert_true(atomic_load(dispatch_control(d, 0).cancel));
    assert_false(atomic_load(dispatch_control(d, 2).cancel));
    dispatch_destroy(d);
}

static void test_stop_reaches_later_jobs(void **state)
{
    (void)state;
    struct dispatch *d = dispatch_create(1, 0);
    assert_non_null(d);
    const struct store_ticket a = {.id = "a", .fence = 1};
    dispatch_stop(d);
    dispatch_enter(d, 0, &a); /* its claim was already on the way */
    assert_true(atomic_load(dispatch_control(d, 0).cancel));
    assert_true(dispatch_stopping(d));
    dispatch_wait(d, dispatch_rings(d), 60); /* returns at once */
    dispatch_destroy(d);
}

static void *ring(void *arg)
{
    dispatch_ring(arg);
    return NULL;
}

static void test_bell_is_not_missed(void **state)
{
    (void)state;
    struct dispatch *d = dispatch_create(0, 0);
    assert_non_null(d);
    const int64_t start = clock_mono_us();
    for (int i = 0; i < 200; i++) {
        const uint64_t seen = dispatch_rings(d);
        pthread_t thread; /* may ring before or while we wait */
        assert_int_equal(pthread_create(&thread, NULL, ring, d), 0);
        dispatch_wait(d, seen, 60);
        (void)pthread_join(thread, NULL);
    }
    assert_true(clock_mono_us() - start < 30000000);
    dispatch_wait(d, dispatch_rings(d), 0); /* nobody rings: the time limit ends it */
    dispatch_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slots),
        cmocka_unit_test(test_units),
        cmocka_unit_test(test_stop_reaches_later_jobs),
        cmocka_unit_test(test_bell_is_not_missed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
