/* The search for a boundary on functions whose roots and jumps are known. */
#include "core/study/boundary.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static const struct boundary_def range_2_9 = {
    .from = 2.0, .to = 9.0, .tolerance = 0.02, .scan = 5, .evaluations_max = 64};

/* A function of x, a hole where it fails, a call that ends the search; hysteresis as two levels. */
struct subject {
    double (*value)(double x);
    bool only_class;
    double hole_from, hole_to;
    int end_at; /* that call is cancelled; 0: none */
    int calls;
    double previous[BOUNDARY_SAMPLES_MAX]; /* x of `before`, NAN without */
    double x[BOUNDARY_SAMPLES_MAX];
};

static enum status answer(void *context, double x, enum boundary_sweep sweep, int before,
                          struct boundary_sample *out)
{
    struct subject *s = context;
    (void)sweep;
    s->previous[s->calls] = before >= 0 ? s->x[before] : (double)NAN;
    s->x[s->calls] = x;
    if (++s->calls == s->end_at) {
        return ST_CANCELLED;
    }
    if (x >= s->hole_from && x < s->hole_to) {
        out->status = ST_NOT_CONVERGED;
        return ST_OK;
    }
    const double value = s->value(x);
    out->side = value < 0.0 ? -1 : 1;
    out->value = s->only_class ? (double)NAN : value;
    return ST_OK;
}

static double falling_line(double x)
{
    return 6.1 - x;
}
static double root_of_cubic(double x)
{
    return 100.0 - x * x * x; /* 100^(1/3) */
}
static double steep(double x)
{
    return tanh(50.0 * (x - 2.9)) + 0.999;
}
static double jump(double x)
{
    return x < 7.123 ? 0.3 : -40.0;
}
static double wave(double x)
{
    return cos(x); /* 1.5 pi and 2.5 pi, and pi/2 below the range */
}
static double positive(double x)
{
    return 1.0 + x;
}

static void roots_are_found_within_the_tolerance(void **state)
{
    (void)state;
    const struct {
        double (*value)(double);
        double root;
        int side_below;
        int most; /* evaluations beside the scan */
    } cases[] = {
        {falling_line, 6.1, 1, 5},
        {root_of_cubic, 4.6415888336127791, 1, 4},
        {steep, 2.9 - 3.8002011672502 / 50.0, -1, 9},
        {jump, 7.123, 1, 9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct subject s = {.value = cases[i].value};
        struct boundary_result r;
        assert_ok(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r));
        assert_int_equal(r.outcome, BOUNDARY_FOUND);
        assert_true(r.upper - r.lower <= range_2_9.tolerance);
        assert_true(r.lower <= cases[i].root && cases[i].root <= r.upper);
        assert_true(r.lower <= r.x && r.x <= r.upper);
        assert_int_equal(r.side_below, cases[i].side_below);
        assert_int_equal(r.changes, 1);
        assert_int_equal(r.n, s.calls);
        assert_true(r.n <= range_2_9.scan + cases[i].most);
    }
}

/* Where only a class is known the bracket is halved: 1.75 to 0.02 takes 7. */
static void a_class_alone_is_bisected(void **state)
{
    (void)state;
    struct subject s = {.value = falling_line, .only_class = true};
    struct boundary_result r;
    assert_ok(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r));
    assert_int_equal(r.outcome, BOUNDARY_FOUND);
    assert_true(r.lower <= 6.1 && 6.1 <= r.upper);
    assert_int_equal(r.n, 5 + 7);
}

/* Never more than one evaluation above bisection, whatever the function. */
static void the_worst_case_is_bisection_and_one(void **state)
{
    (void)state;
    struct boundary_def d = range_2_9;
    for (int digits = 1; digits <= 6; digits++) {
        d.tolerance = pow(10.0, -digits);
        const int halvings = (int)ceil(log2(1.75 / d.tolerance));
        double (*const list[])(double) = {falling_line, root_of_cubic, steep, jump};
        for (int i = 0; i < 4; i++) {
            struct subject s = {.value = list[i]};
            struct boundary_result r;
            assert_ok(boundary_search(&d, BOUNDARY_ALONE, answer, &s, &r));
            assert_int_equal(r.outcome, BOUNDARY_FOUND);
            assert_true(r.n <= 5 + halvings + 1);
        }
    }
}

static void of_several_crossings_the_first_met_is_found(void **state)
{
    (void)state;
    struct boundary_result r;
    struct subject s = {.value = wave};
    assert_ok(boundary_search(&range_2_9, BOUNDARY_UP, answer, &s, &r));
    assert_near_abs(r.x, 4.71238898038469, 0.02);
    assert_int_equal(r.changes, 2);
    s = (struct subject){.value = wave};
    assert_ok(boundary_search(&range_2_9, BOUNDARY_DOWN, answer, &s, &r));
    assert_near_abs(r.x, 7.85398163397448, 0.02);
    assert_int_equal(r.changes, 2);
}

static void without_a_change_the_side_is_told(void **state)
{
    (void)state;
    struct subject s = {.value = positive};
    struct boundary_result r;
    assert_ok(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r));
    assert_int_equal(r.outcome, BOUNDARY_NOT_BRACKETED);
    assert_true(isnan(r.x));
    assert_int_equal(r.side_below, 1);
    assert_int_equal(r.n, 5);
    assert_true(r.sample[0].value == 3.0 && r.sample[4].value == 10.0);
}

