/* Dynamic stall with the shipped polars: steady flow, linearisation, and where the energy goes. */
#include "core/aero/dynamic_stall.h"
#include "api/library.h"
#include "core/aero/attached.h"
#include "core/analysis/loop.h"
#include "core/num.h"
#include "tests/verify/check.h"

#include <complex.h>
#include <stdlib.h>

static const double unit_chord = 1.0, unit_speed = 1.0;
static const char *const shipped[] = {"plate-4pct-channel", "flat-plate-linear"};

static void stall_of(const struct polar_def *def, struct polar **polar, struct dynamic_stall *ds)
{
    if (polar_create(def, polar) != ST_OK ||
        dynamic_stall_init(1, &unit_chord, unit_speed, 0.01, *polar, &def->stall, ds) != ST_OK) {
        abort();
    }
}

/* Largest difference between steady flow and the polar over -180 to 180 degrees and beyond both
 * ends of the plunge axis. */
static double steady_error(const struct polar_def *def)
{
    struct polar *polar = NULL;
    struct dynamic_stall ds;
    double worst = 0.0;
    stall_of(def, &polar, &ds);
    for (double alpha = -NUM_PI; alpha < NUM_PI; alpha += 1.7e-3) {
        for (double plunge = -1.5; plunge <= 1.5; plunge += 0.25) {
            double x[STALL_ARRAYS];
            dynamic_stall_steady(&ds, &alpha, &plunge, x);
            dynamic_stall_step(&ds, &alpha, &plunge, x);
            const struct stall_value got = dynamic_stall_output(&ds, alpha, plunge, x);
            const struct polar_value v = polar_at(polar, alpha, plunge);
            worst = fmax(worst,
                         fmax(fabs(got.cl - v.cl), fmax(fabs(got.cm - v.cm), fabs(got.cd - v.cd))));
        }
    }
    dynamic_stall_done(&ds);
    polar_destroy(polar);
    return worst;
}

static void steady(struct check_list *list, const struct library *lib)
{
    for (size_t i = 0; i < sizeof shipped / sizeof shipped[0]; i++) {
        check_add(list, CHECK_AT_MOST, "", steady_error(library_polar(lib, shipped[i])), 0.0, 1e-13,
                  "property", "%s, -180 to 180 deg: steady flow less polar", shipped[i]);
    }
}

static struct loop_result run(const struct polar_def *polar, enum dynamic_type dynamic, double mean,
                              double amplitude, double frequency)
{
    struct loop_def d;
    struct loop_result r;
    loop_def_defaults(&d);
    d.polar = polar;
    d.dynamic = dynamic;
    d.mean = num_rad(mean);
    d.amplitude = num_rad(amplitude);
    d.frequency = frequency;
    d.cycles = 20;
    if (loop_run(&d, &r) != ST_OK) {
        abort();
    }
    return r;
}

/* First harmonic of a coefficient over the last 400 steps, per unit of pitch. */
static double complex harmonic(const struct loop_result *r, enum loop_quantity k, double amplitude)
{
    enum { STEPS = 400 };
    double complex sum = 0.0;
    for (int i = r->n - STEPS; i < r->n; i++) {
        const double x = 2.0 * NUM_PI * i / STEPS;
        sum += r->value[num_at(i, (int)k, r->n)] * NUM_COMPLEX(sin(x), cos(x));
    }
    return 2.0 / STEPS / num_rad(amplitude) * sum;
}

/* The states at rest at an angle, and the change of derivatives, c_l and c_m with each of them and
 * with the angle, by differences: what the linearised analysis sees. */
struct linear {
    double rate[STALL_STATES][STALL_STATES + 1];       /* d x'/d(x, alpha) */
    double cl[STALL_STATES + 1], cm[STALL_STATES + 1]; /* d c_l, d c_m/d(x, alpha) */
};

static struct linear linearised(const struct polar_def *def, double alpha)
{
    const double h = 1e-6, plunge = 0.0;
    struct polar *polar = NULL;
    struct dynamic_stall ds;
    struct linear out;
    double x[STALL_ARRAYS];
    stall_of(def, &polar, &ds);
    dynamic_stall_steady(&ds, &alpha, &plunge, x);
    for (int k = 0; k <= STALL_STATES; k++) {
        double up[STALL_STATES], down[STALL_STATES];
        struct stall_value value[2];
        for (int side = 0; side < 2; side++) {
            const double shift = side == 0 ? h : -h;
            const double a = alpha + (k == STALL_STATES ? shift : 0.0);
            if (k < STALL_STATES) {
                x[k] += shift;
            }
            dynamic_stall_derivative(&ds, 0, a, plunge, x, side == 0 ? up : down);
            value[side] = dynamic_stall_output(&ds, a, plunge, x);
            if (k < STALL_STATES) {
                x[k] -= shift;
            }
        }
        for (int j = 0; j < STALL_STATES; j++) {
            out.rate[j][k] = (up[j] - down[j]) / (2.0 * h);
        }
        out.cl[k] = (value[0].cl - value[1].cl) / (2.0 * h);
        out.cm[k] = (value[0].cm - value[1].cm) / (2.0 * h);
    }
    dynamic_stall_done(&ds);
    polar_destroy(polar);
    return out;
}

