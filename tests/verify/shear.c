/* Retained shear: the Timoshenko cantilever, statically and in vibration, and no locking. */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

enum { BENDING = 0, LAG = 1 };

static const double chord = 0.08, modulus = 70e9, poisson = 0.3, density = 2700.0;

static double shear_modulus(void)
{
    return modulus / (2.0 * (1.0 + poisson));
}

static void draw_strip(double length, double thickness, enum shear_model shear,
                       struct case_def *out)
{
    const struct material m = fixture_isotropic(modulus, poisson, density);
    fixture_strip(&m, length, chord, thickness, out);
    out->beam.section.shape.contour_elements = 32;
    out->beam.section.shear = shear;
}

/* Tip deflection of a force up and forward: P L^3/(3 EI) + P L/(5/6 G A). */
static void deflection(struct check_list *list)
{
    static const double slenderness[] = {2.0, 5.0, 20.0};
    const double h = 0.02, area = chord * h, k = 5.0 / 6.0 * shear_modulus() * area;
    static struct case_def def;
    for (size_t i = 0; i < sizeof slenderness / sizeof slenderness[0]; i++) {
        const double length = slenderness[i] * chord;
        draw_strip(length, h, SHEAR_RETAINED, &def);
        def.kind = CASE_STATIC;
        def.loads.n_point = 1;
        def.loads.point[0] =
            (struct point_load_def){.z = length, .load = {.force = {1000.0, 1000.0, 0.0}}};
        const struct beam_motion tip = built_tip(&def);
        const double cube = length * length * length;
        check_add(list, CHECK_RELATIVE, "m", tip.u,
                  1000.0 * (4.0 * cube / (modulus * h * pow(chord, 3)) + length / k), 1e-5,
                  "closed form, Timoshenko", "strip, L = %g c, 1 kN forward: tip", slenderness[i]);
        check_add(list, CHECK_RELATIVE, "m", tip.v,
                  1000.0 * (4.0 * cube / (modulus * chord * pow(h, 3)) + length / k), 1e-5,
                  "closed form, Timoshenko", "strip, L = %g c, 1 kN upward: tip", slenderness[i]);
    }
}

/* Frequency equation of the clamped-free Timoshenko beam (Huang 1961): b2 = rho A L^4 w^2/EI,
 * r2 = I/(A L^2), s2 = EI/(k G A L^2). */
static double huang(double b2, double r2, double s2)
{
    const double sum = r2 + s2, root = sqrt(num_sq(r2 - s2) + 4.0 / b2), b = sqrt(b2);
    const double alpha = b * sqrt(0.5 * (root - sum)), beta = b * sqrt(0.5 * (root + sum));
    return 2.0 + (b2 * num_sq(r2 - s2) + 2.0) * cosh(alpha) * cos(beta) -
           b * sum / sqrt(1.0 - b2 * r2 * s2) * sinh(alpha) * sin(beta);
}

/* Angular frequency of mode `number` (0 first) of a beam of length l, stiffness ei, shear stiffness
 * k, mass m and rotary inertia mr2 per length. */
static double timoshenko(double ei, double k, double m, double mr2, double l, int number)
{
    const double r2 = mr2 / (m * l * l), s2 = ei / (k * l * l), step = 0.02;
    double b = step, before = huang(b * b, r2, s2);
    for (;;) {
        const double now = huang(num_sq(b + step), r2, s2);
        if (before * now < 0.0 && number-- == 0) {
            break;
        }
        b += step;
        before = now;
    }
    double from = b, to = b + step;
    for (int i = 0; i < 100; i++) {
        const double middle = 0.5 * (from + to);
        *(huang(num_sq(middle), r2, s2) * huang(num_sq(from), r2, s2) > 0.0 ? &from : &to) = middle;
    }
    return from * sqrt(ei / (m * num_sq(l * l)));
}

