/* A section in given motion: lags against their closed form, steady flow against the polar, and the
 * stations of the coupled march against the same section alone. */
#include "core/aero/moving_section.h"
#include "core/coupling/loads.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static const struct network_frame full = {.base = NETWORK_ON_STALL,
                                          .n_lag = 3,
                                          .lag = {0.5, 2.0, 9.0},
                                          .n_oscillator = 2,
                                          .oscillator = {{0.68, 0.1}, {0.9, 0.7}}};

static const double ramp_chord[2] = {0.1, 0.25}, ramp_speed = 5.0;

/* The inputs of two stations after 20 steps in which alpha rises from `from` at 0.2 a second and
 * the pitch rate falls from 0.3 at 0.1. Returns the time. */
static double ramp(double step, double from, double in[2 * NET_IN_COUNT])
{
    struct network_memory m;
    double alpha[2] = {from, from}, pitch[2] = {0.3, 0.3}, t = 0.0;
    assert_ok(network_memory_init(2, ramp_chord, ramp_speed, step, &full, &m));
    network_memory_steady(&m, alpha, pitch, in);
    for (int i = 0; i < 20; i++) {
        t += step;
        for (int s = 0; s < 2; s++) {
            alpha[s] = from + 0.2 * t;
            pitch[s] = 0.3 - 0.1 * t;
        }
        network_memory_step(&m, alpha, pitch, in);
    }
    network_memory_done(&m);
    return t;
}

/* u = rate t from rest: x = rate (t - T (1 - e^(-t/T))), whatever the step. */
static void lags_of_a_ramp(void **state)
{
    (void)state;
    static const double step[] = {1e-4, 0.03, 0.7};
    for (size_t k = 0; k < sizeof step / sizeof step[0]; k++) {
        double in[2 * NET_IN_COUNT];
        const double t = ramp(step[k], 0.0, in);
        for (int s = 0; s < 2; s++) {
            for (int lag = 0; lag < full.n_lag; lag++) {
                const double time = full.lag[lag] * ramp_chord[s] / ramp_speed;
                const double behind = t + time * expm1(-t / time);
                assert_near_abs(in[num_at(s, NET_IN_ALPHA_LAG_1 + lag, 2)], 0.2 * behind, 1e-13);
                assert_near_abs(in[num_at(s, NET_IN_PITCH_LAG_1 + lag, 2)], 0.3 - 0.1 * behind,
                                1e-13);
            }
            assert_true(in[num_at(s, NET_IN_ALPHA_LAG_4, 2)] == 0.0); /* there are three */
            assert_true(in[num_at(s, NET_IN_ALPHA, 2)] == 0.2 * t);
        }
    }
}

/* x and x'/w of x'' + 2 zeta w x' + w^2 (x - t) = 0 from rest. */
static void swing_of_a_ramp(double w, double zeta, double t, double *x, double *rate)
{
    const double root = w * sqrt(1.0 - zeta * zeta), decay = exp(-zeta * w * t);
    const double c = cos(root * t), s = sin(root * t);
    *x = t - 2.0 * zeta / w + decay * (2.0 * zeta / w * c + (2.0 * zeta * zeta - 1.0) / root * s);
    *rate = (1.0 - decay * (c + zeta * w / root * s)) / w;
}

static void oscillators_of_a_ramp(void **state)
{
    (void)state;
    static const double step[] = {1e-4, 0.003, 0.07};
    for (size_t k = 0; k < sizeof step / sizeof step[0]; k++) {
        double in[2 * NET_IN_COUNT];
        const double t = ramp(step[k], 0.4, in);
        for (int s = 0; s < 2; s++) {
            for (int o = 0; o < full.n_oscillator; o++) {
                const struct network_oscillator *osc = &full.oscillator[o];
                double x = 0.0, rate = 0.0;
                swing_of_a_ramp(2.0 * NUM_PI * osc->frequency * ramp_speed / ramp_chord[s],
                                osc->damping, t, &x, &rate);
                const int a = NET_IN_ALPHA_OSCILLATOR_1 + 2 * o;
                const int p = NET_IN_PITCH_OSCILLATOR_1 + 2 * o;
                assert_near_abs(in[num_at(s, a, 2)], 0.4 + 0.2 * x, 1e-13);
                assert_near_abs(in[num_at(s, a + 1, 2)], 0.2 * rate, 1e-13);
                assert_near_abs(in[num_at(s, p, 2)], 0.3 - 0.1 * x, 1e-13);
                assert_near_abs(in[num_at(s, p + 1, 2)], -0.1 * rate, 1e-13);
            }
        }
    }
}

