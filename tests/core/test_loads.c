/* One evaluation of the aerodynamics in states where the answer can be written down. */
#include "core/coupling/loads.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

struct setting {
    struct polar_def polar;
    struct network_def network;
    struct case_def def;
    struct model model;
    struct workspace w;
};

/* c_l = 5 a, c_m = 0.8 a, c_d = 0.05 on the paper's beam; `prepare` may change the case. */
static void start(void (*prepare)(struct setting *), struct setting *s)
{
    struct failure fail;
    memset(s, 0, sizeof *s);
    s->polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    fixture_paper_beam(-45.0, &s->polar, &s->def);
    s->def.aero.lifting_line = false;
    if (prepare != NULL) {
        prepare(s);
    }
    assert_ok(model_build(&s->def, &s->model, &fail));
    assert_ok(workspace_init(&s->model, &s->w));
}

static void finish(struct setting *s)
{
    workspace_done(&s->w);
    model_done(&s->model);
    polar_def_done(&s->polar);
    network_def_done(&s->network);
}

static void a_beam_at_rest(void **state)
{
    (void)state;
    struct setting s;
    start(NULL, &s);
    loads_evaluate(&s.model, &s.w, true);
    const double alpha = num_rad(5.0), q = 0.5 * 1.225 * 36.0, c = 0.1, area = 0.037;
    const struct load_totals t = loads_total(&s.model, &s.w);
    assert_near_rel(t.cl, 5.0 * alpha, 1e-13);
    assert_near_rel(t.cm, 0.8 * alpha, 1e-13);
    assert_near_rel(t.cd, 0.05, 1e-13);
    assert_near_rel(t.lift, q * area * 5.0 * alpha, 1e-13);
    assert_near_rel(t.moment, q * area * c * 0.8 * alpha, 1e-13);
    const double lift = q * c * 5.0 * alpha, drag = q * c * 0.05;
    for (int i = 0; i < s.w.n_station; i++) {
        /* Lift is normal to the stream, which comes from below the nose at alpha_0. */
        assert_near_rel(s.w.force_y[i], lift * cos(alpha) + drag * sin(alpha), 1e-13);
        assert_near_rel(s.w.force_x[i], lift * sin(alpha) - drag * cos(alpha), 1e-13);
    }
    finish(&s);
}

/* Pure plunge of a mode without twist: alpha falls by v_dot/V. */
static void motion_changes_the_angle(void **state)
{
    (void)state;
    struct setting s;
    start(NULL, &s);
    s.w.qd[0] = 0.01;
    s.w.q[1] = 1e-4;
    loads_evaluate(&s.model, &s.w, true);
    for (int i = 0; i < s.w.n_station; i++) {
        const double v = s.model.station_v[i] * 0.01;
        const double theta = s.model.station_theta[i + s.w.n_station] * 1e-4;
        assert_near_abs(s.w.alpha[i], num_rad(5.0) + theta - v / 6.0, 1e-15);
        assert_near_abs(s.w.plunge_rate[i], v / 6.0, 1e-16);
        assert_near_abs(s.w.cl[i], 5.0 * s.w.alpha[i], 1e-14);
    }
    finish(&s);
}

static void with_lifting_line(struct setting *s)
{
    s->def.aero.lifting_line = true;
}

static void the_induced_angle_tilts_the_lift(void **state)
{
    (void)state;
    struct setting s;
    start(with_lifting_line, &s);
    loads_evaluate(&s.model, &s.w, true);
    for (int i = 0; i < s.w.n_station; i++) {
        assert_true(s.w.induced[i] > 0.0);
        assert_near_abs(s.w.alpha[i], s.w.alpha_geometric[i] - s.w.induced[i], 1e-15);
        assert_near_abs(s.w.cd[i], 0.05 + s.w.cl[i] * s.w.induced[i], 1e-14);
    }
    const struct load_totals t = loads_total(&s.model, &s.w);
    /* Induced drag of Glauert: C_L^2 (1 + delta)/(pi AR), a few per cent high on 16 elements. */
    assert_near_rel(t.cd - 0.05, t.cl * t.cl / (NUM_PI * 7.4) * 1.05, 0.05);
    finish(&s);
}

/* A plunge beyond the table is counted, but is no angle beyond it: a deflected beam does not
 * diverge. */
