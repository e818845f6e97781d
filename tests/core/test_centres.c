/* Centres, principal axes and couplings of a section. */
#include "core/coupling/model.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

static const double modulus = 70e9, thickness = 0.001;

static struct shape shape;

static struct centres centres_of(const struct shape *s)
{
    static struct case_def def;
    struct model m;
    struct failure fail;
    draw_case(s, 1.0, &def);
    def.kind = CASE_SECTION;
    assert_ok(model_build(&def, &m, &fail));
    const struct centres c = m.centres;
    model_done(&m);
    return c;
}

/* An L of two legs along +x and +y, corner at (x0, y0), of lengths a and b. */
static void draw_angle(double x0, double y0, double a, double b)
{
    const struct material m = fixture_isotropic(modulus, 0.3, 2700.0);
    const struct ply ply = draw_ply(&m, thickness);
    draw_contour(&shape, 16);
    const int layup = draw_layup(&shape, 1, &ply);
    const int corner = draw_point(&shape, x0, y0);
    (void)draw_wall(&shape, corner, draw_point(&shape, x0 + a, y0), layup);
    (void)draw_wall(&shape, corner, draw_point(&shape, x0, y0 + b), layup);
}

/* The shear flow of an angle runs through its corner, whatever the force. */
static void the_shear_centre_of_an_angle_is_its_corner(void **state)
{
    (void)state;
    draw_angle(0.013, -0.021, 0.05, 0.08);
    const struct centres c = centres_of(&shape);
    assert_near_abs(c.shear_x, 0.013, 3e-5);
    assert_near_abs(c.shear_y, -0.021, 3e-5);
    const double area = 0.13 * thickness;
    assert_near_rel(c.tension_x, 0.013 + 0.05 * 0.025 / 0.13, 1e-9);
    assert_near_rel(c.tension_y, -0.021 + 0.08 * 0.04 / 0.13, 1e-9);
    assert_near_rel(c.ea, modulus * area, 1e-9);
    assert_near_rel(c.mass, 2700.0 * area, 1e-12);
    assert_near_rel(c.mass_x, c.tension_x, 1e-9);
    assert_near_rel(c.mass_y, c.tension_y, 1e-9);
}

/* Equal legs: the axis of symmetry at 45 degrees and the one across it. */
static void an_equal_angle_bends_about_its_diagonals(void **state)
{
    (void)state;
    const double leg = 0.06, t = thickness;
    draw_angle(0.0, 0.0, leg, leg);
    const struct centres c = centres_of(&shape);
    /* Thin walls: about the diagonal of symmetry t l^3/3, across it t l^3/12; the points far from
     * the diagonal lie in the direction of -45 degrees from x. */
    assert_near_rel(c.ei_major, modulus * t * pow(leg, 3) / 3.0, 1e-3);
    assert_near_rel(c.ei_minor, modulus * t * pow(leg, 3) / 12.0, 2e-3);
    assert_near_abs(fabs(c.principal_angle), 0.25 * NUM_PI, 1e-6);
    assert_true(c.principal_angle < 0.0);
}

/* Moving the section moves its centres and nothing else. */
static void stiffness_does_not_depend_on_the_origin(void **state)
{
    (void)state;
    draw_angle(0.0, 0.0, 0.05, 0.08);
    const struct centres a = centres_of(&shape);
    draw_angle(0.2, -0.1, 0.05, 0.08);
    const struct centres b = centres_of(&shape);
    assert_near_rel(b.tension_x, a.tension_x + 0.2, 1e-8);
    assert_near_rel(b.shear_y, a.shear_y - 0.1, 1e-6);
    assert_near_rel(b.ea, a.ea, 1e-8);
    assert_near_rel(b.gj, a.gj, 1e-8);
    assert_near_rel(b.ei_major, a.ei_major, 1e-8);
    assert_near_rel(b.ei_minor, a.ei_minor, 1e-8);
    assert_near_rel(b.principal_angle, a.principal_angle, 1e-8);
    assert_near_rel(b.inertia_polar, a.inertia_polar, 1e-8);
    assert_near_rel(b.ei_warping, a.ei_warping, 1e-5);
}

static void a_turn_turns_the_principal_axes(void **state)
{
    (void)state;
    const struct material m = fixture_isotropic(modulus, 0.3, 2700.0);
    static struct case_def def;
    struct model model;
    struct failure fail;
    for (double degrees = -60.0; degrees <= 90.0; degrees += 30.0) {
        fixture_strip(&m, 1.0, 0.05, 0.002, &def);
        def.kind = CASE_SECTION;
        def.beam.section.shape.turn = num_rad(degrees);
        assert_ok(model_build(&def, &model, &fail));
        assert_near_abs(model.centres.principal_angle, num_rad(degrees), 1e-9);
        assert_near_rel(model.centres.ei_major, modulus * 0.002 * pow(0.05, 3) / 12.0, 1e-9);
        assert_near_rel(model.centres.ei_minor, modulus * 0.05 * pow(0.002, 3) / 12.0, 1e-9);
        model_done(&model);
    }
}

/* The couplings of the paper's beam are those of its fibre angle: opposite angles, opposite signs.
 */
static void couplings_change_sign_with_the_fibre(void **state)
{
    (void)state;
    struct centres c[2];
    for (int i = 0; i < 2; i++) {
        struct case_def def;
        struct model m;
        struct failure fail;
        fixture_paper_beam(i == 0 ? 30.0 : -30.0, NULL, &def);
        def.kind = CASE_SECTION;
        assert_ok(model_build(&def, &m, &fail));
        c[i] = m.centres;
        model_done(&m);
    }
    assert_true(fabs(c[0].flap_twist) > 1e-4);
    assert_near_rel(c[1].flap_twist, -c[0].flap_twist, 1e-8);
    assert_near_rel(c[1].extension_shear_x, -c[0].extension_shear_x, 1e-8);
    assert_near_rel(c[1].gj, c[0].gj, 1e-9);
    assert_true(c[0].tension_y < -0.0015); /* the stiff skin is the lower face */
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shear_centre_of_an_angle_is_its_corner),
        cmocka_unit_test(an_equal_angle_bends_about_its_diagonals),
        cmocka_unit_test(stiffness_does_not_depend_on_the_origin),
        cmocka_unit_test(a_turn_turns_the_principal_axes),
        cmocka_unit_test(couplings_change_sign_with_the_fibre),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