/* Driven at its own frequency an oscillator answers 1/(2 zeta) times as large, a quarter late; far
 * above, against the input and as (f0/f)^2. Steps of 1/200 period: 1e-4 of a straight line. */
static void an_oscillator_resonates_and_stands_still(void **state)
{
    (void)state;
    const double one = 1.0, none = 0.0;
    const struct network_frame frame = {.n_oscillator = 1, .oscillator = {{0.5, 0.05}}};
    static const double ratio[] = {1.0, 40.0};
    for (int k = 0; k < 2; k++) {
        const double f = 0.5 * ratio[k], step = 0.005 / f, r2 = ratio[k] * ratio[k];
        struct network_memory m;
        double in[NET_IN_COUNT], sine = 0.0, cosine = 0.0;
        assert_ok(network_memory_init(1, &one, 1.0, step, &frame, &m));
        network_memory_steady(&m, &none, &none, in);
        const int cycles = 1600;
        for (int i = 1; i <= 200 * cycles; i++) {
            const double phase = 2.0 * NUM_PI * (i % 200) / 200.0, u = sin(phase);
            network_memory_step(&m, &u, &none, in);
            if (i > 200 * (cycles - 1)) {
                sine += in[NET_IN_ALPHA_OSCILLATOR_1] * sin(phase) / 100.0;
                cosine += in[NET_IN_ALPHA_OSCILLATOR_1] * cos(phase) / 100.0;
            }
        }
        const double size = num_sq(1.0 - r2) + num_sq(0.1 * ratio[k]);
        assert_near_abs(sine * size, 1.0 - r2, 2e-4 * sqrt(size));
        assert_near_abs(cosine * size, -0.1 * ratio[k], 2e-4 * sqrt(size));
        network_memory_done(&m);
    }
}

/* Whatever it stands on: at rest the polar, and all angles behind lags and oscillators are the
 * angle. */
static void steady_flow_is_the_polar(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    struct polar *polar = NULL;
    assert_ok(polar_create(&def, &polar));
    for (int base = 0; base < NETWORK_BASES; base++) {
        struct network_frame frame = full;
        struct moving_section s;
        frame.base = (enum network_base)base;
        assert_ok(moving_section_init(&frame, polar, 0.05, &s));
        for (double theta = -0.5; theta < 0.51; theta += 0.1) {
            const struct moving_state rest = {.theta = theta, .w = 0.3};
            for (int i = 0; i < 5; i++) {
                const struct moving_value v = moving_section_step(&s, &rest, i == 0);
                const struct polar_value p = polar_at(polar, theta, 0.3);
                assert_near_abs(v.cl, p.cl, 1e-14);
                assert_near_abs(v.cm, p.cm, 1e-14);
                assert_near_abs(v.cd, p.cd, 1e-14);
                assert_near_abs(s.input[NET_IN_ALPHA_LAG_3], theta, 1e-15);
                assert_near_abs(s.input[NET_IN_ALPHA_OSCILLATOR_2], theta, 1e-15);
                assert_true(s.input[NET_IN_ALPHA_SWING_2] == 0.0);
                assert_true(s.input[NET_IN_PITCH_RATE] == 0.0);
            }
        }
        moving_section_done(&s);
    }
    polar_destroy(polar);
    polar_def_done(&def);
}

/* All inputs a network can see that have a memory of their own. */
static struct network_def remembering(void)
{
    static const enum network_input seen[] = {
        NET_IN_ALPHA,         NET_IN_PITCH_RATE,         NET_IN_ALPHA_LAG_2,  NET_IN_PITCH_LAG_3,
        NET_IN_ALPHA_SWING_1, NET_IN_PITCH_OSCILLATOR_2, NET_IN_STALL_BUBBLE, NET_IN_STALL_LOST};
    enum { SEEN = sizeof seen / sizeof seen[0], HIDDEN = 5 };
    struct network_def d = fixture_network(HIDDEN, 0.3, 8);
    uint64_t seed = 2;
    free(d.w1);
    d.w1 = malloc(SEEN * HIDDEN * sizeof *d.w1);
    d.n_in = SEEN;
    d.frame = full;
    memcpy(d.input, seen, sizeof seen);
    for (int i = 0; i < SEEN; i++) {
        d.in_scale[i] = 0.3;
        d.hull_min[i] = -1.0;
        d.hull_max[i] = 1.0;
    }
    for (int i = 0; i < SEEN * HIDDEN; i++) {
        d.w1[i] = fixture_normal(&seed);
    }
    return d;
}

