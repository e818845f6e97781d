/* Stresses of plies and the failure index, by hand values. */
#include "core/la.h"
#include "core/num.h"
#include "core/structure/static.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static struct shape shape;
static struct ply_state ply_state[LIMIT_LAYUPS * LIMIT_PLIES];

/* Round strengths [Pa]: 1500, 1000, 50, 200, 80 MPa. */
static struct material strong(void)
{
    struct material m = fixture_skin();
    m.x_tension = 1500e6;
    m.x_compression = 1000e6;
    m.y_tension = 50e6;
    m.y_compression = 200e6;
    m.s_shear = 80e6;
    return m;
}

/* One stress at a time: the strengths themselves have index and reserve one. */
static void strengths_have_an_index_of_one(void **state)
{
    (void)state;
    const struct material m = strong();
    const struct ply_stress stress[] = {{.l = 1500e6}, {.l = -1000e6}, {.t = 50e6},
                                        {.t = -200e6}, {.lt = 80e6},   {.lt = -80e6}};
    for (size_t i = 0; i < sizeof stress / sizeof stress[0]; i++) {
        double index = 0.0, reserve = 0.0;
        assert_true(static_tsai_wu(&m, &stress[i], &index, &reserve));
        assert_near_abs(index, 1.0, 1e-12);
        assert_near_abs(reserve, 1.0, 1e-12);
    }
}

/* l = 600, t = 20, lt = 40 MPa by hand: F1 = 1/1500 - 1/1000 = -1/3000, F2 = 1/50 - 1/200 = 3/200,
 * F11 = 1/1.5e6, F22 = 1e-4, F66 = 1/6400, F12 = -sqrt(F11 F22)/2 (1/MPa). Linear part -0.2 + 0.3,
 * square 0.24 + 0.04 + 0.25 - 12000 sqrt(F11 F22). */
static void a_mixed_stress_by_hand(void **state)
{
    (void)state;
    const struct material m = strong();
    const struct ply_stress s = {.l = 600e6, .t = 20e6, .lt = 40e6};
    const double linear = 0.1, square = 0.53 - 12000.0 * sqrt(1e-4 / 1.5e6);
    double index = 0.0, reserve = 0.0;
    assert_true(static_tsai_wu(&m, &s, &index, &reserve));
    assert_near_rel(index, linear + square, 1e-12);
    assert_near_rel(square * reserve * reserve + linear * reserve, 1.0, 1e-12);
    assert_true(reserve > 0.0);
}

static void without_strengths_there_is_no_index(void **state)
{
    (void)state;
    struct material m = strong();
    const struct ply_stress s = {.l = 1.0};
    double index = 0.0, reserve = 0.0;
    m.y_tension = 0.0;
    assert_false(static_tsai_wu(&m, &s, &index, &reserve));
    assert_true(isnan(index));
    assert_true(isnan(reserve));
}

static void no_stress_has_no_limit(void **state)
{
    (void)state;
    const struct material m = strong();
    const struct ply_stress s = {.l = 0.0};
    double index = 1.0, reserve = 0.0;
    assert_true(static_tsai_wu(&m, &s, &index, &reserve));
    assert_near_abs(index, 0.0, 0.0);
    assert_true(isinf(reserve));
}

