/* Series as JSON and CSV, and the min-max thinning against brute force. */
#include "api/json.h"
#include "api/series_out.h"
#include "tests/api/fake_service.h"

#include <cjson/cJSON.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/near.h"

static int setup(void **state)
{
    struct fake *f = fake_create();
    (void)fake_add(f, CASE_SIMULATION, JOB_DONE, "");
    *state = f;
    return 0;
}

static int teardown(void **state)
{
    fake_destroy(*state);
    return 0;
}

static int get(struct fake *f, const char *query, const char *accept)
{
    char target[256];
    (void)snprintf(target, sizeof target, "/v1/jobs/%s/series%s", f->job[0].record.id, query);
    return fake_get_with(f, target, accept, NULL);
}

static cJSON *get_json(struct fake *f, const char *query)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    assert_int_equal(get(f, query, NULL), 200);
    assert_string_equal(f->answer.content_type, "application/json");
    assert_int_equal(json_parse(f->answer.body, f->answer.body_size, &tree, &fail), ST_OK);
    return tree;
}

static const cJSON *item(const cJSON *tree, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(tree, key);
}

static void test_whole_series(void **state)
{
    cJSON *tree = get_json(*state, "");
    assert_near_abs(item(tree, "t0_s")->valuedouble, 0.0, 0.0);
    assert_near_abs(item(tree, "step_s")->valuedouble, 1e-3, 0.0);
    assert_int_equal(item(tree, "samples")->valueint, FAKE_SAMPLES);
    assert_true(cJSON_IsFalse(item(tree, "thinned")));
    const cJSON *channels = item(tree, "channels");
    assert_int_equal(cJSON_GetArraySize(channels), 2);
    const cJSON *ramp = item(item(channels, "tip_plunge_m"), "value");
    assert_int_equal(cJSON_GetArraySize(ramp), FAKE_SAMPLES);
    int i = 0;
    for (const cJSON *v = ramp->child; v != NULL; v = v->next, i++) {
        assert_near_abs(v->valuedouble, 0.001 * i, 0.0); /* to the bit */
    }
    assert_null(item(item(channels, "tip_plunge_m"), "time_s"));
    json_free(tree);
}

static void test_selection(void **state)
{
    cJSON *tree = get_json(*state, "?channels=modal_amplitude&from_s=0.1005&to_s=0.2");
    assert_int_equal(item(tree, "samples")->valueint, 100);
    assert_near_abs(item(tree, "t0_s")->valuedouble, 0.101, 1e-15);
    assert_int_equal(cJSON_GetArraySize(item(tree, "channels")), 1);
    assert_non_null(item(item(tree, "channels"), "modal_amplitude[1]"));
    json_free(tree);
    tree = get_json(*state, "?channels=modal_amplitude%5B1%5D,tip_plunge_m");
    assert_int_equal(cJSON_GetArraySize(item(tree, "channels")), 2);
    json_free(tree);
    tree = get_json(*state, "?from_s=50");
    assert_int_equal(item(tree, "samples")->valueint, 0);
    json_free(tree);
}

static void test_thinned(void **state)
{
    cJSON *tree = get_json(*state, "?points=20");
    assert_true(cJSON_IsTrue(item(tree, "thinned")));
    const cJSON *c = item(item(tree, "channels"), "modal_amplitude[1]");
    assert_int_equal(cJSON_GetArraySize(item(c, "value")), 20);
    assert_int_equal(cJSON_GetArraySize(item(c, "time_s")), 20);
    double highest = -1.0, at = 0.0, last = -1.0;
    for (int i = 0; i < 20; i++) {
        const double t = cJSON_GetArrayItem(item(c, "time_s"), i)->valuedouble;
        const double v = cJSON_GetArrayItem(item(c, "value"), i)->valuedouble;
        assert_true(t > last);
        last = t;
        at = v > highest ? t : at;
        highest = v > highest ? v : highest;
    }
    assert_near_abs(highest, 7.0, 0.0); /* the one spike survives, with its own time */
    assert_near_abs(at, 0.501, 1e-15);
    json_free(tree);
    tree = get_json(*state, "?points=1000"); /* no more than there are */
    assert_true(cJSON_IsFalse(item(tree, "thinned")));
    json_free(tree);
}

static void test_csv(void **state)
{
    struct fake *f = *state;
    assert_int_equal(get(f, "?format=csv&to_s=0.0015", NULL), 200);
    assert_string_equal(f->answer.content_type, "text/csv; charset=utf-8; header=present");
    assert_memory_equal(f->answer.body,
                        "time_s,tip_plunge_m,modal_amplitude[1]\n0,0,0\n0.001,0.001,",
                        strlen("time_s,tip_plunge_m,modal_amplitude[1]\n0,0,0\n0.001,0.001,"));
    assert_int_equal(get(f, "?channels=tip_plunge_m&format=csv&points=2", NULL), 200);
    assert_string_equal(f->answer.body, "tip_plunge_m.time_s,tip_plunge_m\n0,0\n0.999,0.999\n");
}

