/* What every section matrix must satisfy; its numbers are verified in tests/verify/sections.c. */
#include "core/coupling/model.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

enum { N = SECTION_STRAIN_COUNT, C = SECTION_CLASSIC };

static void build(double degrees, enum chordwise_curvature chordwise, struct model *m)
{
    struct case_def def;
    struct failure fail;
    fixture_paper_beam(degrees, NULL, &def);
    def.kind = CASE_SECTION;
    def.beam.section.shape.chordwise = chordwise;
    assert_ok(model_build(&def, m, &fail));
}

static void assert_symmetric(int n, const double *a)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) {
            const double scale = sqrt(a[num_at(i, i, n)] * a[num_at(j, j, n)]);
            assert_near_abs(a[num_at(i, j, n)], a[num_at(j, i, n)], 1e-12 * scale);
        }
    }
}

/* Positive definite: all pivots of an elimination without exchange are positive. */
static void assert_positive(int n, const double *matrix)
{
    double a[N * N];
    memcpy(a, matrix, (size_t)(n * n) * sizeof *a);
    for (int k = 0; k < n; k++) {
        const double pivot = a[num_at(k, k, n)];
        assert_true(pivot > 1e-12 * matrix[num_at(k, k, n)]);
        for (int i = k + 1; i < n; i++) {
            for (int j = k + 1; j < n; j++) {
                a[num_at(i, j, n)] -= a[num_at(i, k, n)] * a[num_at(k, j, n)] / pivot;
            }
        }
    }
}

static void matrices_are_symmetric_and_positive(void **state)
{
    (void)state;
    for (double degrees = -90.0; degrees <= 90.0; degrees += 15.0) {
        for (int chord = 0; chord < 2; chord++) {
            struct model m;
            build(degrees, (enum chordwise_curvature)chord, &m);
            assert_symmetric(N, m.section.stiffness);
            assert_symmetric(C, m.section.classic);
            assert_symmetric(SECTION_MOTION_COUNT, m.section.mass);
            assert_positive(N, m.section.stiffness);
            assert_positive(C, m.section.classic);
            model_done(&m);
        }
    }
}

/* A ply angle of the other sign mirrors the section: only the coupling terms change sign. */
static void mirrored_plies_mirror_the_section(void **state)
{
    (void)state;
    struct model a, b;
    build(30.0, CHORDWISE_FREE, &a);
    build(-30.0, CHORDWISE_FREE, &b);
    assert_near_rel(b.section_summary.ei_flap, a.section_summary.ei_flap, 1e-10);
    assert_near_rel(b.section_summary.ei_lag, a.section_summary.ei_lag, 1e-10);
    assert_near_rel(b.section_summary.gj, a.section_summary.gj, 1e-10);
    assert_near_rel(b.section_summary.bend_twist, -a.section_summary.bend_twist, 1e-10);
    assert_true(b.section_summary.bend_twist < 0.0);
    model_done(&a);
    model_done(&b);
}

/* Holding the chord straight can only stiffen. */
static void a_rigid_chord_is_stiffer(void **state)
{
    (void)state;
    struct model a, b;
    build(-45.0, CHORDWISE_FREE, &a);
    build(-45.0, CHORDWISE_RIGID, &b);
    assert_true(b.section_summary.ei_flap > 1.01 * a.section_summary.ei_flap);
    assert_true(b.section_summary.gj >= a.section_summary.gj * (1.0 - 1e-12));
    model_done(&a);
    model_done(&b);
}

/* Torsion of the one-sided laminate must not be held by the in-plane shear (model, section 2). */
static void shear_of_an_open_wall_is_free(void **state)
{
    (void)state;
    struct model m;
    build(0.0, CHORDWISE_FREE, &m);
    const struct shape *shape = &m.def.beam.section.shape;
    struct laminate laminate;
    assert_int_equal(
        laminate_build(shape->layup[0].n_ply, shape->layup[0].ply, shape->chordwise, &laminate),
        ST_OK);
    const double held = 4.0 * laminate.d[8] * 0.1; /* k_sz = 2 theta', gamma = 0 */
    assert_true(m.section_summary.gj < 0.3 * held);
    model_done(&m);
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
        cmocka_unit_test(matrices_are_symmetric_and_positive),
        cmocka_unit_test(mirrored_plies_mirror_the_section),
        cmocka_unit_test(a_rigid_chord_is_stiffer),
        cmocka_unit_test(shear_of_an_open_wall_is_free),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