static void plunge_outside_is_only_counted(void **state)
{
    (void)state;
    struct setting s;
    start(NULL, &s);
    struct polar_def two = s.polar;
    const size_t n = (size_t)two.n_alpha;
    double plunge[] = {-1e-4, 1e-4}, cl[2 * 64], cd[2 * 64], cm[2 * 64];
    assert_true(n <= 64);
    for (size_t i = 0; i < 2 * n; i++) {
        cl[i] = s.polar.cl[i % n];
        cd[i] = s.polar.cd[i % n];
        cm[i] = s.polar.cm[i % n];
    }
    two.n_plunge = 2;
    two.plunge = plunge;
    two.cl = cl;
    two.cd = cd;
    two.cm = cm;
    polar_destroy(s.model.polar);
    assert_ok(polar_create(&two, &s.model.polar));
    s.w.q[0] = 0.05; /* bent up */
    loads_evaluate(&s.model, &s.w, true);
    assert_true(s.w.counters.outside_polar > 0);
    assert_false(s.w.any_outside);
    finish(&s);
}

static void outside_and_stalled_are_counted(void **state)
{
    (void)state;
    struct setting s;
    start(NULL, &s);
    loads_evaluate(&s.model, &s.w, true);
    assert_false(s.w.any_outside);
    assert_false(s.w.any_stalled);
    s.w.q[0] = 0.0;
    s.w.qd[0] = -0.6; /* the tip plunges down: large angles outboard */
    loads_evaluate(&s.model, &s.w, true);
    long expected = 0;
    for (int i = 0; i < s.w.n_station; i++) {
        expected += fabs(s.w.alpha[i]) > 0.6;
    }
    assert_true(expected > 0 && expected < s.w.n_station);
    assert_int_equal(s.w.counters.outside_polar, expected);
    assert_true(s.w.any_outside);
    assert_true(s.w.any_stalled);
    finish(&s);
}

static void with_network(struct setting *s)
{
    s->network = fixture_network(20, 0.1, 3);
    s->def.aero.dynamic = DYNAMIC_NETWORK;
    s->def.aero.network = &s->network;
    s->def.solver.time_step = 0.02; /* the window is a dozen steps */
}

/* Inputs of the network: rates from the modal state, c/V as the time. */
static void the_network_sees_scaled_rates(void **state)
{
    (void)state;
    struct setting s;
    start(with_network, &s);
    const double time = 0.1 / 6.0, step = 0.02;
    s.w.qd[1] = 0.02;
    s.w.qdd[0] = 3.0;
    s.w.qdd[1] = -2.0;
    s.w.qdd_previous[0] = 2.5;
    loads_evaluate(&s.model, &s.w, true);
    const int n = s.w.n_station;
    for (int i = 0; i < n; i++) {
        const double *v = s.model.station_v, *theta = s.model.station_theta;
        const double rate = theta[i + n] * 0.02 - (3.0 * v[i] - 2.0 * v[i + n]) / 6.0;
        const double jerk = v[i] * 0.5 / step + v[i + n] * -2.0 / step;
        const double second = theta[i] * 3.0 - theta[i + n] * 2.0 - jerk / 6.0;
        assert_near_abs(s.w.net_in[n * NET_IN_MEAN_ALPHA + i], s.w.alpha[i], 1e-15);
        assert_near_abs(s.w.net_in[n * NET_IN_DELTA_ALPHA + i], 0.0, 1e-15);
        assert_near_abs(s.w.net_in[n * NET_IN_ALPHA_RATE + i], rate * time, 1e-13);
        assert_near_abs(s.w.net_in[n * NET_IN_ALPHA_ACCELERATION + i], second * time * time, 1e-13);
        const double increment = s.w.net_out[n * NET_OUT_CL + i];
        assert_near_abs(s.w.cl[i], 5.0 * s.w.alpha[i] + increment, 1e-14);
    }
    finish(&s);
}