/* A strip of 0 and 90 degree plies, pulled: plies share the strain and stress across cancels. */
static void pulled_plies_share_the_strain(void **state)
{
    (void)state;
    const struct material m = strong();
    struct ply ply[3] = {draw_ply(&m, 1e-3), draw_ply(&m, 2e-3), draw_ply(&m, 1e-3)};
    const double strain[SECTION_WIDE_COUNT] = {[S_W] = 1e-3};
    int n = 0;
    ply[1].angle = 0.5 * NUM_PI;
    draw_contour(&shape, 8);
    shape.type = SECTION_STRIP;
    shape.width = 0.05;
    (void)draw_layup(&shape, 3, ply);
    assert_ok(static_ply_states(&shape, SHEAR_CONDENSED, strain, ply_state, &n));
    assert_int_equal(n, 3);
    assert_near_rel(ply_state[0].strain_l, 1e-3, 1e-9);
    assert_near_rel(ply_state[1].strain_t, 1e-3, 1e-9);
    /* N_ss = 0 over the wall of 2 + 2 mm; the ply at 90 degrees has its fibre across. */
    assert_near_abs(2.0 * ply_state[0].stress.t + 2.0 * ply_state[1].stress.l, 0.0, 1.0);
    assert_near_rel(ply_state[0].stress.l, ply_state[2].stress.l, 1e-9);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(ply_state[i].ply, i);
        assert_int_equal(ply_state[i].layup, 0);
        assert_near_abs(ply_state[i].stress.lt, 0.0, 1.0);
        assert_true(!isnan(ply_state[i].index));
    }
}

/* The worst point under bending is the face, on the side where the index is larger. */
static void the_worst_point_of_a_bent_strip_is_its_face(void **state)
{
    (void)state;
    struct material m = fixture_isotropic(70e9, 0.3, 2700.0);
    const double strain[SECTION_WIDE_COUNT] = {[S_PHI] = 0.5};
    int n = 0;
    m.x_tension = m.y_tension = 100e6;
    m.x_compression = m.y_compression = 400e6;
    m.s_shear = 200e6;
    const struct ply ply = draw_ply(&m, 0.004);
    draw_contour(&shape, 8);
    shape.type = SECTION_STRIP;
    shape.width = 0.05;
    (void)draw_layup(&shape, 1, &ply);
    assert_ok(static_ply_states(&shape, SHEAR_CONDENSED, strain, ply_state, &n));
    assert_int_equal(n, 1);
    assert_near_rel(ply_state[0].stress.l, 70e9 * 0.002 * 0.5, 1e-9); /* the pulled face */
    assert_near_abs(ply_state[0].n, 0.002, 1e-12); /* phi' = -v'' > 0 pulls the upper one */
}

/* Bent where the curvature across is held at zero it is a plate in cylindrical bending, where it
 * has its natural one, -nu of that along, a free strip. */
static void a_held_strip_is_a_plate(void **state)
{
    (void)state;
    const double nu = 0.3, face = 0.002 * 0.5;
    const struct material m = fixture_isotropic(70e9, nu, 2700.0);
    const struct ply ply = draw_ply(&m, 0.004);
    draw_contour(&shape, 8);
    shape.type = SECTION_STRIP;
    shape.width = 0.05;
    shape.chordwise = CHORDWISE_CLAMPED;
    (void)draw_layup(&shape, 1, &ply);
    for (int held = 0; held < 2; held++) {
        /* The wall runs towards -x: kappa_zz = phi', kappa_ss = -nu phi'. */
        const double strain[SECTION_WIDE_COUNT] = {
            [S_PHI] = 0.5, [S_CAMBER] = held ? 0.0 : -nu * 0.5};
        int n = 0;
        assert_ok(static_ply_states(&shape, SHEAR_CONDENSED, strain, ply_state, &n));
        const double along = fabs(ply_state[0].strain_l), across = fabs(ply_state[0].strain_t);
        assert_near_rel(along, face, 1e-9);
        assert_near_abs(across, held ? 0.0 : nu * face, 1e-9 * face);
        assert_near_rel(fabs(ply_state[0].stress.l),
                        held ? 70e9 * face / (1.0 - nu * nu) : 70e9 * face, 1e-9);
    }
    shape.chordwise = CHORDWISE_FREE;
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
        cmocka_unit_test(strengths_have_an_index_of_one),
        cmocka_unit_test(a_mixed_stress_by_hand),
        cmocka_unit_test(without_strengths_there_is_no_index),
        cmocka_unit_test(no_stress_has_no_limit),
        cmocka_unit_test(pulled_plies_share_the_strain),
        cmocka_unit_test(the_worst_point_of_a_bent_strip_is_its_face),
        cmocka_unit_test(a_held_strip_is_a_plate),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
