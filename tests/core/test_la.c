#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

enum { N = 7 };

static void random_matrix(int rows, int columns, uint64_t seed, double *a)
{
    for (int i = 0; i < rows * columns; i++) {
        a[i] = fixture_normal(&seed);
    }
}

static double residual(int n, const double *a, const double *x, const double *b)
{
    double y[N], largest = 0.0;
    fixture_multiply(n, a, x, y);
    for (int i = 0; i < n; i++) {
        largest = fmax(largest, fabs(y[i] - b[i]));
    }
    return largest;
}

static void solves(void **state)
{
    (void)state;
    double a[N * N], s[N * N], keep[N * N], b[N], x[N];
    random_matrix(N, N, 1, a);
    random_matrix(N, 1, 2, b);
    memcpy(keep, a, sizeof a);
    memcpy(x, b, sizeof b);
    assert_ok(la_solve(N, a, 1, x));
    assert_near_abs(residual(N, keep, x, b), 0.0, 1e-12);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            s[num_at(i, j, N)] = keep[num_at(i, j, N)] + keep[num_at(j, i, N)]; /* indefinite */
        }
    }
    memcpy(keep, s, sizeof s);
    memcpy(x, b, sizeof b);
    assert_ok(la_solve_symmetric(N, s, 1, x));
    assert_near_abs(residual(N, keep, x, b), 0.0, 1e-12);
}

static void singular_is_said(void **state)
{
    (void)state;
    double a[4] = {1.0, 2.0, 2.0, 4.0}, b[2] = {1.0, 1.0}, zero[4] = {0.0};
    double work[4];
    int pivot[2];
    assert_int_equal(la_solve(2, a, 1, b), ST_SINGULAR);
    assert_int_equal(la_solve_symmetric(2, zero, 1, b), ST_SINGULAR);
    double again[4] = {1.0, 2.0, 2.0, 4.0};
    assert_int_equal(la_inverse_work(2, again, pivot, work), ST_SINGULAR);
    double one_column[4] = {1.0, 1.0, 0.0, 0.0};
    assert_int_equal(la_least_squares(2, 2, one_column, 1, b), ST_SINGULAR);
}

static void inverse(void **state)
{
    (void)state;
    double a[N * N], keep[N * N], work[N * N];
    int pivot[N];
    random_matrix(N, N, 3, a);
    memcpy(keep, a, sizeof a);
    assert_ok(la_inverse_work(N, a, pivot, work));
    for (int j = 0; j < N; j++) {
        double y[N];
        fixture_multiply(N, keep, a + num_at(0, j, N), y);
        for (int i = 0; i < N; i++) {
            assert_near_abs(y[i], i == j ? 1.0 : 0.0, 1e-12);
        }
    }
}

/* k = diag(1..N), m = 2 I: lambda = i/2, x = e_i/sqrt 2. */
static void smallest_modes(void **state)
{
    (void)state;
    double k[N * N] = {0}, m[N * N] = {0}, lambda[3], x[N * 3];
    for (int i = 0; i < N; i++) {
        k[num_at(i, i, N)] = i + 1.0;
        m[num_at(i, i, N)] = 2.0;
    }
    assert_ok(la_smallest_modes(N, k, m, 3, lambda, x));
    for (int j = 0; j < 3; j++) {
        assert_near_rel(lambda[j], 0.5 * (j + 1), 1e-13);
        for (int i = 0; i < N; i++) {
            assert_near_abs(fabs(x[num_at(i, j, N)]), i == j ? sqrt(0.5) : 0.0, 1e-13);
        }
    }
    double bad[4] = {1.0, 0.0, 0.0, -1.0}, one[4] = {1.0, 0.0, 0.0, 1.0}, l[1], v[2];
    assert_int_equal(la_smallest_modes(2, bad, one, 1, l, v), ST_SINGULAR);
}

static void singular_values(void **state)
{
    (void)state;
    /* Rank one: 5 * unit * unit'. */
    double a[6] = {3.0, 0.0, 4.0, 0.0, 0.0, 0.0}, s[2], vt[4];
    assert_ok(la_svd_right(3, 2, a, s, vt));
    assert_near_rel(s[0], 5.0, 1e-14);
    assert_near_abs(s[1], 0.0, 1e-14);
    assert_near_abs(fabs(vt[0]), 1.0, 1e-14);
}

static void least_squares_and_eigenvalues(void **state)
{
    (void)state;
    /* A line through (0,1) (1,3) (2,5) (3,7). */
    double a[8] = {1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.0, 3.0}, b[4] = {1.0, 3.0, 5.0, 7.0};
    assert_ok(la_least_squares(4, 2, a, 1, b));
    assert_near_abs(b[0], 1.0, 1e-14);
    assert_near_abs(b[1], 2.0, 1e-14);
    double turn[4] = {0.0, 1.0, -1.0, 0.0}, re[2], im[2];
    assert_ok(la_eigenvalues(2, turn, re, im));
    assert_near_abs(re[0], 0.0, 1e-15);
    assert_near_abs(fabs(im[0]), 1.0, 1e-15);
    assert_near_abs(im[0] + im[1], 0.0, 1e-15);
}

static void eigenvectors_and_determinant(void **state)
{
    (void)state;
    /* A quarter turn: i and -i, with the vectors (1, -i) and (1, i), both of unit length. */
    double turn[4] = {0.0, 1.0, -1.0, 0.0}, re[2], im[2], v[4];
    assert_ok(la_eigen(2, turn, re, im, v));
    assert_near_abs(re[0], 0.0, 1e-15);
    assert_near_abs(im[0], 1.0, 1e-15); /* the positive one first */
    /* a v = i v: the real part of a v is minus the imaginary part of v. */
    assert_near_abs(-v[1], -v[2], 1e-15);
    assert_near_abs(v[0], -v[3], 1e-15);
    assert_near_abs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3], 1.0, 1e-14);
    int pivot[3];
    double a[9] = {0.0, 2.0, 1.0, 1.0, 0.0, 3.0, 4.0, 5.0, 6.0}; /* columns; rows change places */
    assert_near_rel(la_determinant(3, a, pivot), 17.0, 1e-14);
    double singular[4] = {1.0, 2.0, 2.0, 4.0};
    assert_near_abs(la_determinant(2, singular, pivot), 0.0, 0.0);
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return la_description()[0] == '\0';
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves),
        cmocka_unit_test(singular_is_said),
        cmocka_unit_test(inverse),
        cmocka_unit_test(smallest_modes),
        cmocka_unit_test(singular_values),
        cmocka_unit_test(least_squares_and_eigenvalues),
        cmocka_unit_test(eigenvectors_and_determinant),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