struct response {
    double complex cl, cm;
};

/* Response of c_l and c_m to pitch at omega: the states answer one after the other (each only
 * depends on itself and on those before), then apparent mass and the wake's function. */
static struct response response_of(const struct linear *l, double omega)
{
    static const int order[STALL_STATES] = {STALL_PRESSURE, STALL_BUBBLE, STALL_SEPARATION,
                                            STALL_RESIDUE,  STALL_MOMENT, STALL_LOST};
    const double complex s = NUM_COMPLEX(0.0, omega);
    double complex x[STALL_STATES + 1] = {0}, cl = 0.0, cm = 0.0, wake = 0.5;
    x[STALL_STATES] = 1.0;
    for (int n = 0; n < STALL_STATES; n++) {
        const int j = order[n];
        double complex drive = 0.0;
        for (int k = 0; k <= STALL_STATES; k++) {
            drive += k == j ? 0.0 : l->rate[j][k] * x[k];
        }
        x[j] = drive / (s - l->rate[j][j]);
    }
    for (int k = 0; k <= STALL_STATES; k++) {
        cl += l->cl[k] * x[k];
        cm += l->cm[k] * x[k];
    }
    for (int i = 0; i < ATTACHED_LAGS; i++) {
        const double rate = attached_rate(i) * 2.0;
        wake += attached_share(i) * rate / (rate + s);
    }
    const double complex angle = wake * (1.0 + 0.25 * s);
    return (struct response){.cl = cl * angle + attached_cl_rate() * s,
                             .cm = cm * angle + attached_cm_rate() * s - NUM_PI / 64.0 * s * s};
}

static void linearisation(struct check_list *list, const struct library *lib)
{
    static const double mean[] = {1.3, 5.3, 7.1};
    const struct polar_def *polar = library_polar(lib, shipped[0]);
    for (size_t i = 0; i < sizeof mean / sizeof mean[0]; i++) {
        const struct linear l = linearised(polar, num_rad(mean[i]));
        for (double f = 0.05; f < 0.5; f *= 3.0) {
            struct loop_result r = run(polar, DYNAMIC_STALL, mean[i], 1e-3, f);
            const struct response e = response_of(&l, 2.0 * NUM_PI * f);
            const double complex cl = harmonic(&r, LOOP_CL, 1e-3) / e.cl;
            const double complex cm = harmonic(&r, LOOP_CM, 1e-3) / e.cm;
            check_add(list, CHECK_AT_MOST, "", fmax(cabs(cl - 1.0), cabs(cm - 1.0)), 0.0, 1e-3,
                      "derivatives and output of the frozen state",
                      "pitch 0.001 deg about %g deg, f c/V %g: c_l, c_m, |march/linear - 1|",
                      mean[i], f);
            loop_done(&r);
        }
    }
}

static void energy(struct check_list *list, const struct library *lib)
{
    static const struct {
        double mean, amplitude, frequency;
        bool feeds;
    } row[] = {{8.0, 6.0, 0.06, true},
               {0.0, 1.0, 0.125, false},
               {2.5, 5.0, 0.125, false},
               {5.0, 7.0, 0.25, false}};
    const struct polar_def *plate = library_polar(lib, shipped[0]);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct loop_result r =
            run(plate, DYNAMIC_STALL, row[i].mean, row[i].amplitude, row[i].frequency);
        const double sign = row[i].feeds ? 1.0 : -1.0;
        check_add(list, CHECK_AT_LEAST, "", sign * r.work_pitch, 0.0, 1e-4,
                  "sign of the flow computation, data/cfd",
                  "%g deg, pitch %g deg, f c/V %g: work %s", row[i].mean, row[i].amplitude,
                  row[i].frequency, row[i].feeds ? "fed" : "taken");
        loop_done(&r);
    }
    struct loop_result attached = run(plate, DYNAMIC_ATTACHED, 8.0, 6.0, 0.06);
    check_add(list, CHECK_AT_LEAST, "", -attached.work_pitch, 0.0, 1e-4, "property",
              "8 deg, pitch 6 deg, f c/V 0.06, model attached: work taken, no stall flutter");
    loop_done(&attached);
}

static void fill(struct check_list *list)
{
    struct library *lib = NULL;
    struct failure fail;
    if (library_create_builtin(&lib, &fail) != ST_OK) {
        abort();
    }
    steady(list, lib);
    linearisation(list, lib);
    energy(list, lib);
    library_destroy(lib);
}

const struct check_group group_dynamic_stall = {
    .name = "dynamic_stall",
    .title = "Dynamic stall",
    .text = "The model `dynamic_stall` with its default constants. Steady flow is the polar by "
            "construction. A small pitch, marched, is what the derivatives of the frozen states "
            "say. Slow pitch through stall takes energy out of the flow and fast or attached pitch "
            "gives it back, as in the flow computations; LOOPS.md has the loops.",
    .fill = fill,
};
