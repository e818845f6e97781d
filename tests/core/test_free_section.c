/* Sections on springs against closed forms and the typical section of the text books; those in a
 * stalling flow against flow computations are in docs/FREE.md. */
#include "core/analysis/free_section.h"
#include "core/analysis/stability.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

/* A stream without any load but that of apparent mass. */
static struct polar_def nothing(void)
{
    return fixture_linear_polar(0.0, 0.0, 0.0, 1.5);
}

static struct polar_def plate(void)
{
    return fixture_linear_polar(2.0 * NUM_PI, 0.5 * NUM_PI, 0.0, 1.0);
}

static double at(const struct free_section_result *r, enum free_section_quantity k, int i)
{
    return r->value[num_at(i, (int)k, r->n)];
}

static void run(const struct free_section_def *d, struct free_section_result *r)
{
    static struct failure_list problems;
    problems.count = problems.total = 0;
    free_section_def_check(d, &problems);
    assert_int_equal(problems.total, 0);
    assert_ok(free_section_run(d, r));
}

/* Mass centre behind the axis, axis behind mid-chord, a push of both freedoms. */
static struct free_section_def coupled(const struct polar_def *polar)
{
    struct free_section_def d;
    free_section_def_defaults(&d);
    d.polar = polar;
    d.mass = 12.0;
    d.inertia = 1.3;
    d.axis = 0.1;
    d.imbalance = 0.15;
    d.plunge_frequency = 0.11;
    d.pitch_frequency = 0.17;
    d.pitch = 0.02;
    d.plunge_rate = 0.03;
    d.duration = 40.0;
    return d;
}

/* lambda of det(K - lambda M) = 0, the smaller first. */
static void frequencies(const struct free_section_def *d, double omega[2])
{
    const double s = -d->mass * d->imbalance;
    const double kw = d->mass * num_sq(2.0 * NUM_PI * d->plunge_frequency);
    const double kt = d->inertia * num_sq(2.0 * NUM_PI * d->pitch_frequency);
    const double a = d->mass * d->inertia - s * s, b = kw * d->inertia + kt * d->mass;
    const double root = sqrt(b * b - 4.0 * a * kw * kt);
    omega[0] = sqrt((b - root) / (2.0 * a));
    omega[1] = sqrt((b + root) / (2.0 * a));
}

/* Every part of the motion in a vacuum obeys (D^2 + omega_1^2)(D^2 + omega_2^2) x = 0; of values at
 * equal steps: x(t+2h) + x(t-2h) - 2 (c1 + c2) (x(t+h) + x(t-h)) + (2 + 4 c1 c2) x(t) = 0 with
 * c = cos(omega h). Exact for any h. */
static void frequencies_in_a_vacuum_are_exact(void **state)
{
    (void)state;
    struct polar_def polar = nothing();
    const struct free_section_def d = coupled(&polar);
    struct free_section_result r;
    double omega[2];
    frequencies(&d, omega);
    run(&d, &r);
    const int h = 50; /* one c/V */
    const double c1 = cos(omega[0]), c2 = cos(omega[1]);
    for (int i = 2 * h; i + 2 * h < r.n; i++) {
        for (int k = FREE_ALPHA; k <= FREE_PLUNGE; k++) {
            const double *x = r.value + num_at(i, k, r.n);
            const double rest = x[2 * h] + x[-2 * h] - 2.0 * (c1 + c2) * (x[h] + x[-h]) +
                                (2.0 + 4.0 * c1 * c2) * x[0];
            assert_near_abs(rest, 0.0, 1e-12);
        }
    }
    assert_near_abs(at(&r, FREE_ALPHA, 0), 0.02, 1e-15);
    assert_int_equal(r.n, 2001);
    assert_int_equal(r.stop, STOP_DURATION);
    free_section_done(&r);
    polar_def_done(&polar);
}

/* Kinetic and elastic energy, the rates by differences of fourth order. */
static double energy(const struct free_section_def *d, const struct free_section_result *r, int i)
{
    double x[2], rate[2];
    for (int k = 0; k < 2; k++) {
        const double *v = r->value + num_at(i, k == 0 ? FREE_PLUNGE : FREE_ALPHA, r->n);
        const double *theta = r->value + num_at(i, FREE_ALPHA, r->n);
        const double arm = k == 0 ? d->axis : 0.0; /* from mid-chord to the axis */
        x[k] = v[0] - arm * theta[0];
        rate[k] = (8.0 * (v[1] - v[-1]) - (v[2] - v[-2]) -
                   arm * (8.0 * (theta[1] - theta[-1]) - (theta[2] - theta[-2]))) /
                  (12.0 * d->step);
    }
    const double kw = d->mass * num_sq(2.0 * NUM_PI * d->plunge_frequency);
    const double kt = d->inertia * num_sq(2.0 * NUM_PI * d->pitch_frequency);
    return 0.5 * (d->mass * num_sq(rate[0]) + d->inertia * num_sq(rate[1]) + kw * num_sq(x[0]) +
                  kt * num_sq(x[1])) -
           d->mass * d->imbalance * rate[0] * rate[1];
}

