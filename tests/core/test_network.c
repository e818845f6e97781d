#include "core/aero/network.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

enum { STATIONS_MAX = 37 };

/* The network by its definition, in scalar libm. */
static double plain(const struct network_def *d, const double *x, int o)
{
    double sum = d->b2[o];
    for (int j = 0; j < d->n_hidden; j++) {
        double v = d->b1[j];
        for (int i = 0; i < d->n_in; i++) {
            v += d->w1[i + d->n_in * j] * (x[i] - d->in_offset[i]) / d->in_scale[i];
        }
        sum += d->w2[j + d->n_hidden * o] * tanh(v);
    }
    return sum * d->out_scale[o] + d->out_offset[o];
}

static void random_inputs(int n, uint64_t seed, double *x)
{
    static const double size[NET_IN_COUNT] = {0.3, 0.2, 0.1, 0.05, 0.1};
    for (int i = 0; i < NET_IN_COUNT; i++) {
        for (int s = 0; s < n; s++) {
            x[i * n + s] = size[i] * fixture_normal(&seed);
        }
    }
}

/* Every number of stations, so every number of idle lanes; sizes around the lanes. */
static void agrees_with_the_definition(void **state)
{
    (void)state;
    static const int hidden[] = {1, 7, 50};
    for (size_t k = 0; k < sizeof hidden / sizeof hidden[0]; k++) {
        struct network_def d = fixture_network(hidden[k], 0.7, 40 + k);
        struct network *net = NULL;
        d.in_offset[1] = 0.03;
        d.out_offset[0] = -0.2;
        assert_ok(network_create(&d, &net));
        for (int n = 1; n <= STATIONS_MAX; n++) {
            double x[NET_IN_COUNT * STATIONS_MAX], y[NET_OUT_COUNT * STATIONS_MAX];
            random_inputs(n, (uint64_t)n, x);
            memset(y, 0x55, sizeof y);
            assert_int_equal(network_eval(net, n, x, y), 0);
            for (int s = 0; s < n; s++) {
                double one[LIMIT_NET_INPUTS];
                for (int i = 0; i < d.n_in; i++) {
                    one[i] = x[(int)d.input[i] * n + s];
                }
                assert_near_abs(y[NET_OUT_CL * n + s], plain(&d, one, 0), 1e-13);
                assert_near_abs(y[NET_OUT_CM * n + s], plain(&d, one, 1), 1e-13);
                assert_true(y[NET_OUT_CD * n + s] == 0.0); /* not an output of this net */
            }
        }
        network_destroy(net);
        network_def_done(&d);
    }
}

/* The same station gives the same bits wherever it stands and whatever its neighbours are. */
static void a_station_does_not_see_its_neighbours(void **state)
{
    (void)state;
    struct network_def d = fixture_network(50, 1.0, 3);
    struct network *net = NULL;
    double x[NET_IN_COUNT * STATIONS_MAX], y[NET_OUT_COUNT * STATIONS_MAX];
    assert_ok(network_create(&d, &net));
    random_inputs(STATIONS_MAX, 9, x);
    (void)network_eval(net, STATIONS_MAX, x, y);
    for (int s = 0; s < STATIONS_MAX; s++) {
        double one[NET_IN_COUNT], out[NET_OUT_COUNT];
        for (int i = 0; i < NET_IN_COUNT; i++) {
            one[i] = x[i * STATIONS_MAX + s];
        }
        (void)network_eval(net, 1, one, out);
        assert_memory_equal(&out[NET_OUT_CL], &y[NET_OUT_CL * STATIONS_MAX + s], sizeof out[0]);
        assert_memory_equal(&out[NET_OUT_CM], &y[NET_OUT_CM * STATIONS_MAX + s], sizeof out[0]);
    }
    network_destroy(net);
    network_def_done(&d);
}

