/* Every route over a service in memory: answers, refusals, and that nothing refused is stored. */
#include "api/route.h"
#include "tests/api/fake_service.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/api/fake_assert.h"

#define CASE_OF(chord)                                                                             \
    "{\"schema_version\":1,\"kind\":\"section\",\"name\":\"s\",\"beam\":{\"section\":{\"type\":"   \
    "\"strip\",\"chord_m\":" chord ",\"layup\":[{\"material\":\"foam\",\"thickness_m\":0.001}]}}}"
static const char good_case[] = CASE_OF("0.1");

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

static void test_submit_and_reuse(void **state)
{
    struct fake *f = *state;
    assert_int_equal(fake_post(f, good_case), 202);
    assert_string_equal(f->answer.content_type, "application/json");
    assert_string_equal(fake_header(f, "Location"),
                        "/v1/jobs/00000000-0000-7000-8000-000000000000");
    assert_true(fake_says(f, "\"id\":\"00000000-0000-7000-8000-000000000000\""));
    assert_true(fake_says(f, "\"state\":\"queued\",\"reused\":false"));
    assert_int_equal(f->n_job, 1);
    assert_int_equal(fake_post(f, good_case), 200);
    assert_true(fake_says(f, "\"reused\":true"));
    assert_int_equal(f->n_job, 1);
    assert_int_equal(fake_get(f, "/v1/jobs/00000000-0000-7000-8000-000000000000/case"), 200);
    assert_true(fake_says(f, "\"contour_elements\":16"));
}

static void test_batch(void **state)
{
    struct fake *f = *state;
    assert_int_equal(fake_post(f, "{\"jobs\":[" CASE_OF("0.1") "," CASE_OF("0.2") "]}"), 202);
    assert_true(fake_says(f, "{\"jobs\":[{\"id\":"));
    assert_null(fake_header(f, "Location"));
    assert_int_equal(f->n_job, 2);
    /* One bad case, and nothing of the batch is stored. */
    assert_int_equal(
        fake_post(f, "{\"jobs\":[" CASE_OF("0.3") "," CASE_OF("-1") "," CASE_OF("0.4") "]}"), 422);
    assert_problem(f, 422, "invalid_case");
    assert_first_error(f, "/jobs/1/beam/section/chord_m", "out_of_range");
    assert_int_equal(f->n_job, 2);
}

static void test_batch_sizes(void **state)
{
    struct fake *f = *state;
    char *body = malloc(1100 * sizeof good_case);
    assert_int_equal(fake_post(f, "{\"jobs\":[]}"), 422);
    assert_first_error(f, "/jobs", "empty_list");
    assert_int_equal(fake_post(f, "{\"jobs\":1}"), 422);
    assert_first_error(f, "/jobs", "wrong_type");
    assert_int_equal(fake_post(f, "{\"jobs\":[" CASE_OF("1") "],\"x\":1}"), 422);
    assert_first_error(f, "/x", "unknown_key");
    assert_int_equal(f->n_job, 0);
    for (int n = 1000; n <= 1001; n++) {
        char *at = body + sprintf(body, "{\"jobs\":[");
        for (int i = 0; i < n; i++) {
            at += sprintf(at, "%s%s", i > 0 ? "," : "", good_case);
        }
        (void)sprintf(at, "]}");
        assert_int_equal(fake_post(f, body), n == 1000 ? 202 : 422);
    }
    assert_first_error(f, "/jobs", "wrong_length");
    assert_int_equal(f->n_job, 1); /* a thousand equal cases are one job */
    free(body);
}

static void test_bad_bodies(void **state)
{
    static const struct {
        const char *body, *pointer, *code;
        int status;
    } bad[] = {
        {"", "", "syntax", 400},
        {"{\"kind\":\"section\"", "/kind", "syntax", 400},
        {CASE_OF("0.1") " {}", "", "trailing_text", 400},
        {CASE_OF("NaN"), "/beam/section/chord_m", "syntax", 400},
        {CASE_OF("01"), "/beam/section/chord_m", "bad_number", 400},
        {CASE_OF("1e999"), "/beam/section/chord_m", "not_finite", 422},
        {CASE_OF("-0.1"), "/beam/section/chord_m", "out_of_range", 422},
        {CASE_OF("0.1,\"chord_m\":0.1"), "/beam/section/chord_m", "duplicate_key", 422},
        {CASE_OF("0.1,\"Chord_m\":0.1"), "/beam/section/Chord_m", "unknown_key", 422},
        {"[]", "", "wrong_type", 422},
    };
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(fake_post(f, bad[i].body), bad[i].status);
        assert_problem(f, bad[i].status, bad[i].status == 400 ? "malformed_json" : "invalid_case");
        assert_first_error(f, bad[i].pointer, bad[i].code);
    }
    char *deep = malloc(100001);
    memset(deep, '[', 100000);
    deep[100000] = '\0';
    assert_int_equal(fake_post(f, deep), 400);
    assert_true(fake_says(f, "\"code\":\"too_deep\""));
    free(deep);
    assert_int_equal(f->n_job, 0);
}

