/* core/aero/lifting_line_kernel.h
 * Inside of the lifting line: what its solver asks in every iteration, per instruction set.
 * Stateless; thread-safe. */
#ifndef AEROM_CORE_AERO_LIFTING_LINE_KERNEL_H
#define AEROM_CORE_AERO_LIFTING_LINE_KERNEL_H

#include "core/aero/lifting_line.h"

lifting_line_kernel_fn lifting_line_kernel(enum simd_level level);

/* Largest |x|; NaN if one of them is. */
double lifting_line_largest(int n, const double *x);

#endif
