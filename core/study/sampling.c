#include "core/study/sampling.h"

#include "core/num.h"
#include "core/random.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const char *const method_name[] = {
    [SAMPLING_LATIN] = "latin_hypercube", [SAMPLING_SOBOL] = "sobol"};
static const char *const distribution_name[] = {
    [SAMPLING_UNIFORM] = "uniform", [SAMPLING_NORMAL] = "normal"};

static int find_name(int n, const char *const *list, const char *name)
{
    int i = 0;
    while (i < n && strcmp(list[i], name) != 0) {
        i++;
    }
    return i;
}

const char *sampling_method_name(enum sampling_method m)
{
    return (unsigned)m < SAMPLING_METHODS ? method_name[m] : "";
}

enum sampling_method sampling_method_of(const char *name)
{
    return (enum sampling_method)find_name(SAMPLING_METHODS, method_name, name);
}

const char *sampling_distribution_name(enum sampling_distribution d)
{
    return (unsigned)d < SAMPLING_DISTRIBUTIONS ? distribution_name[d] : "";
}

enum sampling_distribution sampling_distribution_of(const char *name)
{
    return (enum sampling_distribution)find_name(SAMPLING_DISTRIBUTIONS, distribution_name, name);
}

enum { BITS = 32, DEGREE_MAX = 7 };

/* One dimension of the sequence: degree of its primitive polynomial, the inner coefficients as
 * bits, and the first direction numbers; from the second dimension on. */
static const struct direction {
    int degree;
    uint32_t coefficients;
    uint32_t first[DEGREE_MAX];
} directions[SAMPLING_DIMENSIONS_MAX - 1] = {
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
    {7, 7, {1, 1, 3, 13, 7, 35, 63}},
    {7, 8, {1, 3, 5, 9, 1, 25, 53}},
    {7, 14, {1, 3, 1, 13, 9, 35, 107}},
    {7, 19, {1, 3, 1, 5, 27, 61, 31}},
    {7, 21, {1, 1, 5, 11, 19, 41, 61}},
    {7, 28, {1, 3, 5, 3, 3, 13, 69}},
    {7, 31, {1, 1, 7, 13, 1, 19, 1}},
    {7, 32, {1, 3, 7, 5, 13, 19, 59}},
    {7, 37, {1, 1, 3, 9, 25, 29, 41}},
    {7, 41, {1, 3, 5, 13, 23, 1, 55}},
    {7, 42, {1, 3, 7, 3, 13, 59, 17}},
};

/* Direction numbers of one dimension, the first digit in the highest bit. */
static void direction_numbers(int dimension, uint32_t v[BITS])
{
    if (dimension == 0) {
        for (int k = 0; k < BITS; k++) {
            v[k] = UINT32_C(1) << (BITS - 1 - k);
        }
        return;
    }
    const struct direction *d = &directions[dimension - 1];
    for (int k = 0; k < BITS; k++) {
        if (k < d->degree) {
            v[k] = d->first[k] << (BITS - 1 - k);
            continue;
        }
        v[k] = v[k - d->degree] ^ (v[k - d->degree] >> d->degree);
        for (int j = 1; j < d->degree; j++) {
            const bool has = (d->coefficients >> (d->degree - 1 - j)) & 1u;
            v[k] ^= has ? v[k - j] : 0;
        }
    }
}

static uint32_t digits_at(const uint32_t v[BITS], uint32_t index)
{
    uint32_t x = 0;
    for (int k = 0; index >> k != 0; k++) {
        x ^= (index >> k) & 1u ? v[k] : 0;
        if (k == BITS - 1) {
            break;
        }
    }
    return x;
}

void sampling_sobol(int dimensions, uint32_t index, double *u)
{
    assert(dimensions >= 1 && dimensions <= SAMPLING_DIMENSIONS_MAX);
    for (int j = 0; j < dimensions; j++) {
        uint32_t v[BITS];
        direction_numbers(j, v);
        u[j] = digits_at(v, index) * 0x1p-32;
    }
}

static void fill_sobol(int dimensions, int n, uint64_t seed, double *u)
{
    for (int j = 0; j < dimensions; j++) {
        uint32_t v[BITS];
        const uint32_t shift = (uint32_t)(random_uniform(&seed) * 0x1p32);
        direction_numbers(j, v);
        for (int i = 0; i < n; i++) {
            /* The middle of the cell of the last digit: never 0, never 1. */
            u[num_at(j, i, dimensions)] = ((digits_at(v, (uint32_t)i) ^ shift) + 0.5) * 0x1p-32;
        }
    }
}

static enum status fill_latin(int dimensions, int n, uint64_t seed, double *u)
{
    int *cell = malloc((size_t)n * sizeof *cell);
    if (cell == NULL) {
        return ST_NO_MEMORY;
    }
    for (int j = 0; j < dimensions; j++) {
        for (int i = 0; i < n; i++) {
            const int k = (int)(random_uniform(&seed) * (i + 1));
            cell[i] = cell[k];
            cell[k] = i;
        }
        for (int i = 0; i < n; i++) {
            const double inside = num_clamp(random_uniform(&seed), 0x1p-32, 1.0 - 0x1p-32);
            u[num_at(j, i, dimensions)] = (cell[i] + inside) / n;
        }
    }
    free(cell);
    return ST_OK;
}