static void test_accept(void **state)
{
    static const struct {
        const char *accept;
        bool csv;
    } table[] = {
        {NULL, false},
        {"*/*", false},
        {"text/csv", true},
        {"TEXT/CSV", true},
        {"text/*", true},
        {"application/json, text/csv;q=0.5", false},
        {"application/json;q=0.5, text/csv", true},
        {"text/csv, */*;q=0.1", true},
        {"text/html", false},
    };
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        assert_int_equal(get(f, "?to_s=0.01", table[i].accept), 200);
        assert_int_equal(strncmp(f->answer.content_type, "text/csv", 8) == 0, table[i].csv);
        assert_string_equal(fake_header(f, "Vary"), "Accept");
    }
    assert_int_equal(get(f, "?format=json", "text/csv"), 200);
    assert_string_equal(f->answer.content_type, "application/json");
}

static void test_bad_queries(void **state)
{
    static const char *const bad[] = {
        "?points=1",      "?points=100001", "?points=x",        "?points=2.5",
        "?from_s=x",      "?from_s=inf",    "?to_s=nan",        "?to_s=1e999",
        "?to_s=",         "?format=xml",    "?from_s=2&to_s=1", "?channels=",
        "?channels=a,,b", "?channels=,",    "?channels=lift_n", "?step=2"};
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(get(f, bad[i], NULL), 400);
        assert_true(fake_says(f, "\"code\":\"bad_query\""));
    }
    assert_int_equal(get(f, "?channels=tip_plunge_m,tip", NULL), 400);
    assert_true(fake_says(f, "\"unknown_channel\""));
    assert_true(fake_says(f, "tip_plunge_m modal_amplitude[1]"));
    assert_true(fake_says(f, "\"got\":\"\\\"tip\\\"\""));
}

/* Each bucket's extremes are among the kept samples, and those only, in ascending order. */
static void check_minmax(int n, const double *value, int points)
{
    int *index = malloc((size_t)points * sizeof *index);
    const int kept = series_minmax(n, value, points, index);
    const int buckets = points / 2;
    assert_int_equal(kept, 2 * buckets);
    for (int i = 1; i < kept; i++) {
        assert_true(index[i] > index[i - 1]);
    }
    for (int b = 0; b < buckets; b++) {
        const int first = (int)((long long)n * b / buckets);
        const int last = (int)((long long)n * (b + 1) / buckets);
        double low = value[first], high = value[first];
        for (int i = first; i < last; i++) {
            low = value[i] < low ? value[i] : low;
            high = value[i] > high ? value[i] : high;
        }
        const int *kept_two = index + 2 * (ptrdiff_t)b;
        const double one = value[kept_two[0]], two = value[kept_two[1]];
        assert_in_range(kept_two[0], first, last - 1);
        assert_in_range(kept_two[1], first, last - 1);
        assert_near_abs(one < two ? one : two, low, 0.0);
        assert_near_abs(one < two ? two : one, high, 0.0);
    }
    free(index);
}

static void test_minmax_brute_force(void **state)
{
    enum { N = 5000 };
    double *value = malloc(N * sizeof *value);
    uint64_t s = 99;
    (void)state;
    for (int shape = 0; shape < 4; shape++) {
        for (int i = 0; i < N; i++) {
            s = s * 6364136223846793005u + 1442695040888963407u;
            const double noise = (double)(s >> 40) / 16777216.0;
            value[i] = shape == 0 ? noise : (shape == 1 ? i : (shape == 2 ? -i : 1.0));
        }
        for (int points = 2; points < 300; points += 7) {
            check_minmax(N, value, points);
            check_minmax(points + 1, value, points);
        }
    }
    free(value);
}

/* Values that are not numbers: null in JSON, empty in CSV, never an extreme. */
static void test_not_finite(void **state)
{
    double v[] = {1.0, (double)NAN, 3.0, (double)INFINITY, (double)NAN, -2.0};
    struct series_column column = {.name = "x", .value = v};
    const struct series_data data = {.step = 1.0, .n = 6, .n_column = 1, .column = &column};
    struct json_out out = {0};
    int index[2];
    (void)state;
    series_out_json(&out, &data, 0);
    assert_non_null(strstr(out.text, "\"value\":[1,null,3,null,null,-2]"));
    json_out_done(&out);
    out = (struct json_out){0};
    series_out_csv(&out, &data, 0);
    assert_string_equal(out.text, "time_s,x\n0,1\n1,\n2,3\n3,\n4,\n5,-2\n");
    json_out_done(&out);
    (void)series_minmax(6, v, 2, index);
    assert_int_equal(index[0], 3);
    assert_int_equal(index[1], 5);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_whole_series),
        TEST(test_selection),
        TEST(test_thinned),
        TEST(test_csv),
        TEST(test_accept),
        TEST(test_bad_queries),
        TEST(test_minmax_brute_force),
        TEST(test_not_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
