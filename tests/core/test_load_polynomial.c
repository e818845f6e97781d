#include "core/coupling/load_polynomial.h"
#include "core/num.h"
#include "tests/support/unit.h"

enum { MODES = 3 };

/* Histories of other lengths: the degree grows with what is known and stays at the order. */
static void the_order_is_lower_at_the_start(void **state)
{
    (void)state;
    for (int order = 0; order <= LIMIT_LOAD_ORDER; order++) {
        struct load_polynomial p;
        load_polynomial_init(MODES, order, &p);
        for (int k = 0; k < 8; k++) {
            const double load[MODES] = {1.0 * k, 2.0, -3.0 * k * k};
            load_polynomial_push(&p, load);
            assert_int_equal(p.degree, k < order ? k : order);
            for (int j = 0; j < MODES; j++) {
                assert_near_abs(load_polynomial_at(&p, j, 0.0), load[j], 1e-13);
            }
        }
    }
}

/* Sampled at k, a polynomial of the order comes back at any tau, each mode with its own. */
static void polynomials_come_back(void **state)
{
    (void)state;
    static const double c[MODES][LOAD_COEFFICIENTS] = {
        {1.0, -0.5, 0.25, 0.125, -0.0625}, {0.0, 1.0, 0.0, 0.0, 0.0}, {3.0, 0.0, 0.0, 0.1, 0.2}};
    for (int order = 0; order <= LIMIT_LOAD_ORDER; order++) {
        struct load_polynomial p;
        load_polynomial_init(MODES, order, &p);
        for (int step = 0; step <= 6; step++) {
            double load[MODES];
            for (int j = 0; j < MODES; j++) {
                load[j] = 0.0;
                for (int k = order; k >= 0; k--) {
                    load[j] = load[j] * step + c[j][k];
                }
            }
            load_polynomial_push(&p, load);
        }
        for (double tau = 0.0; tau <= 1.0; tau += 0.125) {
            for (int j = 0; j < MODES; j++) {
                double exact = 0.0;
                for (int k = order; k >= 0; k--) {
                    exact = exact * (6.0 + tau) + c[j][k];
                }
                assert_near_abs(load_polynomial_at(&p, j, tau), exact, 1e-11);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_is_lower_at_the_start),
        cmocka_unit_test(polynomials_come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
