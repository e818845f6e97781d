/* Bending of a flat section across the span, by hand values of isotropic and coupled strips. */
#include "core/la.h"
#include "core/num.h"
#include "core/structure/camber.h"
#include "core/structure/section.h"
#include "core/structure/shape.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

static const double width = 0.05, thickness = 0.004, modulus = 70e9, poisson = 0.3,
                    density = 2700.0;

static struct shape shape;
static struct contour contour;
static struct laminate laminate[LIMIT_WALLS];

static void build_shape(int n_ply, const struct ply *ply)
{
    draw_contour(&shape, 8);
    shape.type = SECTION_STRIP;
    shape.width = width;
    shape.chordwise = CHORDWISE_CLAMPED;
    (void)draw_layup(&shape, n_ply, ply);
    assert_ok(shape_build(&shape, &contour, laminate));
}

static void build_isotropic(void)
{
    const struct material m = fixture_isotropic(modulus, poisson, density);
    const struct ply ply = draw_ply(&m, thickness);
    build_shape(1, &ply);
}

/* The line of the one wall, its plate stiffness E h^3/(12 (1 - nu^2)) and its shear 5/6 G h. */
static void line_of_a_strip(void **state)
{
    (void)state;
    build_isotropic();
    const double plate = modulus * pow(thickness, 3) / (12.0 * (1.0 - num_sq(poisson)));
    const double shear = 5.0 / 6.0 * modulus / (2.0 * (1.0 + poisson)) * thickness;
    assert_true(contour.camber.on);
    assert_near_abs(contour.camber.x, 0.0, 1e-15);
    assert_near_abs(contour.camber.y, 0.0, 1e-15);
    assert_near_rel(contour.camber.width, width, 1e-14);
    assert_near_abs(contour.camber.axis, 0.0, 1e-15);
    assert_near_rel(contour.camber.stiffness, plate * width, 1e-12);
    assert_near_rel(contour.camber.shear, shear * width, 1e-12);
    contour_done(&contour);
}

/* A laminate moved off the line by d keeps its length across at n = d. */
static void axis_follows_the_offset(void **state)
{
    (void)state;
    const struct material m = fixture_isotropic(modulus, poisson, density);
    const struct ply ply = draw_ply(&m, thickness);
    struct laminate moved, middle;
    assert_ok(laminate_build_at(1, &ply, 0.01, CHORDWISE_CLAMPED, &moved));
    assert_ok(laminate_build(1, &ply, CHORDWISE_CLAMPED, &middle));
    const struct camber_line a = camber_line_of(&moved, 0.0, 0.0, 0.03, 0.04);
    const struct camber_line b = camber_line_of(&middle, 0.0, 0.0, 0.03, 0.04);
    assert_near_rel(a.axis, 0.01, 1e-12);
    assert_near_rel(a.stiffness, b.stiffness, 1e-9);
    assert_near_rel(a.width, 0.05, 1e-14);
    assert_near_rel(a.x, 0.015, 1e-14);
    assert_near_rel(a.y, 0.02, 1e-14);
}

/* Anticlastic bending: a free isotropic strip bends across by -nu of its bending along, and takes
 * no curvature on the average from a twist. */
static void natural_curvature_is_anticlastic(void **state)
{
    (void)state;
    struct warping classic, retained;
    double natural[SECTION_WIDE_COUNT];
    build_isotropic();
    assert_ok(warping_solve(&contour, laminate, &classic, &retained));
    camber_natural(&contour, laminate, &classic, SECTION_WIDE_COUNT, natural);
    const struct contour_point p = contour_at(&contour.element[0], 0.0);
    assert_near_rel(natural[S_PHI], poisson * p.dx, 1e-10); /* kappa_zz = -phi' dx/ds */
    assert_near_abs(natural[S_THETA], 0.0, 1e-10);
    assert_near_abs(natural[S_CAMBER_RATE], 0.0, 1e-10);
    warping_done(&classic);
    warping_done(&retained);
    contour_done(&contour);
}

