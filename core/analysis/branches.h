/* core/analysis/branches.h
 * Which eigenvalue belongs to which natural mode, followed from speed to speed.
 *
 * A branch is known by its last eigenvalue and by the modal part of its vector. The next one is the
 * eigenvalue whose vector is most alike (modal assurance criterion) and which is near. Plain
 * values, no allocation. */
#ifndef AEROM_CORE_ANALYSIS_BRANCHES_H
#define AEROM_CORE_ANALYSIS_BRANCHES_H

#include "core/limits.h"

#include <complex.h>

/* Eigenvalues of y' = A y and their vectors as LAPACK gives them: of a complex pair, the one with
 * the positive imaginary part comes first and columns j, j + 1 hold real and imaginary part. */
struct spectrum {
    int n;
    double *re, *im; /* (n) */
    double *vector;  /* (n x n) */
};

/* Entry i of the vector of eigenvalue j, which has im >= 0. */
double complex spectrum_entry(const struct spectrum *s, int i, int j);

struct branch {
    double complex lambda;                /* [1/s], im >= 0 */
    double complex part[2 * LIMIT_MODES]; /* omega_k q_k, then q_k', of unit length */
};

struct branches {
    int n;                     /* modes */
    double omega[LIMIT_MODES]; /* weights of the amplitudes [rad/s] */
    struct branch branch[LIMIT_MODES];
};

/* The natural modes themselves: lambda = i omega_k. */
void branches_start(int n, const double *omega, struct branches *out);

/* Likeness of a branch and eigenvalue j, 0..1: MAC of the modal parts times closeness. */
double branches_likeness(const struct branches *b, int branch, const struct spectrum *s, int j);

/* Moves every branch to an eigenvalue of its own; *out may be b itself. Returns the likeness of the
 * least certain one. */
double branches_follow(const struct branches *b, const struct spectrum *s, struct branches *out);

#endif
