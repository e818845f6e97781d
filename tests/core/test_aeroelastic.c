/* Static aeroelastic equilibrium: closed forms of the uniform wing in torsion, balance of forces,
 * and the three ways it can end. */
#include "core/analysis/statics.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>

static struct case_def def;

/* GJ 1e4 N m^2, L 16 m, c 1 m, axis at mid-chord; c_l = 2 pi alpha at the quarter point. */
static const double gj = 1e4, length = 16.0, density = 0.0889;

static double divergence_pressure(void)
{
    return num_sq(NUM_PI / (2.0 * length)) * gj / (0.25 * 2.0 * NUM_PI);
}

/* At a share of the divergence pressure. */
static void wing(double share, const struct polar_def *polar)
{
    case_def_defaults(&def);
    def.kind = CASE_STATIC;
    def.beam.length = length;
    section_def_defaults(SECTION_PROPERTIES, &def.beam.section);
    struct properties *p = &def.beam.section.properties;
    p->chord = 1.0;
    p->ei_flap = 2e4;
    p->gj = gj;
    p->mass = 0.75;
    p->torsion_inertia = 0.1;
    properties_complete(p);
    def.flow.density = density;
    def.flow.speed = sqrt(2.0 * share * divergence_pressure() / density);
    def.flow.incidence = 1e-3;
    def.aero.polar = polar;
    def.aero.lifting_line = false;
}

static void run(struct static_result *r)
{
    struct model m;
    struct failure fail;
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(statics_run(&m, r));
    model_done(&m);
}

/* GJ theta'' + q c e a_0 theta = 0 under a tip torque T: theta(L) = T tan(k L)/(GJ k). */
static void a_given_torque_is_amplified(void **state)
{
    (void)state;
    struct static_result r;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    const double share = 0.6, torque = 2.0, k = NUM_PI / (2.0 * length) * sqrt(share);
    wing(share, &polar);
    def.flow.incidence = 0.0;
    def.loads.n_point = 1;
    def.loads.point[0] =
        (struct point_load_def){.z = length, .load = {.moment = {0.0, 0.0, torque}}};
    run(&r);
    assert_int_equal(r.air.state, AEROELASTIC_EQUILIBRIUM);
    assert_near_rel(r.tip.theta, torque * tan(k * length) / (gj * k), 5e-4);
    statics_done(&r);
    polar_def_done(&polar);
}

/* Clamp and air are in balance; so are the stations and the totals. */
static void forces_balance(void **state)
{
    (void)state;
    struct static_result r;
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    wing(0.4, &polar);
    def.aero.lifting_line = true;
    def.beam.section.properties.elastic_axis = 0.4;
    def.beam.section.properties.mass_axis = 0.4;
    def.flow.incidence = num_rad(3.0);
    run(&r);
    const double a = def.flow.incidence;
    const struct load_totals *t = &r.air.total;
    assert_int_equal(r.air.state, AEROELASTIC_EQUILIBRIUM);
    assert_near_rel(r.reaction_force[1], -(t->lift * cos(a) + t->drag * sin(a)), 1e-12);
    assert_near_rel(r.reaction_force[0], -(t->lift * sin(a) - t->drag * cos(a)), 1e-12);
    /* About the axis, 0.1 m before mid-chord. */
    assert_near_rel(r.reaction_moment[2],
                    -(t->moment - 0.1 * (t->lift * cos(a) + t->drag * sin(a))), 1e-11);
    double lift = 0.0, bending = 0.0;
    for (int i = 0; i < r.air.n_station; i++) {
        const struct aeroelastic_station *s = &r.air.station[i];
        lift += s->lift * length / r.air.n_station;
        bending += s->z * (s->lift * cos(a) + s->drag * sin(a)) * length / r.air.n_station;
    }
    assert_int_equal(r.air.n_station, 64);
    assert_near_rel(lift, t->lift, 1e-12);
    assert_near_rel(r.reaction_moment[0], bending, 1e-12);
    statics_done(&r);
    polar_def_done(&polar);
}

