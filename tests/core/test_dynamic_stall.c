/* Dynamic stall on one station and several; its loops through stall are in tests/verify. */
#include "core/aero/dynamic_stall.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

enum { ANGLES = 13, ROWS = 2, STATIONS = 16 };

/* A cambered plate that stalls at 9 degrees, with a lift slope above 2 pi, at two heights. */
static const double degrees[ANGLES] = {-40, -20, -12, -8, -5, -2, 0, 3, 6, 9, 12, 20, 40};
static const double lift[ANGLES] = {-1.0, -0.7, -0.75, -0.8, -0.55, -0.05, 0.25,
                                    0.76, 1.2,  1.4,   1.1,  0.95,  1.2};
static const double moment[ANGLES] = {0.12, 0.05, -0.05, -0.11, -0.09, -0.04, 0.0,
                                      0.08, 0.13, 0.12,  0.05,  -0.02, -0.1};

struct stalling {
    double alpha[ANGLES], plunge[ROWS], cl[ANGLES * ROWS], cd[ANGLES * ROWS], cm[ANGLES * ROWS];
    struct polar_def def;
    struct polar *polar;
};

static void stalling_init(struct stalling *s)
{
    *s = (struct stalling){.plunge = {0.0, 1.0}};
    for (int i = 0; i < ANGLES * ROWS; i++) {
        const int a = i % ANGLES;
        const double height = 1.0 + 0.05 * (double)(i / ANGLES);
        s->alpha[a] = num_rad(degrees[a]);
        s->cl[i] = height * lift[a];
        s->cd[i] = 0.02 + num_sq(s->alpha[a]);
        s->cm[i] = height * moment[a];
    }
    s->def = (struct polar_def){.n_alpha = ANGLES,
                                .n_plunge = ROWS,
                                .alpha = s->alpha,
                                .plunge = s->plunge,
                                .cl = s->cl,
                                .cd = s->cd,
                                .cm = s->cm,
                                .linear_from = num_rad(-8.0),
                                .linear_to = num_rad(8.0),
                                .stall = stall_def_default()};
    assert_ok(polar_create(&s->def, &s->polar));
}

/* Stations of chord 0.1 m at 5 m/s: 2V/c = 100/s. */
enum { RATE = 100 };

static void stall_init(int n, double dt, const struct polar *p, const struct stall_def *def,
                       struct dynamic_stall *out)
{
    double chord[STATIONS];
    for (int i = 0; i < n; i++) {
        chord[i] = 0.1;
    }
    assert_ok(dynamic_stall_init(n, chord, 5.0, dt, p, def, out));
}

static void kirchhoff_and_back(void **state)
{
    (void)state;
    for (int i = 0; i <= 100; i++) {
        const double f = 0.01 * i;
        assert_near_abs(dynamic_stall_separation(dynamic_stall_lift_share(f)), f, 1e-14);
    }
    /* Separated at the leading edge a quarter of the lift is left; more than all there is not. */
    assert_near_abs(dynamic_stall_lift_share(0.0), 0.25, 1e-15);
    assert_near_abs(dynamic_stall_separation(0.1), 0.0, 1e-15);
    assert_near_abs(dynamic_stall_separation(-3.0), 0.0, 1e-15);
    assert_near_abs(dynamic_stall_separation(1.7), 1.0, 1e-15);
}

static void linear_lift_of_the_polar(void **state)
{
    (void)state;
    struct stalling s;
    struct dynamic_stall ds;
    stalling_init(&s);
    stall_init(1, 1e-3, s.polar, &s.def.stall, &ds);
    assert_near_abs(polar_at(s.polar, ds.zero_lift, 0.0).cl, 0.0, 1e-12);
    assert_true(ds.zero_lift > num_rad(-2.0));
    assert_true(ds.zero_lift < 0.0);
    double largest = 0.0;
    for (double a = num_rad(-8.0); a < num_rad(8.0); a += num_rad(0.37)) {
        largest =
            fmax(largest, polar_at(s.polar, a, 0.0).cl / (ds.polar_slope * (a - ds.zero_lift)));
    }
    assert_near_abs(largest, 1.0, 2e-3);
    dynamic_stall_done(&ds);
    polar_destroy(s.polar);
}