/* Inputs and outputs in any order, three outputs, the fifth input. */
static void any_order_of_inputs_and_outputs(void **state)
{
    (void)state;
    enum { N = 11 };
    double w1[2 * 3] = {1.0, -2.0, 0.5, 0.25, -1.0, 3.0}, b1[3] = {0.1, -0.2, 0.3};
    double w2[3 * 3] = {1, 2, 3, -1, 0.5, 0.25, 4, -4, 1}, b2[3] = {0.0, 0.1, -0.1};
    const struct network_def d = {.n_in = 2,
                                  .n_hidden = 3,
                                  .n_out = 3,
                                  .input = {NET_IN_PLUNGE_RATE, NET_IN_MEAN_ALPHA},
                                  .output = {NET_OUT_CD, NET_OUT_CL, NET_OUT_CM},
                                  .in_scale = {2.0, 0.5},
                                  .out_scale = {1.0, 2.0, 3.0},
                                  .hull_min = {-100.0, -100.0},
                                  .hull_max = {100.0, 100.0},
                                  .w1 = w1,
                                  .b1 = b1,
                                  .w2 = w2,
                                  .b2 = b2};
    struct network *net = NULL;
    double x[NET_IN_COUNT * N], y[NET_OUT_COUNT * N];
    assert_ok(network_create(&d, &net));
    random_inputs(N, 5, x);
    (void)network_eval(net, N, x, y);
    for (int s = 0; s < N; s++) {
        const double one[2] = {x[NET_IN_PLUNGE_RATE * N + s], x[NET_IN_MEAN_ALPHA * N + s]};
        assert_near_abs(y[NET_OUT_CD * N + s], plain(&d, one, 0), 1e-13);
        assert_near_abs(y[NET_OUT_CL * N + s], plain(&d, one, 1), 1e-13);
        assert_near_abs(y[NET_OUT_CM * N + s], plain(&d, one, 2), 1e-13);
    }
    network_destroy(net);
}

static void stations_outside_the_hull_are_counted_once(void **state)
{
    (void)state;
    enum { N = 11 };
    struct network_def d = fixture_network(5, 1.0, 3);
    struct network *net = NULL;
    double x[NET_IN_COUNT * N] = {0}, y[NET_OUT_COUNT * N];
    d.hull_min[0] = -0.1;
    d.hull_max[0] = 0.2;
    d.hull_min[2] = -1.0;
    d.hull_max[2] = 1.0;
    assert_ok(network_create(&d, &net));
    assert_int_equal(network_eval(net, N, x, y), 0);
    x[NET_IN_MEAN_ALPHA * N + 0] = 0.2; /* the border belongs to the hull */
    x[NET_IN_MEAN_ALPHA * N + 1] = -0.1;
    assert_int_equal(network_eval(net, N, x, y), 0);
    x[NET_IN_MEAN_ALPHA * N + 0] = 0.2000001;
    x[NET_IN_ALPHA_RATE * N + 0] = 5.0; /* outside twice, one station */
    x[NET_IN_ALPHA_RATE * N + 10] = -1.1;
    assert_int_equal(network_eval(net, N, x, y), 2);
    x[NET_IN_ALPHA_RATE * N + 8] = (double)NAN; /* the first lane of the last block */
    assert_int_equal(network_eval(net, N, x, y), 3);
    x[NET_IN_PLUNGE_RATE * N + 5] = 1e9; /* no input of this net */
    assert_int_equal(network_eval(net, N, x, y), 3);
    network_destroy(net);
    network_def_done(&d);
}

#define KERNEL_STEM tanh_eight
#define KERNEL_FILE "tests/core/tanh_levels.inc"
#include "core/simd_levels.inc"

static void (*const tanh_eight[SIMD_LEVELS])(const double *, double *) = {
    tanh_eight_portable, tanh_eight_avx2, tanh_eight_avx512};

/* Of the best level; the bits of all levels of this machine are the same. */
static void tanh_of(const double *x, double *y)
{
    const enum simd_level best = simd_level_of_machine();
    double other[LANES];
    tanh_eight[best](x, y);
    for (int level = SIMD_PORTABLE; level < (int)best; level++) {
        tanh_eight[level](x, other);
        assert_memory_equal(other, y, sizeof other);
    }
}

static double tanh_one(double x)
{
    double all[LANES], y[LANES];
    for (int l = 0; l < LANES; l++) {
        all[l] = x;
    }
    tanh_of(all, y);
    return y[3];
}

