/* The solver of the lifting line; its numbers are verified in tests/verify/lifting_line.c. */
#include "core/aero/lifting_line.h"
#include "core/aero/lifting_line_kernel.h"
#include "core/la.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

enum { N = 16 };

struct setting {
    struct polar *polar;
    struct lifting_line ll;
    struct lifting_line_state state;
};

static void fill(double value, double *x)
{
    for (int i = 0; i < N; i++) {
        x[i] = value;
    }
}

static void start(const struct polar_def *def, double tolerance, int iterations, struct setting *s)
{
    assert_ok(polar_create(def, &s->polar));
    double chord[N];
    fill(0.1, chord);
    const struct wing wing = {.n = N, .length = 0.37, .chord = chord, .walls = WALLS_ROOT};
    assert_ok(lifting_line_init(&wing, tolerance, iterations, &s->ll));
    assert_ok(lifting_line_state_init(N, &s->state));
}

static void finish(struct setting *s)
{
    lifting_line_state_done(&s->state);
    lifting_line_done(&s->ll);
    polar_destroy(s->polar);
}

/* Largest |c_l - C_l(alpha) - eps B~ alpha|, alpha = alpha_g - B c_l, computed from outside. */
static double residual(const struct setting *s, const double *alpha, const double *plunge)
{
    double largest = 0.0;
    for (int i = 0; i < N; i++) {
        double induced = 0.0;
        for (int j = 0; j < N; j++) {
            induced += s->ll.induced[num_at(i, j, N)] * s->state.cl[j];
        }
        assert_near_abs(s->state.induced[i], induced, 1e-14);
        assert_near_abs(s->state.alpha[i], alpha[i] - induced, 1e-14);
        double rough = 0.0;
        for (int j = 0; j < N; j++) {
            rough += s->ll.induced[num_at(i, j, N)] * (s->state.alpha[j] - s->state.alpha[i]);
        }
        const double cl = polar_at(s->polar, alpha[i] - induced, plunge[i]).cl;
        largest = fmax(largest, fabs(s->state.cl[i] - cl - s->state.epsilon * rough));
    }
    return largest;
}

/* Random twisted wings, partly beyond the table: a cold start finds every solution; a start
 * continued from quite other angles may fail, but the report says so. */
static void the_report_is_true(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(2.0 * NUM_PI, 0.0, 0.0, 0.3);
    struct setting s, warm;
    double alpha[N], plunge[N];
    uint64_t seed = 2;
    start(&def, 1e-10, 50, &warm);
    fill(0.0, plunge);
    for (int k = 0; k < 40; k++) {
        const double root = 0.7 * random_uniform(&seed) - 0.35;
        const double tip = 0.7 * random_uniform(&seed) - 0.35;
        for (int i = 0; i < N; i++) {
            alpha[i] = root + (tip - root) * (i + 0.5) / N;
        }
        start(&def, 1e-10, 50, &s);
        struct lifting_line_report r = lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
        assert_true(r.converged);
        assert_true(r.residual <= 1e-10);
        assert_near_abs(residual(&s, alpha, plunge), r.residual, 1e-13);
        finish(&s);
        r = lifting_line_solve(&warm.ll, warm.polar, alpha, plunge, &warm.state);
        assert_int_equal(r.converged, r.residual <= 1e-10);
        assert_near_abs(residual(&warm, alpha, plunge), r.residual, 1e-12);
    }
    finish(&warm);
    polar_def_done(&def);
}

/* A linear polar needs one step; the warm start of the same state none. */
static void linear_problems_take_one_step(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(5.0, 0.0, 0.0, 1.0);
    struct setting s;
    double alpha[N], plunge[N];
    start(&def, 1e-10, 50, &s);
    fill(0.1, alpha);
    fill(0.0, plunge);
    struct lifting_line_report r = lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
    assert_true(r.converged);
    assert_int_equal(r.iterations, 1);
    r = lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
    assert_true(r.converged);
    assert_int_equal(r.iterations, 0);
    finish(&s);
    polar_def_done(&def);
}