enum status sampling_points(enum sampling_method method, int dimensions, int n, uint64_t seed,
                            double *u)
{
    assert(n >= 1 && n <= SAMPLING_POINTS_MAX);
    assert(dimensions >= 1 && dimensions <= SAMPLING_DIMENSIONS_MAX);
    if (method == SAMPLING_LATIN) {
        return fill_latin(dimensions, n, seed, u);
    }
    fill_sobol(dimensions, n, seed, u);
    return ST_OK;
}

double sampling_normal(double u)
{
    assert(u > 0.0 && u < 1.0);
    /* By symmetry the lower tail, where erfc keeps its digits. */
    const double tail = fmin(u, 1.0 - u);
    /* Start: the leading term of the tail, or the slope in the middle. */
    const double t = sqrt(-2.0 * log(tail));
    double x = tail < 0.1 ? -(t - log(t * sqrt(2.0 * NUM_PI)) / t) : (tail - 0.5) * 2.5;
    for (int i = 0; i < 50; i++) {
        const double cdf = 0.5 * erfc(-x * sqrt(0.5));
        const double density = exp(-0.5 * x * x) / sqrt(2.0 * NUM_PI);
        /* Halley's step on log(cdf) - log(tail): third order, and it converges from any start. */
        const double slope = density / cdf;
        const double f = log(cdf / tail), curvature = -slope * (x + slope);
        const double step = f / slope / (1.0 - 0.5 * f * curvature / (slope * slope));
        x -= step;
        if (fabs(step) <= 1e-12 * (1.0 + fabs(x))) {
            break; /* the next step would be of the cube of this */
        }
    }
    return u < 0.5 ? x : -x;
}

double sampling_value(const struct sampling_tolerance *t, double u)
{
    if (t->distribution == SAMPLING_NORMAL) {
        return t->centre + t->spread * sampling_normal(u);
    }
    return t->centre + t->spread * (2.0 * u - 1.0);
}

/* Between two sorted values, either of which may be infinite. */
static double between(double a, double b, double share)
{
    if (!(share > 0.0) || !(b > a)) {
        return a;
    }
    return isfinite(a) ? a + share * (b - a) : (isfinite(b) ? a : (share < 0.5 ? a : b));
}

/* Binomial weights about the most likely count, relative to its weight, so that nothing overflows:
 * from count k to its neighbour. */
static double weight_down(int n, double p, int k)
{
    return k * (1.0 - p) / ((n - k + 1) * p);
}
static double weight_up(int n, double p, int k)
{
    return (n - k) * p / ((k + 1) * (1.0 - p));
}

/* Largest count k with P(B < k) <= share and least one with P(B >= k) <= share, B binomial. */
static void binomial_limits(int n, double p, double share, int *low, int *high)
{
    const int mode = (int)fmin(floor((n + 1) * p), n);
    double below = 0.0, above = 0.0; /* weights left and right of the mode */
    double w = 1.0;
    for (int k = mode; k > 0; k--) {
        w *= weight_down(n, p, k);
        below += w;
    }
    w = 1.0;
    for (int k = mode; k < n; k++) {
        w *= weight_up(n, p, k);
        above += w;
    }
    const double allowed = share * (below + 1.0 + above);
    int k = mode; /* below is the weight of all counts < k */
    for (w = 1.0; k > 0 && below > allowed; k--) {
        w *= weight_down(n, p, k);
        below -= w;
    }
    *low = k;
    k = mode + 1; /* above is the weight of all counts >= k */
    w = 1.0;
    while (k <= n && above > allowed) {
        w *= weight_up(n, p, k - 1);
        above -= w;
        k++;
    }
    *high = k;
}

void sampling_quantile_of(int n, const double *sorted, double p, double confidence,
                          struct sampling_quantile *out)
{
    assert(n >= 1);
    assert(p > 0.0 && p < 1.0);
    const double place = p * (n - 1);
    const int at = (int)fmin(floor(place), n - 1);
    const int next = at + 1 < n ? at + 1 : at;
    /* The true quantile lies above the l-th value when at least l values are below it, and below
     * the u-th when fewer than u are (counted from 1). */
    int low = 0, high = 0;
    binomial_limits(n, p, 0.5 * (1.0 - confidence), &low, &high);
    *out = (struct sampling_quantile){.p = p,
                                      .value = between(sorted[at], sorted[next], place - at),
                                      .lower_at = low - 1,
                                      .upper_at = high <= n ? high - 1 : -1};
    out->lower = out->lower_at >= 0 ? sorted[out->lower_at] : (double)NAN;
    out->upper = out->upper_at >= 0 ? sorted[out->upper_at] : (double)NAN;
}