static void energy_is_conserved_in_a_vacuum(void **state)
{
    (void)state;
    struct polar_def polar = nothing();
    struct free_section_def d = coupled(&polar);
    struct free_section_result r;
    d.duration = 400.0;
    run(&d, &r);
    const double first = energy(&d, &r, 2);
    assert_true(first > 1e-4);
    for (int i = 2; i + 2 < r.n; i++) {
        assert_near_rel(energy(&d, &r, i), first, 1e-7); /* of the differences */
    }
    free_section_done(&r);
    polar_def_done(&polar);
}

/* One freedom alone swings as exp(-zeta omega t); the still air makes the plunge heavier by
 * pi/4 rho c^2, the pitch by pi/128 rho c^4, and carries no damping but that of the pitch rate. */
static void dampers_and_air_mass_are_those_of_one_freedom(void **state)
{
    (void)state;
    struct polar_def polar = nothing();
    for (int model = 0; model < 2; model++) {
        struct free_section_def d;
        struct free_section_result r;
        free_section_def_defaults(&d);
        d.polar = &polar;
        d.dynamic = model == 0 ? DYNAMIC_NONE : DYNAMIC_ATTACHED;
        d.mass = 3.0;
        d.plunge_frequency = 0.1;
        d.pitch_frequency = 0.3;
        d.plunge_damping = 0.02;
        d.pitch_damping = 0.5;
        d.plunge_rate = 0.1;
        d.duration = 50.0;
        run(&d, &r);
        const double mass = d.mass + (model == 0 ? 0.0 : 0.25 * NUM_PI);
        const double omega0 = 2.0 * NUM_PI * d.plunge_frequency;
        const double omega = omega0 * sqrt(d.mass / mass);
        const double decay = d.plunge_damping * omega0 * d.mass / mass;
        const double swing = sqrt(num_sq(omega) - num_sq(decay));
        for (int i = 0; i < r.n; i++) {
            const double t = at(&r, FREE_TIME, i);
            const double start = d.plunge_rate / swing;
            assert_near_abs(at(&r, FREE_PLUNGE, i), start * exp(-decay * t) * sin(swing * t), 1e-6);
            assert_near_abs(at(&r, FREE_ALPHA, i), 0.0, 1e-12);
        }
        free_section_done(&r);
    }
    polar_def_done(&polar);
}

/* k (theta - rest) = q c_m'(theta): the moment of a linear polar. */
static void settles_at_the_static_equilibrium(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    for (int model = 0; model < 3; model++) {
        static const enum dynamic_type dynamic[3] = {DYNAMIC_NONE, DYNAMIC_ATTACHED, DYNAMIC_STALL};
        struct free_section_def d;
        struct free_section_result r;
        free_section_def_defaults(&d);
        d.polar = &polar;
        d.dynamic = dynamic[model];
        d.plunge_frequency = 0.05;
        d.pitch_frequency = 0.15;
        d.plunge_damping = d.pitch_damping = 0.6;
        d.rest = 0.05;
        d.duration = 400.0;
        run(&d, &r);
        const double kt = d.inertia * num_sq(2.0 * NUM_PI * d.pitch_frequency);
        const double kw = d.mass * num_sq(2.0 * NUM_PI * d.plunge_frequency);
        const double theta = d.rest / (1.0 - 0.25 * NUM_PI / kt);
        const double lift = 0.5 * 2.0 * NUM_PI * theta;
        assert_near_rel(at(&r, FREE_ALPHA, r.n - 1), theta,
                        2e-4); /* lift turns with the incidence */
        assert_near_rel(at(&r, FREE_PLUNGE, r.n - 1), lift / kw * cos(d.rest), 2e-3);
        assert_near_rel(at(&r, FREE_CL, r.n - 1), 2.0 * lift, 2e-4);
        assert_near_rel(at(&r, FREE_CM, r.n - 1), 0.5 * lift, 2e-4);
        free_section_done(&r);
    }
    polar_def_done(&polar);
}

/* The section of Hodges & Pierce, mu = 20, a = -1/5, x = 1/10, r^2 = 6/25, sigma = 2/5, with the
 * chord as unit of length and b omega_theta = 1 for a speed of one: flutter of the linearised
 * system at V/(b omega_theta) = 2.184, omega/omega_theta = 0.649. */
static struct free_section_def hodges(const struct polar_def *polar, double reduced)
{
    struct free_section_def d;
    free_section_def_defaults(&d);
    d.polar = polar;
    d.dynamic = DYNAMIC_ATTACHED;
    d.mass = 5.0 * NUM_PI;
    d.inertia = 0.06 * d.mass;
    d.axis = -0.1;
    d.imbalance = 0.05;
    d.pitch_frequency = 1.0 / (NUM_PI * reduced); /* omega b/V = 1/reduced */
    d.plunge_frequency = 0.4 * d.pitch_frequency;
    d.pitch = 1e-3;
    d.duration = 300.0;
    d.step = 0.01;
    return d;
}