/* At every angle, on both sides of the table too, at any height and with any parameters. */
static void steady_flow_is_the_polar(void **state)
{
    (void)state;
    struct stalling s;
    stalling_init(&s);
    const struct stall_def odd = {.lift_slope = 3.0,
                                  .lift_centre = -0.1,
                                  .pressure_lag = 0.3,
                                  .boundary_layer_lag = 11.0,
                                  .vortex_lag = 2.0};
    const struct stall_def def[] = {s.def.stall, odd};
    for (size_t k = 0; k < sizeof def / sizeof def[0]; k++) {
        struct dynamic_stall ds;
        stall_init(1, 1e-3, s.polar, &def[k], &ds);
        for (double alpha = -1.5; alpha < 1.5; alpha += 0.0137) {
            for (double plunge = -0.5; plunge < 2.0; plunge += 0.5) {
                double x[STALL_ARRAYS];
                const struct polar_value v = polar_at(s.polar, alpha, plunge);
                dynamic_stall_steady(&ds, &alpha, &plunge, x);
                for (int i = 0; i < 50; i++) {
                    dynamic_stall_step(&ds, &alpha, &plunge, x);
                }
                double cl = v.cl, cd = v.cd, cm = v.cm;
                dynamic_stall_coefficients(&ds, &alpha, x, &cl, &cd, &cm);
                assert_near_abs(cl, v.cl, 1e-13);
                assert_near_abs(cd, v.cd, 1e-13);
                assert_near_abs(cm, v.cm, 1e-13);
            }
        }
        dynamic_stall_done(&ds);
    }
    polar_destroy(s.polar);
}

/* A long time after any start the polar is met as well. */
static void rest_forgets_the_start(void **state)
{
    (void)state;
    struct stalling s;
    struct dynamic_stall ds;
    stalling_init(&s);
    stall_init(1, 5e-3, s.polar, &s.def.stall, &ds);
    const double start = num_rad(25.0), plunge = 0.3;
    for (double alpha = -0.5; alpha < 0.5; alpha += 0.1) {
        double x[STALL_ARRAYS], cl = 0.0, cd = 0.0, cm = 0.0;
        dynamic_stall_steady(&ds, &start, &plunge, x);
        for (int i = 0; i < 1000; i++) {
            dynamic_stall_step(&ds, &alpha, &plunge, x);
        }
        dynamic_stall_coefficients(&ds, &alpha, x, &cl, &cd, &cm);
        const struct polar_value v = polar_at(s.polar, alpha, plunge);
        assert_near_abs(cl, v.cl, 1e-12);
        assert_near_abs(cm, v.cm, 1e-12);
    }
    dynamic_stall_done(&ds);
    polar_destroy(s.polar);
}

/* A linear polar of the potential slope leaves nothing to lag: c_l and c_m are those of the polar
 * in any motion. */
static void attached_flow_has_no_lag(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(5.7, 5.7 * 0.25, 0.01, 1.0);
    struct polar *p = NULL;
    struct dynamic_stall ds;
    def.stall.lift_slope = 5.7;
    assert_ok(polar_create(&def, &p));
    stall_init(1, 1e-3, p, &def.stall, &ds);
    double x[STALL_ARRAYS], alpha = 0.0;
    const double plunge = 0.0;
    dynamic_stall_steady(&ds, &alpha, &plunge, x);
    for (int i = 0; i < 1000; i++) {
        alpha = 0.3 * sin(0.02 * i) + 0.5 * sin(0.3 * i);
        dynamic_stall_step(&ds, &alpha, &plunge, x);
        double cl = 5.7 * alpha, cd = 0.01, cm = 0.0;
        dynamic_stall_coefficients(&ds, &alpha, x, &cl, &cd, &cm);
        assert_near_abs(cl, 5.7 * alpha, 1e-13);
        assert_near_abs(cd, 0.01, 1e-13);
        assert_near_abs(cm, 0.25 * 5.7 * alpha, 1e-13);
    }
    dynamic_stall_done(&ds);
    polar_destroy(p);
    polar_def_done(&def);
}

/* With the slope and centre of a polar that is straight about zero lift, an oscillation in that
 * range is the steady polar, although the polar stalls beyond it. */