/* The mean of w and of u_s over the wall is zero, and neither turns the section: the motion is no
 * rigid one. The wall stays normal to its normals, dw/ds = -turn of them. */
static void motion_is_not_rigid(void **state)
{
    (void)state;
    build_isotropic();
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < contour.n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &contour.element[i / CONTOUR_GAUSS];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight = contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian;
        struct camber_motion at, next;
        struct contour_point q = p;
        camber_motion(&contour.camber, &p, &at);
        q.x += 1e-6 * p.dx;
        camber_motion(&contour.camber, &q, &next);
        sum[0] += weight * at.bend[1];
        sum[1] += weight * p.x * at.bend[1];
        sum[2] += weight * at.bend_slope[0];
        const double dw = -p.dx * (next.bend[1] - at.bend[1]) / 1e-6;
        assert_near_abs(dw, -p.dx * at.bend_slope[0], 1e-6);
    }
    assert_near_abs(sum[0], 0.0, 1e-15);
    assert_near_abs(sum[1], 0.0, 1e-15);
    assert_near_abs(sum[2], 0.0, 1e-15);
    contour_done(&contour);
}

/* Energy of the rate kappa' of an isotropic strip: the twist 2 s of the plate, with its edges free
 * by Kirchhoff: D66 int (2 s)^2 ds = G h^3/12 b^3/3. */
static void rate_twists_the_wall(void **state)
{
    (void)state;
    struct section s;
    build_isotropic();
    assert_ok(section_build(&contour, laminate, &s));
    const double g = modulus / (2.0 * (1.0 + poisson));
    assert_near_rel(
        s.flat_classic.stiffness[num_at(S_CAMBER_RATE, S_CAMBER_RATE, SECTION_WIDE_COUNT)],
        g * pow(thickness, 3) / 12.0 * pow(width, 3) / 3.0, 1e-9);
    assert_near_rel(s.flat_classic.mass[num_at(M_CAMBER, M_CAMBER, SECTION_WIDE_MOTION)],
                    density * (thickness * pow(width, 5) / 720.0 +
                               pow(thickness, 3) / 12.0 * pow(width, 3) / 12.0),
                    1e-9);
    contour_done(&contour);
}

/* Bending in the plane of a strip of coupled plies shears it by -(A16/A66) of the axial strain: the
 * warping of psi' is lambda's, and where plies do not couple there is none. */
static void lag_warping_comes_with_coupling(void **state)
{
    (void)state;
    const struct material m = fixture_skin();
    struct ply ply = draw_ply(&m, thickness);
    for (int coupled = 0; coupled < 2; coupled++) {
        struct warping classic, retained;
        ply.angle = coupled ? num_rad(30.0) : 0.0;
        build_shape(1, &ply);
        assert_ok(warping_solve(&contour, laminate, &classic, &retained));
        /* Bending in the plane is psi' = dx/ds. */
        const struct contour_point p = contour_at(&contour.element[1], 0.3);
        assert_near_abs(classic.lag[S_PSI], coupled * p.dx, 1e-9);
        if (coupled) {
            const double *r = laminate[0].reduced;
            double e[WALL_STRAINS * SECTION_WIDE_COUNT], normal[SECTION_WIDE_COUNT];
            warping_wide_strains(&classic, &contour.element[1], &p, e, normal);
            assert_near_rel(e[W_GAMMA + WALL_STRAINS * S_LAG],
                            p.dx * p.x * r[W_EPS + WALL_STRAINS * W_GAMMA] /
                                r[W_GAMMA + WALL_STRAINS * W_GAMMA],
                            1e-6);
            assert_near_abs(e[W_GAMMA + WALL_STRAINS * S_PSI], 0.0, 1e-9);
        }
        warping_done(&classic);
        warping_done(&retained);
        contour_done(&contour);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_of_a_strip),
        cmocka_unit_test(axis_follows_the_offset),
        cmocka_unit_test(natural_curvature_is_anticlastic),
        cmocka_unit_test(motion_is_not_rigid),
        cmocka_unit_test(rate_twists_the_wall),
        cmocka_unit_test(lag_warping_comes_with_coupling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
