/* tests/bench/bench_peak.c
 * Arithmetic limit of one core: fused additions and multiplications a second from registers, in the
 * widest vectors of the machine.
 *
 * Usage: bench_peak */
#include "core/simd.h"
#include "tests/bench/paper_case.h"

#include <math.h>
#include <stdio.h>

enum { CHAINS = 12, TURNS = 2000000, ROUNDS = 9 };

#define KERNEL_STEM peak
#define KERNEL_FILE "tests/bench/peak_kernel.inc"
#include "core/simd_levels.inc"

int main(void)
{
    static const struct {
        const char *name;
        int width;
        double (*run)(void);
    } level[SIMD_LEVELS] = {
        {"portable", 2, peak_portable}, {"avx2", 4, peak_avx2}, {"avx512", 8, peak_avx512}};
    const enum simd_level l = simd_level_of_machine();
    double best = 0.0, sum = 0.0;
    for (int r = 0; r < ROUNDS; r++) {
        const double start = paper_cpu_now();
        sum += level[l].run();
        const double used = paper_cpu_now() - start;
        best = fmax(best, 2e-9 * CHAINS * TURNS * level[l].width / used);
    }
    (void)printf("peak %s %.3g Gflop/s%s\n", level[l].name, best, sum > 0.0 ? "" : " ");
    return 0;
}
