/* core/aero/tanh_lanes.h
 * tanh of eight doubles at once, in the vector types of gcc and clang: the compiler lowers them to
 * whatever instruction set the including function is compiled for, with the same bits.
 *
 * Error against the exact value: below 4e-16 absolute, 8e-16 relative (tests/core/test_network.c).
 * A NaN stays a NaN. */
#ifndef AEROM_CORE_AERO_TANH_LANES_H
#define AEROM_CORE_AERO_TANH_LANES_H

#include "core/simd.h"

#define TANH_SCALE 2.8853900817779268 /* 2/ln 2 */

#define TANH_VECTOR lanes
#define TANH_NAME tanh_scaled_lanes
#define TANH_TARGET
#include "core/aero/tanh_lanes.inc"
#undef TANH_VECTOR
#undef TANH_NAME
#undef TANH_TARGET

/* In place; by pointer, since passing wide vectors by value depends on the instruction set. */
static inline __attribute__((always_inline)) void tanh_lanes(lanes *v)
{
    *v *= TANH_SCALE;
    tanh_scaled_lanes(v);
}

#endif
