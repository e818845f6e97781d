#include "core/simd.h"

#include <assert.h>
#include <string.h>

enum simd_level simd_level_of_machine(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        return SIMD_AVX512;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        return SIMD_AVX2;
    }
#endif
    return SIMD_PORTABLE;
}

#define KERNEL_STEM gemv
#define KERNEL_FILE "core/simd_gemv.inc"
#include "core/simd_levels.inc"

simd_gemv_fn simd_gemv(enum simd_level level)
{
    static const simd_gemv_fn table[SIMD_LEVELS] = {gemv_portable, gemv_avx2, gemv_avx512};
    assert((unsigned)level < SIMD_LEVELS);
    return table[level];
}

#define KERNEL_STEM gram
#define KERNEL_FILE "core/simd_gram.inc"
#include "core/simd_levels.inc"

simd_gram_fn simd_gram(enum simd_level level)
{
    static const simd_gram_fn table[SIMD_LEVELS] = {gram_portable, gram_avx2, gram_avx512};
    assert((unsigned)level < SIMD_LEVELS);
    return table[level];
}
