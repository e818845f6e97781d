/* Flat sections whose shape the clamp holds: cantilever plates, long beams, mesh. */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdlib.h>

static const double chord = 0.05, modulus = 70e9, poisson = 0.3, density = 2700.0;

/* w a^2 sqrt(rho h/D) of the clamped-free thin plate of length a and width b, nu = 0.3. */
static const struct plate {
    double aspect; /* a/b */
    int n;
    double value[4], tolerance;
    const char *source;
} plates[] = {
    {2.0,
     4,
     {3.4394, 14.803, 21.435, 48.181},
     0.01,
     "thin plate, Ritz with 14 x 10 Legendre polynomials"},
    {2.5, 4, {3.4562, 17.988, 21.563, 57.458}, 0.01, "thin plate, Leissa 1973 (Ritz, 36 terms)"},
    {3.0,
     4,
     {3.4193, 21.138, 21.364, 60.023},
     0.01,
     "thin plate, Ritz with 14 x 10 Legendre polynomials"},
    {5.0,
     4,
     {3.3978, 21.269, 33.917, 59.678},
     0.01,
     "thin plate, Ritz with 14 x 10 Legendre polynomials"},
};

static void draw_plate(double aspect, enum chordwise_curvature chordwise, struct case_def *out)
{
    const struct material m = fixture_isotropic(modulus, poisson, density);
    fixture_strip(&m, aspect * chord, chord, 0.002 * chord, out);
    out->beam.elements = 32;
    out->beam.root_warping = ROOT_WARPING_RESTRAINED;
    out->beam.section.shape.chordwise = chordwise;
}

static void compare_plates(struct check_list *list)
{
    static struct case_def def;
    for (size_t i = 0; i < sizeof plates / sizeof plates[0]; i++) {
        const struct plate *p = &plates[i];
        const double h = 0.002 * chord, length = p->aspect * chord;
        const double d = modulus * h * h * h / (12.0 * (1.0 - num_sq(poisson)));
        struct model m;
        draw_plate(p->aspect, CHORDWISE_CLAMPED, &def);
        built_model(&def, &m);
        for (int j = 0; j < p->n; j++) {
            const double value =
                2.0 * NUM_PI * built_hz(&m, j) * num_sq(length) * sqrt(density * h / d);
            check_add(list, CHECK_RELATIVE, "", value, p->value[j], p->tolerance, p->source,
                      "plate, length/width %g: mode %d", p->aspect, j + 1);
        }
        model_done(&m);
    }
}

static double first_hz(const struct case_def *def)
{
    struct model m;
    built_model(def, &m);
    const double f = built_hz(&m, 0);
    model_done(&m);
    return f;
}

/* The clamp reaches as far as the width: what it stiffens falls with width over length. */
static void long_beams(struct check_list *list)
{
    static const double aspects[] = {20.0, 200.0};
    static struct case_def def;
    double rise[2];
    for (int i = 0; i < 2; i++) {
        double f[2];
        for (int clamped = 0; clamped < 2; clamped++) {
            draw_plate(aspects[i], clamped ? CHORDWISE_CLAMPED : CHORDWISE_FREE, &def);
            f[clamped] = first_hz(&def);
        }
        rise[i] = f[1] / f[0] - 1.0;
    }
    check_add(list, CHECK_RELATIVE, "", rise[0] / rise[1], aspects[1] / aspects[0], 0.05,
              "property: of the order of width over length",
              "length/width 20 and 200, bending 1 of clamped over free chord: ratio of the rises "
              "(%.2g, %.2g)",
              rise[0], rise[1]);
}

/* A clamp that lets the section warp and bend across leaves what a free chord has, but for the
 * twist that a curvature across brings where it changes along the span: more in every higher mode.
 */
static void free_root(struct check_list *list)
{
    static struct model m[2];
    static struct case_def def;
    for (int clamped = 0; clamped < 2; clamped++) {
        fixture_minguet_strip(&def);
        def.beam.section.shape.chordwise = clamped ? CHORDWISE_CLAMPED : CHORDWISE_FREE;
        def.beam.root_warping = ROOT_WARPING_FREE;
        built_model(&def, &m[clamped]);
    }
    for (int j = 0; j < 3; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", built_hz(&m[1], j), built_hz(&m[0], j), 0.002,
                  "the same beam with a free chord",
                  "Table-2 beam, nothing held at the root, clamped chord: mode %d", j + 1);
    }
    model_done(&m[0]);
    model_done(&m[1]);
}

/* The paper's beam with all that the clamp may hold. */
static void draw_soft(struct case_def *def)
{
    fixture_paper_beam(-45.0, NULL, def);
    def->kind = CASE_MODES;
    def->solver.modes = 5;
    def->beam.section.shape.chordwise = CHORDWISE_CLAMPED;
    def->beam.section.shape.wall_shear = WALL_SHEAR_FLEXIBLE;
    def->beam.section.shear = SHEAR_RETAINED;
}

static void turned(struct check_list *list)
{
    static struct case_def def;
    static struct model m[2];
    for (int k = 0; k < 2; k++) {
        draw_soft(&def);
        def.beam.section.shape.turn = k * num_rad(30.0);
        built_model(&def, &m[k]);
    }
    for (int j = 0; j < 5; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", built_hz(&m[1], j), built_hz(&m[0], j), 1e-7,
                  "property", "paper beam, -45 deg, all amplitudes, turned by 30 deg: mode %d",
                  j + 1);
    }
    model_done(&m[0]);
    model_done(&m[1]);
}

static void mesh(struct check_list *list)
{
    static struct case_def def;
    static struct model coarse, fine;
    draw_soft(&def);
    def.beam.elements = 16;
    built_model(&def, &coarse);
    def.beam.elements = 128;
    built_model(&def, &fine);
    for (int j = 0; j < 5; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", built_hz(&coarse, j), built_hz(&fine, j), 0.001,
                  "128 elements", "paper beam, -45 deg, all amplitudes, 16 elements: mode %d",
                  j + 1);
    }
    model_done(&coarse);
    model_done(&fine);
}

static void fill(struct check_list *list)
{
    compare_plates(list);
    long_beams(list);
    free_root(list);
    turned(list);
    mesh(list);
}

const struct check_group group_flat = {
    .name = "flat",
    .title = "Flat sections that bend across",
    .text =
        "Sections with `\"chordwise_curvature\": \"clamped\"`: the curvature across is a field "
        "along the span that the clamp holds. Plates are isotropic strips, 1/500 of their width "
        "thick, 32 elements, as frequencies w a^2 sqrt(rho h/D) of length a. Ritz series of few "
        "beam functions, as "
        "Leissa's, are up to 0.8 % high.",
    .fill = fill,
};
