#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/series.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint64_t next_random(uint64_t *s)
{
    *s ^= *s << 13;
    *s ^= *s >> 7;
    *s ^= *s << 17;
    return *s;
}

static struct series_chunk round_trip(const double *value, int n, void *buffer)
{
    struct series_chunk chunk;
    double back[SERIES_CHUNK];
    series_encode(value, n, buffer, &chunk);
    assert_int_equal(series_decode(&chunk, back), ST_OK);
    assert_memory_equal(value, back, (size_t)n * sizeof *value);
    return chunk;
}

static void test_smooth_signal_shrinks(void **state)
{
    double value[SERIES_CHUNK];
    for (int i = 0; i < SERIES_CHUNK; i++) {
        const double t = 2e-4 * i;
        value[i] = 0.01 * exp(-0.5 * t) * sin(33.0 * t) + 0.002 * cos(210.0 * t);
    }
    const struct series_chunk c = round_trip(value, SERIES_CHUNK, *state);
    assert_int_equal(c.codec, SERIES_DELTA_ZSTD);
    assert_true((double)c.size < 0.75 * sizeof value);
}

static void test_special_values(void **state)
{
    const double value[] = {0.0,     -0.0,     NAN,       -NAN, INFINITY,    -INFINITY,   DBL_MIN,
                            DBL_MAX, -DBL_MAX, 0x1p-1074, 1.0,  DBL_EPSILON, 0x1.8p-1060, 0.1};
    const int n = (int)(sizeof value / sizeof value[0]);
    for (int first = 0; first < n; first++) {
        (void)round_trip(value + first, n - first, *state);
    }
    /* A payload in a NaN survives too. */
    const uint64_t bits = 0x7ff4dead0000beef;
    double payload;
    memcpy(&payload, &bits, sizeof payload);
    (void)round_trip(&payload, 1, *state);
}

static void test_random_bits_fall_back_to_raw(void **state)
{
    uint64_t seed = 88172645463325252ULL;
    double value[SERIES_CHUNK];
    for (int round = 0; round < 50; round++) {
        const int n = 1 + (int)(next_random(&seed) % SERIES_CHUNK);
        for (int i = 0; i < n; i++) {
            const uint64_t bits = next_random(&seed);
            memcpy(&value[i], &bits, sizeof bits);
        }
        const struct series_chunk c = round_trip(value, n, *state);
        assert_true(c.size <= (size_t)n * sizeof *value);
        if (n > 100) {
            assert_int_equal(c.codec, SERIES_RAW);
        }
    }
}

static void test_corruption_is_seen(void **state)
{
    double value[512], back[SERIES_CHUNK];
    for (int i = 0; i < 512; i++) {
        value[i] = sin(0.01 * i);
    }
    struct series_chunk good;
    series_encode(value, 512, *state, &good);
    unsigned char *bytes = malloc(good.size);
    assert_non_null(bytes);
    for (size_t i = 0; i < good.size; i++) {
        memcpy(bytes, good.data, good.size);
        bytes[i] ^= 0x10;
        struct series_chunk bad = good;
        bad.data = bytes;
        const enum status st = series_decode(&bad, back);
        /* A flipped bit is refused, or was one the format does not use. */
        assert_true(st == ST_CORRUPT || memcmp(back, value, sizeof value) == 0);
    }
    free(bytes);

    struct series_chunk bad = good;
    bad.checksum ^= 1;
    assert_int_equal(series_decode(&bad, back), ST_CORRUPT);
    bad = good;
    bad.size--;
    assert_int_equal(series_decode(&bad, back), ST_CORRUPT);
    bad = good;
    bad.n++;
    assert_int_equal(series_decode(&bad, back), ST_CORRUPT);
    bad = good;
    bad.n = SERIES_CHUNK + 1;
    assert_int_equal(series_decode(&bad, back), ST_CORRUPT);
    bad = good;
    bad.codec = (enum series_codec)7;
    assert_int_equal(series_decode(&bad, back), ST_CORRUPT);
}

static int setup(void **state)
{
    *state = malloc(series_bound());
    return *state == NULL ? -1 : 0;
}

static int teardown(void **state)
{
    free(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_smooth_signal_shrinks),
        cmocka_unit_test(test_special_values),
        cmocka_unit_test(test_random_bits_fall_back_to_raw),
        cmocka_unit_test(test_corruption_is_seen),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
