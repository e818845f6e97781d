/* Means over the end of a march whose length is not known beforehand. */
#include "core/coupling/span_mean.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/unit.h"

enum { N = 3, SAMPLES_MAX = 700 };

static double value_at(int sample, int kind, int station)
{
    return sin(0.37 * sample) + 0.01 * sample * (kind + 1) + station;
}

static void push(struct span_mean *s, int sample)
{
    double x[SPAN_VALUES][N];
    const double *value[SPAN_VALUES];
    for (int k = 0; k < SPAN_VALUES; k++) {
        for (int i = 0; i < N; i++) {
            x[k][i] = value_at(sample, k, i);
        }
        value[k] = x[k];
    }
    span_mean_push(s, value);
}

/* Every end of marches planned for `planned` samples: the mean is that of the samples from the one
 * reported, the window is as long as wanted or longer by less than a block, and exact at the end.
 */
static void check_march(int planned, int window)
{
    struct span_mean s;
    assert_ok(span_mean_init(N, window, planned, &s));
    for (int n = 1; n <= planned; n++) {
        double mean[N * SPAN_VALUES];
        push(&s, n - 1);
        const int from = span_mean_get(&s, mean);
        const int wanted = n > window ? n - window : 0;
        assert_true(from >= 0);
        assert_true(from <= wanted);
        assert_true(wanted - from <= (window - 1) / SPAN_WINDOW_BLOCKS);
        if (n == planned) {
            assert_int_equal(from, wanted);
        }
        for (int k = 0; k < SPAN_VALUES; k++) {
            for (int i = 0; i < N; i++) {
                double sum = 0.0;
                for (int j = from; j < n; j++) {
                    sum += value_at(j, k, i);
                }
                assert_near_rel(mean[num_at(i, k, N)], sum / (n - from), 1e-12);
            }
        }
    }
    span_mean_done(&s);
}

static void marches(void **state)
{
    (void)state;
    check_march(1, 1);
    check_march(1, 100);
    check_march(130, 1);
    check_march(130, 64);
    check_march(300, 65);
    check_march(300, 201);
    check_march(300, 300);
    check_march(300, 5000);
    uint64_t seed = 5;
    for (int k = 0; k < 10; k++) {
        const int planned = 2 + (int)(random_uniform(&seed) * (SAMPLES_MAX - 2));
        check_march(planned, 1 + (int)(random_uniform(&seed) * planned));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(marches)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
