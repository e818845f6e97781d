/* Minima under constraints whose place is known, and what happens where evaluations fail. */
#include "core/num.h"
#include "core/study/optimum.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

struct subject {
    void (*fill)(struct optimum_point *p);
    int calls, end_at;
};

static enum status answer(void *context, struct optimum_point *p)
{
    struct subject *s = context;
    if (++s->calls == s->end_at) {
        return ST_CANCELLED;
    }
    s->fill(p);
    return ST_OK;
}

static struct optimum_def def_of(int n, double lower, double upper)
{
    struct optimum_def d;
    optimum_def_defaults(&d);
    d.n = n;
    for (int i = 0; i < n; i++) {
        d.lower[i] = lower;
        d.upper[i] = upper;
    }
    for (int j = 0; j < OPTIMUM_CONSTRAINTS_MAX; j++) {
        d.scale[j] = 1.0;
    }
    return d;
}

/* Rosenbrock's valley on the unit disc: (0.786415, 0.617698), 0.0456748. */
static void valley_on_a_disc(struct optimum_point *p)
{
    const double x = p->x[0], y = p->x[1];
    p->objective = num_sq(1.0 - x) + 100.0 * num_sq(y - x * x);
    p->excess[0] = x * x + y * y - 1.0;
}

static void rosenbrock_on_a_disc(void **state)
{
    (void)state;
    struct optimum_def d = def_of(2, -1.5, 1.5);
    d.n_constraint = 1;
    d.evaluations_max = 2000;
    d.tolerance = 1e-7;
    struct subject s = {.fill = valley_on_a_disc};
    struct optimum_result r;
    assert_ok(optimum_search(&d, 0, answer, &s, &r));
    assert_int_equal(r.outcome, OPTIMUM_FOUND);
    const struct optimum_point *best = &r.point[r.best];
    assert_near_abs(best->objective, 0.0456748, 1e-4);
    assert_near_abs(best->x[0], 0.786415, 5e-3);
    assert_near_abs(best->x[1], 0.617698, 8e-3);
    assert_true(best->feasible && best->excess[0] <= d.excess_max);
    assert_int_equal(r.n, s.calls);
    optimum_done(&r);
}

/* Two basins: -1 at 0.2, -2 at 0.83 of a narrow one. */
static void two_basins(struct optimum_point *p)
{
    const double x = p->x[0];
    p->objective = -exp(-num_sq((x - 0.2) / 0.15)) - 2.0 * exp(-num_sq((x - 0.83) / 0.06));
}

static void the_whole_box_is_searched(void **state)
{
    (void)state;
    struct optimum_def d = def_of(1, 0.0, 1.0);
    d.method = OPTIMUM_DIRECT;
    d.starts = 1;
    struct subject s = {.fill = two_basins};
    struct optimum_result r;
    assert_ok(optimum_search(&d, 0, answer, &s, &r));
    assert_int_equal(r.outcome, OPTIMUM_FOUND);
    assert_near_abs(r.point[r.best].x[0], 0.83, 2e-3);
    assert_true(r.n <= d.evaluations_max);
    optimum_done(&r);
    /* One descent from the left stays there; several starts find the better basin. */
    d.method = OPTIMUM_COBYLA;
    d.has_start = true;
    d.start[0] = 0.1;
    struct optimum_point found = {.status = ST_NOT_FINITE};
    for (int i = 0; i < 4; i++) {
        assert_ok(optimum_search(&d, i, answer, &s, &r));
        const struct optimum_point *p = &r.point[r.best];
        found = optimum_is_better(p, &found) ? *p : found;
        if (i == 0) {
            assert_near_abs(p->x[0], 0.2, 5e-3);
        }
        optimum_done(&r);
    }
    assert_near_abs(found.x[0], 0.83, 2e-3);
}

/* Fails left of 0.4 and steps; the minimum -1 at 0.5 sits close by. */
static void beside_a_hole(struct optimum_point *p)
{
    if (p->x[0] < 0.4) {
        p->status = ST_NOT_CONVERGED;
        p->objective = NAN;
        return;
    }
    p->objective = num_sq(p->x[0] - 0.5) - 1.0;
}

static void failures_do_not_end_a_search(void **state)
{
    (void)state;
    struct optimum_def d = def_of(1, 0.0, 1.0);
    d.has_start = true;
    d.start[0] = 0.45;
    for (enum optimum_method m = 0; m < OPTIMUM_METHODS; m++) {
        struct subject s = {.fill = beside_a_hole};
        struct optimum_result r;
        d.method = m;
        assert_ok(optimum_search(&d, 0, answer, &s, &r));
        assert_int_equal(r.outcome, OPTIMUM_FOUND);
        assert_near_abs(r.point[r.best].x[0], 0.5, 5e-3);
        assert_true(m == OPTIMUM_COBYLA || r.n_failed > 0);
        optimum_done(&r);
    }
    /* A start that fails is the end of that search. */
    struct subject s = {.fill = beside_a_hole};
    struct optimum_result r;
    d.method = OPTIMUM_COBYLA;
    d.start[0] = 0.1;
    assert_ok(optimum_search(&d, 0, answer, &s, &r));
    assert_int_equal(r.outcome, OPTIMUM_FAILED);
    assert_int_equal(r.best, -1);
    assert_int_equal(r.n, 1);
    optimum_done(&r);
}

