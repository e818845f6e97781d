/* Static cases: point and line loads, reactions, stresses of plies, reserve; the Timoshenko beam
 * with retained shear. Isotropic, closed forms. */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <assert.h>

static const double length = 1.0, chord = 0.08, thickness = 0.004, modulus = 70e9, poisson = 0.3,
                    density = 2700.0;

static struct material alloy(void)
{
    struct material m = fixture_isotropic(modulus, poisson, density);
    m.x_tension = m.y_tension = 300e6;
    m.x_compression = m.y_compression = 250e6;
    m.s_shear = 170e6;
    return m;
}

static void draw_strip(double length_, double h, struct case_def *out)
{
    const struct material m = alloy();
    fixture_strip(&m, length_, chord, h, out);
    out->kind = CASE_STATIC;
}

static double flap_stiffness(void)
{
    return modulus * chord * pow(thickness, 3) / 12.0;
}

static double lag_stiffness(void)
{
    return modulus * thickness * pow(chord, 3) / 12.0;
}

static double torsion_stiffness(void)
{
    return modulus / (2.0 * (1.0 + poisson)) * chord * pow(thickness, 3) / 3.0;
}

struct row {
    const char *what, *unit;
    double value, reference, tolerance;
};

static void add_rows(struct check_list *list, const char *source, size_t n, const struct row *row)
{
    for (size_t i = 0; i < n; i++) {
        check_add(list, CHECK_RELATIVE, row[i].unit, row[i].value, row[i].reference,
                  row[i].tolerance, source, "%s", row[i].what);
    }
}

/* A force of every direction and a moment about every axis, inside an element. */
static void point_load(struct check_list *list)
{
    const double a = 0.37, lag = lag_stiffness(), flap = flap_stiffness();
    const double arm = a * a * (3.0 * length - a) / 6.0, ea = modulus * chord * thickness;
    const struct beam_load load = {.force = {30.0, 2.0, 1000.0}, .moment = {-0.5, 7.0, 0.4}};
    static struct case_def def;
    struct model m;
    struct static_result r;
    draw_strip(length, thickness, &def);
    def.loads.n_point = 1;
    def.loads.point[0] = (struct point_load_def){.z = a, .load = load};
    built_model(&def, &m);
    built_answer(&m, &r);
    /* A moment M bends by M a (L - a/2); about x it moves v down, about y it moves u forward. */
    const double swing = a * (length - 0.5 * a);
    const struct row row[] = {
        {"strip, point load: tip plunge", "m", r.tip.v, 2.0 * arm / flap + 0.5 * swing / flap,
         1e-8},
        {"strip, point load: tip chordwise", "m", r.tip.u, 30.0 * arm / lag + 7.0 * swing / lag,
         1e-8},
        {"strip, point load: tip axial", "m", r.tip.w, 1000.0 * a / ea, 1e-8},
        {"strip, point load: tip twist", "rad", r.tip.theta, 0.4 * a / torsion_stiffness(), 0.003},
        {"strip, point load: reaction x", "N", r.reaction_force[0], -30.0, 1e-12},
        {"strip, point load: reaction y", "N", r.reaction_force[1], -2.0, 1e-12},
        {"strip, point load: reaction z", "N", r.reaction_force[2], -1000.0, 1e-12},
        {"strip, point load: reaction moment x", "N m", r.reaction_moment[0], 0.5 + 2.0 * a, 1e-12},
        {"strip, point load: reaction moment y", "N m", r.reaction_moment[1], -7.0 - 30.0 * a,
         1e-12},
        {"strip, point load: reaction torque", "N m", r.reaction_moment[2], -0.4, 1e-12},
    };
    add_rows(list, "closed form", sizeof row / sizeof row[0], row);
    statics_done(&r);
    model_done(&m);
}

/* Antiderivative of a^2 (3L - a)/6. */
static double line_arm(double a)
{
    return (length * a * a * a - 0.25 * a * a * a * a) / 6.0;
}