/* Largest errors over the whole range against libm in long double. */
static void tanh_keeps_its_promise(void **state)
{
    (void)state;
    double absolute = 0.0, relative = 0.0, x[LANES], y[LANES];
    uint64_t seed = 1;
    for (int i = 0; i < 400000; i += LANES) {
        for (int l = 0; l < LANES; l++) {
            const double e = -30.0 + 36.0 * random_uniform(&seed); /* 2^-30 .. 2^6 */
            x[l] = (l % 2 == 0 ? 1.0 : -1.0) * exp2(i % 10 == 0 ? e : fmin(e + 26.0, 6.0));
        }
        tanh_of(x, y);
        for (int l = 0; l < LANES; l++) {
            const long double exact = tanhl((long double)x[l]);
            const double error = (double)fabsl((long double)y[l] - exact);
            absolute = fmax(absolute, error);
            relative = fmax(relative, error / (double)fabsl(exact));
        }
    }
    print_message("tanh: largest error %.3g absolute, %.3g relative\n", absolute, relative);
    assert_true(absolute < 4e-16);
    assert_true(relative < 8e-16);
}

static void tanh_at_its_corners(void **state)
{
    (void)state;
    assert_true(tanh_one(0.0) == 0.0);
    assert_true(signbit(tanh_one(-0.0)));
    assert_true(tanh_one(40.0) == 1.0);
    assert_true(tanh_one(-1e300) == -1.0);
    assert_true(tanh_one(HUGE_VAL) == 1.0);
    assert_true(tanh_one(5e-324) == 5e-324 || tanh_one(5e-324) == 0.0);
    assert_true(isnan(tanh_one((double)NAN)));
    /* Each lane its own. */
    double x[LANES], y[LANES];
    for (int l = 0; l < LANES; l++) {
        x[l] = 0.3 * (l - 3);
    }
    tanh_of(x, y);
    for (int l = 0; l < LANES; l++) {
        assert_true(y[l] == tanh_one(x[l]));
    }
}

static void assert_refused(const struct network_def *d, const char *pointer)
{
    struct failure_list *list = calloc(1, sizeof *list);
    network_def_check(d, "/n", list);
    assert_int_equal(list->count, 1);
    assert_string_equal(list->item[0].pointer, pointer);
    free(list);
}

static void every_fault_of_a_network_is_named(void **state)
{
    (void)state;
    struct network_def d = fixture_network(5, 1.0, 3);
    struct failure_list *list = calloc(1, sizeof *list);
    network_def_check(&d, "/n", list);
    assert_int_equal(list->count, 0);
    free(list);
    const struct {
        double *value;
        double wrong;
        const char *pointer;
    } fault[] = {
        {&d.in_offset[1], (double)NAN, "/n/input_offset/1"},
        {&d.in_scale[2], 0.0, "/n/input_scale/2"},
        {&d.out_offset[0], (double)INFINITY, "/n/output_offset/0"},
        {&d.out_scale[1], -1.0, "/n/output_scale/1"},
        {&d.w1[7], (double)NAN, "/n/w1/7"},
        {&d.b1[4], (double)NAN, "/n/b1/4"},
        {&d.w2[9], (double)INFINITY, "/n/w2/9"},
        {&d.b2[1], (double)NAN, "/n/b2/1"},
        {&d.hull_max[3], -11.0, "/n/hull_max/3"},
        {&d.hull_min[0], (double)NAN, "/n/hull_max/0"},
    };
    for (size_t i = 0; i < sizeof fault / sizeof fault[0]; i++) {
        const double keep = *fault[i].value;
        *fault[i].value = fault[i].wrong;
        assert_refused(&d, fault[i].pointer);
        *fault[i].value = keep;
    }
    network_def_done(&d);
    assert_null(d.w1);
    network_def_done(&d);
}

