/* core/num.h
 * Numerical constants and one-line helpers. */
#ifndef AEROM_CORE_NUM_H
#define AEROM_CORE_NUM_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* C11's CMPLX, which glibc gives gcc only. */
#define NUM_COMPLEX(re, im) __builtin_complex((double)(re), (double)(im))

#define NUM_PI 3.14159265358979323846

static inline double num_rad(double degrees)
{
    return degrees * (NUM_PI / 180.0);
}

static inline double num_deg(double radians)
{
    return radians * (180.0 / NUM_PI);
}

static inline double num_sq(double x)
{
    return x * x;
}

static inline double num_clamp(double x, double lo, double hi)
{
    return x < lo ? lo : (x > hi ? hi : x);
}

/* Place of entry (i, j) in a column-major matrix of so many rows. */
static inline ptrdiff_t num_at(int i, int j, int rows)
{
    return i + (ptrdiff_t)rows * j;
}

/* Tells zeros of different sign apart. */
static inline bool num_same_bits(double a, double b)
{
    uint64_t x, y;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    return x == y;
}

static inline bool num_all_finite(int n, const double *x)
{
    for (int i = 0; i < n; i++) {
        if (!isfinite(x[i])) {
            return false;
        }
    }
    return true;
}

#endif
