/* core/simd.h
 * Eight doubles at a time: the vector type of gcc and clang, the instruction sets a kernel is
 * compiled for, the one matrix-vector product the time loop needs and the one matrix product of the
 * training.
 *
 * A kernel is one body compiled once per level; sums and products are fused where the body says so
 * (SIMD_KERNEL(fma) of core/simd_vector.inc) and nowhere else, so every level gives the same bits.
 * Stateless; thread-safe. */
#ifndef AEROM_CORE_SIMD_H
#define AEROM_CORE_SIMD_H

#include <stddef.h>
#include <stdint.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

enum { LANES = 8 };
typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

#if defined(__x86_64__)
#define SIMD_TARGET_AVX2 __attribute__((target("avx2,fma")))
#define SIMD_TARGET_AVX512 __attribute__((target("avx512f,avx512dq")))
#else
#define SIMD_TARGET_AVX2
#define SIMD_TARGET_AVX512
#endif

enum simd_level { SIMD_PORTABLE, SIMD_AVX2, SIMD_AVX512, SIMD_LEVELS };
/* Best level of this machine. */
enum simd_level simd_level_of_machine(void);

/* Names in a template that core/simd_levels.inc includes once per instruction set (.inc): each
 * inclusion defines
 *   KERNEL_NAME    of its function; SIMD_KERNEL(x) names the parts
 *   KERNEL_TARGET  attribute that selects the instruction set
 *   KERNEL_WIDTH   doubles of its vectors: what one register holds, since wider vectors are carried
 *                  through memory from one turn of a loop to the next
 * behind core/simd_vector.inc, which defines the vector and its operations. */
#define SIMD_PASTE(name, kernel) name##_##kernel
#define SIMD_JOIN(name, kernel) SIMD_PASTE(name, kernel)
#define SIMD_KERNEL(name) SIMD_JOIN(name, KERNEL_NAME)
#define TANH_SCALE 2.8853900817779268 /* 2/ln 2: of what SIMD_KERNEL(tanh_scaled) is given */

/* Rows padded to whole lanes. */
static inline int simd_padded(int n)
{
    return (n + LANES - 1) / LANES * LANES;
}

/* y = a x; a is (rows x n), column-major, 64-byte aligned, rows a multiple of LANES; y (rows)
 * aligned too. */
typedef void (*simd_gemv_fn)(int rows, int n, const double *a, const double *x, double *y);
simd_gemv_fn simd_gemv(enum simd_level level);

/* c += a a', at least in the lower triangle of c (n x n); a is (n x k), n a multiple of LANES, work
 * (n x k) is overwritten. A library's product would be as fast, where it knows the machine, but not
 * of the same bits. */
typedef void (*simd_gram_fn)(int n, int k, const double *a, double *work, double *c);
simd_gram_fn simd_gram(enum simd_level level);

#endif