static void beyond_divergence_there_is_no_answer(void **state)
{
    (void)state;
    static const double share[3] = {1.02, 1.5, 4.0}, limit[3] = {1.0, 1.0, 50.0};
    for (int i = 0; i < 3; i++) {
        struct static_result r;
        struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, limit[i]);
        wing(share[i], &polar);
        run(&r);
        assert_int_equal(r.air.state, AEROELASTIC_DIVERGENCE);
        assert_near_rel(r.air.divergence_pressure, divergence_pressure(), 1e-6);
        assert_near_rel(r.air.divergence_speed, def.flow.speed / sqrt(share[i]), 1e-6);
        assert_true(isnan(r.tip.theta));
        assert_true(isnan(r.reaction_force[1]));
        assert_true(isnan(r.air.total.lift));
        assert_int_equal(r.air.n_station, 0);
        assert_true(r.air.reason[0] != '\0');
        statics_done(&r);
        polar_def_done(&polar);
    }
}

/* Lift that falls off smoothly, 2 pi a tanh(alpha/a) with a = 5 degrees. */
static struct polar_def soft_stall(void)
{
    enum { ANGLES = 241 };
    struct polar_def polar = fixture_linear_polar(0.0, 0.0, 0.0, 1.0);
    double **const column[4] = {&polar.alpha, &polar.cl, &polar.cd, &polar.cm};
    for (int k = 0; k < 4; k++) {
        free(*column[k]);
        *column[k] = calloc(ANGLES, sizeof(double));
        assert_non_null(*column[k]);
    }
    polar.n_alpha = ANGLES;
    for (int i = 0; i < ANGLES; i++) {
        const double soft = num_rad(5.0);
        polar.alpha[i] = num_rad(0.5 * (i - ANGLES / 2));
        polar.cl[i] = 2.0 * NUM_PI * soft * tanh(polar.alpha[i] / soft);
        polar.cm[i] = 0.25 * polar.cl[i];
    }
    return polar;
}

/* The twist of a beam beyond divergence stops where the lift does, and the branch from rest leads
 * there. */
static void stall_stops_divergence(void **state)
{
    (void)state;
    struct static_result r;
    struct polar_def polar = soft_stall();
    wing(1.5, &polar);
    run(&r);
    assert_int_equal(r.air.state, AEROELASTIC_EQUILIBRIUM);
    assert_true(r.air.divergence_speed > def.flow.speed);
    assert_int_equal(r.air.outside_polar, 0);
    assert_true(r.tip.theta > num_rad(5.0));
    /* Never more than under the full torque all along: q c^2 c_m L^2/(2 GJ). */
    const double q = 1.5 * divergence_pressure(), cm = 0.5 * NUM_PI * num_rad(5.0);
    assert_true(r.tip.theta < q * cm * num_sq(length) / (2.0 * gj));
    statics_done(&r);
    polar_def_done(&polar);
}

static void a_lifting_line_that_fails_is_said(void **state)
{
    (void)state;
    struct static_result r;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    polar.cl[3] *= 1.3; /* bent: one Newton step does not do */
    wing(0.3, &polar);
    def.flow.incidence = num_rad(20.0);
    def.aero.lifting_line = true;
    def.aero.tolerance = 1e-14;
    def.aero.iterations_max = 1;
    run(&r);
    assert_int_equal(r.air.state, AEROELASTIC_NOT_CONVERGED);
    assert_true(isnan(r.tip.v));
    statics_done(&r);
    polar_def_done(&polar);
}

static void without_incidence_nothing_moves(void **state)
{
    (void)state;
    struct static_result r;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    wing(0.9, &polar);
    def.flow.incidence = 0.0;
    run(&r);
    assert_int_equal(r.air.state, AEROELASTIC_EQUILIBRIUM);
    assert_near_abs(r.tip.theta, 0.0, 1e-15);
    assert_near_rel(r.air.divergence_pressure, divergence_pressure(), 1e-6);
    statics_done(&r);
    def.flow.density = 0.0; /* no air at all */
    run(&r);
    assert_int_equal(r.air.state, AEROELASTIC_EQUILIBRIUM);
    assert_true(isinf(r.air.divergence_pressure));
    statics_done(&r);
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_given_torque_is_amplified),
        cmocka_unit_test(forces_balance),
        cmocka_unit_test(beyond_divergence_there_is_no_answer),
        cmocka_unit_test(stall_stops_divergence),
        cmocka_unit_test(a_lifting_line_that_fails_is_said),
        cmocka_unit_test(without_incidence_nothing_moves),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
