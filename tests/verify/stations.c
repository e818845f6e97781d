/* Beams that vary along the span and carry masses: taper, jumps, blended layups, tip mass, offset
 * store, gravity, turned sections. Isotropic strips against closed forms. */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdlib.h>

enum { BENDING = 0 };

static const double length = 1.2, chord = 0.06, thickness = 0.003, modulus = 70e9, density = 2700.0,
                    gravity = 9.80665;

static double flap_stiffness(double b, double h)
{
    return modulus * b * h * h * h / 12.0;
}

/* The strip of this file, warping free at the root, no load. */
static void draw_strip(struct case_def *out)
{
    const struct material m = fixture_isotropic(modulus, 0.3, density);
    fixture_strip(&m, length, chord, thickness, out);
    out->kind = CASE_STATIC;
}

static void load_tip(struct case_def *def, const struct beam_load *load)
{
    def->loads.n_point = 1;
    def->loads.point[0] = (struct point_load_def){.z = def->beam.length, .load = *load};
}

/* Two stations, the outer of other chord and thickness. */
static void draw_taper(double chord_ratio, double thickness_ratio, struct station_def station[2],
                       struct case_def *out)
{
    draw_strip(out);
    station[0] = (struct station_def){.z = 0.0, .section = out->beam.section};
    station[1] = (struct station_def){.z = length, .section = out->beam.section};
    station[1].section.shape.width *= chord_ratio;
    station[1].section.shape.layup[0].ply[0].thickness *= thickness_ratio;
    draw_stations(out, 2, station);
}

/* int_0^1 y^2 / (r + (1 - r) y) dy: deflection under a tip load of a beam whose EI falls linearly
 * to the share r, over P L^3 / EI(0). */
static double linear_taper(double r)
{
    const double a = 1.0 - r;
    return (0.5 * a * a - a * r - r * r * log(r)) / (a * a * a);
}

/* int_0^1 y^2 / (r + (1 - r) y)^3 dy: thickness falls linearly, EI with its cube. */
static double cubic_taper(double r)
{
    const double a = 1.0 - r;
    /* y = (q - r)/a, q from r to 1: int (q - r)^2 / (a^3 q^3) dq. */
    return (-log(r) - 2.0 * (1.0 - r) + 0.5 * (1.0 - r * r)) / (a * a * a);
}

static void taper(struct check_list *list)
{
    static const double ratio[] = {0.75, 0.5, 0.25};
    const struct beam_load up = {.force = {0.0, 1.0, 0.0}};
    const double unit = length * length * length / flap_stiffness(chord, thickness);
    static struct station_def station[2];
    static struct case_def def;
    for (size_t i = 0; i < sizeof ratio / sizeof ratio[0]; i++) {
        draw_taper(ratio[i], 1.0, station, &def);
        load_tip(&def, &up);
        check_add(list, CHECK_RELATIVE, "m", built_tip(&def).v, unit * linear_taper(ratio[i]), 1e-5,
                  "closed form", "strip, chord tapered to %g, 1 N at the tip: plunge", ratio[i]);
        draw_taper(1.0, ratio[i], station, &def);
        load_tip(&def, &up);
        check_add(list, CHECK_RELATIVE, "m", built_tip(&def).v, unit * cubic_taper(ratio[i]), 1e-4,
                  "closed form", "strip, thickness tapered to %g, 1 N at the tip: plunge",
                  ratio[i]);
    }
}

