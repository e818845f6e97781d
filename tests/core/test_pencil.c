/* The matrix pencil on signals made of its own exponentials; accuracy on the validation signals is
 * verified in tests/verify/damping.c. */
#include "core/analysis/pencil.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

enum { N = 200 };
static const double dt = 0.01;

static void sum_of(int n_root, const struct pencil_root *root, double *y)
{
    for (int i = 0; i < N; i++) {
        y[i] = 0.0;
        for (int k = 0; k < n_root; k++) {
            const struct pencil_root *r = &root[k];
            y[i] += r->amplitude * exp(r->sigma * dt * i) * cos(r->omega * dt * i + r->phase);
        }
    }
}

static void exact_sums_come_back(void **state)
{
    (void)state;
    /* By falling amplitude: offset, decaying pair, growing pair, pair near the Nyquist frequency.
     */
    static const struct pencil_root root[] = {{0.0, 0.0, 3.0, 0.0},
                                              {-0.8, 26.0, 1.0, 0.4},
                                              {0.5, 90.0, 0.3, -2.0},
                                              {-2.0, 300.0, 0.1, 1.0}};
    double y[N];
    struct pencil_fit fit;
    sum_of(4, root, y);
    assert_ok(pencil_identify(N, y, dt, 1e-8, 20, &fit));
    assert_int_equal(fit.order, 7);
    assert_int_equal(fit.n, 4);
    for (int k = 0; k < 4; k++) {
        assert_near_abs(fit.root[k].sigma, root[k].sigma, 1e-7);
        assert_near_abs(fit.root[k].omega, root[k].omega, 1e-7);
        assert_near_rel(fit.root[k].amplitude, root[k].amplitude, 1e-7);
        assert_near_abs(cos(fit.root[k].phase), cos(root[k].phase), 1e-6);
        assert_near_abs(sin(fit.root[k].phase), sin(root[k].phase), 1e-6);
    }
    assert_true(fit.residual < 1e-9);
}

static void a_real_root_of_negative_amplitude(void **state)
{
    (void)state;
    static const struct pencil_root root = {-3.0, 0.0, 2.0, NUM_PI};
    double y[N];
    struct pencil_fit fit;
    sum_of(1, &root, y);
    assert_ok(pencil_identify(N, y, dt, 1e-6, 10, &fit));
    assert_int_equal(fit.n, 1);
    assert_near_rel(fit.root[0].sigma, -3.0, 1e-9);
    assert_true(fit.root[0].omega == 0.0);
    assert_near_rel(fit.root[0].amplitude, 2.0, 1e-9);
    assert_near_abs(cos(fit.root[0].phase), -1.0, 1e-9);
}

static void the_order_is_bounded(void **state)
{
    (void)state;
    double y[N];
    uint64_t seed = 5;
    for (int i = 0; i < N; i++) {
        y[i] = fixture_normal(&seed);
    }
    for (int order = 1; order <= PENCIL_ORDER_MAX; order += 13) {
        struct pencil_fit fit;
        assert_ok(pencil_identify(N, y, dt, 0.0, order, &fit));
        assert_true(fit.order <= order);
        int exponentials = 0;
        for (int k = 0; k < fit.n; k++) {
            const double turn = fit.root[k].omega * dt; /* real roots stand at 0 and pi */
            exponentials += turn > 0.0 && turn < NUM_PI - 1e-9 ? 2 : 1;
            assert_true(k == 0 || fit.root[k].amplitude <= fit.root[k - 1].amplitude);
        }
        assert_true(exponentials <= fit.order);
        assert_true(fit.residual > 0.0 && fit.residual < 1.0 + 1e-12);
    }
}

static void nothing_gives_nothing(void **state)
{
    (void)state;
    double y[N] = {0};
    struct pencil_fit fit = {.n = 9};
    assert_ok(pencil_identify(N, y, dt, 1e-3, 10, &fit));
    assert_int_equal(fit.n, 0);
    assert_ok(pencil_identify(8, y, dt, 1e-3, 10, &fit));
    assert_int_equal(fit.n, 0);
}

static void alternating_samples(void **state)
{
    (void)state;
    double y[N];
    struct pencil_fit fit;
    for (int i = 0; i < N; i++) {
        y[i] = i % 2 == 0 ? 2.0 : -2.0;
    }
    assert_ok(pencil_identify(N, y, dt, 1e-6, 6, &fit));
    assert_int_equal(fit.n, 1);
    assert_near_rel(fit.root[0].omega, NUM_PI / dt, 1e-9);
    assert_near_rel(fit.root[0].amplitude, 2.0, 1e-9);
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
        cmocka_unit_test(exact_sums_come_back), cmocka_unit_test(a_real_root_of_negative_amplitude),
        cmocka_unit_test(the_order_is_bounded), cmocka_unit_test(nothing_gives_nothing),
        cmocka_unit_test(alternating_samples),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