/* Oscillators that are none, inputs behind oscillators there are none of. */
static void inputs_need_their_oscillator(void **state)
{
    (void)state;
    struct network_def d = fixture_network(2, 1.0, 3);
    d.frame = (struct network_frame){.n_oscillator = 2, .oscillator = {{0.7, 0.1}, {1.0, 0.7}}};
    d.input[0] = NET_IN_ALPHA_SWING_2;
    d.input[1] = NET_IN_PITCH_OSCILLATOR_1;
    static struct failure_list none;
    network_def_check(&d, "/n", &none);
    assert_int_equal(none.total, 0);
    static struct failure_list shown;
    d.frame.oscillator[0].damping = 1.5;
    network_def_check(&d, "/n", &shown);
    assert_string_equal(shown.item[0].got, "1.5");
    d.frame.oscillator[0].damping = 0.1;
    static const double wrong[] = {0.0, -1.0, 1.0, 1e3, (double)NAN};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        d.frame.oscillator[1].damping = wrong[k];
        assert_refused(&d, "/n/oscillators/1/damping");
        d.frame.oscillator[1].damping = 0.7;
        if (wrong[k] != 1.0) {
            d.frame.oscillator[0].frequency = wrong[k];
            assert_refused(&d, "/n/oscillators/0/f_c_v");
            d.frame.oscillator[0].frequency = 0.7;
        }
    }
    d.frame.n_oscillator = 1;
    assert_refused(&d, "/n/inputs/0");
    d.input[0] = NET_IN_ALPHA;
    d.input[1] = NET_IN_PITCH_SWING_2;
    assert_refused(&d, "/n/inputs/1");
    network_def_done(&d);
}

/* Lags that are none, inputs behind lags there are none of, states without their model. */
static void inputs_need_their_lag_and_base(void **state)
{
    (void)state;
    struct network_def d = fixture_network(2, 1.0, 3);
    d.frame = (struct network_frame){.base = NETWORK_ON_STALL, .n_lag = 2, .lag = {0.5, 3.0}};
    d.input[0] = NET_IN_ALPHA_LAG_2;
    d.input[1] = NET_IN_PITCH_LAG_1;
    d.input[2] = NET_IN_STALL_LOST;
    static struct failure_list none;
    network_def_check(&d, "/n", &none);
    assert_int_equal(none.total, 0);
    assert_true(network_def_uses(&d, NET_IN_STALL_LOST));
    assert_false(network_def_uses(&d, NET_IN_MEAN_ALPHA));
    d.frame.lag[1] = 0.0;
    assert_refused(&d, "/n/lags_c_v/1");
    d.frame.lag[1] = (double)NAN;
    assert_refused(&d, "/n/lags_c_v/1");
    d.frame.n_lag = 1;
    assert_refused(&d, "/n/inputs/0");
    d.input[0] = NET_IN_ALPHA;
    d.input[1] = NET_IN_PITCH_LAG_3;
    assert_refused(&d, "/n/inputs/1");
    d.input[1] = NET_IN_PITCH_RATE;
    d.frame.base = NETWORK_ON_ATTACHED;
    assert_refused(&d, "/n/inputs/2");
    network_def_done(&d);
}

/* Known to be of another polar only where both are known. */
static void polars_are_told_apart(void **state)
{
    (void)state;
    struct network_def d = {.polar_hash = "ab"};
    assert_true(network_def_is_of_other_polar(&d, "cd"));
    assert_false(network_def_is_of_other_polar(&d, "ab"));
    assert_false(network_def_is_of_other_polar(&d, ""));
    d.polar_hash[0] = '\0';
    assert_false(network_def_is_of_other_polar(&d, "cd"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_the_definition),
        cmocka_unit_test(a_station_does_not_see_its_neighbours),
        cmocka_unit_test(any_order_of_inputs_and_outputs),
        cmocka_unit_test(stations_outside_the_hull_are_counted_once),
        cmocka_unit_test(tanh_keeps_its_promise),
        cmocka_unit_test(tanh_at_its_corners),
        cmocka_unit_test(every_fault_of_a_network_is_named),
        cmocka_unit_test(inputs_need_their_lag_and_base),
        cmocka_unit_test(inputs_need_their_oscillator),
        cmocka_unit_test(polars_are_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