static void test_content_type(void **state)
{
    static const struct {
        const char *type;
        int status;
    } types[] = {
        {NULL, 415},
        {"", 415},
        {"text/plain", 415},
        {"application/jsonx", 415},
        {"application/x-www-form-urlencoded", 415},
        {"application/json; charset=utf-8", 202},
        {"Application/JSON", 200},
        {"application/json ;charset=utf-8", 200},
    };
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        assert_int_equal(fake_request(f, "POST", "/v1/jobs", types[i].type, good_case),
                         types[i].status);
        assert_int_equal(f->n_job, types[i].status == 415 ? 0 : 1);
    }
}

static void test_body_limits(void **state)
{
    struct fake *f = *state;
    assert_int_equal(router_body_max("POST", "/v1/jobs"), 16 << 20);
    assert_int_equal(router_body_max("GET", "/v1/jobs"), 1 << 20);
    const size_t most = 16 << 20;
    char *body = malloc(most + 2);
    memset(body, ' ', most + 1);
    body[most + 1] = '\0';
    assert_int_equal(fake_post(f, body), 413);
    assert_problem(f, 413, "body_too_large");
    /* One case may have 1 MiB: blanks count. */
    memcpy(body, good_case, strlen(good_case));
    body[1 << 20] = '\0';
    assert_int_equal(fake_post(f, body), 202);
    body[1 << 20] = ' ';
    body[(1 << 20) + 1] = '\0';
    assert_int_equal(fake_post(f, body), 413);
    free(body);
}

static void test_service_refusals(void **state)
{
    static const struct {
        enum service_status status;
        int http;
        const char *code;
    } table[] = {
        {SERVICE_BUSY, 503, "busy"},
        {SERVICE_DISK_FULL, 507, "disk_full"},
        {SERVICE_ERROR, 500, "internal"},
    };
    struct fake *f = *state;
    const struct fake_job *job = fake_add(f, CASE_MODES, JOB_QUEUED, "");
    char path[80];
    (void)snprintf(path, sizeof path, "/v1/jobs/%s", job->record.id);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        f->refuse = table[i].status;
        (void)fake_post(f, good_case);
        assert_problem(f, table[i].http, table[i].code);
        (void)fake_request(f, "DELETE", path, NULL, NULL);
        assert_problem(f, table[i].http, table[i].code);
    }
    f->refuse = SERVICE_BUSY;
    (void)fake_post(f, good_case);
    assert_non_null(fake_header(f, "Retry-After"));
}

static void test_unknown_paths(void **state)
{
    static const char *const paths[] = {
        "/",        "/v1",          "/v1/job",        "/v1/jobs/",  "/v2/jobs", "/v1/jobs//case",
        "/V1/jobs", "/v1/jobs/a/b", "/v1/materials/", "/healthz/x", ""};
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        (void)fake_get(f, paths[i]);
        assert_problem(f, 404, "unknown_path");
    }
}

static void test_methods(void **state)
{
    struct fake *f = *state;
    (void)fake_request(f, "PUT", "/v1/jobs", NULL, NULL);
    assert_problem(f, 405, "method_not_allowed");
    assert_string_equal(fake_header(f, "Allow"), "POST, GET, HEAD, OPTIONS");
    (void)fake_request(f, "POST", "/healthz", NULL, NULL);
    assert_string_equal(fake_header(f, "Allow"), "GET, HEAD, OPTIONS");
    assert_int_equal(fake_request(f, "OPTIONS", "/v1/jobs/x", NULL, NULL), 204);
    assert_string_equal(fake_header(f, "Allow"), "GET, HEAD, DELETE, OPTIONS");
    assert_null(f->answer.body);
    assert_int_equal(fake_request(f, "OPTIONS", "/nothing", NULL, NULL), 404);
    assert_int_equal(fake_request(f, "HEAD", "/healthz", NULL, NULL), 200);
    assert_int_equal(fake_request(f, "HEAD", "/nothing", NULL, NULL), 404);
    assert_int_equal(fake_request(f, "get", "/healthz", NULL, NULL), 405);
}