/* x >= 1 and x <= -1 cannot be met at once: least violation 1 at 0. */
static void contradiction(struct optimum_point *p)
{
    p->objective = p->x[0];
    p->excess[0] = 1.0 - p->x[0];
    p->excess[1] = p->x[0] + 1.0;
}

static void no_feasible_point_is_said(void **state)
{
    (void)state;
    struct optimum_def d = def_of(1, -3.0, 3.0);
    d.n_constraint = 2;
    struct subject s = {.fill = contradiction};
    struct optimum_result r;
    assert_ok(optimum_search(&d, 1, answer, &s, &r));
    assert_int_equal(r.outcome, OPTIMUM_INFEASIBLE);
    assert_near_abs(r.point[r.best].x[0], 0.0, 0.02);
    assert_near_abs(r.point[r.best].violation, 1.0, 0.02);
    assert_false(r.point[r.best].feasible);
    optimum_done(&r);
}

/* A maximum at a bound, and constraints whose scales differ by eight orders. */
static void corner(struct optimum_point *p)
{
    p->objective = -p->x[0] - p->x[1];
    p->excess[0] = 1e-4 * (p->x[0] - 2.0);
    p->excess[1] = 1e4 * (p->x[1] - 8.0);
}

static void scales_do_not_matter(void **state)
{
    (void)state;
    struct optimum_def d = def_of(2, 0.0, 10.0);
    d.n_constraint = 2;
    d.scale[0] = 1e-4;
    d.scale[1] = 1e4;
    d.tolerance = 1e-5;
    struct subject s = {.fill = corner};
    struct optimum_result r;
    assert_ok(optimum_search(&d, 0, answer, &s, &r));
    assert_near_abs(r.point[r.best].x[0], 2.0, 1e-3);
    assert_near_abs(r.point[r.best].x[1], 8.0, 1e-3);
    optimum_done(&r);
}

static void the_same_search_twice_and_its_ends(void **state)
{
    (void)state;
    struct optimum_def d = def_of(2, -1.5, 1.5);
    d.n_constraint = 1;
    for (enum optimum_method m = 0; m < OPTIMUM_METHODS; m++) {
        struct subject s = {.fill = valley_on_a_disc};
        struct optimum_result a, b;
        d.method = m;
        d.evaluations_max = 40;
        d.tolerance = 1e-6;
        assert_ok(optimum_search(&d, 0, answer, &s, &a));
        assert_ok(optimum_search(&d, 0, answer, &s, &b));
        assert_int_equal(a.n, b.n);
        assert_memory_equal(a.point, b.point, (size_t)a.n * sizeof *a.point);
        assert_int_equal(a.outcome, OPTIMUM_EXHAUSTED);
        assert_int_equal(a.n, 40);
        optimum_done(&a);
        optimum_done(&b);
        s = (struct subject){.fill = valley_on_a_disc, .end_at = 10};
        assert_int_equal(optimum_search(&d, 0, answer, &s, &a), ST_CANCELLED);
        assert_int_equal(a.n, 9);
        assert_int_equal(s.calls, 10);
        optimum_done(&a);
    }
}

static void starts_differ_and_lie_in_the_box(void **state)
{
    (void)state;
    struct optimum_def d = def_of(3, -2.0, 4.0);
    double x[3], first[3] = {1.0, 1.0, 1.0};
    optimum_start(&d, 0, x);
    assert_memory_equal(x, first, sizeof x); /* the middle */
    for (int i = 1; i < OPTIMUM_STARTS_MAX; i++) {
        double before[3];
        memcpy(before, x, sizeof x);
        optimum_start(&d, i, x);
        assert_true(memcmp(before, x, sizeof x) != 0);
        for (int k = 0; k < 3; k++) {
            assert_true(x[k] > -2.0 && x[k] < 4.0);
        }
    }
}

static void bad_definitions_are_named(void **state)
{
    (void)state;
    struct failure_list *list = calloc(1, sizeof *list);
    struct optimum_def d = def_of(2, 0.0, 1.0);
    optimum_def_check(&d, list);
    assert_int_equal(list->total, 0);
    d.upper[1] = 0.0;
    d.evaluations_max = 3;
    optimum_def_check(&d, list);
    assert_int_equal(list->total, 2);
    assert_string_equal(list->item[0].pointer, "/evaluations_max");
    assert_string_equal(list->item[1].pointer, "/variables/1/to");
    free(list);
    assert_int_equal(optimum_method_of("direct"), OPTIMUM_DIRECT);
    assert_int_equal(optimum_method_of("newton"), OPTIMUM_METHODS);
    assert_string_equal(optimum_outcome_name(OPTIMUM_INFEASIBLE), "infeasible");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rosenbrock_on_a_disc),
        cmocka_unit_test(the_whole_box_is_searched),
        cmocka_unit_test(failures_do_not_end_a_search),
        cmocka_unit_test(no_feasible_point_is_said),
        cmocka_unit_test(scales_do_not_matter),
        cmocka_unit_test(the_same_search_twice_and_its_ends),
        cmocka_unit_test(starts_differ_and_lie_in_the_box),
        cmocka_unit_test(bad_definitions_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