/* The modes swing, each at its own frequency and size. */
static void swing(const struct model *m, double t, struct workspace *w)
{
    for (int j = 0; j < m->n_mode; j++) {
        const double omega = 20.0 + 15.0 * j, size = 0.01 / (1.0 + 3.0 * j);
        memcpy(w->qdd_previous, w->qdd, (size_t)m->n_mode * sizeof *w->qdd);
        w->q[j] = size * (1.0 - cos(omega * t));
        w->qd[j] = size * omega * sin(omega * t);
        w->qdd[j] = size * omega * omega * cos(omega * t);
    }
}

/* What the modes do to station i, without dimensions. */
static struct moving_state motion_of(const struct model *m, const struct workspace *w, int i)
{
    const double c = m->chord[i], v = m->def.flow.speed, time = c / v;
    struct moving_state s = {.theta = m->def.flow.incidence};
    for (int j = 0; j < m->n_mode; j++) {
        const double up = m->station_v[num_at(i, j, m->n_station)];
        const double twist = m->station_theta[num_at(i, j, m->n_station)];
        s.theta += twist * w->q[j];
        s.theta_rate += twist * w->qd[j] * time;
        s.theta_acceleration += twist * w->qdd[j] * time * time;
        s.w += up * w->q[j] / c;
        s.w_rate += up * w->qd[j] / v;
        s.w_acceleration += up * w->qdd[j] * time / v;
    }
    return s;
}

/* Inputs and coefficients of a network that is trained, asked in a loop and marched agree. */
static void stations_of_a_march_are_such_sections(void **state)
{
    (void)state;
    enum { STEPS = 200, STATION = 11 };
    static struct case_def def;
    struct failure fail;
    struct model m;
    struct workspace w;
    struct moving_section s;
    struct network *net = NULL;
    struct polar_def polar = fixture_linear_polar(9.0, 1.1, 0.05, 1.0);
    struct network_def network = remembering();
    fixture_paper_beam(-45.0, &polar, &def);
    def.aero.lifting_line = false;
    def.aero.dynamic = DYNAMIC_NETWORK;
    def.aero.network = &network;
    def.solver.time_step = 1e-3;
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(workspace_init(&m, &w));
    assert_int_equal(w.window, 0); /* nothing of the mean is kept */
    assert_ok(network_create(&network, &net));
    assert_ok(moving_section_init(&network.frame, m.polar,
                                  1e-3 * m.def.flow.speed / m.chord[STATION], &s));
    const int n = w.n_station;
    for (int k = 0; k < STEPS; k++) {
        double out[NET_OUT_COUNT];
        swing(&m, k * 1e-3, &w);
        loads_evaluate(&m, &w, k == 0);
        const struct moving_state motion = motion_of(&m, &w, STATION);
        const struct moving_value v = moving_section_step(&s, &motion, k == 0);
        for (int in = NET_IN_ALPHA; in < NET_IN_COUNT; in++) {
            assert_near_abs(w.net_in[num_at(STATION, in, n)], s.input[in], 1e-12);
        }
        (void)network_eval(net, 1, s.input, out);
        assert_true(fabs(out[NET_OUT_CL]) > 1e-4);
        assert_near_abs(w.cl[STATION], v.cl + out[NET_OUT_CL], 1e-11);
        assert_near_abs(w.cm[STATION], v.cm + out[NET_OUT_CM], 1e-11);
        assert_near_abs(w.cd[STATION], v.cd, 1e-11);
    }
    moving_section_done(&s);
    network_destroy(net);
    workspace_done(&w);
    model_done(&m);
    network_def_done(&network);
    polar_def_done(&polar);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lags_of_a_ramp),
        cmocka_unit_test(oscillators_of_a_ramp),
        cmocka_unit_test(an_oscillator_resonates_and_stands_still),
        cmocka_unit_test(steady_flow_is_the_polar),
        cmocka_unit_test(stations_of_a_march_are_such_sections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