/* A load per length over a part of the span that ends inside elements; a torque per length. */
static void line_load(struct check_list *list)
{
    const double from = 0.21, to = 0.83, q = 3.0, torque = 0.2, gj = torsion_stiffness();
    static struct case_def def;
    struct model m;
    struct static_result r;
    draw_strip(length, thickness, &def);
    def.loads.n_line = 1;
    def.loads.line[0] = (struct line_load_def){
        .from = from, .to = to, .load = {.force = {2.0 * q, q, 0.0}, .moment = {0.0, 0.0, torque}}};
    built_model(&def, &m);
    built_answer(&m, &r);
    const double arm = line_arm(to) - line_arm(from), run = to - from, middle = 0.5 * (from + to);
    const struct row row[] = {
        {"strip, line load: tip plunge", "m", r.tip.v, q * arm / flap_stiffness(), 1e-8},
        {"strip, line load: tip chordwise", "m", r.tip.u, 2.0 * q * arm / lag_stiffness(), 1e-8},
        {"strip, line torque: tip twist", "rad", r.tip.theta, torque * run * middle / gj, 0.003},
        {"strip, line load: reaction y", "N", r.reaction_force[1], -q * run, 1e-12},
        {"strip, line load: reaction moment x", "N m", r.reaction_moment[0], q * run * middle,
         1e-12},
    };
    add_rows(list, "closed form", sizeof row / sizeof row[0], row);
    statics_done(&r);
    model_done(&m);
}

/* Stress of the outer face of the strip: 6 M/(b h^2) from flap, 6 M/(h b^2) at the edge from lag,
 * N/(b h); in torsion G h theta'. One load at a time. */
static void strip_stress(struct check_list *list)
{
    static const struct {
        const char *what;
        struct beam_load load;
        double normal, shear;
        double tolerance;
    } load[] = {
        {"flap moment 4 N m: 6 M/(b h^2)", {.moment = {4.0, 0.0, 0.0}}, 18.75e6, 0.0, 1e-6},
        {"lag moment 90 N m: 6 M/(h b^2)", {.moment = {0.0, 90.0, 0.0}}, 21.09375e6, 0.0, 1e-6},
        {"axial force 5 kN: N/(b h)", {.force = {0.0, 0.0, 5e3}}, 15.625e6, 0.0, 1e-6},
        {"torque 2 N m: 3 T/(b h^2)", {.moment = {0.0, 0.0, 2.0}}, 0.0, 4.6875e6, 1e-6},
    };
    static struct case_def def;
    for (size_t i = 0; i < sizeof load / sizeof load[0]; i++) {
        struct model m;
        struct static_result r;
        draw_strip(length, thickness, &def);
        def.loads.n_point = 1;
        def.loads.point[0] = (struct point_load_def){.z = length, .load = load[i].load};
        def.output.n_stress = 1;
        def.output.stress[0] = 0.4;
        built_model(&def, &m);
        built_answer(&m, &r);
        assert(r.n_stress == 1 && r.stress[0].n_ply == 1);
        const struct ply_stress *s = &r.stress[0].ply[0].stress;
        const bool normal = load[i].normal > 0.0;
        check_add(list, CHECK_RELATIVE, "Pa", fabs(normal ? s->l : s->lt),
                  normal ? load[i].normal : load[i].shear, load[i].tolerance, "closed form",
                  "strip, %s", load[i].what);
        check_add(list, CHECK_AT_MOST, "Pa", fmax(fabs(s->t), fabs(normal ? s->lt : s->l)), 0.0,
                  1.0, "closed form", "strip, %.8s...: the other stresses", load[i].what);
        statics_done(&r);
        model_done(&m);
    }
}

/* A round tube of two plies under torque: where they meet, in the middle of the wall, the shear
 * stress is Bredt's T/(2 A t). */