/* Mode `number` of the stubby strip, lag or bending [Hz]. */
static double stubby(int elements, int share, int number)
{
    static struct case_def def;
    struct model m;
    draw_strip(0.4, 0.02, SHEAR_RETAINED, &def);
    def.solver.modes = 14;
    def.beam.elements = elements;
    built_model(&def, &m);
    const double f = built_frequency(&m, share, number);
    model_done(&m);
    return f;
}

static double stubby_exact(int share, int number)
{
    const double h = 0.02, k = 5.0 / 6.0 * shear_modulus() * chord * h, mass = density * chord * h;
    const double depth = share == LAG ? chord : h, ei = modulus * chord * h * depth * depth / 12.0;
    return timoshenko(ei, k, mass, mass * depth * depth / 12.0, 0.4, number) / (2.0 * NUM_PI);
}

static void frequencies(struct check_list *list)
{
    static const char *const name[2] = {"bending", "lag"};
    static const char *const source = "closed form, Huang 1961";
    for (int share = BENDING; share <= LAG; share++) {
        for (int j = 0; j < 3; j++) {
            check_add(list, CHECK_RELATIVE, "Hz", stubby(64, share, j), stubby_exact(share, j),
                      2e-4, source, "strip, L = 5 c = 20 h, 64 elements: %s %d", name[share],
                      j + 1);
        }
        check_add(list, CHECK_RELATIVE, "Hz", stubby(16, share, 0), stubby_exact(share, 0), 2e-4,
                  source, "strip, L = 5 c = 20 h, 16 elements: %s 1", name[share]);
        const double coarse = stubby(8, share, 1) / stubby_exact(share, 1) - 1.0;
        const double fine = stubby(16, share, 1) / stubby_exact(share, 1) - 1.0;
        check_add(list, CHECK_AT_LEAST, "", log2(coarse / fine), 0.0, 1.9, "property: order 2",
                  "strip, %s 2: observed order from 8 to 16 elements (errors %.2g, %.2g)",
                  name[share], coarse, fine);
    }
}

/* A slender beam must not feel that its shear is kept: one element, both directions. */
static void locking(struct check_list *list)
{
    static const double slenderness[] = {1e2, 1e3, 1e4};
    static struct case_def def;
    for (size_t i = 0; i < sizeof slenderness / sizeof slenderness[0]; i++) {
        struct beam_motion tip[2];
        const double h = 0.02, length = slenderness[i] * chord;
        for (int shear = 0; shear < 2; shear++) {
            draw_strip(length, h, (enum shear_model)shear, &def);
            def.kind = CASE_STATIC;
            def.beam.elements = 1;
            def.loads.n_point = 1;
            def.loads.point[0] =
                (struct point_load_def){.z = length, .load = {.force = {1.0, 1.0, 0.0}}};
            tip[shear] = built_tip(&def);
        }
        /* What is left is the shear itself: 3 EI/(k G A L^2), at most 0.8 (c/L)^2. */
        check_add(list, CHECK_AT_MOST, "", fabs(tip[1].u / tip[0].u - 1.0), 0.0,
                  0.8 / num_sq(slenderness[i]) + 1e-9, "property",
                  "one element, L = %g c: retained over condensed, lag", slenderness[i]);
        check_add(list, CHECK_AT_MOST, "", fabs(tip[1].v / tip[0].v - 1.0), 0.0,
                  0.8 / num_sq(slenderness[i]) + 1e-9, "property",
                  "one element, L = %g c: retained over condensed, flap", slenderness[i]);
    }
}

static void fill(struct check_list *list)
{
    deflection(list);
    frequencies(list);
    locking(list);
}

const struct check_group group_shear = {
    .name = "shear",
    .title = "Retained shear",
    .text =
        "Isotropic strip, chord 80 mm, thickness 20 mm, nu = 0.3, 16 elements; shear factors "
        "5/6 in both directions. The shear strain inside an element is that of its nodes at rest, "
        "constant, so with retained shear the error of a frequency falls with the square of the "
        "element length (0.3 % at 16 elements in lag 3 of this stubby beam); with condensed "
        "shear it falls with the fourth power.",
    .fill = fill,
};
