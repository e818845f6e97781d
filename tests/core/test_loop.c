/* Loops of a section against closed forms; those through stall against flow computations are in
 * docs/LOOPS.md and tests/data. */
#include "core/analysis/loop.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <complex.h>

/* The polar of thin-aerofoil theory. */
static struct polar_def plate(void)
{
    return fixture_linear_polar(2.0 * NUM_PI, 0.5 * NUM_PI, 0.01, 1.5);
}

static double at(const struct loop_result *r, enum loop_quantity k, int i)
{
    return r->value[num_at(i, (int)k, r->n)];
}

static void run(const struct loop_def *d, struct loop_result *r)
{
    static struct failure_list problems;
    problems.count = problems.total = 0;
    loop_def_check(d, &problems);
    assert_int_equal(problems.total, 0);
    assert_ok(loop_run(d, r));
}

/* Complex amplitude over the last cycle, of a motion that is sin(x): X sin(x) + Y cos(x) -> X+iY.
 */
static double complex harmonic(const struct loop_def *d, const struct loop_result *r,
                               enum loop_quantity k)
{
    double in = 0.0, out = 0.0;
    for (int i = r->n - d->steps; i < r->n; i++) {
        const double x = 2.0 * NUM_PI * i / d->steps;
        in += 2.0 * at(r, k, i) * sin(x) / d->steps;
        out += 2.0 * at(r, k, i) * cos(x) / d->steps;
    }
    return NUM_COMPLEX(in, out);
}

static double complex theodorsen(double k)
{
    const double complex h0 = NUM_COMPLEX(j0(k), -y0(k)), h1 = NUM_COMPLEX(j1(k), -y1(k));
    return h1 / (h1 + NUM_COMPLEX(0.0, 1.0) * h0);
}

/* k = pi f c/V. Pitch about mid-chord and plunge w up, Theodorsen's formulas; the work is pi times
 * amplitude squared times the imaginary part. Without stall the dynamic stall model says the same.
 */
static void attached_loops_are_theodorsens(void **state)
{
    (void)state;
    const double complex i = NUM_COMPLEX(0.0, 1.0);
    const double size = 0.02;
    struct polar_def polar = plate();
    for (int model = 0; model < 2; model++) {
        for (double k = 0.1; k < 1.2; k *= 2.0) {
            struct loop_def d;
            struct loop_result r;
            loop_def_defaults(&d);
            d.polar = &polar;
            d.dynamic = model == 0 ? DYNAMIC_ATTACHED : DYNAMIC_STALL;
            d.frequency = k / NUM_PI;
            d.amplitude = size;
            d.cycles = 60;
            run(&d, &r);
            const double complex circulation = 2.0 * NUM_PI * theodorsen(k) * (1.0 + 0.5 * i * k);
            const double complex cl = circulation + i * NUM_PI * k;
            const double complex cm =
                0.25 * circulation - 0.25 * i * NUM_PI * k + NUM_PI / 16.0 * k * k;
            assert_true(cabs(harmonic(&d, &r, LOOP_CL) / size / cl - 1.0) < 0.003);
            assert_true(cabs(harmonic(&d, &r, LOOP_CM) / size / cm - 1.0) < 0.003);
            const double area = NUM_PI * size * size;
            assert_near_abs(r.work_pitch, area * cimag(cm), 0.003 * area * cabs(cm));
            assert_true(r.work_pitch < 0.0); /* attached flow damps pitch about mid-chord */
            assert_int_equal(r.outside_polar, 0);
            loop_done(&r);
            d.amplitude = 0.0;
            d.plunge = size;
            run(&d, &r);
            const double complex lift =
                -2.0 * NUM_PI * theodorsen(k) * 2.0 * i * k + 2.0 * NUM_PI * k * k;
            assert_true(cabs(harmonic(&d, &r, LOOP_CL) / size / lift - 1.0) < 0.003);
            assert_near_abs(r.work_plunge, area * cimag(lift), 0.003 * area * cabs(lift));
            assert_near_abs(r.work_pitch, 0.0, 1e-15);
            loop_done(&r);
        }
    }
    polar_def_done(&polar);
}