static void tube_stress(struct check_list *list)
{
    const double radius = 0.04, wall = 0.001, torque = 50.0;
    const struct material m = alloy();
    const struct ply ply[2] = {draw_ply(&m, 0.5 * wall), draw_ply(&m, 0.5 * wall)};
    static struct shape shape;
    static struct case_def def;
    struct model model;
    struct static_result r;
    draw_contour(&shape, 64);
    const int layup = draw_layup(&shape, 2, ply);
    const int front = draw_point(&shape, radius, 0.0), rear = draw_point(&shape, -radius, 0.0);
    (void)draw_arc(&shape, front, rear, layup, 0.0, radius);
    (void)draw_arc(&shape, rear, front, layup, 0.0, -radius);
    draw_case(&shape, length, &def);
    def.loads.n_point = 1;
    def.loads.point[0] =
        (struct point_load_def){.z = length, .load = {.moment = {0.0, 0.0, torque}}};
    def.output.n_stress = 1;
    def.output.stress[0] = 0.5;
    built_model(&def, &model);
    built_answer(&model, &r);
    const double bredt = torque / (2.0 * NUM_PI * radius * radius * wall);
    assert(r.stress[0].n_ply == 2);
    /* The inner ply has its largest shear at that place. */
    check_add(list, CHECK_RELATIVE, "Pa", fabs(r.stress[0].ply[0].stress.lt), bredt, 0.001,
              "closed form, Bredt", "round tube, torque: shear stress in the middle of the wall");
    check_add(list, CHECK_RELATIVE, "rad", r.tip.theta,
              torque * length * 2.0 * (1.0 + poisson) /
                  (modulus * 2.0 * NUM_PI * pow(radius, 3) * wall),
              0.001, "closed form, Bredt", "round tube, torque: tip twist");
    statics_done(&r);
    model_done(&model);
}

/* All loads times the reserve bring the most strained ply to an index of one. */
static void reserve(struct check_list *list)
{
    struct case_def def;
    double before = 0.0;
    draw_strip(length, thickness, &def);
    def.loads.n_point = 1;
    def.loads.point[0] = (struct point_load_def){
        .z = length, .load = {.force = {40.0, 3.0, 100.0}, .moment = {0.0, 0.0, 1.0}}};
    def.output.n_stress = 3;
    def.output.stress[0] = 0.02;
    def.output.stress[1] = 0.5;
    def.output.stress[2] = 0.98;
    for (int pass = 0; pass < 2; pass++) {
        struct model m;
        struct static_result r;
        built_model(&def, &m);
        built_answer(&m, &r);
        const double index = r.stress[0].ply[0].index;
        if (pass == 1) {
            check_add(list, CHECK_RELATIVE, "", index, 1.0, 1e-9, "property",
                      "strip, loads times the reserve (%.3f): Tsai-Wu index", before);
            check_add(list, CHECK_RELATIVE, "", r.reserve_min, 1.0, 1e-9, "property",
                      "strip, loads times the reserve: reserve");
            check_add(list, CHECK_ABSOLUTE, "", r.critical_position, 0.0, 0.0, "property",
                      "strip: the critical position is the inmost");
        }
        before = r.reserve_min;
        for (int k = 0; k < 3; k++) {
            def.loads.point[0].load.force[k] *= r.reserve_min;
            def.loads.point[0].load.moment[k] *= r.reserve_min;
        }
        statics_done(&r);
        model_done(&m);
    }
}

static void fill(struct check_list *list)
{
    point_load(list);
    line_load(list);
    strip_stress(list);
    tube_stress(list);
    reserve(list);
}

const struct check_group group_loads = {
    .name = "loads",
    .title = "Static loads, reactions, stresses",
    .text = "Isotropic, nu = 0.3, root warping free. The twist under a load inside the span has "
            "0.1 % of warping stiffness in it. Stresses are those of the most strained point of a "
            "ply.",
    .fill = fill,
};
