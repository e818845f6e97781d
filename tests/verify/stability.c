/* Flutter and divergence of the linearised system: the typical section of the text books, published
 * wings and plates, and the same speeds from time marching. */
#include "core/analysis/stability.h"
#include "core/analysis/damping.h"
#include "core/analysis/equilibrium.h"
#include "core/analysis/free_section.h"
#include "core/coupling/apparent_mass.h"
#include "core/num.h"
#include "core/sim.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct stability_result stability_of(const struct model *m)
{
    struct stability_result r;
    if (stability_run(m, NULL, &r) != ST_OK) {
        abort();
    }
    return r;
}

/* Section of Hodges & Pierce, mu = 20, a = -1/5, x_theta = 1/10, r^2 = 6/25, sigma = 2/5, with the
 * chord as unit of length; omega_theta = 2, so that a speed is one by b omega_theta. */
static void typical_section(struct check_list *list)
{
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, 0.5 * NUM_PI, 0.0, 1.0);
    struct free_section_def s;
    struct model m;
    free_section_def_defaults(&s);
    s.polar = &polar;
    s.dynamic = DYNAMIC_ATTACHED;
    s.mass = 5.0 * NUM_PI;
    s.inertia = 0.06 * s.mass;
    s.axis = -0.1;
    s.imbalance = 0.05;
    s.pitch_frequency = 1.0 / NUM_PI;
    s.plunge_frequency = 0.4 * s.pitch_frequency;
    s.step = 1e-3;
    if (free_section_model(&s, &m) != ST_OK) {
        abort();
    }
    m.def.kind = CASE_STABILITY;
    m.def.stability.from = 0.2;
    m.def.stability.to = 3.2;
    m.def.stability.count = 31;
    struct stability_result r = stability_of(&m);
    check_add(list, CHECK_RELATIVE, "", r.flutter.speed, 2.1839, 0.015, "[C], validation data 3.2",
              "typical section: flutter speed / (b omega_theta)");
    check_add(list, CHECK_RELATIVE, "", r.flutter.frequency / s.pitch_frequency, 0.6490, 0.015,
              "[C], validation data 3.2", "typical section: flutter frequency / omega_theta");
    check_add(list, CHECK_RELATIVE, "", r.divergence.speed, sqrt(0.24 * 20.0 / 0.6), 0.001,
              "closed form: r sqrt(mu/(1 + 2a))", "typical section: divergence / (b omega_theta)");
    check_add(list, CHECK_ABSOLUTE, "", r.flutter.damping, 0.0, 2e-6, "property",
              "typical section: damping ratio at the flutter speed");
    stability_done(&r);
    model_done(&m);
    polar_def_done(&polar);
}

/* -- published wings */

/* Start of a march next to its equilibrium: a push of `size` in the first modes. */
static void start_near_equilibrium(double size, struct case_def *def)
{
    struct model m;
    struct workspace w;
    double residual = 0.0;
    built_model(def, &m);
    if (workspace_init(&m, &w) != ST_OK || equilibrium_solve(&m, &w, &residual) != ST_OK) {
        abort();
    }
    def->solver.start = START_AMPLITUDES;
    def->solver.n_amplitude = m.n_mode;
    apparent_mass_to_vacuo(&m, w.q, def->solver.amplitude);
    for (int j = 0; j < 3 && j < m.n_mode; j++) {
        def->solver.amplitude[j] += size;
    }
    workspace_done(&w);
    model_done(&m);
}

/* Damping ratio of the least damped root in the twist of such a march. */
static double marched_damping(const struct case_def *def, double size, double speed)
{
    static struct case_def march; /* large */
    march = *def;
    march.kind = CASE_SIMULATION;
    march.flow.speed = speed;
    march.output.n_channel = 0;
    start_near_equilibrium(size, &march);
    struct sim *sim = built_run(&march);
    const struct damping_result *d = &sim_result(sim)->tip_twist;
    double least = (double)NAN;
    for (int i = 0; i < d->n_root; i++) {
        if (d->root[i].frequency_hz > 0.0 && d->root[i].amplitude > 0.02 * d->root[0].amplitude) {
            least = fmin(isnan(least) ? HUGE_VAL : least, d->root[i].ratio);
        }
    }
    sim_destroy(sim);
    return least;
}

/* Speed at which the marched damping changes sign, between two that bracket it. */
static double marched_flutter(const struct case_def *def, double size, double stable,
                              double unstable)
{
    double a = stable, b = unstable;
    double fa = marched_damping(def, size, a), fb = marched_damping(def, size, b);
    for (int i = 0; i < 3; i++) {
        const double guess = a - fa * (b - a) / (fb - fa), f = marched_damping(def, size, guess);
        if (f > 0.0) {
            a = guess;
            fa = f;
        } else {
            b = guess;
            fb = f;
        }
    }
    return a - fa * (b - a) / (fb - fa);
}

struct published_wing {
    const char *name, *file, *source;
    double flutter, omega, divergence;
    double time_step, duration;
};