/* Each point of a sweep goes on from the last one in its direction, inside a bracket from the end
 * where the sweep comes from. */
static void a_sweep_goes_on_from_the_point_before(void **state)
{
    (void)state;
    for (int down = 0; down <= 1; down++) {
        struct subject s = {.value = jump};
        struct boundary_result r;
        assert_ok(boundary_search(&range_2_9, down ? BOUNDARY_DOWN : BOUNDARY_UP, answer, &s, &r));
        assert_int_equal(r.outcome, BOUNDARY_FOUND);
        assert_true(isnan(s.previous[0]));
        assert_true(s.x[0] == (down ? 9.0 : 2.0));
        for (int i = 1; i < s.calls; i++) {
            assert_true(down ? s.previous[i] > s.x[i] : s.previous[i] < s.x[i]);
            /* The state before is that of the side the sweep comes from. */
            assert_true(i < 5 || (down ? jump(s.previous[i]) < 0.0 : jump(s.previous[i]) > 0.0));
        }
    }
}

static void failures_are_passed_around_and_told(void **state)
{
    (void)state;
    struct boundary_result r;
    /* A point of the scan and the neighbourhood of the root's secant fail; the root does not. */
    struct subject s = {.value = falling_line, .hole_from = 5.2, .hole_to = 5.8};
    assert_ok(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r));
    assert_int_equal(r.outcome, BOUNDARY_FOUND);
    assert_near_abs(r.x, 6.1, 0.02);
    assert_true(r.n_failed >= 1);
    assert_int_equal(r.sample[2].status, ST_NOT_CONVERGED);
    assert_true(r.sample[2].x == 5.5);
    /* The root itself lies in the hole. */
    s = (struct subject){.value = falling_line, .hole_from = 5.9, .hole_to = 6.3};
    assert_ok(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r));
    assert_int_equal(r.outcome, BOUNDARY_FAILED);
    assert_true(isnan(r.x));
    assert_true(r.lower < 5.9 && r.upper >= 6.3 && r.upper - r.lower < 1.75);
    /* Everything fails. */
    s = (struct subject){.value = falling_line, .hole_from = 0.0, .hole_to = 10.0};
    assert_ok(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r));
    assert_int_equal(r.outcome, BOUNDARY_FAILED);
    assert_int_equal(r.side_below, 0);
    assert_int_equal(r.n_failed, 5);
}

static void evaluations_end(void **state)
{
    (void)state;
    struct boundary_def d = range_2_9;
    struct boundary_result r;
    struct subject s = {.value = jump};
    d.evaluations_max = 8;
    assert_ok(boundary_search(&d, BOUNDARY_ALONE, answer, &s, &r));
    assert_int_equal(r.outcome, BOUNDARY_EXHAUSTED);
    assert_int_equal(s.calls, 8);
    assert_true(r.lower <= 7.123 && 7.123 <= r.upper);
    s = (struct subject){.value = jump, .end_at = 7};
    assert_int_equal(boundary_search(&range_2_9, BOUNDARY_ALONE, answer, &s, &r), ST_CANCELLED);
    assert_int_equal(r.n, 6);
}

static void bad_definitions_are_named(void **state)
{
    (void)state;
    static const struct {
        struct boundary_def def;
        const char *pointer;
    } bad[] = {
        {{9.0, 2.0, 0.02, 5, 64}, "/field/to"},
        {{2.0, 9.0, 0.0, 5, 64}, "/field/tolerance"},
        {{2.0, 9.0, 8.0, 5, 64}, "/field/tolerance"},
        {{2.0, 9.0, 0.02, 1, 64}, "/field/scan"},
        {{2.0, 9.0, 0.02, 5, 4}, "/field/evaluations_max"},
        {{2.0, 9.0, 0.02, 5, BOUNDARY_SAMPLES_MAX + 1}, "/field/evaluations_max"},
    };
    struct failure_list *list = calloc(1, sizeof *list);
    boundary_def_check(&range_2_9, list);
    assert_int_equal(list->total, 0);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        list->count = list->total = 0;
        boundary_def_check(&bad[i].def, list);
        assert_int_equal(list->total, 1);
        assert_string_equal(list->item[0].pointer, bad[i].pointer);
    }
    free(list);
    assert_string_equal(boundary_outcome_name(BOUNDARY_NOT_BRACKETED), "not_bracketed");
    assert_string_equal(boundary_sweep_name(BOUNDARY_DOWN), "down");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_are_found_within_the_tolerance),
        cmocka_unit_test(a_class_alone_is_bisected),
        cmocka_unit_test(the_worst_case_is_bisection_and_one),
        cmocka_unit_test(of_several_crossings_the_first_met_is_found),
        cmocka_unit_test(without_a_change_the_side_is_told),
        cmocka_unit_test(a_sweep_goes_on_from_the_point_before),
        cmocka_unit_test(failures_are_passed_around_and_told),
        cmocka_unit_test(evaluations_end),
        cmocka_unit_test(bad_definitions_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