/* The sliding mean against a plain mean over the last `window` angles, several windows long. */
static void the_mean_slides(void **state)
{
    (void)state;
    enum { STEPS = 100 };
    struct setting s;
    double past[STEPS];
    uint64_t seed = 6;
    start(with_network, &s);
    assert_true(s.w.window >= 10 && s.w.window <= 15);
    for (int step = 0; step < STEPS; step++) {
        s.w.qd[0] = 0.02 * fixture_normal(&seed);
        loads_evaluate(&s.model, &s.w, step == 0);
        past[step] = s.w.alpha[7];
        const int from = step + 1 > s.w.window ? step + 1 - s.w.window : 0;
        double mean = 0.0;
        for (int k = from; k <= step; k++) {
            mean += past[k] / (step + 1 - from);
        }
        assert_near_abs(s.w.net_in[s.w.n_station * NET_IN_MEAN_ALPHA + 7], mean, 1e-15);
        assert_near_abs(s.w.net_in[s.w.n_station * NET_IN_DELTA_ALPHA + 7], past[step] - mean,
                        1e-15);
    }
    finish(&s);
}

/* Bent at 0.3 rad: at the incidence of the next test the section is stalled. */
static void with_stall(struct setting *s)
{
    s->polar.cl[0] = -0.9;
    s->polar.cl[4] = 0.9;
    s->polar.cm[4] = -0.1;
    s->polar.cd[4] = 0.3;
    s->polar.linear_from = -0.3;
    s->polar.linear_to = 0.3;
    s->def.aero.lifting_line = true;
    s->def.aero.dynamic = DYNAMIC_STALL;
    s->def.flow.incidence = 0.5;
}

static void without_dynamics(struct setting *s)
{
    with_stall(s);
    s->def.aero.dynamic = DYNAMIC_NONE;
}

/* Steady flow is the polar's, with the lifting line too and past stall, and stays so. */
static void steady_stall_is_the_polar(void **state)
{
    (void)state;
    struct setting s, reference;
    start(with_stall, &s);
    start(without_dynamics, &reference);
    loads_evaluate(&reference.model, &reference.w, true);
    for (int step = 0; step < 50; step++) {
        loads_evaluate(&s.model, &s.w, step == 0);
    }
    assert_true(s.w.any_stalled);
    for (int i = 0; i < s.w.n_station; i++) {
        assert_near_abs(s.w.cl[i], reference.w.cl[i], 1e-9);
        assert_near_abs(s.w.cd[i], reference.w.cd[i], 1e-9);
        assert_near_abs(s.w.cm[i], reference.w.cm[i], 1e-9);
    }
    finish(&s);
    finish(&reference);
}

static void straight_with_stall(struct setting *s)
{
    s->polar.stall.lift_slope = 5.0;
    s->polar.stall.lift_centre = 0.8 / 5.0;
    s->def.aero.dynamic = DYNAMIC_STALL;
}

static void straight_attached(struct setting *s)
{
    s->def.aero.dynamic = DYNAMIC_ATTACHED;
}

/* A polar that does not bend has no stall to lag: the answers are those of attached flow. */
static void no_stall_is_attached_flow(void **state)
{
    (void)state;
    struct setting s, attached;
    start(straight_with_stall, &s);
    start(straight_attached, &attached);
    for (int step = 0; step < 200; step++) {
        for (int j = 0; j < 2; j++) {
            const double phase = 0.05 * step + j;
            s.w.q[j] = attached.w.q[j] = 1e-3 * cos(phase);
            s.w.qd[j] = attached.w.qd[j] = 0.05 * sin(phase);
        }
        loads_evaluate(&s.model, &s.w, step == 0);
        loads_evaluate(&attached.model, &attached.w, step == 0);
        for (int i = 0; i < s.w.n_station; i++) {
            assert_near_abs(s.w.cl[i], attached.w.cl[i], 1e-12);
            assert_near_abs(s.w.cm[i], attached.w.cm[i], 1e-12);
            assert_near_abs(s.w.cd[i], attached.w.cd[i], 1e-12);
        }
    }
    finish(&s);
    finish(&attached);
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
        cmocka_unit_test(a_beam_at_rest),
        cmocka_unit_test(motion_changes_the_angle),
        cmocka_unit_test(the_induced_angle_tilts_the_lift),
        cmocka_unit_test(outside_and_stalled_are_counted),
        cmocka_unit_test(plunge_outside_is_only_counted),
        cmocka_unit_test(the_network_sees_scaled_rates),
        cmocka_unit_test(the_mean_slides),
        cmocka_unit_test(steady_stall_is_the_polar),
        cmocka_unit_test(no_stall_is_attached_flow),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