static void test_unknown_query(void **state)
{
    struct fake *f = *state;
    (void)fake_get(f, "/v1/jobs?Kind=modes");
    assert_problem(f, 400, "bad_query");
    assert_first_error(f, "?Kind", "unknown_key");
    (void)fake_get(f, "/healthz?x=1");
    assert_problem(f, 400, "bad_query");
    (void)fake_get(f, "/v1/jobs?limit=1&limit=2");
    assert_first_error(f, "?limit", "duplicate_key");
}

static void test_get_job(void **state)
{
    struct fake *f = *state;
    struct fake_job *job = fake_add(f, CASE_SIMULATION, JOB_FAILED, "na\"me");
    char path[80];
    (void)snprintf(path, sizeof path, "/v1/jobs/%s", job->record.id);
    job->record.started_us = 1700000000000001;
    (void)snprintf(job->record.error_code, sizeof job->record.error_code, "singular");
    (void)snprintf(job->record.error_detail, sizeof job->record.error_detail, "at 0.1 s");
    assert_int_equal(fake_get(f, path), 200);
    assert_true(fake_says(f, "\"name\":\"na\\\"me\""));
    assert_true(fake_says(f, "\"created\":\"2023-11-14T22:13:20.000000Z\""));
    assert_true(fake_says(f, "\"started\":\"2023-11-14T22:13:20.000001Z\",\"finished\":null"));
    assert_true(fake_says(f, "\"verdict\":null,\"error\":{\"code\":\"singular\","));
    (void)fake_get(f, "/v1/jobs/00000000-0000-7000-8000-0000000000ff");
    assert_problem(f, 404, "unknown_job");
    (void)fake_get(f, "/v1/jobs/nonsense");
    assert_problem(f, 404, "unknown_job");
    (void)fake_get(f, "/v1/jobs/%zz");
    assert_problem(f, 400, "bad_path");
    (void)fake_get(f, "/v1/jobs/%00");
    assert_problem(f, 400, "bad_path");
}

static void test_cancel(void **state)
{
    struct fake *f = *state;
    const struct fake_job *job = fake_add(f, CASE_MODES, JOB_QUEUED, "");
    char path[80];
    (void)snprintf(path, sizeof path, "/v1/jobs/%s", job->record.id);
    for (int i = 0; i < 2; i++) { /* idempotent */
        assert_int_equal(fake_request(f, "DELETE", path, NULL, NULL), 200);
        assert_true(fake_says(f, "\"state\":\"cancelled\""));
    }
    (void)fake_request(f, "DELETE", "/v1/jobs/00000000-0000-7000-8000-0000000000ff", NULL, NULL);
    assert_problem(f, 404, "unknown_job");
}

static void test_documents(void **state)
{
    static const struct {
        enum case_kind kind;
        enum job_state state;
        const char *document;
        int status;
        const char *code;
    } table[] = {
        {CASE_SIMULATION, JOB_DONE, "summary", 200, NULL},
        {CASE_SIMULATION, JOB_DONE, "damping", 200, NULL},
        {CASE_SIMULATION, JOB_DONE, "loads", 200, NULL},
        {CASE_MODES, JOB_DONE, "loads", 404, "no_document"},
        {CASE_SIMULATION, JOB_DONE, "modes", 200, NULL},
        {CASE_SIMULATION, JOB_DONE, "section", 200, NULL},
        {CASE_SIMULATION, JOB_DONE, "series", 200, NULL},
        {CASE_MODES, JOB_DONE, "damping", 404, "no_document"},
        {CASE_MODES, JOB_QUEUED, "series", 404, "no_document"},
        {CASE_SECTION, JOB_DONE, "modes", 404, "no_document"},
        {CASE_SECTION, JOB_DONE, "section", 200, NULL},
        {CASE_SIMULATION, JOB_QUEUED, "summary", 409, "not_ready"},
        {CASE_SIMULATION, JOB_RUNNING, "damping", 409, "not_ready"},
        {CASE_SIMULATION, JOB_FAILED, "summary", 409, "not_ready"},
        {CASE_SIMULATION, JOB_CANCELLED, "series", 409, "not_ready"},
    };
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        const struct fake_job *job = fake_add(f, table[i].kind, table[i].state, "");
        char path[96];
        (void)snprintf(path, sizeof path, "/v1/jobs/%s/%s", job->record.id, table[i].document);
        assert_int_equal(fake_get(f, path), table[i].status);
        if (table[i].code != NULL) {
            assert_problem(f, table[i].status, table[i].code);
        }
        if (table[i].status == 409) {
            char member[40];
            (void)snprintf(member, sizeof member, "\"state\":\"%s\"",
                           job_state_name(table[i].state));
            assert_true(fake_says(f, member));
        }
    }
}

