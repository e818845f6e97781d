/* Convergence in beam elements and in elements of the wall. */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdio.h>

enum { MODES = 5, COARSE = 8, FINE = 16, FINEST = 128 };

/* Lowest frequencies [Hz] of a case with so many elements. */
static void lowest(struct case_def *def, int elements, double hz[MODES])
{
    struct model m;
    def->kind = CASE_MODES;
    def->solver.modes = MODES;
    def->beam.elements = elements;
    built_model(def, &m);
    for (int j = 0; j < MODES; j++) {
        hz[j] = built_hz(&m, j);
    }
    model_done(&m);
}

static void elements(struct check_list *list, const char *name, struct case_def *def,
                     double tolerance, double order)
{
    double coarse[MODES], fine[MODES], finest[MODES];
    lowest(def, COARSE, coarse);
    lowest(def, FINE, fine);
    lowest(def, FINEST, finest);
    for (int j = 0; j < MODES; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", fine[j], finest[j], tolerance, "128 elements",
                  "%s, 16 elements: mode %d", name, j + 1);
    }
    const int last = MODES - 1;
    const double before = coarse[last] / finest[last] - 1.0,
                 after = fine[last] / finest[last] - 1.0;
    check_add(list, CHECK_AT_LEAST, "", log2(before / after), 0.0, order, "property",
              "%s, mode 5: order from 8 to 16 elements (errors %.2g, %.2g)", name, before, after);
}

/* The [15]6 CAS box, 762 mm long. */
static void draw_box_case(enum shear_model shear, struct case_def *out)
{
    static const double degrees[BOX_WALLS] = {0.0, 15.0, 0.0, -15.0};
    const struct material skin = fixture_skin();
    static struct shape shape;
    static struct layup layup[BOX_WALLS];
    for (int w = 0; w < BOX_WALLS; w++) {
        layup[w] = (struct layup){.n_ply = 1, .ply = {draw_ply(&skin, 0.000762)}};
        (void)snprintf(layup[w].name, sizeof layup[w].name, "wall %d", w);
        layup[w].ply[0].angle = num_rad(degrees[w]);
    }
    draw_box(&shape, 0.02421, 0.01346, BOX_WALLS, layup);
    draw_case(&shape, 0.762, out);
    out->beam.root_warping = ROOT_WARPING_RESTRAINED;
    out->beam.section.shear = shear;
}

static void beam_elements(struct check_list *list)
{
    static struct case_def def;
    fixture_paper_beam(-45.0, NULL, &def);
    elements(list, "paper beam, -45 deg", &def, 0.001, 3.5);
    draw_box_case(SHEAR_CONDENSED, &def);
    elements(list, "CAS box, shear condensed", &def, 0.001, 3.5);
    draw_box_case(SHEAR_RETAINED, &def);
    elements(list, "CAS box, shear retained", &def, 0.001, 3.5);
}

/* Rate of the twist rate at the clamp [rad/m^2], which bends the walls there, under a tip force. */
static double clamp_bimoment_strain(struct case_def *def, int n)
{
    struct model m;
    struct static_result r;
    def->kind = CASE_STATIC;
    def->beam.elements = n;
    def->loads.n_point = 1;
    def->loads.point[0] =
        (struct point_load_def){.z = def->beam.length, .load = {.force = {0.0, 1.0, 0.0}}};
    def->output.n_stress = 1;
    def->output.stress[0] = 0.0;
    built_model(def, &m);
    built_answer(&m, &r);
    const double strain = r.stress[0].strain[S_THETA2];
    statics_done(&r);
    model_done(&m);
    return strain;
}

static void clamp_strains(struct check_list *list)
{
    static struct case_def def;
    static const int n[] = {4, 8, 16, 32, 64};
    draw_box_case(SHEAR_CONDENSED, &def);
    const double finest = clamp_bimoment_strain(&def, FINEST);
    for (size_t i = 0; i < sizeof n / sizeof n[0]; i++) {
        check_add(list, CHECK_RELATIVE, "rad/m2", clamp_bimoment_strain(&def, n[i]), finest, 0.01,
                  "128 elements", "CAS box, tip force: theta'' at the clamp, %d elements", n[i]);
    }
}

/* A tube of chords, 2 x n of them: GJ of the circle it stands for, error falls with n^-2. */
static double tube(int n)
{
    const struct material m = fixture_isotropic(70e9, 0.3, 2700.0);
    const struct ply ply = draw_ply(&m, 0.0001);
    static struct shape shape;
    static struct model model;
    draw_contour(&shape, n);
    const int layup = draw_layup(&shape, 1, &ply);
    const int front = draw_point(&shape, 0.05, 0.0), rear = draw_point(&shape, -0.05, 0.0);
    (void)draw_arc(&shape, front, rear, layup, 0.0, 0.05);
    (void)draw_arc(&shape, rear, front, layup, 0.0, -0.05);
    built_section(&shape, &model);
    const double gj = model.centres.gj;
    model_done(&model);
    return gj / (2.0 * NUM_PI * m.g_lt * 0.0001 * pow(0.05, 3)) - 1.0;
}

/* Shear of a strip in its plane, 5/6 G b h: the warping is a cubic, met to the fourth order. */
static double strip(int n)
{
    const struct material m = fixture_isotropic(70e9, 0.3, 2700.0);
    struct case_def def;
    struct model model;
    fixture_strip(&m, 1.0, 0.05, 0.002, &def);
    def.kind = CASE_SECTION;
    def.beam.section.shape.contour_elements = n;
    built_model(&def, &model);
    const double k = model.section.stiffness[num_at(S_GXZ, S_GXZ, SECTION_STRAIN_COUNT)];
    model_done(&model);
    return k / (5.0 / 6.0 * m.g_lt * 0.05 * 0.002) - 1.0;
}

static void wall_elements(struct check_list *list)
{
    const double tube_coarse = tube(20), tube_fine = tube(40);
    const double strip_coarse = strip(4), strip_fine = strip(8);
    check_add(list, CHECK_ABSOLUTE, "", log2(tube_coarse / tube_fine), 2.0, 0.05,
              "property: chords of an arc",
              "round tube, GJ: order from 2 x 20 to 2 x 40 elements (errors %.2g, %.2g)",
              tube_coarse, tube_fine);
    check_add(list, CHECK_ABSOLUTE, "", log2(strip_coarse / strip_fine), 4.0, 0.1,
              "property: quadratic elements",
              "strip, shear in its plane: order from 4 to 8 elements (errors %.2g, %.2g)",
              strip_coarse, strip_fine);
}

static void fill(struct check_list *list)
{
    beam_elements(list);
    clamp_strains(list);
    wall_elements(list);
}

const struct check_group group_convergence = {
    .name = "convergence",
    .title = "Convergence",
    .text =
        "The clamp that holds the warping has nodes of its own next to it where the layer in which "
        "theta' comes free is shorter than an element (closed sections: without them mode 5 of the "
        "CAS box was 0.8 % high at 16 elements, with an error of first order). With retained shear "
        "the internal freedoms of an element have their own inertia in the frequency: with their "
        "static place alone the order is two and mode 5 of the box 0.105 % high. Static cases have "
        "finer nodes in that layer, for the stresses at the clamp.",
    .fill = fill,
};
