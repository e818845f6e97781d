/* tests/bench/bench_peak.c
 * Arithmetic limit of one core: additions and multiplications a second from registers, in the
 * widest vectors of the machine, not fused, as the core computes.
 *
 * Usage: bench_peak */
#include "core/simd.h"
#include "tests/bench/paper_case.h"

#include <stdio.h>

enum { CHAINS = 6, TURNS = 2000000, ROUNDS = 9 };

/* CHAINS products and as many sums a turn, none waiting for another. */
#define PEAK(name, target, width)                                                                  \
    typedef double name##_vector __attribute__((vector_size(width * sizeof(double))));             \
    target static double name##_apart(void)                                                        \
    {                                                                                              \
        name##_vector x[CHAINS], y[CHAINS];                                                        \
        for (int k = 0; k < CHAINS; k++) {                                                         \
            x[k] = y[k] = (name##_vector){0} + 1.0 + k;                                            \
        }                                                                                          \
        const name##_vector a = (name##_vector){0} + 0.999999, b = (name##_vector){0} + 1e-6;      \
        for (int turn = 0; turn < TURNS; turn++) {                                                 \
            for (int k = 0; k < CHAINS; k++) {                                                     \
                x[k] = x[k] * a;                                                                   \
                y[k] = y[k] + b;                                                                   \
            }                                                                                      \
        }                                                                                          \
        double sum = 0.0;                                                                          \
        for (int k = 0; k < CHAINS; k++) {                                                         \
            sum += x[k][0] + y[k][0];                                                              \
        }                                                                                          \
        return sum;                                                                                \
    }

PEAK(portable, , 2)
PEAK(avx2, SIMD_TARGET_AVX2, 4)
PEAK(avx512, SIMD_TARGET_AVX512, 8)

int main(void)
{
    static const struct {
        const char *name;
        int width;
        double (*run)(void);
    } level[SIMD_LEVELS] = {
        {"portable", 2, portable_apart}, {"avx2", 4, avx2_apart}, {"avx512", 8, avx512_apart}};
    for (int l = 0; l <= (int)simd_level_of_machine(); l++) {
        double best = 0.0, sum = 0.0;
        for (int r = 0; r < ROUNDS; r++) {
            const double start = paper_cpu_now();
            sum += level[l].run();
            const double used = paper_cpu_now() - start;
            const double rate = 2e-9 * CHAINS * TURNS * level[l].width / used;
            best = rate > best ? rate : best;
        }
        (void)printf("peak %s %.3g Gflop/s%s\n", level[l].name, best, sum > 0.0 ? "" : " ");
    }
    return 0;
}
