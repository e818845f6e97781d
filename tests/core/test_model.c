/* From the case to the model: where mid-chord is, and what that does to loads and plunge. */
#include "core/analysis/equilibrium.h"
#include "core/analysis/statics.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

static struct case_def def;

static const double *shape_of(const struct model *m, int mode)
{
    return m->modes.shape + (size_t)mode * (size_t)m->modes.n_dof;
}

/* The stations move with mid-chord: the axis and the turn about it. */
static void stations_are_at_mid_chord(void **state)
{
    (void)state;
    struct model m;
    struct failure fail;
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    const double along = -0.02, turn = 0.1;
    fixture_paper_beam(-45.0, &polar, &def);
    def.beam.section.mid_chord = along;
    def.beam.section.shape.turn = turn;
    assert_ok(model_build(&def, &m, &fail));
    for (int j = 0; j < m.n_mode; j++) {
        for (int i = 0; i < m.n_station; i++) {
            const double z = (i + 0.5) * m.station_length;
            const struct beam_motion axis = beam_motion_at(&m.beam, shape_of(&m, j), z);
            const ptrdiff_t k = num_at(i, j, m.n_station);
            assert_near_abs(m.station_u[k], axis.u - along * sin(turn) * axis.theta, 1e-13);
            assert_near_abs(m.station_v[k], axis.v + along * cos(turn) * axis.theta, 1e-13);
            assert_near_abs(m.station_theta[k], axis.theta, 0.0);
        }
    }
    const struct beam_motion axis = beam_motion_at(&m.beam, shape_of(&m, 0), def.beam.length);
    assert_near_abs(m.tip[0].v, axis.v + along * cos(turn) * axis.theta, 1e-13);
    assert_near_abs(m.tip[0].w, axis.w + along * (sin(turn) * axis.phi - cos(turn) * axis.psi),
                    1e-13);
    model_done(&m);
    polar_def_done(&polar);
}

/* Between stations mid-chord and the turn are blended. */
static void mid_chord_is_blended(void **state)
{
    (void)state;
    struct model m;
    struct failure fail;
    fixture_paper_beam(0.0, NULL, &def);
    struct station_def station[2] = {{.z = 0.0, .section = def.beam.section},
                                     {.z = def.beam.length, .section = def.beam.section}};
    station[0].section.mid_chord = 0.01;
    station[1].section.mid_chord = 0.03;
    def.kind = CASE_MODES;
    def.beam.n_station = 2;
    def.beam.station = station;
    assert_ok(model_build(&def, &m, &fail));
    const double z = 0.75 * def.beam.length;
    double largest = 0.0;
    for (int j = 0; j < m.modes.n_mode; j++) {
        const struct beam_motion axis = beam_motion_at(&m.beam, shape_of(&m, j), z);
        const struct beam_motion mid = model_motion_at(&m, shape_of(&m, j), z);
        assert_near_abs(mid.v - axis.v, 0.025 * axis.theta, 1e-12);
        largest = fmax(largest, fabs(axis.theta));
    }
    assert_true(largest > 1.0); /* a torsion mode is among them */
    model_done(&m);
}

/* Lift of thin-aerofoil theory acts at the quarter point. With the axis there it twists nothing;
 * with the axis at mid-chord it does, nose-up. */
static double twist_at_equilibrium(double mid_chord)
{
    struct model m;
    struct workspace w;
    struct failure fail;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    const struct material metal = fixture_isotropic(70e9, 0.0, 2700.0);
    fixture_strip(&metal, 1.2, 0.02, 0.001, &def);
    def.kind = CASE_SIMULATION;
    def.beam.section.mid_chord = mid_chord;
    def.flow.speed = 20.0;
    def.flow.incidence = 1e-3;
    def.aero.polar = &polar;
    def.aero.lifting_line = false;
    def.solver.modes = 12;
    def.solver.duration = 1.0;
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(workspace_init(&m, &w));
    double residual = 0.0, twist = 0.0;
    assert_ok(equilibrium_solve(&m, &w, &residual));
    for (int j = 0; j < m.n_mode; j++) {
        twist += m.tip[j].theta * w.q[j];
    }
    workspace_done(&w);
    model_done(&m);
    polar_def_done(&polar);
    return twist;
}

static void lift_at_the_axis_does_not_twist(void **state)
{
    (void)state;
    const double off_axis = twist_at_equilibrium(0.0);
    assert_true(off_axis > 1e-4);
    assert_near_abs(twist_at_equilibrium(-0.005), 0.0, 1e-6 * off_axis);
    assert_true(twist_at_equilibrium(-0.008) < 0.0); /* lift behind the axis: nose-down */
}

/* A torque about the axis moves a mid-chord that is off it. */
static void static_plunge_is_that_of_mid_chord(void **state)
{
    (void)state;
    struct model m;
    struct failure fail;
    struct static_result r;
    fixture_paper_beam(0.0, NULL, &def);
    def.kind = CASE_STATIC;
    def.beam.section.mid_chord = 0.04;
    def.loads.n_point = 1;
    def.loads.point[0] =
        (struct point_load_def){.z = def.beam.length, .load = {.moment = {0.0, 0.0, 0.01}}};
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(statics_run(&m, &r));
    assert_true(r.tip.theta > 1e-4);
    assert_near_rel(r.tip.v, 0.04 * r.tip.theta, 1e-6);
    assert_near_rel(r.span[STATIC_SAMPLES - 1].motion.v, r.tip.v, 1e-12);
    statics_done(&r);
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
        cmocka_unit_test(stations_are_at_mid_chord),
        cmocka_unit_test(mid_chord_is_blended),
        cmocka_unit_test(lift_at_the_axis_does_not_twist),
        cmocka_unit_test(static_plunge_is_that_of_mid_chord),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
