/* What every section matrix must satisfy; its numbers are verified in tests/verify/sections.c. */
#include "core/coupling/model.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/draw.h"
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

/* Torsion stiffness with all forces but the torque zero, from the retained matrix. */
static double retained_gj(const struct section *s)
{
    static const int free_strain[] = {S_W, S_PSI, S_PHI, S_GXZ, S_GYZ};
    enum { FREE = sizeof free_strain / sizeof free_strain[0] };
    double a[FREE * FREE], b[FREE], gj = s->stiffness[num_at(S_THETA, S_THETA, N)];
    for (int i = 0; i < FREE; i++) {
        for (int j = 0; j < FREE; j++) {
            a[num_at(i, j, FREE)] = s->stiffness[num_at(free_strain[i], free_strain[j], N)];
        }
        b[i] = s->stiffness[num_at(free_strain[i], S_THETA, N)];
    }
    assert_ok(la_solve_symmetric(FREE, a, 1, b));
    for (int i = 0; i < FREE; i++) {
        gj -= b[i] * s->stiffness[num_at(free_strain[i], S_THETA, N)];
    }
    return gj;
}

static void add_walls(struct shape *s, int n, const double (*point)[2])
{
    const struct material m = fixture_isotropic(70e9, 0.33, 2700.0);
    const struct ply ply = draw_ply(&m, 0.0015);
    draw_contour(s, 64); /* the turn decays within a third of the thickness */
    const int layup = draw_layup(s, 1, &ply);
    for (int i = 0, last = -1; i < n; i++) {
        const int next = draw_point(s, point[i][0], point[i][1]);
        if (i > 0) {
            (void)draw_wall(s, last, next, layup);
        }
        last = next;
    }
}

static double length_of(int n, const double (*point)[2])
{
    double sum = 0.0;
    for (int i = 1; i < n; i++) {
        sum += hypot(point[i][0] - point[i - 1][0], point[i][1] - point[i - 1][1]);
    }
    return sum;
}

/* The retained set has the torsion of the classic one where no shear force acts, whatever the walls
 * may do: at a corner their normals turn with the section, each wall by its own part. */
static void both_sets_have_one_torsion(void **state)
{
    (void)state;
    static const double channel[4][2] = {{0.025, 0.02}, {0.0, 0.02}, {0.0, -0.02}, {0.025, -0.02}};
    static const double angle[3][2] = {{0.03, 0.0}, {0.0, 0.0}, {0.0, -0.02}};
    static const double strip[2][2] = {{0.02, 0.01}, {-0.02, -0.01}};
    static const struct {
        int n;
        const double (*point)[2];
    } open_section[] = {{4, channel}, {3, angle}, {2, strip}};
    for (size_t i = 0; i < sizeof open_section / sizeof open_section[0]; i++) {
        double gj[2];
        for (int walls = WALL_SHEAR_RIGID; walls <= WALL_SHEAR_FLEXIBLE; walls++) {
            struct case_def def;
            struct failure fail;
            struct model m;
            case_def_defaults(&def);
            def.kind = CASE_SECTION;
            add_walls(&def.beam.section.shape, open_section[i].n, open_section[i].point);
            def.beam.section.shape.wall_shear = (enum wall_shear)walls;
            assert_ok(model_build(&def, &m, &fail));
            gj[walls] = m.centres.gj;
            assert_near_rel(retained_gj(&m.section), gj[walls], 1e-3);
            model_done(&m);
        }
        /* 0.63 h/b for the two free edges of the developed length b, less than that for each wall.
         */
        const double edges = 0.63 * 0.0015 / length_of(open_section[i].n, open_section[i].point);
        const double loss = 1.0 - gj[WALL_SHEAR_FLEXIBLE] / gj[WALL_SHEAR_RIGID];
        assert_true(loss > 0.97 * edges);
        assert_true(loss < 1.01 * edges * (open_section[i].n - 1));
    }
}

/* A round tube does not warp, so flexible walls have no surplus to hold: its modes stay. */
static void modes_of_a_round_tube(void **state)
{
    (void)state;
    const struct material m = fixture_isotropic(70e9, 0.33, 2700.0);
    const struct ply ply = draw_ply(&m, 0.0005);
    static struct shape shape;
    double omega[2][4];
    draw_contour(&shape, 20);
    const int layup = draw_layup(&shape, 1, &ply);
    const int front = draw_point(&shape, 0.03, 0.0), rear = draw_point(&shape, -0.03, 0.0);
    (void)draw_arc(&shape, front, rear, layup, 0.0, 0.03);
    (void)draw_arc(&shape, rear, front, layup, 0.0, -0.03);
    for (int walls = WALL_SHEAR_RIGID; walls <= WALL_SHEAR_FLEXIBLE; walls++) {
        struct case_def def;
        struct failure fail;
        struct model model;
        draw_case(&shape, 0.8, &def);
        def.kind = CASE_MODES;
        def.solver.modes = 4;
        def.beam.section.shear = SHEAR_RETAINED;
        def.beam.section.shape.wall_shear = (enum wall_shear)walls;
        assert_ok(model_build(&def, &model, &fail));
        memcpy(omega[walls], model.modes.omega, sizeof omega[walls]);
        model_done(&model);
    }
    for (int j = 0; j < 4; j++) {
        assert_near_rel(omega[WALL_SHEAR_FLEXIBLE][j], omega[WALL_SHEAR_RIGID][j], 1e-3);
    }
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
        cmocka_unit_test(both_sets_have_one_torsion),
        cmocka_unit_test(modes_of_a_round_tube),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
