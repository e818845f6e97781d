#include "core/coupling/model.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>

static void build(int n_mode, struct model *m)
{
    struct case_def def;
    struct failure fail;
    fixture_paper_beam(-45.0, NULL, &def);
    def.kind = CASE_MODES;
    def.solver.modes = n_mode;
    assert_ok(model_build(&def, m, &fail));
}

static double product(int n, const double *a, const double *x, const double *y, double *scratch)
{
    double sum = 0.0;
    fixture_multiply(n, a, y, scratch);
    for (int i = 0; i < n; i++) {
        sum += x[i] * scratch[i];
    }
    return sum;
}

static void modes_are_orthonormal_and_ascend(void **state)
{
    (void)state;
    struct model m;
    build(12, &m);
    const int n = m.beam.n_dof;
    double *scratch = malloc((size_t)n * sizeof *scratch);
    for (int i = 0; i < 12; i++) {
        const double *x = m.modes.shape + num_at(0, i, n);
        assert_true(i == 0 || m.modes.omega[i] >= m.modes.omega[i - 1]);
        for (int j = 0; j <= i; j++) {
            const double *y = m.modes.shape + num_at(0, j, n);
            const double scale = m.modes.omega[i] * m.modes.omega[j];
            assert_near_abs(product(n, m.beam.m, x, y, scratch), i == j ? 1.0 : 0.0, 1e-9);
            assert_near_abs(product(n, m.beam.k, x, y, scratch) / scale, i == j ? 1.0 : 0.0, 1e-7);
        }
    }
    free(scratch);
    model_done(&m);
}

static void signs_and_shares(void **state)
{
    (void)state;
    struct model m;
    build(8, &m);
    for (int j = 0; j < 8; j++) {
        const struct beam_motion tip = modes_tip(&m.beam, &m.modes, j);
        const double part[3] = {tip.v, tip.u, tip.theta * 0.1};
        double largest = 0.0, sum = 0.0;
        for (int i = 0; i < 3; i++) {
            largest = fabs(part[i]) > fabs(largest) ? part[i] : largest;
        }
        assert_true(largest > 0.0);
        for (int f = 0; f < MODE_SHARES; f++) {
            assert_true(m.modes.share[num_at(f, j, MODE_SHARES)] >= 0.0);
            sum += m.modes.share[num_at(f, j, MODE_SHARES)];
        }
        assert_near_rel(sum, 1.0, 1e-12);
    }
    model_done(&m);
}

/* More modes do not change the first ones. */
static void a_subset_is_a_subset(void **state)
{
    (void)state;
    struct model few, many;
    build(3, &few);
    build(40, &many);
    for (int j = 0; j < 3; j++) {
        assert_near_rel(few.modes.omega[j], many.modes.omega[j], 1e-9);
    }
    model_done(&few);
    model_done(&many);
}

static void all_freedoms_have_a_mode(void **state)
{
    (void)state;
    struct case_def def;
    struct failure fail;
    struct model m;
    fixture_paper_beam(0.0, NULL, &def);
    def.kind = CASE_MODES;
    def.beam.elements = 2;
    def.solver.modes = 2 * BEAM_NODE_FREEDOMS;
    assert_ok(model_build(&def, &m, &fail));
    assert_true(num_all_finite(m.modes.n_mode, m.modes.omega));
    assert_true(m.modes.omega[0] > 0.0);
    model_done(&m);
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
        cmocka_unit_test(modes_are_orthonormal_and_ascend),
        cmocka_unit_test(signs_and_shares),
        cmocka_unit_test(a_subset_is_a_subset),
        cmocka_unit_test(all_freedoms_have_a_mode),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