/* Quasi-steady coefficients have no loop in pitch, and their plunge is an angle of -w_dot/V. */
static void quasi_steady_loops_are_closed(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    struct loop_def d;
    struct loop_result r;
    loop_def_defaults(&d);
    d.polar = &polar;
    d.frequency = 0.1;
    d.mean = 0.05;
    d.amplitude = 0.1;
    d.cycles = 2;
    run(&d, &r);
    for (int i = 0; i < r.n; i++) {
        assert_near_abs(at(&r, LOOP_CL, i), 2.0 * NUM_PI * at(&r, LOOP_ALPHA, i), 1e-14);
        assert_near_abs(at(&r, LOOP_TIME, i), i / (0.1 * d.steps), 1e-12);
    }
    assert_near_abs(r.work_pitch, 0.0, 1e-15);
    loop_done(&r);
    d.plunge = 0.2;
    d.phase = 0.5 * NUM_PI;
    d.amplitude = 0.0;
    run(&d, &r);
    const double omega = 2.0 * NUM_PI * 0.1;
    for (int i = 0; i < r.n; i++) {
        const double x = 2.0 * NUM_PI * i / d.steps;
        assert_near_abs(at(&r, LOOP_PLUNGE, i), 0.2 * cos(x), 1e-13);
        assert_near_abs(at(&r, LOOP_CL, i), 2.0 * NUM_PI * (0.05 + 0.2 * omega * sin(x)), 1e-12);
    }
    assert_near_rel(r.work_plunge, -2.0 * NUM_PI * NUM_PI * omega * 0.04, 1e-12);
    loop_done(&r);
    polar_def_done(&polar);
}

/* A table of the same sine is the same motion: the same loop, and the work of its cycles. */
static void a_table_is_the_motion_it_holds(void **state)
{
    (void)state;
    enum { STEPS = 200, CYCLES = 3, N = STEPS * CYCLES + 1 };
    struct polar_def polar = fixture_linear_polar(8.0, 1.2, 0.02, 0.4);
    polar.cl[0] = -1.0; /* bends: stalled beyond 0.2 */
    polar.cl[4] = 1.0;
    polar.linear_from = -0.2;
    polar.linear_to = 0.2;
    struct loop_def d;
    struct loop_result r, t;
    static double value[N * MOTION_ROWS];
    loop_def_defaults(&d);
    d.polar = &polar;
    d.dynamic = DYNAMIC_STALL;
    d.frequency = 0.07;
    d.mean = 0.1;
    d.amplitude = 0.2;
    d.plunge = 0.1;
    d.phase = 1.0;
    d.cycles = CYCLES;
    d.steps = STEPS;
    run(&d, &r);
    const double omega = 2.0 * NUM_PI * d.frequency;
    for (int i = 0; i < N; i++) {
        const double x = 2.0 * NUM_PI * i / STEPS, y = x + 1.0;
        const double row[MOTION_ROWS] = {
            0.1 + 0.2 * sin(x), 0.2 * omega * cos(x), -0.2 * omega * omega * sin(x),
            0.1 * sin(y),       0.1 * omega * cos(y), -0.1 * omega * omega * sin(y)};
        for (int k = 0; k < MOTION_ROWS; k++) {
            value[num_at(i, k, N)] = row[k];
        }
    }
    const struct loop_motion motion = {.n = N, .step = 1.0 / (d.frequency * STEPS), .value = value};
    d.motion = &motion;
    run(&d, &t);
    assert_int_equal(t.n, r.n);
    for (int i = 0; i < N * LOOP_QUANTITIES; i++) {
        assert_near_abs(t.value[i], r.value[i], 1e-11);
    }
    /* The work of all three cycles; the first starts in steady flow. */
    double work = 0.0;
    for (int i = 0; i + 1 < N; i++) {
        work += 0.5 * (at(&r, LOOP_CM, i) + at(&r, LOOP_CM, i + 1)) *
                (at(&r, LOOP_ALPHA, i + 1) - at(&r, LOOP_ALPHA, i));
    }
    assert_near_abs(t.work_pitch, work, 1e-3 * fabs(work));
    loop_done(&r);
    loop_done(&t);
    polar_def_done(&polar);
}

