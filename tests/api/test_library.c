/* What users add to the library: versions, references, and what of a bad entry is said. */
#include "tests/api/fake_service.h"

#include "api/case.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define NETWORK(name, b1, more)                                                                    \
    "{\"name\":\"" name "\",\"activation\":\"tanh\",\"inputs\":[\"alpha_rate\"],"                  \
    "\"outputs\":[\"cl\"],\"hidden\":1,\"input_offset\":[0],\"input_scale\":[1],"                  \
    "\"output_offset\":[0],\"output_scale\":[1],\"hull_min\":[-1],\"hull_max\":[1],"               \
    "\"w1\":[[0.5]],\"b1\":" b1 ",\"w2\":[[2]],\"b2\":[0]" more "}"
#define LOOP(network)                                                                              \
    "{\"schema_version\":1,\"kind\":\"loop\",\"aerodynamics\":{\"polar\":\"flat-plate-linear\","   \
    "\"dynamic\":{\"type\":\"network\",\"name\":\"" network "\"}},"                                \
    "\"motion\":{\"type\":\"sine\",\"amplitude_deg\":2,\"frequency_c_v\":0.1}}"

static int setup(void **state)
{
    *state = fake_create();
    return 0;
}

static int teardown(void **state)
{
    fake_destroy(*state);
    return 0;
}

static int post(struct fake *f, const char *target, const char *body)
{
    return fake_request(f, "POST", target, "application/json", body);
}

/* Parses a case; NULL and the first problem's pointer when it is refused. */
static struct api_case *parse(const struct fake *f, const char *json, char pointer[64])
{
    struct failure_list *problems = calloc(1, sizeof *problems);
    struct api_case *c = NULL;
    pointer[0] = '\0';
    if (api_case_parse(f->library, json, strlen(json), "", &c, problems) != ST_OK) {
        (void)snprintf(pointer, 64, "%.63s", problems->item[0].pointer);
        c = NULL;
    }
    free(problems);
    return c;
}

static void test_versions(void **state)
{
    struct fake *f = *state;
    assert_int_equal(post(f, "/v1/networks", NETWORK("a", "[0]", "")), 201);
    assert_true(fake_says(f, "\"version\":1"));
    assert_int_equal(post(f, "/v1/networks", NETWORK("a", "[1]", "")), 201);
    assert_true(fake_says(f, "\"version\":2"));
    /* The description does not count for the content. */
    assert_int_equal(post(f, "/v1/networks", NETWORK("a", "[0]", ",\"description\":\"d\"")), 200);
    assert_true(fake_says(f, "\"version\":1"));
    assert_true(fake_says(f, "\"reused\":true"));
    assert_int_equal(fake_get(f, "/v1/networks/a"), 200);
    assert_true(fake_says(f, "\"b1\":[1]"));
    assert_int_equal(fake_get(f, "/v1/networks/a?version=1"), 200);
    assert_true(fake_says(f, "\"b1\":[0]"));
    assert_int_equal(fake_get(f, "/v1/networks/a?version=3"), 404);
    assert_int_equal(fake_get(f, "/v1/networks/a?version=x"), 400);
    assert_int_equal(fake_request(f, "DELETE", "/v1/networks/a?version=2", NULL, NULL), 204);
    assert_int_equal(fake_get(f, "/v1/networks/a"), 200);
    assert_true(fake_says(f, "\"b1\":[0]"));
}

/* The stored case holds what it refers to: it is the same after the entry has gone. */
static void test_case_keeps_what_it_needs(void **state)
{
    struct fake *f = *state;
    char pointer[64];
    assert_null(parse(f, LOOP("a"), pointer));
    assert_string_equal(pointer, "/aerodynamics/dynamic/name");
    assert_int_equal(post(f, "/v1/networks", NETWORK("a", "[0]", "")), 201);
    assert_int_equal(post(f, "/v1/networks", NETWORK("a", "[1]", "")), 201);
    struct api_case *first = parse(f, LOOP("a@1"), pointer), *newest = parse(f, LOOP("a"), pointer);
    struct api_case *second = parse(f, LOOP("a@2"), pointer);
    assert_non_null(first);
    assert_non_null(second);
    assert_string_equal(api_case_hash(newest), api_case_hash(second));
    assert_string_not_equal(api_case_hash(first), api_case_hash(second));
    assert_int_equal(fake_request(f, "DELETE", "/v1/networks/a", NULL, NULL), 204);
    assert_null(parse(f, LOOP("a"), pointer));
    struct api_case *again = parse(f, api_case_canonical(first), pointer);
    assert_non_null(again);
    assert_string_equal(api_case_hash(again), api_case_hash(first));
    assert_string_equal(api_case_canonical(again), api_case_canonical(first));
    assert_true(api_case_def(again)->aero.network->b1[0] == 0.0);
    api_case_destroy(first);
    api_case_destroy(second);
    api_case_destroy(newest);
    api_case_destroy(again);
}