static void wings(struct check_list *list)
{
    static const struct published_wing wing[] = {
        {"Goland wing", "goland-stability", "[C], validation data 3.3", 137.2, 70.1, 252.7, 2e-4,
         2.0},
        {"16 m wing", "wing-16m-stability", "[C], validation data 3.4", 32.5, 22.4, 37.154, 1e-3,
         8.0},
    };
    for (size_t i = 0; i < sizeof wing / sizeof wing[0]; i++) {
        const struct published_wing *w = &wing[i];
        struct built_case *c = built_shipped(w->file);
        static struct case_def def; /* large */
        def = *built_case_def(c);
        struct model m;
        built_model(&def, &m);
        struct stability_result r = stability_of(&m);
        check_add(list, CHECK_RELATIVE, "m/s", r.flutter.speed, w->flutter, 0.015, w->source,
                  "%s: flutter speed", w->name);
        check_add(list, CHECK_RELATIVE, "rad/s", 2.0 * NUM_PI * r.flutter.frequency, w->omega,
                  0.015, w->source, "%s: flutter frequency", w->name);
        check_add(list, CHECK_RELATIVE, "m/s", r.divergence.speed, w->divergence, 0.005, w->source,
                  "%s: divergence speed", w->name);
        def.solver.time_step = w->time_step;
        def.solver.duration = w->duration;
        check_add(list, CHECK_RELATIVE, "m/s",
                  marched_flutter(&def, 1e-3, 0.97 * r.flutter.speed, 1.03 * r.flutter.speed),
                  r.flutter.speed, 0.01, "own eigenvalue",
                  "%s: flutter speed from time marching and the matrix pencil", w->name);
        stability_done(&r);
        model_done(&m);
        built_release(c);
    }
}

/* -- stall, and beams whose chord changes */

/* The paper's beam at 5 degrees with the channel polar and dynamic stall: the eigenvalue about the
 * stalled equilibrium against marches of tiny amplitude about it. */
static void stalled(struct check_list *list)
{
    struct built_case *c = built_shipped("paper-beam");
    static struct case_def def; /* large */
    def = *built_case_def(c);
    struct model m;
    def.kind = CASE_STABILITY;
    def.aero.dynamic = DYNAMIC_STALL;
    def.stability.from = 6.0;
    def.stability.to = 16.0;
    def.stability.count = 11;
    def.solver.duration = 1.5;
    def.solver.plunge_max = 10.0; /* the linear beam goes on */
    built_model(&def, &m);
    struct stability_result r = stability_of(&m);
    check_add(list, CHECK_RELATIVE, "m/s",
              marched_flutter(&def, 1e-6, 0.99 * r.flutter.speed, 1.01 * r.flutter.speed),
              r.flutter.speed, 0.01, "own eigenvalue",
              "paper's beam at 5 deg, dynamic stall: flutter speed of small amplitudes, marched");
    check_add(
        list, CHECK_ABSOLUTE, "", r.flutter.stalled, 1.0, 0.0, "property",
        "paper's beam at 5 deg, dynamic stall: flutters with stations beyond the linear range");
    stability_done(&r);
    model_done(&m);
    built_release(c);
}

/* Lags of the modes (one chord) against lags of the stations (the same wing with a chord that
 * changes by less than anyone can see). */
static void wake_of_stations(struct check_list *list)
{
    struct built_case *c = built_shipped("goland-stability");
    static struct case_def def; /* large */
    def = *built_case_def(c);
    struct station_def station[2] = {{.z = 0.0, .section = def.beam.section},
                                     {.z = def.beam.length, .section = def.beam.section}};
    struct model uniform, tapered;
    built_model(&def, &uniform);
    station[1].section.properties.chord *= 1.0 + 1e-9;
    def.beam.n_station = 2;
    def.beam.station = station;
    built_model(&def, &tapered);
    struct stability_result a = stability_of(&uniform), b = stability_of(&tapered);
    check_add(list, CHECK_RELATIVE, "m/s", b.flutter.speed, a.flutter.speed, 2e-6, "property",
              "Goland wing: flutter with lags of the stations, against lags of the modes");
    stability_done(&a);
    stability_done(&b);
    model_done(&uniform);
    model_done(&tapered);
    built_release(c);
}

/* -- the plates of Hollowell and Dugundji */

struct plate {
    const char *name;
    double angle[3];           /* outer ply first, negative towards the leading edge [deg] */
    bool diverges;             /* the instability that comes first */
    double theory, experiment; /* of that instability [m/s], 0: not known */
};