/* The network sees angle and rates of the motion; its increments are added. */
static void the_network_is_added(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    struct network_def network = fixture_network(10, 0.1, 4);
    struct network *net = NULL;
    struct loop_def d;
    struct loop_result r;
    loop_def_defaults(&d);
    assert_ok(network_create(&network, &net));
    d.polar = &polar;
    d.dynamic = DYNAMIC_NETWORK;
    d.network = &network;
    d.frequency = 0.08;
    d.mean = 0.03;
    d.amplitude = 0.06;
    d.plunge = 0.1;
    d.phase = 0.7;
    run(&d, &r);
    const double omega = 2.0 * NUM_PI * d.frequency;
    for (int i = 0; i < d.steps; i += 7) {
        const double x = 2.0 * NUM_PI * i / d.steps, y = x + 0.7;
        const double alpha = 0.03 + 0.06 * sin(x) - 0.1 * omega * cos(y);
        const double rate = omega * (0.06 * cos(x) + 0.1 * omega * sin(y));
        const double second = omega * omega * (-0.06 * sin(x) + 0.1 * omega * cos(y));
        const double in[NET_IN_COUNT] = {0.03, alpha - 0.03, rate, second, 0.1 * omega * cos(y)};
        double out[NET_OUT_COUNT];
        (void)network_eval(net, 1, in, out);
        assert_near_abs(at(&r, LOOP_CL, i), 2.0 * NUM_PI * alpha + out[NET_OUT_CL], 1e-13);
        assert_near_abs(at(&r, LOOP_CM, i), 0.5 * NUM_PI * alpha + out[NET_OUT_CM], 1e-13);
    }
    loop_done(&r);
    network_destroy(net);
    network_def_done(&network);
    polar_def_done(&polar);
}

static void bad_motions_are_refused(void **state)
{
    (void)state;
    static const struct {
        struct loop_def d;
        const char *pointer;
    } bad[] = {
        {{.frequency = 0.0, .cycles = 1, .steps = 100}, "/motion/frequency_c_v"},
        {{.frequency = (double)NAN, .cycles = 1, .steps = 100}, "/motion/frequency_c_v"},
        {{.frequency = 0.1, .cycles = 0, .steps = 100}, "/motion/cycles"},
        {{.frequency = 0.1, .cycles = 1001, .steps = 100}, "/motion/cycles"},
        {{.frequency = 0.1, .cycles = 1, .steps = 15}, "/motion/steps"},
        {{.frequency = 0.1, .cycles = 1000, .steps = 1000}, "/motion/steps"},
        {{.frequency = 0.1, .cycles = 1, .steps = 100, .mean = 4.0}, "/motion/mean_deg"},
        {{.frequency = 0.1, .cycles = 1, .steps = 100, .amplitude = -0.1}, "/motion/amplitude_deg"},
        {{.frequency = 0.1, .cycles = 1, .steps = 100, .plunge = -0.1}, "/motion/plunge_c"},
        {{.frequency = 0.1, .cycles = 1, .steps = 100, .phase = (double)INFINITY},
         "/motion/phase_deg"},
    };
    static struct failure_list problems;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        problems.count = problems.total = 0;
        loop_def_check(&bad[i].d, &problems);
        assert_int_equal(problems.total, 1);
        assert_string_equal(problems.item[0].pointer, bad[i].pointer);
    }
    struct network_def paper = fixture_network(3, 1.0, 1);
    static double rest[2 * MOTION_ROWS], wild[2 * MOTION_ROWS] = {0.0, (double)NAN};
    const struct loop_motion motion[] = {{.n = 1, .step = 0.1, .value = rest},
                                         {.n = 2, .step = 0.0, .value = rest},
                                         {.n = 2, .step = 0.1, .value = wild},
                                         {.n = 2, .step = 0.1, .value = rest}};
    for (size_t i = 0; i < sizeof motion / sizeof motion[0]; i++) {
        const struct loop_def d = {.motion = &motion[i],
                                   .dynamic = i < 3 ? DYNAMIC_NONE : DYNAMIC_NETWORK,
                                   .network = i < 3 ? NULL : &paper};
        problems.count = problems.total = 0;
        loop_def_check(&d, &problems);
        assert_int_equal(problems.total, 1);
        assert_string_equal(problems.item[0].pointer, "/motion");
    }
    network_def_done(&paper);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attached_loops_are_theodorsens),
        cmocka_unit_test(quasi_steady_loops_are_closed),
        cmocka_unit_test(a_table_is_the_motion_it_holds),
        cmocka_unit_test(the_network_is_added),
        cmocka_unit_test(bad_motions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