/* Stall: a polar that falls steeply. Either the residual is below the tolerance or the report says
 * that it is not; the state stays finite and usable. */
static void stall_is_solved_or_said(void **state)
{
    (void)state;
    enum { ANGLES = 5 };
    double alpha_axis[ANGLES] = {-0.5, -0.1, 0.1, 0.2, 0.5}, plunge_axis[1] = {0.0};
    double cl[ANGLES] = {-0.3, -0.6, 0.6, 0.3, 0.25}, zero[ANGLES] = {0};
    const struct polar_def def = {.n_alpha = ANGLES,
                                  .n_plunge = 1,
                                  .alpha = alpha_axis,
                                  .plunge = plunge_axis,
                                  .cl = cl,
                                  .cd = zero,
                                  .cm = zero,
                                  .linear_from = -0.1,
                                  .linear_to = 0.1};
    struct setting s;
    double alpha[N], plunge[N];
    int solved = 0;
    start(&def, 1e-9, 50, &s);
    fill(0.0, plunge);
    for (double angle = 0.0; angle < 0.45; angle += 0.003) {
        fill(angle, alpha);
        const struct lifting_line_report r =
            lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
        const double left = residual(&s, alpha, plunge);
        assert_near_abs(left, r.residual, 1e-12);
        assert_int_equal(r.converged, left <= 1e-9);
        assert_true(r.iterations <= 50);
        assert_true(num_all_finite(N, s.state.cl));
        solved += r.converged;
    }

    assert_true(solved >= 149); /* of 151 */
    finish(&s);
}

/* Where no slope is negative the fall elsewhere in the table changes no bit; in the fall the result
 * is that of the equation with viscosity, and the report says how much it is. */
static void viscosity_only_in_the_fall(void **state)
{
    (void)state;
    enum { ANGLES = 7 };
    double alpha_axis[ANGLES] = {-0.6, -0.4, -0.2, 0.0, 0.2, 0.4, 0.6}, plunge_axis[1] = {0.0};
    double falling[ANGLES] = {-0.9, -0.8, -1.0, 0.0, 1.0, 0.8, 0.9}, zero[ANGLES] = {0};
    double flat[ANGLES] = {-1.0, -1.0, -1.0, 0.0, 1.0, 1.0, 1.0};
    struct polar_def def = {.n_alpha = ANGLES,
                            .n_plunge = 1,
                            .alpha = alpha_axis,
                            .plunge = plunge_axis,
                            .cl = falling,
                            .cd = zero,
                            .cm = zero,
                            .linear_from = -0.2,
                            .linear_to = 0.2};
    struct setting falls, other;
    double alpha[N], plunge[N];
    start(&def, 1e-10, 50, &falls);
    assert_true(polar_steepest_fall(falls.polar) >= 1.0); /* (1.0 - 0.8)/0.2 between the points */
    def.cl = flat;                                        /* the same cubics up to 0.2 rad */
    start(&def, 1e-10, 50, &other);
    assert_true(polar_steepest_fall(other.polar) == 0.0);
    for (int i = 0; i < N; i++) {
        alpha[i] = 0.02 + 0.001 * i; /* all iterates, too, stay below 0.2 rad */
    }
    fill(0.0, plunge);
    struct lifting_line_report a =
        lifting_line_solve(&falls.ll, falls.polar, alpha, plunge, &falls.state);
    assert_true(a.converged);
    assert_true(a.smoothing == 0.0);
    a = lifting_line_solve(&other.ll, other.polar, alpha, plunge, &other.state);
    assert_true(a.converged);
    assert_memory_equal(falls.state.cl, other.state.cl, sizeof alpha);
    fill(0.3, alpha);
    a = lifting_line_solve(&falls.ll, falls.polar, alpha, plunge, &falls.state);
    assert_true(a.converged);
    double largest = 0.0;
    for (int i = 0; i < N; i++) {
        const double cl = polar_at(falls.polar, falls.state.alpha[i], 0.0).cl;
        largest = fmax(largest, fabs(falls.state.cl[i] - cl));
    }
    assert_true(largest > 0.0);
    assert_near_abs(a.smoothing, largest, 1e-9);
    finish(&other);
    finish(&falls);
}