/* Strip theory with the slope 2 pi AR/(AR + 2), or the lifting line with 2 pi. */
static struct stability_result plate_stability(const struct plate *p, bool lifting_line)
{
    const double slope = 2.0 * NUM_PI * (lifting_line ? 1.0 : 8.0 / 10.0);
    struct polar_def polar = fixture_linear_polar(slope, 0.25 * slope, 0.0, 0.5);
    struct case_def def;
    struct model m;
    case_def_defaults(&def);
    def.kind = CASE_STABILITY;
    def.beam.length = 0.305;
    def.aero.polar = &polar;
    def.aero.dynamic = DYNAMIC_ATTACHED;
    def.aero.lifting_line = lifting_line;
    def.solver.modes = 6;
    def.stability.from = 3.0;
    def.stability.to = 60.0;
    def.stability.count = 58;
    struct shape *shape = &def.beam.section.shape;
    shape->width = 0.0762;
    shape->layup[0].n_ply = 6;
    for (int i = 0; i < 6; i++) {
        const int from_outside = i < 3 ? i : 5 - i;
        shape->layup[0].ply[i] = (struct ply){.material = {.name = "AS1/3501-6",
                                                           .e_l = 98e9,
                                                           .e_t = 7.9e9,
                                                           .g_lt = 5.6e9,
                                                           .g_tt = 2.8e9,
                                                           .nu_lt = 0.28,
                                                           .nu_tt = 0.4,
                                                           .density = 1520.0},
                                              .angle = num_rad(p->angle[from_outside]),
                                              .thickness = 0.134e-3};
    }
    built_model(&def, &m);
    const struct stability_result r = stability_of(&m);
    model_done(&m);
    polar_def_done(&polar);
    return r;
}

/* Speed of the instability that comes first; its kind must be the published one. */
static double first_speed(const struct stability_result *r, bool diverges)
{
    const bool flutter_first =
        r->flutter.onset != ONSET_NONE &&
        (r->divergence.onset == ONSET_NONE || r->flutter.speed < r->divergence.speed);
    if (flutter_first == diverges) {
        return (double)NAN;
    }
    return diverges ? r->divergence.speed : r->flutter.speed;
}

static void plates(struct check_list *list)
{
    static const struct plate plate[] = {
        {"[0_2/90]s", {0, 0, 90}, false, 21.0, 25.0},
        {"[-+45/0]s wash-out", {-45, 45, 0}, false, 40.1, 0.0},
        {"[-45_2/0]s wash-out", {-45, -45, 0}, false, 27.8, 28.0},
        {"[45_2/0]s wash-in", {45, 45, 0}, true, 10.0, 12.5},
        {"[-30_2/0]s wash-out", {-30, -30, 0}, false, 27.8, 27.0},
        {"[30_2/0]s wash-in", {30, 30, 0}, true, 10.0, 11.7},
    };
    static const char *const source = "Hollowell & Dugundji 1984, from memory";
    for (size_t i = 0; i < sizeof plate / sizeof plate[0]; i++) {
        const struct plate *p = &plate[i];
        struct stability_result strip = plate_stability(p, false);
        struct stability_result line = plate_stability(p, true);
        const char *kind = p->diverges ? "divergence" : "flutter";
        check_add(list, CHECK_RELATIVE, "m/s", first_speed(&strip, p->diverges), p->theory, 0.2,
                  source, "plate %s, strip theory: %s first, against theory", p->name, kind);
        if (p->experiment > 0.0) {
            check_add(list, CHECK_RELATIVE, "m/s", first_speed(&strip, p->diverges), p->experiment,
                      0.2, source, "plate %s, strip theory: against experiment", p->name);
            check_add(list, CHECK_RELATIVE, "m/s", first_speed(&line, p->diverges), p->experiment,
                      0.2, source, "plate %s, lifting line: against experiment", p->name);
        }
        const bool wash_out = strstr(p->name, "wash-out") != NULL;
        if (wash_out) {
            check_add(list, CHECK_ABSOLUTE, "", strip.divergence.onset == ONSET_NONE, 1.0, 0.0,
                      "published: wash-out does not diverge", "plate %s: no divergence to 60 m/s",
                      p->name);
        }
        stability_done(&strip);
        stability_done(&line);
    }
}

static void fill(struct check_list *list)
{
    typical_section(list);
    wings(list);
    stalled(list);
    wake_of_stations(list);
    plates(list);
}

const struct check_group group_stability = {
    .name = "stability",
    .title = "Flutter and divergence",
    .text =
        "Kind `stability`: the system linearised about its static equilibrium, `attached` "
        "aerodynamics. The typical section is a = -1/5, e = -1/10, mu = 20, r^2 = 6/25, sigma = "
        "2/5; its reference is the root of the flutter determinant with Theodorsen's function. The "
        "wings are the shipped cases `goland-stability` (air of 1.225 kg/m^3) and "
        "`wing-16m-stability`, strip theory with 2 pi; their references are strip theory with "
        "Theodorsen's function by p-k iteration. Time marching starts from small amplitudes of the "
        "first two modes. The plates are 305 x 76.2 mm, 6 plies of 0.134 mm, in strip theory with "
        "2 pi AR/(AR + 2), AR 8, and with the lifting line; which instability comes first is part "
        "of the check. Their published numbers are quoted from memory of the paper, the one for "
        "[45/-45/0]s is for fibres that wash out; its experiment saw nothing below 32 m/s.",
    .fill = fill,
};