static void test_own_material_and_polar(void **state)
{
    struct fake *f = *state;
    char pointer[64];
    assert_int_equal(
        post(f, "/v1/materials",
             "{\"name\":\"mine\",\"e_l_pa\":2e9,\"e_t_pa\":2e9,\"g_lt_pa\":8e8,\"g_tt_pa\":8e8,"
             "\"nu_lt\":0.25,\"nu_tt\":0.25,\"density_kg_m3\":1000}"),
        201);
    assert_int_equal(post(f, "/v1/polars",
                          "{\"name\":\"thin\",\"alpha_deg\":[-10,10],\"cl\":[[-1,1]],"
                          "\"cm\":[[0,0]],\"linear_from_deg\":-9,\"linear_to_deg\":9}"),
                     201);
    struct api_case *c =
        parse(f,
              "{\"schema_version\":1,\"kind\":\"stability\",\"beam\":{\"length_m\":1,\"section\":"
              "{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["
              "{\"material\":\"mine\",\"thickness_m\":0.001},"
              "{\"material\":\"mine\",\"thickness_m\":0.002}]}},"
              "\"aerodynamics\":{\"polar\":\"thin\"},\"stability\":{\"from_m_s\":1,\"to_m_s\":9}}",
              pointer);
    assert_string_equal(pointer, "");
    assert_string_equal(api_case_def(c)->aero.polar->name, "thin");
    assert_true(api_case_def(c)->beam.section.shape.layup[0].ply[1].material.e_l == 2e9);
    assert_non_null(strstr(api_case_canonical(c), "\"materials\":[{\"name\":\"mine\""));
    api_case_destroy(c);
}

static void test_bad_entries(void **state)
{
    static const struct {
        const char *body;
        int status;
        const char *said;
    } bad[] = {
        {"{\"name\":\"a\",\"activation\":\"ta", 400, "malformed_json"},
        {NETWORK("a", "[0,0]", ""), 422, "\"pointer\":\"/b1\",\"code\":\"wrong_length\""},
        {NETWORK("a", "[1e999]", ""), 422, "\"pointer\":\"/b1/0\""},
        {NETWORK("a", "[null]", ""), 422, "\"pointer\":\"/b1/0\",\"code\":\"wrong_type\""},
        {NETWORK("a", "[0]", ",\"hash\":\"00\""), 422,
         "\"pointer\":\"/hash\",\"code\":\"bad_checksum\""},
        {NETWORK("a", "[0]", ",\"hash\":7"), 422, "bad_checksum"},
        {NETWORK("a@1", "[0]", ""), 422, "\"pointer\":\"/name\",\"code\":\"bad_name\""},
        {NETWORK("", "[0]", ""), 422, "\"pointer\":\"/name\""},
        {NETWORK("a", "[0]", ",\"b3\":[0]"), 422, "unknown_key"},
        {"[]", 422, "an object"},
        {"", 400, "malformed_json"},
    };
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(post(f, "/v1/networks", bad[i].body), bad[i].status);
        if (!fake_says(f, bad[i].said)) {
            fail_msg("%s: %.*s", bad[i].said, (int)f->answer.body_size, f->answer.body);
        }
        assert_int_equal(f->n_entry, 0);
    }
    assert_int_equal(post(f, "/v1/materials", "{\"name\":\"foam\"}"), 422);
    (void)fake_get(f, "/v1/polars/flat-plate-linear");
    char *copy = strndup(f->answer.body, f->answer.body_size);
    assert_int_equal(post(f, "/v1/polars", copy), 409);
    assert_true(fake_says(f, "\"code\":\"built_in\""));
    free(copy);
}

/* What GET shows can be sent again as it is; a changed number is found by the hash. */
static void test_copies(void **state)
{
    struct fake *f = *state;
    assert_int_equal(post(f, "/v1/networks", NETWORK("a", "[0]", "")), 201);
    assert_int_equal(fake_get(f, "/v1/networks/a"), 200);
    char *copy = strndup(f->answer.body, f->answer.body_size);
    assert_int_equal(post(f, "/v1/networks", copy), 200);
    char *at = strstr(copy, "\"b1\":[0]");
    assert_non_null(at);
    at[6] = '1';
    assert_int_equal(post(f, "/v1/networks", copy), 422);
    assert_true(fake_says(f, "bad_checksum"));
    free(copy);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_versions),    TEST(test_case_keeps_what_it_needs),
        TEST(test_bad_entries), TEST(test_own_material_and_polar),
        TEST(test_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
