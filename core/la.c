#include "core/la.h"

#include <assert.h>
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

void la_process_init(void)
{
    openblas_set_num_threads(1);
}

const char *la_description(void)
{
    return openblas_get_config();
}

/* info < 0 is our own mistake, info > 0 belongs to the data. */
static enum status from_info(lapack_int info)
{
    assert(info >= 0);
    return info == 0 ? ST_OK : ST_SINGULAR;
}

enum status la_solve(int n, double *a, int n_rhs, double *b)
{
    lapack_int *pivot = malloc((size_t)n * sizeof *pivot);
    if (pivot == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st =
        from_info(LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, n_rhs, a, n, pivot, b, n));
    free(pivot);
    return st;
}

enum status la_solve_symmetric(int n, double *a, int n_rhs, double *b)
{
    enum { BLOCK = 32 };
    const int size = n * BLOCK;
    lapack_int *pivot = malloc((size_t)n * sizeof *pivot);
    double *work = malloc((size_t)size * sizeof *work);
    enum status st = ST_NO_MEMORY;
    if (pivot != NULL && work != NULL) {
        st = from_info(
            LAPACKE_dsysv_work(LAPACK_COL_MAJOR, 'L', n, n_rhs, a, n, pivot, b, n, work, size));
    }
    free(work);
    free(pivot);
    return st;
}

enum status la_solve_least_size(int n, double *a, double rank_tolerance, double *b)
{
    const int size = 16 * n;
    lapack_int rank = 0;
    double *work = malloc((size_t)(size + n) * sizeof *work);
    if (work == NULL) {
        return ST_NO_MEMORY;
    }
    const lapack_int info = LAPACKE_dgelss_work(LAPACK_COL_MAJOR, n, n, 1, a, n, b, n, work,
                                                rank_tolerance, &rank, work + n, size);
    assert(info >= 0);
    free(work);
    return info == 0 ? ST_OK : ST_NOT_CONVERGED;
}

enum status la_cholesky(int n, double *a)
{
    return from_info(LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, a, n));
}

void la_cholesky_solve(int n, const double *factor, int n_rhs, double *b)
{
    const lapack_int info = LAPACKE_dpotrs_work(LAPACK_COL_MAJOR, 'L', n, n_rhs, factor, n, b, n);
    assert(info == 0);
}

enum status la_inverse_work(int n, double *a, int *pivot, double *work)
{
    _Static_assert(sizeof(lapack_int) == sizeof(int), "pivot arrays are plain int");
    enum status st = from_info(LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot));
    if (st == ST_OK) {
        st = from_info(LAPACKE_dgetri_work(LAPACK_COL_MAJOR, n, a, n, pivot, work, n * n));
    }
    return st;
}

enum status la_smallest_modes(int n, double *k, double *m, int n_out, double *lambda, double *x)
{
    assert(n_out >= 1);
    assert(n_out <= n);
    const int work_size = 40 * n;
    lapack_int *iwork = malloc((size_t)(5 * n) * sizeof *iwork);
    lapack_int *fail = malloc((size_t)n * sizeof *fail);
    double *mu = malloc((size_t)n * sizeof *mu);
    double *work = malloc((size_t)work_size * sizeof *work);
    enum status st = ST_NO_MEMORY;
    if (iwork == NULL || fail == NULL || mu == NULL || work == NULL) {
        goto out;
    }
    lapack_int found = 0;
    /* mu ascends, so the wanted ones are the last n_out. */
    st = from_info(LAPACKE_dsygvx_work(LAPACK_COL_MAJOR, 1, 'V', 'I', 'L', n, m, n, k, n, 0.0, 0.0,
                                       n - n_out + 1, n, 2.0 * LAPACKE_dlamch_work('S'), &found, mu,
                                       x, n, work, work_size, iwork, fail));
    if (st == ST_OK && found != n_out) {
        st = ST_NOT_CONVERGED;
    }
    for (int j = 0; j < n_out && st == ST_OK; j++) {
        if (!(mu[j] > 0.0)) {
            st = ST_SINGULAR;
        }
    }
    if (st != ST_OK) {
        goto out;
    }
    /* LAPACK scales to x' k x = 1; x' m x = mu then, so divide by sqrt(mu); reverse the order. */
    for (int j = 0; j < n_out; j++) {
        lambda[n_out - 1 - j] = 1.0 / mu[j];
        cblas_dscal(n, 1.0 / sqrt(mu[j]), x + (size_t)j * (size_t)n, 1);
    }
    for (int j = 0; j < n_out / 2; j++) {
        cblas_dswap(n, x + (size_t)j * (size_t)n, 1, x + (size_t)(n_out - 1 - j) * (size_t)n, 1);
    }
out:
    free(work);
    free(mu);
    free(fail);
    free(iwork);
    return st;
}

enum status la_svd_right(int m, int n, double *a, double *s, double *vt)
{
    const int k = m < n ? m : n;
    double best = 0.0;
    lapack_int *iwork = malloc((size_t)(8 * k) * sizeof *iwork);
    double *u = malloc((size_t)m * (size_t)k * sizeof *u);
    double *work = NULL;
    enum status st = ST_NO_MEMORY;
    if (iwork == NULL || u == NULL) {
        goto out;
    }
    (void)LAPACKE_dgesdd_work(LAPACK_COL_MAJOR, 'S', m, n, a, m, s, u, m, vt, k, &best, -1, iwork);
    const int size = (int)best;
    work = malloc((size_t)size * sizeof *work);
    if (work == NULL) {
        goto out;
    }
    const lapack_int info =
        LAPACKE_dgesdd_work(LAPACK_COL_MAJOR, 'S', m, n, a, m, s, u, m, vt, k, work, size, iwork);
    assert(info >= 0);
    st = info == 0 ? ST_OK : ST_NOT_CONVERGED;
out:
    free(work);
    free(u);
    free(iwork);
    return st;
}

enum status la_least_squares(int m, int n, double *a, int n_rhs, double *b)
{
    assert(m >= n);
    const int size = n + 64 * (n > n_rhs ? n : n_rhs);
    double *work = malloc((size_t)size * sizeof *work);
    if (work == NULL) {
        return ST_NO_MEMORY;
    }
    const enum status st =
        from_info(LAPACKE_dgels_work(LAPACK_COL_MAJOR, 'N', m, n, n_rhs, a, m, b, m, work, size));
    free(work);
    return st;
}

double la_determinant(int n, double *a, int *pivot)
{
    const lapack_int info = LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot);
    assert(info >= 0);
    double product = info == 0 ? 1.0 : 0.0;
    for (int i = 0; i < n; i++) {
        product *= a[i + (ptrdiff_t)n * i] * (pivot[i] == i + 1 ? 1.0 : -1.0);
    }
    return product;
}

/* Right eigenvectors too unless vector is NULL. */
static enum status eigen(int n, double *a, double *re, double *im, double *vector)
{
    const int size = 8 * n;
    double *work = malloc((size_t)size * sizeof *work);
    if (work == NULL) {
        return ST_NO_MEMORY;
    }
    const lapack_int info =
        LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', vector != NULL ? 'V' : 'N', n, a, n, re, im, NULL,
                           1, vector, vector != NULL ? n : 1, work, size);
    assert(info >= 0);
    free(work);
    return info == 0 ? ST_OK : ST_NOT_CONVERGED;
}

enum status la_eigenvalues(int n, double *a, double *re, double *im)
{
    return eigen(n, a, re, im, NULL);
}

enum status la_eigen(int n, double *a, double *re, double *im, double *vector)
{
    return eigen(n, a, re, im, vector);
}
