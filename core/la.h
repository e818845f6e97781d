/* core/la.h
 * The only door to BLAS and LAPACK. Dense matrices, column-major, leading dimension = rows unless
 * an argument says otherwise. Stateless; thread-safe once la_process_init has run.
 *
 * All calls use LAPACKE's `_work` forms: no hidden transposition, no NaN scan. Calls that need a
 * work array allocate it: none of them belongs into the time loop except la_inverse_work. */
#ifndef AEROM_CORE_LA_H
#define AEROM_CORE_LA_H

#include "core/status.h"

/* One BLAS thread: the program's own threads are the parallelism, and bits stay the same. */
void la_process_init(void);
const char *la_description(void);

/* Solves a x = b for n_rhs right-hand sides; a (n x n) is destroyed, b (n x n_rhs) becomes x. */
MUST_CHECK enum status la_solve(int n, double *a, int n_rhs, double *b);

/* Same for a symmetric, possibly indefinite matrix (lower triangle is read). */
MUST_CHECK enum status la_solve_symmetric(int n, double *a, int n_rhs, double *b);

/* Solves a x = b for a square, possibly rank-deficient matrix: of all least-squares solutions the
 * one of least size. Singular values below rank_tolerance times the largest count as zero. */
MUST_CHECK enum status la_solve_least_size(int n, double *a, double rank_tolerance, double *b);

/* Cholesky factor of a symmetric positive definite matrix in place (lower triangle), and solutions
 * with it: b (n x n_rhs) becomes x. Neither allocates. */
MUST_CHECK enum status la_cholesky(int n, double *a);
void la_cholesky_solve(int n, const double *factor, int n_rhs, double *b);

/* Inverts a (n x n) in place without allocating; pivot (n), work (n x n). */
MUST_CHECK enum status la_inverse_work(int n, double *a, int *pivot, double *work);

/* The n_out smallest eigenvalues lambda (n_out, ascending) of k x = lambda m x, and their vectors
 * (n x n_out) with x' m x = 1. k and m are symmetric positive definite and destroyed.
 * The problem is solved as m x = mu k x for its largest mu, where rounding is relative to the
 * wanted values instead of to the stiffest freedom of the mesh. */
MUST_CHECK enum status la_smallest_modes(int n, double *k, double *m, int n_out, double *lambda,
                                         double *x);

/* Singular values s (min(m, n), descending) and right singular vectors: vt (min(m,n) x n), row i
 * belongs to s[i]. a (m x n) is destroyed. */
MUST_CHECK enum status la_svd_right(int m, int n, double *a, double *s, double *vt);

/* Least squares min |a x - b| for n_rhs right-hand sides, m >= n; a is destroyed; b (m x n_rhs)
 * holds x in its first n rows. ST_SINGULAR when a has no full rank. */
MUST_CHECK enum status la_least_squares(int m, int n, double *a, int n_rhs, double *b);

/* Determinant of a (n x n), destroyed; pivot (n). Allocates nothing. */
double la_determinant(int n, double *a, int *pivot);

/* Eigenvalues re + i im (n each) and right eigenvectors of a general matrix a (n x n), destroyed.
 * Of a complex pair the one with the positive imaginary part comes first, and columns j, j + 1 of
 * vector (n x n) hold the real and imaginary part of its vector. */
MUST_CHECK enum status la_eigen(int n, double *a, double *re, double *im, double *vector);

/* Eigenvalues re + i im of a general matrix a (n x n), destroyed. */
MUST_CHECK enum status la_eigenvalues(int n, double *a, double *re, double *im);

#endif
