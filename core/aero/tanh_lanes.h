/* core/aero/tanh_lanes.h
 * tanh of eight doubles at once, in the vector types of gcc and clang: the compiler lowers them to
 * whatever instruction set the including function is compiled for. Nothing is contracted, so every
 * instruction set gives the same bits.
 *
 * Error against the exact value: below 4e-16 absolute, 8e-16 relative (tests/core/test_network.c).
 * A NaN stays a NaN. */
#ifndef AEROM_CORE_AERO_TANH_LANES_H
#define AEROM_CORE_AERO_TANH_LANES_H

#include "core/simd.h"

#include <stdint.h>

typedef int64_t lanes_bits __attribute__((vector_size(LANES * sizeof(int64_t))));

/* In place; by pointer, since passing wide vectors by value depends on the instruction set. */
static inline __attribute__((always_inline)) void tanh_lanes(lanes *v)
{
    /* tanh|x| = -e/(2 + e) with e = expm1(-2|x|); beyond 20 the answer is 1 to the last bit. */
    const double log2_e = 1.44269504088896338700, magic = 6755399441055744.0; /* 1.5 2^52 */
    const double ln2_hi = 6.93147180369123816490e-01, ln2_lo = 1.90821492927058770002e-10;
    const lanes x = *v, forty = {40.0, 40.0, 40.0, 40.0, 40.0, 40.0, 40.0, 40.0};
    const lanes_bits sign = (lanes_bits)x & INT64_MIN;
    const lanes twice = 2.0 * (lanes)((lanes_bits)x ^ sign);
    const lanes_bits far = twice > forty;
    const lanes u = -(lanes)((far & (lanes_bits)forty) | (~far & (lanes_bits)twice));
    const lanes shifted = u * log2_e + magic; /* rounds to the integer k in the low bits */
    const lanes k = shifted - magic;
    const lanes r = (u - k * ln2_hi) - k * ln2_lo;
    lanes p = r * (1.0 / 6227020800.0) + 1.0 / 479001600.0;
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
    const lanes expm1_r = (p * r) * r + r;
    const lanes two_k = (lanes)(((lanes_bits)shifted + 1023) << 52);
    const lanes e = two_k * expm1_r + (two_k - 1.0);
    *v = (lanes)((lanes_bits)(-e / (2.0 + e)) | sign);
}

#endif
