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

#define KERNEL_NAME residual_portable
#define KERNEL_WIDTH SIMD_WIDTH_PORTABLE
#define KERNEL_TARGET
#include "core/aero/lifting_line_kernel.inc"
#undef KERNEL_NAME
#undef KERNEL_WIDTH
#undef KERNEL_TARGET

#define KERNEL_NAME residual_avx2
#define KERNEL_WIDTH SIMD_WIDTH_AVX2
#define KERNEL_TARGET SIMD_TARGET_AVX2
#include "core/aero/lifting_line_kernel.inc"
#undef KERNEL_NAME
#undef KERNEL_WIDTH
#undef KERNEL_TARGET

#define KERNEL_NAME residual_avx512
#define KERNEL_WIDTH SIMD_WIDTH_AVX512
#define KERNEL_TARGET SIMD_TARGET_AVX512
#include "core/aero/lifting_line_kernel.inc"
#undef KERNEL_NAME
#undef KERNEL_WIDTH
#undef KERNEL_TARGET

lifting_line_kernel_fn lifting_line_kernel(enum simd_level level)
{
    static const lifting_line_kernel_fn table[SIMD_LEVELS] = {residual_portable, residual_avx2,
                                                              residual_avx512};
    assert((unsigned)level < SIMD_LEVELS);
    return table[level];
}
