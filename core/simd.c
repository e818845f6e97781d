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

/* One block of rows at a time; even and odd columns are summed apart, which halves the chain of
 * dependent additions. */
static inline __attribute__((always_inline)) void gemv_body(int rows, int n, const double *a,
                                                            const double *x, double *y)
{
    for (int row = 0; row < rows; row += LANES) {
        lanes even = {0}, odd = {0};
        const double *column = a + row;
        int j = 0;
        for (; j + 1 < n; j += 2) {
            even += *(const lanes *)(const void *)column * x[j];
            odd += *(const lanes *)(const void *)(column + rows) * x[j + 1];
            column += 2 * (ptrdiff_t)rows;
        }
        if (j < n) {
            even += *(const lanes *)(const void *)column * x[j];
        }
        *(lanes *)(void *)(y + row) = even + odd;
    }
}

static void gemv_portable(int rows, int n, const double *a, const double *x, double *y)
{
    gemv_body(rows, n, a, x, y);
}

SIMD_TARGET_AVX2 static void gemv_avx2(int rows, int n, const double *a, const double *x, double *y)
{
    gemv_body(rows, n, a, x, y);
}

SIMD_TARGET_AVX512 static void gemv_avx512(int rows, int n, const double *a, const double *x,
                                           double *y)
{
    gemv_body(rows, n, a, x, y);
}

simd_gemv_fn simd_gemv(enum simd_level level)
{
    static const simd_gemv_fn table[SIMD_LEVELS] = {gemv_portable, gemv_avx2, gemv_avx512};
    assert((unsigned)level < SIMD_LEVELS);
    return table[level];
}
