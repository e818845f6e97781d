#include "core/aero/polar.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

enum { ANGLES = 7, ROWS = 3 };

/* A table on the stack; plunge rows differ by their factor. */
struct table {
    double alpha[ANGLES], plunge[ROWS], cl[ANGLES * ROWS], cd[ANGLES * ROWS], cm[ANGLES * ROWS];
    struct polar_def def;
};

static void stalling_table(struct table *t)
{
    static const double alpha[ANGLES] = {-0.3, -0.1, 0.0, 0.05, 0.15, 0.2, 0.4};
    static const double cl[ANGLES] = {-0.8, -0.6, 0.0, 0.3, 0.7, 0.7, 0.9};
    *t = (struct table){.plunge = {-1.0, 0.0, 2.0}};
    memcpy(t->alpha, alpha, sizeof alpha);
    for (int r = 0; r < ROWS; r++) {
        for (int i = 0; i < ANGLES; i++) {
            t->cl[i + ANGLES * r] = (1.0 + r) * cl[i];
            t->cd[i + ANGLES * r] = 0.02 + alpha[i] * alpha[i];
            t->cm[i + ANGLES * r] = 0.1 * cl[i] + r;
        }
    }
    t->def = (struct polar_def){.n_alpha = ANGLES,
                                .n_plunge = ROWS,
                                .alpha = t->alpha,
                                .plunge = t->plunge,
                                .cl = t->cl,
                                .cd = t->cd,
                                .cm = t->cm,
                                .linear_from = -0.1,
                                .linear_to = 0.15};
}

static struct polar *create(const struct polar_def *def)
{
    struct polar *p = NULL;
    assert_ok(polar_create(def, &p));
    return p;
}

static void nodes_are_met(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    for (int r = 0; r < ROWS; r++) {
        for (int i = 0; i < ANGLES; i++) {
            const struct polar_value v = polar_at(p, t.alpha[i], t.plunge[r]);
            assert_near_abs(v.cl, t.cl[i + ANGLES * r], 1e-15);
            assert_near_abs(v.cd, t.cd[i + ANGLES * r], 1e-15);
            assert_near_abs(v.cm, t.cm[i + ANGLES * r], 1e-15);
            assert_false(v.outside);
        }
    }
    polar_destroy(p);
}

/* Monotone data give a monotone curve, without overshoot, also over the flat piece. */
static void shape_is_kept(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    double before = -HUGE_VAL;
    for (int k = 0; k <= 7000; k++) {
        const double alpha = -0.3 + k * 1e-4;
        const struct polar_value v = polar_at(p, alpha, -1.0);
        assert_true(v.cl >= before - 1e-14);
        assert_true(v.cl >= -0.8 - 1e-14);
        assert_true(v.cl <= 0.9 + 1e-14);
        if (alpha > 0.15 && alpha < 0.2) {
            assert_near_abs(v.cl, 0.7, 1e-14);
        }
        before = v.cl;
    }
    polar_destroy(p);
}

static void slopes_are_those_of_the_value(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    const double h = 1e-6;
    for (double alpha = -0.29; alpha < 0.39; alpha += 0.0131) {
        for (double plunge = -0.9; plunge < 2.0; plunge += 0.37) {
            const struct polar_value v = polar_at(p, alpha, plunge);
            const struct polar_value a = polar_at(p, alpha - h, plunge);
            const struct polar_value b = polar_at(p, alpha + h, plunge);
            assert_near_abs(v.cl_slope, (b.cl - a.cl) / (2.0 * h), 1e-4);
            assert_near_abs(v.cm_slope, (b.cm - a.cm) / (2.0 * h), 1e-4);
        }
    }
    polar_destroy(p);
}

static void straight_lines_are_exact(void **state)
{
    (void)state;
    struct polar_def def = fixture_linear_polar(5.7, -0.6, 0.03, 0.5);
    struct polar *p = create(&def);
    for (double alpha = -0.5; alpha <= 0.5; alpha += 0.003) {
        const struct polar_value v = polar_at(p, alpha, 3.0);
        assert_near_abs(v.cl, 5.7 * alpha, 1e-14);
        assert_near_abs(v.cm, -0.6 * alpha, 1e-15);
        assert_near_abs(v.cd, 0.03, 1e-16);
        assert_near_rel(v.cl_slope, 5.7, 1e-12);
        assert_false(v.outside); /* one row of plunge: no range to leave */
    }
    polar_destroy(p);
    polar_def_done(&def);
}

static void plunge_is_linear_and_held(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    const double row[ROWS] = {polar_at(p, 0.07, -1.0).cl, polar_at(p, 0.07, 0.0).cl,
                              polar_at(p, 0.07, 2.0).cl};
    assert_near_rel(polar_at(p, 0.07, -0.25).cl, 0.25 * row[0] + 0.75 * row[1], 1e-14);
    assert_near_rel(polar_at(p, 0.07, 0.5).cl, 0.75 * row[1] + 0.25 * row[2], 1e-14);
    const struct polar_value below = polar_at(p, 0.07, -1.5), above = polar_at(p, 0.07, 9.0);
    assert_near_abs(below.cl, row[0], 1e-15);
    assert_near_abs(above.cl, row[2], 1e-15);
    assert_true(below.outside && !below.outside_alpha);
    assert_true(above.outside && !above.outside_alpha);
    assert_true(polar_at(p, 9.0, 0.0).outside && polar_at(p, 9.0, 0.0).outside_alpha);
    assert_true(above.cl_slope > 0.0); /* the angle is inside: its slope stays */
    polar_destroy(p);
}

