#include "core/aero/lifting_line_kernel.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>

double lifting_line_largest(int n, const double *x)
{
    double largest = 0.0;
    for (int i = 0; i < n; i++) {
        const double size = fabs(x[i]);
        /* A NaN must win, whatever the order of the comparison. */
        largest = size > largest || isnan(size) ? size : largest;
    }
    return largest;
}

#define KERNEL_STEM residual
#define KERNEL_FILE "core/aero/lifting_line_kernel.inc"
#include "core/simd_levels.inc"

lifting_line_kernel_fn lifting_line_kernel(enum simd_level level)
{
    static const lifting_line_kernel_fn table[SIMD_LEVELS] = {residual_portable, residual_avx2,
                                                              residual_avx512};
    assert((unsigned)level < SIMD_LEVELS);
    return table[level];
}