/* Root mean square of the angle over a quarter of the run. */
static double size(const struct free_section_result *r, int quarter)
{
    double sum = 0.0;
    for (int i = quarter * r->n / 4; i < (quarter + 1) * r->n / 4; i++) {
        sum += num_sq(at(r, FREE_ALPHA, i));
    }
    return sqrt(sum);
}

static void typical_section_flutters_where_the_books_say(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    struct free_section_def d = hodges(&polar, 1.0);
    struct model m;
    struct stability_result s;
    assert_ok(free_section_model(&d, &m));
    m.def.kind = CASE_STABILITY;
    m.def.stability.from = 0.2;
    m.def.stability.to = 2.6;
    m.def.stability.count = 25;
    assert_ok(stability_run(&m, NULL, &s));
    assert_near_rel(s.flutter.speed, 2.1839, 0.002);
    assert_near_rel(s.flutter.frequency / d.pitch_frequency, 0.6490, 0.002);
    model_done(&m);
    /* The marches on both sides of it. */
    for (int side = -1; side <= 1; side += 2) {
        struct free_section_result r;
        d = hodges(&polar, s.flutter.speed * (1.0 + 0.02 * side));
        run(&d, &r);
        const double ratio = size(&r, 3) / size(&r, 2);
        assert_true(side < 0 ? ratio < 0.97 : ratio > 1.03);
        free_section_done(&r);
    }
    stability_done(&s);
    polar_def_done(&polar);
}

/* A network that says nothing leaves the steady polar. */
static void a_silent_network_changes_nothing(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    struct network_def net = fixture_network(3, 0.1, 5);
    struct free_section_def d = coupled(&polar);
    struct free_section_result steady, silent;
    for (int i = 0; i < net.n_out; i++) {
        net.out_scale[i] = net.out_offset[i] = 0.0;
    }
    run(&d, &steady);
    d.dynamic = DYNAMIC_NETWORK;
    d.network = &net;
    run(&d, &silent);
    assert_int_equal(silent.n, steady.n);
    assert_memory_equal(silent.value + silent.n, steady.value + steady.n,
                        (size_t)(2 * steady.n) * sizeof *steady.value);
    free_section_done(&steady);
    free_section_done(&silent);
    network_def_done(&net);
    polar_def_done(&polar);
}

/* A spring too soft for the moment of the air lets the section turn away. */
static void divergence_ends_the_march(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    struct free_section_def d = coupled(&polar);
    struct free_section_result r;
    d.imbalance = d.axis = 0.0;
    d.pitch_frequency = 0.05;
    d.duration = 200.0;
    run(&d, &r);
    assert_int_equal(r.stop, STOP_AMPLITUDE);
    assert_true(r.n < 10001);
    assert_true(r.outside_polar > 0);
    free_section_done(&r);
    polar_def_done(&polar);
}

static void refuses_what_is_no_section(void **state)
{
    (void)state;
    struct polar_def polar = plate();
    static struct failure_list problems;
    const struct free_section_def good = coupled(&polar);
    const struct {
        const char *name;
        double value;
    } bad[] = {{"mass", 0.0},
               {"inertia", 0.1},
               {"axis", 1.5},
               {"imbalance", -2.0},
               {"plunge_frequency", 0.0},
               {"pitch_frequency", 11.0},
               {"plunge_damping", -0.01},
               {"pitch_damping", 1.0},
               {"rest_deg", 100.0},
               {"pitch_deg", -100.0},
               {"pitch_rate_deg", 100.0},
               {"plunge", 3.0},
               {"plunge_rate", 2.0},
               {"duration", 1e6},
               {"step", (double)NAN}};
    assert_int_equal(sizeof bad / sizeof bad[0], FREE_SECTION_FIELDS);
    for (int i = 0; i < FREE_SECTION_FIELDS; i++) {
        const struct free_section_field *f = &free_section_fields[i];
        struct free_section_def d = good;
        const double value = f->degrees ? num_rad(bad[i].value) : bad[i].value;
        assert_string_equal(f->name, bad[i].name);
        memcpy((char *)&d + f->offset, &value, sizeof value);
        problems.count = problems.total = 0;
        free_section_def_check(&d, &problems);
        assert_true(problems.total >= 1);
        assert_string_equal(problems.item[0].pointer, bad[i].name);
    }
    polar_def_done(&polar);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frequencies_in_a_vacuum_are_exact),
        cmocka_unit_test(energy_is_conserved_in_a_vacuum),
        cmocka_unit_test(dampers_and_air_mass_are_those_of_one_freedom),
        cmocka_unit_test(settles_at_the_static_equilibrium),
        cmocka_unit_test(typical_section_flutters_where_the_books_say),
        cmocka_unit_test(a_silent_network_changes_nothing),
        cmocka_unit_test(divergence_ends_the_march),
        cmocka_unit_test(refuses_what_is_no_section),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
