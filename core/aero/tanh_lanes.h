/* core/aero/tanh_lanes.h
 * tanh of eight doubles, written so that the compiler turns each loop into vector instructions of
 * whatever set the including function is compiled for. No contraction is used, so every instruction
 * set gives the same bits.
 *
 * Error against the exact value: below 4e-16 absolute, 8e-16 relative (tests/core/test_network.c).
 * A NaN stays a NaN. */
#ifndef AEROM_CORE_AERO_TANH_LANES_H
#define AEROM_CORE_AERO_TANH_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { LANES = 8 };

static inline __attribute__((always_inline)) double tanh_one(double x)
{
    /* tanh|x| = -e/(2 + e) with e = expm1(-2|x|); beyond 20 the answer is 1 to the last bit. */
    static const double log2_e = 1.44269504088896338700, magic = 6755399441055744.0; /* 1.5 2^52 */
    static const double ln2_hi = 6.93147180369123816490e-01, ln2_lo = 1.90821492927058770002e-10;
    const double a = fabs(x);
    const double u = a > 20.0 ? -40.0 : -2.0 * a;
    const double shifted = u * log2_e + magic; /* rounds to the integer k in the low bits */
    const double k = shifted - magic;
    const double r = (u - k * ln2_hi) - k * ln2_lo;
    double p = 1.0 / 6227020800.0;
    p = p * r + 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    const double expm1_r = (p * r) * r + r;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023u) << 52;
    double two_k;
    memcpy(&two_k, &bits, sizeof two_k);
    const double e = two_k * expm1_r + (two_k - 1.0);
    return copysign(-e / (2.0 + e), x);
}

static inline __attribute__((always_inline)) void tanh_lanes(double v[LANES])
{
    for (int l = 0; l < LANES; l++) {
        v[l] = tanh_one(v[l]);
    }
}

#endif