static void attached_motion_is_quasi_steady(void **state)
{
    (void)state;
    struct stalling s;
    struct dynamic_stall ds;
    const double slope = 9.0, centre = 0.2, plunge = 0.0, zero = 0.0;
    stalling_init(&s);
    polar_destroy(s.polar);
    for (int i = 0; i < ANGLES * ROWS; i++) {
        const double a = s.alpha[i % ANGLES];
        s.cl[i] = slope * num_clamp(a, num_rad(-8.0), num_rad(9.0));
        s.cm[i] = centre * s.cl[i];
    }
    s.def.linear_from = num_rad(-5.0);
    s.def.linear_to = num_rad(5.0);
    s.def.stall.lift_slope = slope;
    s.def.stall.lift_centre = centre;
    assert_ok(polar_create(&s.def, &s.polar));
    stall_init(1, 1e-3, s.polar, &s.def.stall, &ds);
    double x[STALL_ARRAYS];
    dynamic_stall_steady(&ds, &zero, &plunge, x);
    for (int i = 0; i < 500; i++) {
        const double alpha = num_rad(5.0) * sin(0.1 * i);
        dynamic_stall_step(&ds, &alpha, &plunge, x);
        const struct stall_value v = dynamic_stall_output(&ds, alpha, plunge, x);
        assert_near_abs(v.cl, slope * alpha, 1e-13);
        assert_near_abs(v.cm, centre * slope * alpha, 1e-13);
    }
    dynamic_stall_done(&ds);
    polar_destroy(s.polar);
}

/* Lags in a row after a step of the angle, in closed form: one for the pressure (exact at any
 * step), two for the linear lift beyond potential flow. */
static void response_to_a_step(void **state)
{
    (void)state;
    const double slope = 9.0, size = 0.1, plunge = 0.0, dt = 1e-4, before = 0.0;
    struct polar_def def = fixture_linear_polar(slope, 2.0, 0.0, 1.0);
    struct polar *p = NULL;
    struct dynamic_stall ds;
    assert_ok(polar_create(&def, &p));
    stall_init(1, dt, p, &def.stall, &ds);
    const double Tp = def.stall.pressure_lag, Tf = def.stall.boundary_layer_lag;
    const double potential = 2.0 * NUM_PI * size, rest = slope * size - potential;
    const double rest_moment = 2.0 * size - 0.25 * potential;
    double x[STALL_ARRAYS];
    dynamic_stall_steady(&ds, &before, &plunge, x);
    x[STALL_STATES + STALL_PRESSURE] = size; /* the step stands before the first interval */
    for (int i = 1; i <= 2000; i++) {
        dynamic_stall_step(&ds, &size, &plunge, x);
        const double t = RATE * dt * i;
        const double one = 1.0 - exp(-t / Tp);
        const double two = 1.0 - (Tp * exp(-t / Tp) - Tf * exp(-t / Tf)) / (Tp - Tf);
        const struct stall_value v = dynamic_stall_output(&ds, size, plunge, x);
        assert_near_abs(x[STALL_PRESSURE], size * one, 1e-14);
        assert_near_abs(v.cl, potential + rest * two, 1e-6);
        assert_near_abs(v.cm, 0.25 * potential + rest_moment * two, 1e-6);
    }
    dynamic_stall_done(&ds);
    polar_destroy(p);
    polar_def_done(&def);
}

/* Exact when the angle runs linearly, whatever the step. */
static void pressure_of_a_ramp(void **state)
{
    (void)state;
    struct stalling s;
    stalling_init(&s);
    const double T = s.def.stall.pressure_lag / RATE, plunge = 0.0, before = 0.0;
    for (double dt = 1e-5; dt < 10.0; dt *= 10.0) {
        struct dynamic_stall ds;
        double x[STALL_ARRAYS];
        stall_init(1, dt, s.polar, &s.def.stall, &ds);
        dynamic_stall_steady(&ds, &before, &plunge, x);
        for (int i = 1; i <= 20; i++) {
            const double t = dt * i, alpha = 0.2 * t;
            dynamic_stall_step(&ds, &alpha, &plunge, x);
            assert_near_abs(x[STALL_PRESSURE], 0.2 * (t + T * expm1(-t / T)), 1e-13 * (1.0 + t));
        }
        dynamic_stall_done(&ds);
    }
    polar_destroy(s.polar);
}

