/* Rows and matrices of one element. */
#include "core/coupling/model.h"
#include "core/la.h"
#include "core/num.h"
#include "core/structure/beam_element.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

enum { NODE = BEAM_NODE_MOST, OUTER = BEAM_OUTER, N = SECTION_WIDE_COUNT };

static const double h = 0.3;

/* A strain row is the derivative of a motion row: difference quotients at the inside. */
static void strains_are_derivatives_of_motions(void **state)
{
    (void)state;
    static const struct {
        int strain, motion;
        double sign;
    } pair[] = {{S_W, M_W, 1.0},
                {S_PSI, M_DU, 1.0},
                {S_PHI, M_DV, -1.0},
                {S_THETA2, M_DTHETA, 1.0},
                {S_SURPLUS_RATE, M_SURPLUS, 1.0},
                {S_TURN_RATE, M_TURN, 1.0},
                {S_CAMBER_RATE, M_CAMBER, 1.0}};
    const double step = 1e-5;
    for (double t = 0.1; t < 1.0; t += 0.2) {
        struct element_rows at, before, after;
        element_rows(t, h, &at);
        element_rows(t - step, h, &before);
        element_rows(t + step, h, &after);
        for (size_t p = 0; p < sizeof pair / sizeof pair[0]; p++) {
            for (int i = 0; i < ELEMENT_ALL; i++) {
                const ptrdiff_t k = pair[p].motion + SECTION_WIDE_MOTION * (ptrdiff_t)i;
                const double slope =
                    pair[p].sign * (after.motion[k] - before.motion[k]) / (2.0 * step * h);
                assert_near_abs(at.strain[pair[p].strain + N * i], slope,
                                1e-7 * (1.0 + fabs(slope)));
            }
        }
    }
}

/* The rotation of the section is the slope less the shear, and the amplitude of the warping the
 * twist rate less eta, at every point and for every freedom. */
static void slope_is_rotation_and_shear(void **state)
{
    (void)state;
    const double step = 1e-5;
    for (double t = 0.1; t < 1.0; t += 0.2) {
        struct element_rows at, before, after;
        element_rows(t, h, &at);
        element_rows(t - step, h, &before);
        element_rows(t + step, h, &after);
        for (int i = 0; i < ELEMENT_ALL; i++) {
            const ptrdiff_t c = SECTION_WIDE_MOTION * (ptrdiff_t)i, s = N * (ptrdiff_t)i;
            const double du = (after.motion[M_U + c] - before.motion[M_U + c]) / (2.0 * step * h);
            const double dv = (after.motion[M_V + c] - before.motion[M_V + c]) / (2.0 * step * h);
            assert_near_abs(at.motion[M_DU + c] + at.strain[S_GXZ + s], du, 1e-7);
            const double twist =
                (after.motion[M_THETA + c] - before.motion[M_THETA + c]) / (2.0 * step * h);
            assert_near_abs(at.motion[M_DV + c] + at.strain[S_GYZ + s], dv, 1e-7);
            assert_near_abs(at.strain[S_THETA + s] + at.strain[S_ETA + s], twist, 1e-7);
            assert_near_abs(at.strain[S_THETA + s], at.motion[M_DTHETA + c], 1e-12);
        }
    }
}

/* At the ends the motions are the freedoms of the node; internal freedoms move nothing there. */
static void ends_are_the_nodes(void **state)
{
    (void)state;
    enum { NONE = -1 };
    static const int motion_of[NODE] = {M_W,
                                        M_U,
                                        M_DU,
                                        M_V,
                                        M_DV,
                                        M_THETA,
                                        M_DTHETA,
                                        M_SURPLUS,
                                        [D_LAG] = NONE,
                                        [D_TURN] = M_TURN,
                                        [D_CAMBER] = M_CAMBER};
    for (int end = 0; end < 2; end++) {
        struct element_rows at;
        element_rows(end, h, &at);
        for (int f = 0; f < NODE; f++) {
            for (int i = 0; i < ELEMENT_ALL; i++) {
                const double value = motion_of[f] == NONE
                                         ? at.strain[S_LAG + N * i]
                                         : at.motion[motion_of[f] + SECTION_WIDE_MOTION * i];
                assert_near_abs(value, i == NODE * end + f ? 1.0 : 0.0, 1e-14);
            }
        }
    }
}

static void build(enum shear_model shear, double thickness, struct element *out)
{
    const struct material m = fixture_isotropic(70e9, 0.0, 2700.0);
    struct case_def def;
    struct model model;
    struct failure fail;
    fixture_strip(&m, 1.0, 0.08, thickness, &def);
    def.kind = CASE_SECTION;
    def.beam.section.shape.contour_elements = 32;
    assert_ok(model_build(&def, &model, &fail));
    const struct section *section[BEAM_GAUSS] = {&model.section, &model.section, &model.section,
                                                 &model.section};
    assert_ok(element_build(section, h, shear, out));
    model_done(&model);
}

/* The stiffness of text books: 12 EI/h^3 and 4 EI/h, with shear 12 EI/((1 + a) h^3) and
 * (4 + a) EI/((1 + a) h), a = 12 EI/(k G A h^2). */
static void stiffness_by_hand(void **state)
{
    (void)state;
    const double b = 0.08, t = 0.05, ei = 70e9 * b * t * t * t / 12.0,
                 kga = 35e9 * b * t * 5.0 / 6.0;
    for (int shear = 0; shear < 2; shear++) {
        struct element e;
        build((enum shear_model)shear, t, &e);
        const double a = shear == SHEAR_RETAINED ? 12.0 * ei / (kga * h * h) : 0.0;
        assert_near_rel(e.k[num_at(D_V, D_V, OUTER)], 12.0 * ei / ((1.0 + a) * h * h * h), 1e-5);
        assert_near_rel(e.k[num_at(D_DV, D_DV, OUTER)], (4.0 + a) * ei / ((1.0 + a) * h), 1e-5);
        assert_near_rel(e.k[num_at(D_DV, NODE + D_DV, OUTER)], (2.0 - a) * ei / ((1.0 + a) * h),
                        1e-4);
        assert_near_rel(e.k[num_at(D_W, D_W, OUTER)], 70e9 * b * t / h, 1e-9);
    }
}

/* Consistent mass of text books: 13/35 m h, less the rotary inertia 6/5 m r^2/h. */
static void mass_by_hand(void **state)
{
    (void)state;
    const double b = 0.08, t = 0.002, m = 2700.0 * b * t, rotary = m * t * t / 12.0;
    struct element e;
    build(SHEAR_CONDENSED, t, &e);
    assert_near_rel(e.m[num_at(D_V, D_V, OUTER)], 13.0 / 35.0 * m * h + 1.2 * rotary / h, 1e-6);
    assert_near_rel(e.m[num_at(D_V, NODE + D_V, OUTER)], 9.0 / 70.0 * m * h - 1.2 * rotary / h,
                    1e-6);
    assert_near_rel(e.m[num_at(D_DV, D_DV, OUTER)], m * h * h * h / 105.0 + rotary * h * 2.0 / 15.0,
                    1e-6);
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
        cmocka_unit_test(strains_are_derivatives_of_motions),
        cmocka_unit_test(slope_is_rotation_and_shear),
        cmocka_unit_test(ends_are_the_nodes),
        cmocka_unit_test(stiffness_by_hand),
        cmocka_unit_test(mass_by_hand),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
