/* core/study/sampling.h
 * Points that fill a unit cube evenly, tolerances they are mapped to, and quantiles of what comes
 * out, with their confidence intervals.
 *
 * Plain values, any thread. A seed names the points, bit for bit. */
#ifndef AEROM_CORE_STUDY_SAMPLING_H
#define AEROM_CORE_STUDY_SAMPLING_H

#include "core/status.h"

#include <stdint.h>

enum { SAMPLING_DIMENSIONS_MAX = 32, SAMPLING_POINTS_MAX = 100000 };

/* Latin hypercube: each coordinate has one point in each n-th of its range, at a random place, in
 * random order (McKay, Beckman, Conover, Technometrics 21, 1979). Sobol: a sequence of low
 * discrepancy with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2008, file
 * new-joe-kuo-6), every coordinate shifted by a random number digit by digit; balanced when n is a
 * power of two. */
enum sampling_method { SAMPLING_LATIN, SAMPLING_SOBOL, SAMPLING_METHODS };
/* "latin_hypercube" "sobol"; SAMPLING_METHODS for another name. */
const char *sampling_method_name(enum sampling_method m);
enum sampling_method sampling_method_of(const char *name);

/* n points of so many dimensions into u (dimensions x n), each coordinate inside (0, 1). 1 <= n <=
 * SAMPLING_POINTS_MAX, 1 <= dimensions <= SAMPLING_DIMENSIONS_MAX. ST_NO_MEMORY. */
MUST_CHECK enum status sampling_points(enum sampling_method method, int dimensions, int n,
                                       uint64_t seed, double *u);
/* Point `index` of the Sobol sequence without shift, from 0 (the origin). */
void sampling_sobol(int dimensions, uint32_t index, double *u);

enum sampling_distribution { SAMPLING_UNIFORM, SAMPLING_NORMAL, SAMPLING_DISTRIBUTIONS };
const char *sampling_distribution_name(enum sampling_distribution d); /* "uniform" "normal" */
enum sampling_distribution sampling_distribution_of(const char *name);

struct sampling_tolerance {
    enum sampling_distribution distribution;
    double centre;
    double spread; /* uniform: half the width; normal: the standard deviation; >= 0 */
};
/* Value of a tolerance below which the share u of (0, 1) lies. */
double sampling_value(const struct sampling_tolerance *t, double u);
/* Of the standard normal distribution; u in (0, 1). Within 1e-14 relative of the exact one. */
double sampling_normal(double u);

/* Estimate of the quantile p from n values, and an interval between two of them that holds the true
 * quantile with at least the confidence asked for, whatever the distribution (order statistics:
 * the number of values below it is binomial). Strict for independent values; those of a Latin
 * hypercube or a Sobol sequence scatter less, mostly. */
struct sampling_quantile {
    double p;
    double value;           /* interpolated between neighbours; may be infinite when they are */
    double lower, upper;    /* NaN where n is too small for the confidence */
    int lower_at, upper_at; /* places of these in the sorted values, from 0; -1 */
};

/* sorted (n) ascending, without NaN; values beyond what was looked at stand as infinities. n >= 1,
 * 0 < p < 1, 0 < confidence < 1. */
void sampling_quantile_of(int n, const double *sorted, double p, double confidence,
                          struct sampling_quantile *out);

#endif