/* Two stations at one place: the inner part has twice the thickness. */
static void jump(struct check_list *list)
{
    static struct station_def station[4];
    static struct case_def def;
    const double at = 0.43, inner = flap_stiffness(chord, 2.0 * thickness);
    const double outer = flap_stiffness(chord, thickness), rest = length - at;
    const struct beam_load up = {.force = {0.0, 1.0, 0.0}};
    draw_strip(&def);
    static const double z[4] = {0.0, 0.43, 0.43, 1.2};
    for (int i = 0; i < 4; i++) {
        station[i] = (struct station_def){.z = z[i], .section = def.beam.section};
        station[i].section.shape.layup[0].ply[0].thickness *= i < 2 ? 2.0 : 1.0;
    }
    draw_stations(&def, 4, station);
    load_tip(&def, &up);
    check_add(list, CHECK_RELATIVE, "m", built_tip(&def).v,
              (pow(length, 3) - pow(rest, 3)) / (3.0 * inner) + pow(rest, 3) / (3.0 * outer), 1e-9,
              "closed form", "strip, inner 0.43 m twice as thick, 1 N at the tip: plunge");
}

/* First roots of 1 + cos b cosh b + mu b (cos b sinh b - sin b cosh b) = 0: cantilever with a point
 * mass of mu times its own at the tip. */
static double tip_mass_root(double mu, double from, double to)
{
    for (int i = 0; i < 200; i++) {
        const double b = 0.5 * (from + to);
        const double f = 1.0 + cos(b) * cosh(b) + mu * b * (cos(b) * sinh(b) - sin(b) * cosh(b));
        const double f0 = 1.0 + cos(from) * cosh(from) +
                          mu * from * (cos(from) * sinh(from) - sin(from) * cosh(from));
        *(f * f0 > 0.0 ? &from : &to) = b;
    }
    return 0.5 * (from + to);
}

static void tip_mass(struct check_list *list)
{
    static const double mu[] = {0.2, 1.0, 5.0};
    static const double bracket[2][2] = {{0.1, 2.0}, {3.0, 4.8}};
    const double per_length = density * chord * thickness;
    static struct case_def def;
    for (size_t i = 0; i < sizeof mu / sizeof mu[0]; i++) {
        struct model m;
        draw_strip(&def);
        def.kind = CASE_MODES;
        def.solver.modes = 6;
        def.beam.n_mass = 1;
        def.beam.mass[0] = (struct beam_mass){.z = length, .mass = mu[i] * per_length * length};
        built_model(&def, &m);
        for (int k = 0; k < 2; k++) {
            const double b = tip_mass_root(mu[i], bracket[k][0], bracket[k][1]) / length;
            const double exact =
                b * b * sqrt(flap_stiffness(chord, thickness) / per_length) / (2.0 * NUM_PI);
            check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, BENDING, k), exact, 1e-4,
                      "closed form", "strip with %g of its mass at the tip: bending %d", mu[i],
                      k + 1);
        }
        model_done(&m);
    }
}

/* Its own weight: q L^4 / (8 EI), q L^3 / (6 EI), reactions. A store beside the axis twists. */
static void weight(struct check_list *list)
{
    const double q = -gravity * density * chord * thickness, mass = 0.3, aside = 0.05, at = 0.77;
    const double ei = flap_stiffness(chord, thickness);
    const double gj = modulus / 2.6 * chord * pow(thickness, 3) / 3.0;
    static struct case_def def;
    struct model m;
    struct static_result r;
    draw_strip(&def);
    def.beam.gravity[1] = -gravity;
    const struct beam_motion bare = built_tip(&def);
    def.beam.n_mass = 1;
    def.beam.mass[0] = (struct beam_mass){.z = at, .x = aside, .mass = mass};
    built_model(&def, &m);
    built_answer(&m, &r);
    const double w = -gravity * mass, all = q * length + w;
    const struct {
        const char *what, *unit;
        double value, reference, tolerance;
    } row[] = {
        {"weight: tip plunge q L^4/(8 EI)", "m", bare.v, q * pow(length, 4) / (8.0 * ei), 1e-6},
        {"weight: tip slope q L^3/(6 EI)", "rad", -bare.phi, q * pow(length, 3) / (6.0 * ei), 1e-6},
        {"weight and store: reaction force", "N", r.reaction_force[1], -all, 1e-9},
        {"weight and store: reaction moment about x", "N m", r.reaction_moment[0],
         0.5 * q * length * length + w * at, 1e-9},
        {"store beside the axis: reaction torque", "N m", r.reaction_moment[2], -w * aside, 1e-9},
        {"store beside the axis: tip twist", "deg", num_deg(r.tip.theta),
         num_deg(w * aside * at / gj), 0.002},
        {"weight and store: tip plunge", "m", r.tip.v,
         q * pow(length, 4) / (8.0 * ei) + w * at * at * (3.0 * length - at) / (6.0 * ei), 1e-6},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        check_add(list, CHECK_RELATIVE, row[i].unit, row[i].value, row[i].reference,
                  row[i].tolerance, "closed form", "strip, %s", row[i].what);
    }
    statics_done(&r);
    model_done(&m);
}

