/* Points, tolerances and quantiles against properties that hold exactly and distributions whose
 * quantiles are known. */
#include "core/num.h"
#include "core/study/sampling.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

/* First points of the sequence, by hand from the recurrence and the printed direction numbers. */
static void the_sequence_begins_as_published(void **state)
{
    (void)state;
    static const double expected[][3] = {
        {0.0, 0.0, 0.0},       {0.5, 0.5, 0.5},       {0.25, 0.75, 0.75},    {0.75, 0.25, 0.25},
        {0.125, 0.625, 0.375}, {0.625, 0.125, 0.875}, {0.375, 0.375, 0.625}, {0.875, 0.875, 0.125},
    };
    for (uint32_t i = 0; i < 8; i++) {
        double u[3];
        sampling_sobol(3, i, u);
        for (int j = 0; j < 3; j++) {
            assert_true(u[j] == expected[i][j]);
        }
    }
    double last[SAMPLING_DIMENSIONS_MAX];
    sampling_sobol(SAMPLING_DIMENSIONS_MAX, UINT32_MAX, last);
    for (int j = 0; j < SAMPLING_DIMENSIONS_MAX; j++) {
        assert_true(last[j] > 0.0 && last[j] < 1.0);
    }
}

/* Each of the 2^k-ths of every coordinate holds one of 2^k points, for both designs. */
static void every_coordinate_is_stratified(void **state)
{
    (void)state;
    enum { N = 256, D = SAMPLING_DIMENSIONS_MAX };
    double *u = malloc((size_t)N * D * sizeof *u);
    for (enum sampling_method m = 0; m < SAMPLING_METHODS; m++) {
        assert_ok(sampling_points(m, D, N, 7, u));
        for (int j = 0; j < D; j++) {
            bool seen[N] = {false};
            for (int i = 0; i < N; i++) {
                const double x = u[num_at(j, i, D)];
                assert_true(x > 0.0 && x < 1.0);
                const int cell = (int)(x * N);
                assert_false(seen[cell]);
                seen[cell] = true;
            }
        }
    }
    free(u);
}

/* Square of the centred L2 discrepancy (Hickernell, Math. Comp. 67, 1998). */
static double discrepancy(int d, int n, const double *u)
{
    double one = 0.0, two = 0.0;
    for (int i = 0; i < n; i++) {
        double p = 1.0;
        for (int k = 0; k < d; k++) {
            const double a = fabs(u[num_at(k, i, d)] - 0.5);
            p *= 1.0 + 0.5 * a - 0.5 * a * a;
        }
        one += p;
        for (int j = 0; j < n; j++) {
            p = 1.0;
            for (int k = 0; k < d; k++) {
                const double x = u[num_at(k, i, d)], y = u[num_at(k, j, d)];
                p *= 1.0 + 0.5 * fabs(x - 0.5) + 0.5 * fabs(y - 0.5) - 0.5 * fabs(x - y);
            }
            two += p;
        }
    }
    return pow(13.0 / 12.0, d) - 2.0 * one / n + two / ((double)n * n);
}

/* Random points have the expectation ((5/4)^d - (13/12)^d)/n; a Latin hypercube is below, Sobol far
 * below. */
static void designs_fill_better_than_chance(void **state)
{
    (void)state;
    enum { N = 256, D = 6 };
    double *u = malloc((size_t)N * D * sizeof *u);
    const double chance = (pow(1.25, D) - pow(13.0 / 12.0, D)) / N;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        assert_ok(sampling_points(SAMPLING_LATIN, D, N, seed, u));
        const double latin = discrepancy(D, N, u);
        assert_ok(sampling_points(SAMPLING_SOBOL, D, N, seed, u));
        const double sobol = discrepancy(D, N, u);
        assert_true(latin < 0.85 * chance);
        assert_true(sobol < 0.2 * chance);
    }
    free(u);
}

/* Mean and variance of a sum of six squares: 6/3 and 6 * 4/45. */
static void moments_of_a_sum(void **state)
{
    (void)state;
    enum { N = 1024, D = 6 };
    double *u = malloc((size_t)N * D * sizeof *u);
    const double tolerance[] = {[SAMPLING_LATIN] = 2e-3, [SAMPLING_SOBOL] = 2e-3};
    for (enum sampling_method m = 0; m < SAMPLING_METHODS; m++) {
        double sum = 0.0, square = 0.0;
        assert_ok(sampling_points(m, D, N, 3, u));
        for (int i = 0; i < N; i++) {
            double y = 0.0;
            for (int j = 0; j < D; j++) {
                y += num_sq(u[num_at(j, i, D)]);
            }
            sum += y;
            square += y * y;
        }
        const double mean = sum / N;
        assert_near_abs(mean, 2.0, tolerance[m]); /* chance: 0.023 */
        assert_near_rel(square / N - mean * mean, 6.0 * 4.0 / 45.0, 0.1);
    }
    free(u);
}

static void a_seed_names_the_points(void **state)
{
    (void)state;
    enum { N = 50, D = 3 };
    double a[N * D], b[N * D];
    for (enum sampling_method m = 0; m < SAMPLING_METHODS; m++) {
        assert_ok(sampling_points(m, D, N, 11, a));
        assert_ok(sampling_points(m, D, N, 11, b));
        assert_memory_equal(a, b, sizeof a);
        assert_ok(sampling_points(m, D, N, 12, b));
        assert_true(memcmp(a, b, sizeof a) != 0);
        assert_int_equal(sampling_method_of(sampling_method_name(m)), m);
    }
    assert_int_equal(sampling_method_of("random"), SAMPLING_METHODS);
    assert_int_equal(sampling_distribution_of("normal"), SAMPLING_NORMAL);
    assert_int_equal(sampling_distribution_of(""), SAMPLING_DISTRIBUTIONS);
}

