/* The exact step; its accuracy under loads is verified in tests/verify/integrators.c. */
#include "core/coupling/exponential.h"
#include "core/num.h"
#include "tests/support/unit.h"

/* Two steps of h are one step of 2 h when nothing pushes. */
static void steps_compose(void **state)
{
    (void)state;
    enum { MODES = 4 };
    const double omega2[MODES] = {1.0, 700.0, 5e4, 4e10}, damping[MODES] = {0.0, 0.5, 300.0, 10.0};
    struct exponential one, two;
    struct load_polynomial none;
    load_polynomial_init(MODES, 0, &none);
    load_polynomial_push(&none, (double[MODES]){0.0, 0.0, 0.0, 0.0});
    exponential_init(MODES, omega2, damping, 2e-3, &one);
    exponential_init(MODES, omega2, damping, 4e-3, &two);
    double q[MODES] = {1.0, -1.0, 0.5, 1e-3}, v[MODES] = {0.3, 0.0, -9.0, 50.0};
    double p[MODES] = {1.0, -1.0, 0.5, 1e-3}, w[MODES] = {0.3, 0.0, -9.0, 50.0};
    exponential_step(&one, &none, q, v);
    exponential_step(&one, &none, q, v);
    exponential_step(&two, &none, p, w);
    for (int j = 0; j < MODES; j++) {
        const double size = hypot(sqrt(omega2[j]) * p[j], w[j]);
        assert_near_abs(sqrt(omega2[j]) * (q[j] - p[j]), 0.0, 1e-11 * size);
        assert_near_abs(v[j] - w[j], 0.0, 1e-11 * size);
    }
}

/* A constant load at its static deflection keeps the state. */
static void equilibrium_stays(void **state)
{
    (void)state;
    const double omega2 = 650.0, damping = 0.02, load = 3.0;
    for (double dt = 1e-5; dt < 10.0; dt *= 10.0) {
        struct exponential e;
        struct load_polynomial p;
        load_polynomial_init(1, 0, &p);
        load_polynomial_push(&p, &load);
        exponential_init(1, &omega2, &damping, dt, &e);
        double q = load / omega2, v = 0.0;
        for (int i = 0; i < 100; i++) {
            exponential_step(&e, &p, &q, &v);
        }
        assert_near_rel(q, load / omega2, 1e-12);
        assert_near_abs(v, 0.0, 1e-12 * load / sqrt(omega2));
    }
}

/* The ratio is refused from 1 on; the last number below 1 must not end the program. */
static void almost_critical_damping(void **state)
{
    (void)state;
    static const double omega[] = {0.1, 25.9, 163.3, 217.0, 455.5, 1e5};
    for (size_t i = 0; i < sizeof omega / sizeof omega[0]; i++) {
        const double omega2 = omega[i] * omega[i];
        const double damping = 2.0 * nextafter(1.0, 0.0) * omega[i], h = 0.5 / omega[i];
        struct exponential e;
        struct load_polynomial none;
        load_polynomial_init(1, 0, &none);
        load_polynomial_push(&none, &(double){0.0});
        exponential_init(1, &omega2, &damping, h, &e);
        double q = 1.0, v = 0.0;
        exponential_step(&e, &none, &q, &v);
        /* Critical: q = (1 + omega t) e^{-omega t}. */
        assert_near_rel(q, 1.5 * exp(-0.5), 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_compose),
        cmocka_unit_test(equilibrium_stays),
        cmocka_unit_test(almost_critical_damping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
