#include "core/simd.h"

#include <assert.h>

enum simd_level simd_level_of_machine(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        return SIMD_AVX512;
    }
    if (__builtin_cpu_supports("avx2")) {
        return SIMD_AVX2;
    }
#endif
    return SIMD_PORTABLE;
}

#define KERNEL_NAME gemv_portable
#define KERNEL_WIDTH SIMD_WIDTH_PORTABLE
#define KERNEL_TARGET
#include "core/simd_gemv.inc"
#undef KERNEL_NAME
#undef KERNEL_WIDTH
#undef KERNEL_TARGET

#define KERNEL_NAME gemv_avx2
#define KERNEL_WIDTH SIMD_WIDTH_AVX2
#define KERNEL_TARGET SIMD_TARGET_AVX2
#include "core/simd_gemv.inc"
#undef KERNEL_NAME
#undef KERNEL_WIDTH
#undef KERNEL_TARGET

#define KERNEL_NAME gemv_avx512
#define KERNEL_WIDTH SIMD_WIDTH_AVX512
#define KERNEL_TARGET SIMD_TARGET_AVX512
#include "core/simd_gemv.inc"
#undef KERNEL_NAME
#undef KERNEL_WIDTH
#undef KERNEL_TARGET

simd_gemv_fn simd_gemv(enum simd_level level)
{
    static const simd_gemv_fn table[SIMD_LEVELS] = {gemv_portable, gemv_avx2, gemv_avx512};
    assert((unsigned)level < SIMD_LEVELS);
    return table[level];
}