static void angles_outside_are_held_and_said(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    static const double angle[] = {-0.31, -9.0, 0.41, 100.0, -HUGE_VAL, HUGE_VAL};
    for (size_t k = 0; k < sizeof angle / sizeof angle[0]; k++) {
        const struct polar_value v = polar_at(p, angle[k], -1.0);
        assert_near_abs(v.cl, angle[k] < 0.0 ? -0.8 : 0.9, 1e-14);
        assert_true(v.outside);
        assert_true(v.cl_slope == 0.0);
        assert_true(v.cm_slope == 0.0);
    }
    assert_true(polar_at(p, (double)NAN, 0.0).outside);
    assert_true(polar_at(p, 0.0, (double)NAN).outside);
    polar_destroy(p);
}

/* What the lifting line keeps of the polar between its questions: the same bits anywhere in the
 * range the piece is said to hold for, up to its borders. */
static void pieces_are_the_curve(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    uint64_t seed = 4;
    for (int i = 0; i < 400; i++) {
        const double alpha = 1.2 * random_uniform(&seed) - 0.55;
        const double plunge = 5.0 * random_uniform(&seed) - 2.0;
        const struct polar_piece c = polar_piece_at(p, alpha, plunge);
        assert_true(c.from <= alpha && alpha < c.to);
        const double angle[] = {alpha, fmax(c.from, -1.0), fmin(c.to, 1.0) - 1e-12};
        for (size_t k = 0; k < sizeof angle / sizeof angle[0]; k++) {
            const struct polar_value v = polar_at(p, angle[k], plunge);
            const double x = angle[k] - c.origin;
            const double *a = c.lift;
            assert_true(v.cl == a[0] + x * (a[1] + x * (a[2] + x * a[3])));
            assert_true(v.cl_slope == a[1] + x * (2.0 * a[2] + x * (3.0 * a[3])));
        }
    }
    const struct polar_piece none = polar_piece_at(p, (double)NAN, 0.0);
    assert_true(none.lift[0] == polar_at(p, (double)NAN, 0.0).cl && none.lift[1] == 0.0);
    polar_destroy(p);
}

static void stall_is_beyond_the_linear_range(void **state)
{
    (void)state;
    struct table t;
    stalling_table(&t);
    struct polar *p = create(&t.def);
    assert_false(polar_is_stalled(p, 0.0));
    assert_false(polar_is_stalled(p, 0.15));
    assert_true(polar_is_stalled(p, 0.1501));
    assert_true(polar_is_stalled(p, -0.11));
    assert_true(polar_is_stalled(p, (double)NAN));
    polar_destroy(p);
}

static void assert_refused(const struct polar_def *def, const char *pointer, const char *code)
{
    struct failure_list *list = calloc(1, sizeof *list);
    polar_def_check(def, "/p", list);
    assert_int_equal(list->count, 1);
    assert_string_equal(list->item[0].pointer, pointer);
    assert_string_equal(list->item[0].code, code);
    free(list);
}

static void every_fault_of_a_table_is_named(void **state)
{
    (void)state;
    struct table t;
    struct failure_list *list = calloc(1, sizeof *list);
    stalling_table(&t);
    polar_def_check(&t.def, "/p", list);
    assert_int_equal(list->count, 0);
    free(list);
    t.alpha[3] = t.alpha[2];
    assert_refused(&t.def, "/p/alpha_deg/3", "not_increasing");
    stalling_table(&t);
    t.alpha[0] = (double)NAN;
    assert_refused(&t.def, "/p/alpha_deg/0", "not_increasing");
    stalling_table(&t);
    t.plunge[2] = (double)INFINITY;
    assert_refused(&t.def, "/p/plunge_c/2", "not_increasing");
    stalling_table(&t);
    t.def.n_alpha = 1;
    assert_refused(&t.def, "/p/alpha_deg", "too_short");
    stalling_table(&t);
    t.def.n_plunge = 0;
    assert_refused(&t.def, "/p/plunge_c", "too_short");
    stalling_table(&t);
    t.cm[ANGLES * 2 + 4] = (double)NAN;
    assert_refused(&t.def, "/p/cm/2/4", "not_finite");
    stalling_table(&t);
    t.def.linear_to = t.def.linear_from;
    assert_refused(&t.def, "/p/linear_to_deg", "out_of_range");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_are_met),
        cmocka_unit_test(shape_is_kept),
        cmocka_unit_test(slopes_are_those_of_the_value),
        cmocka_unit_test(straight_lines_are_exact),
        cmocka_unit_test(plunge_is_linear_and_held),
        cmocka_unit_test(angles_outside_are_held_and_said),
        cmocka_unit_test(pieces_are_the_curve),
        cmocka_unit_test(stall_is_beyond_the_linear_range),
        cmocka_unit_test(every_fault_of_a_table_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
