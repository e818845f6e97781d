/* The adaptive integrator; the order of its step is verified in tests/verify/integrators.c. */
#include "core/coupling/exponential.h"
#include "core/coupling/rk4.h"
#include "core/num.h"
#include "tests/support/unit.h"

enum { MODES = 3 };
static const double omega2[MODES] = {650.0, 26000.0, 44000.0}, damping[MODES] = {0.0, 1.0, 10.0};

static void run(double tolerance, double dt, int steps, double *error, long *inner)
{
    struct rk4 rk = {
        .n_mode = MODES, .omega2 = omega2, .damping = damping, .dt = dt, .tolerance = tolerance};
    struct exponential e;
    struct load_polynomial load;
    double q[MODES] = {1e-3, -2e-4, 1e-4}, v[MODES] = {0.1, 0.0, -0.1};
    double p[MODES] = {1e-3, -2e-4, 1e-4}, w[MODES] = {0.1, 0.0, -0.1};
    load_polynomial_init(MODES, 1, &load);
    exponential_init(MODES, omega2, damping, dt, &e);
    for (int i = 0; i < steps; i++) {
        load_polynomial_push(&load, (double[MODES]){sin(3.0 * dt * i), 1.0, cos(40.0 * dt * i)});
        assert_ok(rk4_advance(&rk, &load, q, v));
        exponential_step(&e, &load, p, w);
    }
    double sum = 0.0, size = 0.0;
    for (int j = 0; j < MODES; j++) {
        sum += omega2[j] * num_sq(q[j] - p[j]) + num_sq(v[j] - w[j]);
        size += omega2[j] * num_sq(p[j]) + num_sq(w[j]);
    }
    *error = sqrt(sum / size);
    *inner = rk.inner_steps;
}

/* The tolerance is an error per outer step: over n steps it adds up to at most n times it. */
static void the_tolerance_is_kept(void **state)
{
    (void)state;
    const int steps = 400;
    long before = 0;
    for (double tolerance = 1e-4; tolerance > 1e-12; tolerance *= 0.01) {
        double error;
        long inner;
        run(tolerance, 2e-3, steps, &error, &inner);
        assert_true(error <= tolerance * steps);
        assert_true(inner > before); /* more is paid for more */
        before = inner;
    }
}

static void the_inner_step_is_found_again(void **state)
{
    (void)state;
    double error;
    long inner;
    run(1e-9, 2e-4, 1000, &error, &inner);
    assert_true(inner < 1300); /* one inner step each suffices at the default time step */
}

static void at_rest_nothing_happens(void **state)
{
    (void)state;
    struct rk4 rk = {
        .n_mode = MODES, .omega2 = omega2, .damping = damping, .dt = 1e-3, .tolerance = 1e-9};
    struct load_polynomial none;
    double q[MODES] = {0}, v[MODES] = {0};
    load_polynomial_init(MODES, 0, &none);
    load_polynomial_push(&none, q);
    assert_ok(rk4_advance(&rk, &none, q, v));
    for (int j = 0; j < MODES; j++) {
        assert_true(q[j] == 0.0 && v[j] == 0.0);
    }
}

/* A load that is not finite, and a time step no patience suffices for. */
static void hopeless_steps_are_said(void **state)
{
    (void)state;
    struct rk4 rk = {
        .n_mode = MODES, .omega2 = omega2, .damping = damping, .dt = 1e-3, .tolerance = 1e-9};
    struct load_polynomial load;
    double q[MODES] = {1.0, 2.0, 3.0}, v[MODES] = {0};
    load_polynomial_init(MODES, 0, &load);
    load_polynomial_push(&load, (double[MODES]){0.0, HUGE_VAL, 0.0});
    assert_int_equal(rk4_advance(&rk, &load, q, v), ST_NOT_FINITE);
    assert_true(q[0] == 1.0 && q[1] == 2.0 && q[2] == 3.0);
    load_polynomial_init(MODES, 0, &load);
    load_polynomial_push(&load, (double[MODES]){0.0, 0.0, 0.0});
    rk.dt = 1e5;
    const enum status st = rk4_advance(&rk, &load, q, v);
    assert_true(st == ST_NOT_CONVERGED || st == ST_NOT_FINITE);
    assert_true(q[0] == 1.0 && q[1] == 2.0 && q[2] == 3.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tolerance_is_kept),
        cmocka_unit_test(the_inner_step_is_found_again),
        cmocka_unit_test(at_rest_nothing_happens),
        cmocka_unit_test(hopeless_steps_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