/* A strip turned by 90 degrees is stiff against an upward force; one turned linearly along the span
 * bends both ways: EI_yy(z) of the turned axes in 1/EI = cos^2/EI_flap + sin^2/EI_lag. */
static void turned(struct check_list *list)
{
    static struct station_def station[2];
    static struct case_def def;
    const double flap = flap_stiffness(chord, thickness), lag = flap_stiffness(thickness, chord);
    const double force = 10.0, cube = length * length * length;
    const struct beam_load up = {.force = {0.0, force, 0.0}};
    draw_strip(&def);
    def.beam.section.shape.turn = 0.5 * NUM_PI;
    load_tip(&def, &up);
    check_add(list, CHECK_RELATIVE, "m", built_tip(&def).v, force * cube / (3.0 * lag), 1e-6,
              "closed form", "strip on edge, 10 N upward at the tip: plunge");
    draw_taper(1.0, 1.0, station, &def);
    station[1].section.shape.turn = num_rad(30.0);
    load_tip(&def, &up);
    /* v = P int (L-z)^2 (cos^2/EI_flap + sin^2/EI_lag) dz with the turn a z; int y^2 cos^2 a(1-y)
     * dy on [0, 1] is 1/6 + int y^2 cos(2 a (1-y))/2 dy. */
    const double a2 = 2.0 * num_rad(30.0);
    const double wave = 0.5 * (2.0 / (a2 * a2) - 2.0 * sin(a2) / (a2 * a2 * a2));
    const double cosine = 1.0 / 6.0 + wave, sine = 1.0 / 6.0 - wave;
    check_add(list, CHECK_RELATIVE, "m", built_tip(&def).v,
              force * cube * (cosine / flap + sine / lag), 1e-3, "closed form",
              "strip twisted by 30 deg along the span, 10 N upward: plunge");
}

/* A layup blended from 30 to 30 deg over stations is the plain beam, with any number of them. */
static void blended(struct check_list *list)
{
    static struct station_def station[3];
    static struct case_def def;
    struct model plain, blend;
    fixture_paper_beam(-30.0, NULL, &def);
    def.kind = CASE_MODES;
    built_model(&def, &plain);
    for (int i = 0; i < 3; i++) {
        station[i] =
            (struct station_def){.z = 0.5 * i * def.beam.length, .section = def.beam.section};
    }
    draw_stations(&def, 3, station);
    built_model(&def, &blend);
    for (int j = 0; j < 4; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", built_hz(&blend, j), built_hz(&plain, j), 1e-9,
                  "property", "paper beam, three equal stations: mode %d", j + 1);
    }
    model_done(&plain);
    model_done(&blend);
}

static void fill(struct check_list *list)
{
    taper(list);
    jump(list);
    tip_mass(list);
    weight(list);
    turned(list);
    blended(list);
}

const struct check_group group_stations = {
    .name = "stations",
    .title = "Taper, jumps, masses, gravity",
    .text =
        "Isotropic strip, L 1.2 m, chord 60 mm, thickness 3 mm, 16 elements. Sections are asked "
        "for at the four Gauss points of an element, so taper is followed inside it; what is "
        "left of the error is that of cubic displacements.",
    .fill = fill,
};