/* c_l, c_m and all states after a swing through stall, in steps of dt. */
static void swing(const struct stalling *s, double dt, double *out)
{
    enum { OUTPUTS = 2 };
    struct dynamic_stall ds;
    double alpha = 0.1;
    const double plunge = 0.0, end = 0.3;
    const int steps = (int)lround(end / dt);
    stall_init(1, dt, s->polar, &s->def.stall, &ds);
    dynamic_stall_steady(&ds, &alpha, &plunge, out + OUTPUTS);
    for (int i = 1; i <= steps; i++) {
        alpha = 0.1 + 0.12 * num_sq(sin(0.5 * 25.0 * end * i / steps));
        dynamic_stall_step(&ds, &alpha, &plunge, out + OUTPUTS);
    }
    const struct stall_value v = dynamic_stall_output(&ds, alpha, plunge, out + OUTPUTS);
    out[0] = v.cl;
    out[1] = v.cm;
    dynamic_stall_done(&ds);
}

static void steps_are_of_second_order(void **state)
{
    (void)state;
    enum { VALUES = 2 + STALL_ARRAYS, HALVINGS = 3 };
    struct stalling s;
    double exact[VALUES], got[VALUES], error[HALVINGS];
    stalling_init(&s);
    swing(&s, 0.3 / 65536.0, exact);
    for (int k = 0; k < HALVINGS; k++) {
        swing(&s, 0.3 / (double)(256 << k), got);
        error[k] = fmax(fabs(got[0] - exact[0]), fabs(got[1] - exact[1]));
    }
    assert_true(error[0] < 1e-3);
    for (int k = 1; k < HALVINGS; k++) {
        assert_near_abs(log2(error[k - 1] / error[k]), 2.0, 0.2);
    }
    polar_destroy(s.polar);
}

static void step_follows_the_derivative(void **state)
{
    (void)state;
    struct stalling s;
    struct dynamic_stall ds;
    stalling_init(&s);
    const double dt = 1e-8, alpha = 0.3, plunge = 0.4;
    double x[STALL_ARRAYS] = {0.2, 0.05, 0.6, 0.1, -0.1, 0.3}, old[STALL_STATES];
    double slope[STALL_STATES];
    stall_init(1, dt, s.polar, &s.def.stall, &ds);
    dynamic_stall_step(&ds, &alpha, &plunge, x); /* now the targets are those of the states */
    memcpy(old, x, sizeof old);
    dynamic_stall_derivative(&ds, 0, alpha, plunge, x, slope);
    dynamic_stall_step(&ds, &alpha, &plunge, x);
    for (int k = 0; k < STALL_STATES; k++) {
        assert_true(fabs(slope[k]) > 1e-3); /* nothing rests */
        assert_near_rel((x[k] - old[k]) / dt, slope[k], 1e-5);
    }
    dynamic_stall_done(&ds);
    polar_destroy(s.polar);
}

/* Angles thrown about at random, with steps from tiny to larger than every lag: separation stays
 * between the edges, lift stays between bounds of the polar and of potential flow. */
static void any_motion_is_bounded(void **state)
{
    (void)state;
    struct stalling s;
    stalling_init(&s);
    uint64_t seed = 5;
    for (double dt = 1e-5; dt < 1.0; dt *= 10.0) {
        struct dynamic_stall ds;
        double x[STATIONS * STALL_ARRAYS], alpha[STATIONS] = {0}, plunge[STATIONS] = {0};
        stall_init(STATIONS, dt, s.polar, &s.def.stall, &ds);
        dynamic_stall_steady(&ds, alpha, plunge, x);
        for (int k = 0; k < 2000; k++) {
            double cl[STATIONS] = {0}, cd[STATIONS] = {0}, cm[STATIONS] = {0};
            for (int i = 0; i < STATIONS; i++) {
                alpha[i] = 2.0 * random_uniform(&seed) - 1.0;
                plunge[i] = 3.0 * random_uniform(&seed) - 1.0;
            }
            dynamic_stall_step(&ds, alpha, plunge, x);
            dynamic_stall_coefficients(&ds, alpha, x, cl, cd, cm);
            for (int i = 0; i < STATIONS; i++) {
                const double f = x[num_at(i, STALL_SEPARATION, STATIONS)];
                assert_true(f >= 0.0);
                assert_true(f <= 1.0);
                assert_true(fabs(cl[i]) < 30.0);
                assert_true(fabs(cm[i]) < 10.0);
                assert_true(isfinite(cd[i]));
            }
        }
        dynamic_stall_done(&ds);
    }
    polar_destroy(s.polar);
}

