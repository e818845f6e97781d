/* Static equilibrium; its numbers are verified in tests/verify/static_aero.c. */
#include "core/analysis/equilibrium.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

static void solve(double speed, bool lifting_line, enum status expected)
{
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    struct case_def def;
    struct model m;
    struct workspace w;
    struct failure fail;
    double residual = -1.0;
    fixture_paper_beam(-45.0, &polar, &def);
    def.flow.speed = speed;
    def.aero.lifting_line = lifting_line;
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(workspace_init(&m, &w));
    assert_int_equal(equilibrium_solve(&m, &w, &residual), expected);
    if (expected == ST_OK) {
        double left = 0.0, size = 0.0;
        loads_evaluate(&m, &w, true);
        for (int j = 0; j < m.n_mode; j++) {
            left += num_sq(m.omega2[j] * w.q[j] - w.load[j]) / m.omega2[j];
            size += num_sq(w.load[j]) / m.omega2[j];
            assert_true(w.qd[j] == 0.0);
        }
        assert_true(size > 0.0);
        assert_true(sqrt(left / size) <= 1e-7);
        assert_true(residual <= 1e-7);
    }
    workspace_done(&w);
    model_done(&m);
    polar_def_done(&polar);
}

static void forces_balance(void **state)
{
    (void)state;
    for (double speed = 0.5; speed < 8.0; speed += 1.5) {
        solve(speed, false, ST_OK);
        solve(speed, true, ST_OK);
    }
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forces_balance)};
    return cmocka_run_group_tests(tests, setup, NULL);
}