static void no_iterations_left(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(5.0, 0.0, 0.0, 1.0);
    struct setting s;
    double alpha[N], plunge[N];
    start(&def, 1e-300, 3, &s);
    fill(0.1, alpha);
    fill(0.0, plunge);
    const struct lifting_line_report r =
        lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
    assert_true(r.iterations <= 3);
    assert_true(r.residual < 1e-13);
    assert_int_equal(r.converged, r.residual <= 1e-300);
    finish(&s);
    polar_def_done(&def);
}

/* An angle that is not a number is held at the border of the table like any other outside it; the
 * solver ends and the next solutions are those of a fresh state. */
static void nan_does_not_stay(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(5.0, 0.0, 0.0, 1.0);
    struct setting s, fresh;
    double alpha[N], plunge[N];
    start(&def, 1e-10, 50, &s);
    start(&def, 1e-10, 50, &fresh);
    fill(0.1, alpha);
    fill(0.0, plunge);
    (void)lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
    alpha[3] = (double)NAN;
    (void)lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state);
    assert_true(isnan(s.state.alpha[3]));
    fill(0.2, alpha);
    for (int k = 0; k < 4; k++) {
        assert_true(lifting_line_solve(&s.ll, s.polar, alpha, plunge, &s.state).converged);
    }
    (void)lifting_line_solve(&fresh.ll, fresh.polar, alpha, plunge, &fresh.state);
    for (int i = 0; i < N; i++) {
        assert_near_abs(s.state.cl[i], fresh.state.cl[i], 1e-9);
    }
    finish(&fresh);
    finish(&s);
    polar_def_done(&def);
}

/* Every instruction set of this machine gives the same bits, on a wing whose angles run over
 * several pieces of the polar and out of it. */
static void levels_agree(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(2.0 * NUM_PI, 0.0, 0.0, 0.3);
    struct setting s[SIMD_LEVELS];
    const enum simd_level best = simd_level_of_machine();
    for (enum simd_level level = SIMD_PORTABLE; level <= best; level++) {
        start(&def, 1e-12, 50, &s[level]);
        s[level].ll.multiply = simd_gemv(level);
        s[level].ll.evaluate = lifting_line_kernel(level);
    }
    for (int k = 0; k < 40; k++) {
        double alpha[N], plunge[N];
        for (int i = 0; i < N; i++) {
            alpha[i] = 0.4 * sin(0.3 * k + 0.2 * i);
            plunge[i] = 0.0;
        }
        for (enum simd_level level = SIMD_PORTABLE; level <= best; level++) {
            (void)lifting_line_solve(&s[level].ll, s[level].polar, alpha, plunge, &s[level].state);
            assert_memory_equal(s[level].state.cl, s[0].state.cl, sizeof alpha);
            assert_memory_equal(s[level].state.alpha, s[0].state.alpha, sizeof alpha);
        }
    }
    for (enum simd_level level = SIMD_PORTABLE; level <= best; level++) {
        finish(&s[level]);
    }
    polar_def_done(&def);
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
        cmocka_unit_test(the_report_is_true),
        cmocka_unit_test(linear_problems_take_one_step),
        cmocka_unit_test(stall_is_solved_or_said),
        cmocka_unit_test(viscosity_only_in_the_fall),
        cmocka_unit_test(no_iterations_left),
        cmocka_unit_test(nan_does_not_stay),
        cmocka_unit_test(levels_agree),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
