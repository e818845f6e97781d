/* Windows, reports and corner cases of the identification; accuracy: tests/verify/damping.c. */
#include "core/analysis/damping.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/unit.h"

#include <stdlib.h>

static const struct damping_system beam = {
    .n_mode = 4, .frequency_low = 4.0, .frequency_high = 72.0, .frequency_torsion = 34.0};
static const double dt = 2e-4;

static struct damping_result identify(int n, const double *y)
{
    struct damping_result r = {.n_root = -1};
    assert_ok(damping_identify(n, y, dt, &beam, &r));
    return r;
}

static double *signal(int n, double amplitude, double sigma, double hz, double offset)
{
    double *y = malloc((size_t)n * sizeof *y);
    for (int i = 0; i < n; i++) {
        y[i] = offset + amplitude * exp(sigma * dt * i) * cos(2.0 * NUM_PI * hz * dt * i);
    }
    return y;
}

static void a_decaying_signal_is_read_at_its_start(void **state)
{
    (void)state;
    double *y = signal(20000, 1.0, -1.5, 4.0, 0.3);
    const struct damping_result r = identify(20000, y);
    assert_near_rel(r.window_from, 0.25, 0.01);
    assert_near_rel(r.window_to, 0.25 + DAMPING_PERIODS / 4.0, 0.01);
    assert_int_equal(r.n_root, 1); /* the offset is not reported */
    assert_near_rel(r.root[0].ratio, 1.5 / hypot(1.5, 2.0 * NUM_PI * 4.0), 1e-4);
    assert_near_rel(r.root[0].amplitude, exp(-1.5 * r.window_from), 1e-3);
    assert_int_equal(r.torsion, -1); /* nothing near 34 Hz */
    free(y);
}

static void a_growing_signal_is_read_at_its_end(void **state)
{
    (void)state;
    double *y = signal(20000, 1e-3, 1.0, 33.0, 0.0);
    const struct damping_result r = identify(20000, y);
    assert_near_rel(r.window_to, 4.0, 0.01);
    assert_true(r.n_root >= 1);
    assert_near_abs(r.root[0].ratio, -1.0 / (2.0 * NUM_PI * 33.0), 1e-4);
    assert_int_equal(r.torsion, 0);
    free(y);
}

/* Two close components make one envelope; bending swings more, but farther from torsion. */
static void torsion_is_the_larger_of_close_roots_and_never_bending(void **state)
{
    (void)state;
    enum { N = 20000 };
    double *large = signal(N, 1.0, -0.4, 35.6, 0.0), *small = signal(N, 0.2, -3.0, 35.3, 0.0);
    double *bending = signal(N, 3.0, -0.5, 24.0, 0.1);
    for (int i = 0; i < N; i++) {
        bending[i] += large[i] + small[i];
    }
    const struct damping_result r = identify(N, bending);
    assert_near_rel(r.root[0].frequency_hz, 24.0, 1e-3);
    assert_true(r.torsion > 0);
    assert_near_rel(r.root[r.torsion].frequency_hz, 35.6, 1e-4);
    assert_near_rel(r.root[r.torsion].ratio, 0.4 / (2.0 * NUM_PI * 35.6), 0.02);
    free(large);
    free(small);
    free(bending);
}

/* A small motion that grows beside a large one that decays; a trace of another one does not count.
 */
static void the_least_stable_root_is_what_the_motion_turns_into(void **state)
{
    (void)state;
    enum { N = 20000 };
    double *large = signal(N, 1.0, -1.0, 4.0, 0.2), *growing = signal(N, 0.02, 0.8, 26.0, 0.0);
    double *trace = signal(N, 1e-4, 1.0, 60.0, 0.0);
    for (int i = 0; i < N; i++) {
        large[i] += growing[i] + trace[i];
    }
    const struct damping_result r = identify(N, large);
    assert_true(r.least_stable > 0);
    assert_near_rel(r.root[r.least_stable].frequency_hz, 26.0, 1e-3);
    assert_near_rel(r.root[r.least_stable].ratio, -0.8 / (2.0 * NUM_PI * 26.0), 0.02);
    free(large);
    free(growing);
    free(trace);
}

static void a_runaway_has_a_real_root(void **state)
{
    (void)state;
    double *y = signal(20000, 1e-3, 4.0, 0.0, 0.0);
    const struct damping_result r = identify(20000, y);
    assert_true(r.n_root >= 1);
    assert_true(r.root[0].frequency_hz == 0.0);
    assert_near_rel(r.root[0].ratio, -1.0, 1e-6);
    assert_true(isnan(r.hilbert_ratio));
    free(y);
}

static void too_little_gives_no_roots(void **state)
{
    (void)state;
    double *y = signal(20000, 0.0, 0.0, 4.0, 0.7); /* at rest */
    for (int n = 1; n < 60; n++) {
        assert_int_equal(identify(n, y).n_root, 0);
    }
    const struct damping_result r = identify(20000, y);
    assert_int_equal(r.n_root, 0);
    assert_int_equal(r.torsion, -1);
    assert_true(isnan(r.log_decrement));
    free(y);
}

/* Histories as a blow-up leaves them: quiet, then one or a few samples out of all proportion. */
static void a_blow_up_does_not_fail(void **state)
{
    (void)state;
    static const double last[] = {1e3, 1e30, 1e150, 1e300, HUGE_VAL};
    for (size_t k = 0; k < sizeof last / sizeof last[0]; k++) {
        for (int count = 1; count <= 3; count++) {
            double *y = signal(5000, 1e-3, -0.5, 4.0, 0.0);
            for (int i = 0; i < count; i++) {
                y[4999 - i] = (i % 2 == 0 ? 1.0 : -1.0) * last[k];
            }
            const struct damping_result r = identify(5000, y);
            for (int i = 0; i < r.n_root; i++) {
                assert_true(isfinite(r.root[i].frequency_hz));
                assert_true(isfinite(r.root[i].ratio));
                assert_true(isfinite(r.root[i].amplitude));
                assert_true(isfinite(r.root[i].residual));
            }
            free(y);
        }
    }
}

/* A time step longer than the periods of the system: nothing can be said, nothing breaks. */
static void steps_longer_than_a_period(void **state)
{
    (void)state;
    double y[500];
    struct damping_result r;
    for (int i = 0; i < 500; i++) {
        y[i] = cos(0.3 * i);
    }
    for (double step = 1e-3; step < 100.0; step *= 3.0) {
        assert_ok(damping_identify(500, y, step, &beam, &r));
        assert_true(r.n_root <= LIMIT_ROOTS);
    }
}

static void fluctuation(void **state)
{
    (void)state;
    const double y[] = {7.0, 1.0, 3.0, 1.0, 3.0, 9.0};
    assert_near_rel(damping_fluctuation(y, 1, 5), 1.0, 1e-15);
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_decaying_signal_is_read_at_its_start),
        cmocka_unit_test(a_growing_signal_is_read_at_its_end),
        cmocka_unit_test(torsion_is_the_larger_of_close_roots_and_never_bending),
        cmocka_unit_test(the_least_stable_root_is_what_the_motion_turns_into),
        cmocka_unit_test(a_runaway_has_a_real_root),
        cmocka_unit_test(too_little_gives_no_roots),
        cmocka_unit_test(a_blow_up_does_not_fail),
        cmocka_unit_test(steps_longer_than_a_period),
        cmocka_unit_test(fluctuation),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
