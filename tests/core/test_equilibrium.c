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

/* Energy about the equilibrium: one for the state it began from, none at the equilibrium, four for
 * twice the distance; found from each of them, and the counters stay. */
static void energy_about_the_equilibrium(void **state)
{
    (void)state;
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    struct case_def def;
    struct model m;
    struct workspace w;
    struct failure fail;
    double residual = -1.0;
    const double nothing[LIMIT_MODES] = {0.0};
    double rest[LIMIT_MODES], plunge = 0.0;
    fixture_paper_beam(-45.0, &polar, &def);
    def.flow.speed = 5.0;
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(workspace_init(&m, &w));
    assert_ok(equilibrium_solve(&m, &w, &residual));
    memcpy(rest, w.q, sizeof(double) * (size_t)m.n_mode);
    w.counters.outside_polar = 7;
    for (double place = -1.0; place < 2.5; place += 1.0) {
        for (int j = 0; j < m.n_mode; j++) {
            w.q[j] = place * rest[j];
            plunge += place == 0.0 ? m.tip[j].v * rest[j] : 0.0;
        }
        const struct march_rest r = equilibrium_near(&m, &w, nothing, nothing);
        assert_true(r.found);
        assert_near_abs(r.energy_ratio, num_sq(place - 1.0), 1e-5);
        if (place >= 0.0) {
            assert_near_rel(r.tip_plunge, plunge, 1e-6);
        }
    }
    assert_int_equal(w.counters.outside_polar, 7);
    workspace_done(&w);
    model_done(&m);
    polar_def_done(&polar);
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forces_balance),
                                       cmocka_unit_test(energy_about_the_equilibrium)};
    return cmocka_run_group_tests(tests, setup, NULL);
}