/* Stations do not see each other: each is what it is alone. */
static void stations_are_independent(void **state)
{
    (void)state;
    struct stalling s;
    stalling_init(&s);
    struct dynamic_stall all, alone;
    double x[STATIONS * STALL_ARRAYS], alpha[STATIONS], plunge[STATIONS];
    stall_init(STATIONS, 2e-3, s.polar, &s.def.stall, &all);
    stall_init(1, 2e-3, s.polar, &s.def.stall, &alone);
    for (int i = 0; i < STATIONS; i++) {
        alpha[i] = 0.02 * i;
        plunge[i] = 0.1 * i;
    }
    dynamic_stall_steady(&all, alpha, plunge, x);
    for (int i = 0; i < STATIONS; i++) {
        alpha[i] += 0.2;
    }
    dynamic_stall_step(&all, alpha, plunge, x);
    for (int i = 0; i < STATIONS; i++) {
        double one[STALL_ARRAYS];
        const double before = alpha[i] - 0.2;
        dynamic_stall_steady(&alone, &before, &plunge[i], one);
        dynamic_stall_step(&alone, &alpha[i], &plunge[i], one);
        for (int k = 0; k < STALL_STATES; k++) {
            assert_near_abs(x[num_at(i, k, STATIONS)], one[k], 1e-14);
        }
    }
    dynamic_stall_done(&alone);
    dynamic_stall_done(&all);
    polar_destroy(s.polar);
}

/* A ramp through stall: lift goes on beyond the largest of the polar and falls later; the moment
 * falls before the lift does. */
static void stall_comes_late(void **state)
{
    (void)state;
    struct stalling s;
    struct dynamic_stall ds;
    stalling_init(&s);
    const double plunge = 0.0, dt = 1e-3, ramp = 0.04 * RATE / 2.0; /* 0.04 rad per c/V */
    double x[STALL_ARRAYS], alpha = 0.0, cl_max = 0.0, cm_max = 0.0, cl_at = 0.0, cm_at = 0.0;
    stall_init(1, dt, s.polar, &s.def.stall, &ds);
    dynamic_stall_steady(&ds, &alpha, &plunge, x);
    while (alpha < 0.6) {
        alpha += ramp * dt;
        dynamic_stall_step(&ds, &alpha, &plunge, x);
        const struct stall_value v = dynamic_stall_output(&ds, alpha, plunge, x);
        cl_at = v.cl > cl_max ? alpha : cl_at;
        cm_at = v.cm > cm_max ? alpha : cm_at;
        cl_max = fmax(cl_max, v.cl);
        cm_max = fmax(cm_max, v.cm);
    }
    assert_true(cl_max > 1.2 * 1.4);
    assert_true(cl_at > num_rad(12.0));
    assert_true(cm_at > num_rad(6.0));
    assert_true(cm_at < cl_at);
    dynamic_stall_done(&ds);
    polar_destroy(s.polar);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kirchhoff_and_back),
        cmocka_unit_test(linear_lift_of_the_polar),
        cmocka_unit_test(steady_flow_is_the_polar),
        cmocka_unit_test(rest_forgets_the_start),
        cmocka_unit_test(attached_flow_has_no_lag),
        cmocka_unit_test(attached_motion_is_quasi_steady),
        cmocka_unit_test(response_to_a_step),
        cmocka_unit_test(pressure_of_a_ramp),
        cmocka_unit_test(steps_are_of_second_order),
        cmocka_unit_test(step_follows_the_derivative),
        cmocka_unit_test(any_motion_is_bounded),
        cmocka_unit_test(stations_are_independent),
        cmocka_unit_test(stall_comes_late),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
