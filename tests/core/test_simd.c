/* Matrix products of the instruction sets: right, and the same bits on all of them. */
#include "core/num.h"
#include "core/random.h"
#include "core/simd.h"

#include "tests/support/unit.h"

enum { N = 3 * LANES, TERMS = 37 };

static bool has(enum simd_level level)
{
    return level <= simd_level_of_machine();
}

static void random_values(uint64_t seed, int n, double *x)
{
    for (int i = 0; i < n; i++) {
        x[i] = 2.0 * random_uniform(&seed) - 1.0;
    }
}

static void gram_is_the_sum_of_the_products(void **state)
{
    double a[N * TERMS], work[N * TERMS], c[N * N];
    (void)state;
    random_values(1, N * TERMS, a);
    random_values(2, N * N, c);
    for (enum simd_level level = SIMD_PORTABLE; level < SIMD_LEVELS && has(level); level++) {
        double sum[N * N];
        memcpy(sum, c, sizeof sum);
        simd_gram(level)(N, TERMS, a, work, sum);
        for (int j = 0; j < N; j++) {
            for (int i = j; i < N; i++) {
                double wanted = c[num_at(i, j, N)];
                for (int t = 0; t < TERMS; t++) {
                    wanted += a[num_at(i, t, N)] * a[num_at(j, t, N)];
                }
                assert_near_abs(sum[num_at(i, j, N)], wanted, 1e-13);
            }
        }
    }
}

static void gram_has_the_same_bits_on_all_instruction_sets(void **state)
{
    double a[N * TERMS], work[N * TERMS], first[N * N] = {0.0};
    (void)state;
    random_values(3, N * TERMS, a);
    simd_gram(SIMD_PORTABLE)(N, TERMS, a, work, first);
    for (enum simd_level level = SIMD_PORTABLE; level < SIMD_LEVELS && has(level); level++) {
        double sum[N * N] = {0.0};
        simd_gram(level)(N, TERMS, a, work, sum);
        for (int j = 0; j < N; j++) { /* above the diagonal the blocks differ in what they add */
            assert_memory_equal(sum + num_at(j, j, N), first + num_at(j, j, N),
                                (size_t)(N - j) * sizeof *sum);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gram_is_the_sum_of_the_products),
        cmocka_unit_test(gram_has_the_same_bits_on_all_instruction_sets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
