/* White box: the kernels of all instruction sets this machine has give the same bits. They are
 * file-local, so the source itself is included. */
#include "core/aero/network.c"

#include "tests/support/fixture.h"
#include "tests/support/unit.h"

enum { STATIONS = 29, VALUES = NET_OUT_COUNT * STATIONS };

static void inputs(uint64_t seed, double *x)
{
    for (int i = 0; i < NET_IN_COUNT * STATIONS; i++) {
        x[i] = 0.3 * fixture_normal(&seed);
    }
    x[3] = 1e9; /* saturated */
    x[4] = 1e-300;
    x[5] = -0.0;
}

static void compare(network_kernel_fn kernel)
{
    for (uint64_t seed = 1; seed < 20; seed++) {
        struct network_def d = fixture_network(1 + (int)(3 * seed), 1.0, seed);
        struct network *net = NULL;
        double x[NET_IN_COUNT * STATIONS], y[VALUES], z[VALUES];
        assert_ok(network_create(&d, &net));
        inputs(seed, x);
        net->kernel = kernel_portable;
        (void)network_eval(net, STATIONS, x, y);
        net->kernel = kernel;
        (void)network_eval(net, STATIONS, x, z);
        assert_memory_equal(y, z, sizeof y);
        network_destroy(net);
        network_def_done(&d);
    }
}

static void avx2(void **state)
{
    (void)state;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        compare(kernel_avx2);
        return;
    }
#endif
    skip();
}

static void avx512(void **state)
{
    (void)state;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        compare(kernel_avx512);
        return;
    }
#endif
    skip();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(avx2), cmocka_unit_test(avx512)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