static void test_etags(void **state)
{
    struct fake *f = *state;
    const struct fake_job *job = fake_add(f, CASE_SIMULATION, JOB_DONE, "");
    char path[96], etag[64], other[96];
    (void)snprintf(path, sizeof path, "/v1/jobs/%s/summary", job->record.id);
    assert_int_equal(fake_get(f, path), 200);
    (void)snprintf(etag, sizeof etag, "%s", fake_header(f, "ETag"));
    assert_true(etag[0] == '"');
    assert_non_null(strstr(fake_header(f, "Cache-Control"), "immutable"));
    assert_int_equal(fake_get_with(f, path, NULL, etag), 304);
    assert_null(f->answer.body);
    assert_string_equal(fake_header(f, "ETag"), etag);
    (void)snprintf(other, sizeof other, "\"x\" , W/%s", etag);
    assert_int_equal(fake_get_with(f, path, NULL, other), 304);
    assert_int_equal(fake_get_with(f, path, NULL, "*"), 304);
    assert_int_equal(fake_get_with(f, path, NULL, "\"x\""), 200);
    (void)snprintf(path, sizeof path, "/v1/jobs/%s/damping", job->record.id);
    assert_int_equal(fake_get_with(f, path, NULL, etag), 200); /* other bytes, other tag */
}

static void test_library(void **state)
{
    struct fake *f = *state;
    assert_int_equal(fake_get(f, "/v1/materials"), 200);
    assert_true(fake_says(f, "\"name\":\"AS4/3501-6\",\"e_l_pa\":141960000000"));
    assert_int_equal(fake_get(f, "/v1/materials/AS4/3501-6"), 200);
    assert_true(fake_says(f, "\"provenance\":\"Table 1"));
    assert_int_equal(fake_get(f, "/v1/materials/AS4%2F3501-6"), 200);
    (void)fake_get(f, "/v1/materials/AS4");
    assert_problem(f, 404, "unknown_name");
    assert_int_equal(fake_get(f, "/v1/polars"), 200);
    assert_false(fake_says(f, "\"cl\""));
    assert_int_equal(fake_get(f, "/v1/polars/plate-4pct-channel"), 200);
    assert_true(fake_says(f, "\"cl\":[["));
    assert_int_equal(fake_get(f, "/v1/networks"), 200);
    assert_int_equal(fake_get_with(f, "/v1/networks", NULL, fake_header(f, "ETag")), 304);
    (void)fake_get(f, "/v1/networks/none");
    assert_problem(f, 404, "unknown_name");
}

static void test_meta(void **state)
{
    struct fake *f = *state;
    assert_int_equal(fake_get(f, "/healthz"), 200);
    assert_true(fake_says(f, "\"core_version\":\"" AEROM_CORE_VERSION "\""));
    assert_int_equal(fake_get(f, "/readyz"), 200);
    f->not_ready = true;
    assert_int_equal(fake_get(f, "/readyz"), 503);
    assert_true(fake_says(f, "the store is closed"));
    assert_int_equal(fake_get(f, "/openapi.json"), 200);
    assert_true(fake_says(f, "\"openapi\""));
}

static void test_adaptor_problem(void **state)
{
    struct api_response res;
    (void)state;
    router_problem(&res, 413, "body_too_large", "x");
    assert_int_equal(res.status, 413);
    assert_non_null(strstr(res.body, "\"title\":\"The body is too large\""));
    api_response_done(&res);
    router_problem(&res, 431, "headers", "y");
    assert_non_null(strstr(res.body, "\"code\":\"headers\""));
    api_response_done(&res);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_submit_and_reuse), TEST(test_batch),
        TEST(test_batch_sizes),      TEST(test_bad_bodies),
        TEST(test_content_type),     TEST(test_body_limits),
        TEST(test_service_refusals), TEST(test_unknown_paths),
        TEST(test_methods),          TEST(test_unknown_query),
        TEST(test_get_job),          TEST(test_cancel),
        TEST(test_documents),        TEST(test_etags),
        TEST(test_library),          TEST(test_meta),
        TEST(test_adaptor_problem),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