static void normal_quantiles(void **state)
{
    (void)state;
    static const struct {
        double u, x;
    } table[] = {
        {0.5, 0.0},
        {0.975, 1.959963984540054},
        {0.84134474606854293, 1.0},
        {0.001, -3.090232306167814},
        {1e-10, -6.361340902404056},
        {0.1, -1.2815515655446004},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        assert_near_abs(sampling_normal(table[i].u), table[i].x, 1e-12);
    }
    /* Back through the distribution function, over the whole range. */
    for (int i = -39; i <= 39; i++) {
        const double x = 0.2 * i, u = 0.5 * erfc(-x * sqrt(0.5));
        if (u < 1.0 - 1e-4) {
            assert_near_abs(sampling_normal(u), x, 1e-10);
        }
    }
    const struct sampling_tolerance normal = {SAMPLING_NORMAL, 10.0, 2.0};
    const struct sampling_tolerance uniform = {SAMPLING_UNIFORM, 10.0, 2.0};
    assert_near_abs(sampling_value(&normal, 0.975), 13.919927969080108, 1e-11);
    assert_near_abs(sampling_value(&uniform, 0.25), 9.0, 1e-14);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Published ranks: median of 10 at 95 %: 2nd and 9th of 10; 0.9-quantile of 100 at 95 %: 85th and
 * 97th (Hahn and Meeker, Statistical Intervals, tables of order statistics). */
static void ranks_of_the_interval(void **state)
{
    (void)state;
    double x[100];
    for (int i = 0; i < 100; i++) {
        x[i] = i + 1.0;
    }
    struct sampling_quantile q;
    sampling_quantile_of(10, x, 0.5, 0.95, &q);
    assert_true(q.lower == 2.0 && q.upper == 9.0 && q.value == 5.5);
    assert_int_equal(q.lower_at, 1);
    assert_int_equal(q.upper_at, 8);
    sampling_quantile_of(100, x, 0.9, 0.95, &q);
    assert_true(q.lower == 84.0 || q.lower == 85.0);
    assert_true(q.upper == 96.0 || q.upper == 97.0);
    assert_near_abs(q.value, 90.1, 1e-12);
    /* Five values cannot bound a 1 % quantile from below. */
    sampling_quantile_of(5, x, 0.01, 0.95, &q);
    assert_true(isnan(q.lower));
    assert_int_equal(q.lower_at, -1);
    assert_int_equal(q.upper_at, 1);
    sampling_quantile_of(1, x, 0.5, 0.95, &q);
    assert_true(q.value == 1.0 && isnan(q.lower) && isnan(q.upper));
}

/* The interval of random normal samples holds the true quantile as often as it says, at least. */
static void the_interval_covers_the_truth(void **state)
{
    (void)state;
    enum { N = 60, TRIALS = 2000 };
    const double p[] = {0.05, 0.5, 0.9};
    uint64_t seed = 42;
    int covered[3] = {0};
    for (int t = 0; t < TRIALS; t++) {
        double x[N];
        for (int i = 0; i < N; i++) {
            x[i] = fixture_normal(&seed);
        }
        qsort(x, N, sizeof x[0], by_size);
        for (int k = 0; k < 3; k++) {
            struct sampling_quantile q;
            sampling_quantile_of(N, x, p[k], 0.9, &q);
            const double truth = sampling_normal(p[k]);
            covered[k] += !(q.lower > truth) && !(q.upper < truth);
        }
    }
    for (int k = 0; k < 3; k++) {
        /* Three standard deviations of the count below 90 %. */
        assert_true(covered[k] > 0.9 * TRIALS - 3.0 * sqrt(0.09 * TRIALS));
        assert_true(covered[k] < 0.985 * TRIALS); /* and it is no wider than it must be */
    }
}

/* Quantiles of an exponential through a Sobol design; values beyond a limit stand as infinite. */
static void quantiles_of_a_known_distribution(void **state)
{
    (void)state;
    enum { N = 1024 };
    double u[N], x[N];
    assert_ok(sampling_points(SAMPLING_SOBOL, 1, N, 5, u));
    for (int i = 0; i < N; i++) {
        const double y = -log1p(-u[i]);
        x[i] = y > 2.0 ? (double)INFINITY : y;
    }
    qsort(x, N, sizeof x[0], by_size);
    struct sampling_quantile q;
    sampling_quantile_of(N, x, 0.5, 0.95, &q);
    assert_near_abs(q.value, log(2.0), 2e-3);
    assert_true(q.lower < log(2.0) && log(2.0) < q.upper);
    sampling_quantile_of(N, x, 0.95, 0.95, &q);
    assert_true(isinf(q.value) && isinf(q.upper) && !isnan(q.lower));
    sampling_quantile_of(N, x, 0.9, 0.95, &q);
    assert_true(isinf(q.value) == (q.value > 2.0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sequence_begins_as_published),
        cmocka_unit_test(every_coordinate_is_stratified),
        cmocka_unit_test(designs_fill_better_than_chance),
        cmocka_unit_test(moments_of_a_sum),
        cmocka_unit_test(a_seed_names_the_points),
        cmocka_unit_test(normal_quantiles),
        cmocka_unit_test(ranks_of_the_interval),
        cmocka_unit_test(the_interval_covers_the_truth),
        cmocka_unit_test(quantiles_of_a_known_distribution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
