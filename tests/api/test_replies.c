/* Recorded replies against the OpenAPI document: status, headers, media type and body. */
#include "api/embedded.h"
#include "api/json.h"
#include "tests/api/fake_service.h"
#include "tests/api/schema_check.h"

#include <cjson/cJSON.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct fixture {
    struct fake *fake;
    cJSON *doc;
};

static int setup(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    struct failure fail;
    f->fake = fake_create();
    if (json_parse(openapi_files[0].data, embedded_size(&openapi_files[0]), &f->doc, &fail) !=
        ST_OK) {
        print_error("openapi.json%s: %s\n", fail.pointer, fail.detail);
        return -1;
    }
    *state = f;
    return 0;
}

static int teardown(void **state)
{
    struct fixture *f = *state;
    json_free(f->doc);
    fake_destroy(f->fake);
    free(f);
    return 0;
}

static const cJSON *get(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static const cJSON *schema_named(const struct fixture *f, const char *name)
{
    const cJSON *s = get(get(get(f->doc, "components"), "schemas"), name);
    assert_non_null(s);
    return s;
}

static const cJSON *operation_of(const struct fixture *f, const char *path, const char *method)
{
    char lower[16] = "";
    for (size_t i = 0; method[i] != '\0' && i + 1 < sizeof lower; i++) {
        lower[i] = (char)(method[i] | 0x20);
        lower[i + 1] = '\0';
    }
    return get(get(get(f->doc, "paths"), path), lower);
}

static void check_reply(const struct fixture *f, const char *path, const char *method)
{
    const struct api_response *res = &f->fake->answer;
    char status[8], why[256];
    (void)snprintf(status, sizeof status, "%d", res->status);
    const cJSON *responses = get(operation_of(f, path, method), "responses");
    const cJSON *response = schema_resolve(f->doc, get(responses, status));
    if (response == NULL) {
        fail_msg("%s %s answers %s, which is not in the document", method, path, status);
    }
    const cJSON *header = NULL;
    cJSON_ArrayForEach(header, get(response, "headers"))
    {
        assert_true(fake_header(f->fake, header->string) != NULL ||
                    strcmp(header->string, "Location") == 0 || strcmp(header->string, "Link") == 0);
    }
    if (res->body == NULL) {
        assert_null(get(response, "content"));
        return;
    }
    char type[64];
    (void)snprintf(type, sizeof type, "%.*s", (int)strcspn(res->content_type, ";"),
                   res->content_type);
    const cJSON *content = get(get(response, "content"), type);
    assert_non_null(content);
    if (strstr(type, "json") == NULL) {
        return;
    }
    struct cJSON *tree = NULL;
    struct failure fail;
    assert_int_equal(json_parse(res->body, res->body_size, &tree, &fail), ST_OK);
    if (!schema_check(f->doc, get(content, "schema"), tree, why)) {
        fail_msg("%s %s %s: %s in %.300s", method, path, status, why, res->body);
    }
    json_free(tree);
}

static const char good_case[] =
    "{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\","
    "\"chord_m\":0.1,\"layup\":[{\"material\":\"foam\",\"thickness_m\":0.001}]}}}";

#define STUDY                                                                                      \
    "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"case\":%s,\"vary\":["            \
    "{\"pointer\":\"/beam/section/chord_m\",\"values\":[0.1,0.2]},"                                \
    "{\"pointer\":\"/beam/section/layup/0/angle_deg\",\"from\":-90,\"to\":90,\"count\":3}]}"

/* Result documents are the fake's own words here: test_result.c checks the real ones. */
static void test_replies(void **state)
{
#define ID "00000000-0000-7000-8000-000000000000"
    static const struct {
        const char *path, *target;
        int status;
    } gets[] = {
        {"/v1/jobs", "/v1/jobs", 200},
        {"/v1/jobs", "/v1/jobs?limit=1", 200},
        {"/v1/jobs", "/v1/jobs?limit=x", 400},
        {"/v1/jobs/{id}", "/v1/jobs/" ID, 200},
        {"/v1/jobs/{id}", "/v1/jobs/x", 404},
        {"/v1/jobs/{id}", "/v1/jobs/%zz", 400},
        {"/v1/jobs/{id}/case", "/v1/jobs/x/case", 404},
        {"/v1/jobs/{id}/series", "/v1/jobs/" ID "/series", 200},
        {"/v1/jobs/{id}/series", "/v1/jobs/" ID "/series?points=10", 200},
        {"/v1/jobs/{id}/series", "/v1/jobs/" ID "/series?format=csv", 200},
        {"/v1/jobs/{id}/series", "/v1/jobs/" ID "/series?points=1", 400},
        {"/v1/jobs/{id}/damping", "/v1/jobs/00000000-0000-7000-8000-000000000001/damping", 409},
        {"/v1/jobs/{id}/summary", "/v1/jobs/x/summary", 404},
        {"/v1/materials", "/v1/materials", 200},
        {"/v1/materials/{name}", "/v1/materials/foam", 200},
        {"/v1/materials/{name}", "/v1/materials/x", 404},
        {"/v1/polars", "/v1/polars", 200},
        {"/v1/polars/{name}", "/v1/polars/flat-plate-linear", 200},
        {"/v1/networks", "/v1/networks", 200},
        {"/v1/networks/{name}", "/v1/networks/x", 404},
        {"/v1/datasets", "/v1/datasets", 200},
        {"/v1/datasets/{dataset}", "/v1/datasets/plate-4pct", 200},
        {"/v1/datasets/{dataset}/records/{record}",
         "/v1/datasets/plate-4pct/records/pitch_m2.5_a5_f0.125", 200},
        {"/v1/datasets/{dataset}/records/{record}",
         "/v1/datasets/plate-4pct/records/pitch_m2.5_a5_f0.125.svg", 200},
        {"/v1/datasets/{dataset}/records/{record}", "/v1/datasets/plate-4pct/records/x", 404},
        {"/v1/datasets/{dataset}", "/v1/datasets/plate-4pct?format=svg", 400},
        {"/v1/datasets/{dataset}", "/v1/datasets/x", 404},
        {"/healthz", "/healthz", 200},
        {"/readyz", "/readyz", 200},
        {"/openapi.json", "/openapi.json", 200},
    };
    struct fixture *f = *state;
    (void)fake_add(f->fake, CASE_SIMULATION, JOB_DONE, "a");
    (void)fake_add(f->fake, CASE_SIMULATION, JOB_FAILED, "b");
    for (size_t i = 0; i < sizeof gets / sizeof gets[0]; i++) {
        assert_int_equal(fake_get(f->fake, gets[i].target), gets[i].status);
        check_reply(f, gets[i].path, "GET");
    }
    assert_int_equal(fake_get_with(f->fake, "/v1/polars", NULL, "*"), 304);
    check_reply(f, "/v1/polars", "GET");
    f->fake->not_ready = true;
    assert_int_equal(fake_get(f->fake, "/readyz"), 503);
    check_reply(f, "/readyz", "GET");
    assert_int_equal(fake_request(f->fake, "DELETE", "/v1/jobs/" ID, NULL, NULL), 200);
    check_reply(f, "/v1/jobs/{id}", "DELETE");
}

static const char own_material[] =
    "{\"name\":\"m\",\"e_l_pa\":2e9,\"e_t_pa\":2e9,\"g_lt_pa\":8e8,\"g_tt_pa\":8e8,\"nu_lt\":0.25,"
    "\"nu_tt\":0.25,\"density_kg_m3\":1000}";
static const char own_polar[] =
    "{\"name\":\"p\",\"alpha_deg\":[-10,10],\"cl\":[[-1,1]],\"cm\":[[0,0]],"
    "\"linear_from_deg\":-9,\"linear_to_deg\":9}";
static const char own_network[] =
    "{\"name\":\"n\",\"activation\":\"tanh\",\"inputs\":[\"alpha_rate\"],\"outputs\":[\"cl\"],"
    "\"hidden\":1,\"input_offset\":[0],\"input_scale\":[1],\"output_offset\":[0],"
    "\"output_scale\":[1],\"hull_min\":[-1],\"hull_max\":[1],\"w1\":[[1]],\"b1\":[0],"
    "\"w2\":[[1]],\"b2\":[0]}";

/* What is added shows in lists and entries in the same form as what is compiled in. */
static void test_library_replies(void **state)
{
    static const struct {
        const char *list, *entry, *target, *body;
    } kinds[] = {{"/v1/materials", "/v1/materials/{name}", "/v1/materials/m", own_material},
                 {"/v1/polars", "/v1/polars/{name}", "/v1/polars/p", own_polar},
                 {"/v1/networks", "/v1/networks/{name}", "/v1/networks/n", own_network}};
    static const struct {
        enum service_status refuse;
        const char *type, *body;
        int status;
    } bad[] = {{SERVICE_OK, "text/plain", "{}", 415},
               {SERVICE_OK, "application/json", "{\"name\":", 400},
               {SERVICE_OK, "application/json", "{\"name\":\"x\"}", 422},
               {SERVICE_BUSY, "application/json", NULL, 503},
               {SERVICE_DISK_FULL, "application/json", NULL, 507},
               {SERVICE_ERROR, "application/json", NULL, 500}};
    struct fixture *f = *state;
    struct fake *fake = f->fake;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const char *list = kinds[i].list, *target = kinds[i].target;
        for (int again = 0; again < 2; again++) {
            assert_int_equal(fake_request(fake, "POST", list, "application/json", kinds[i].body),
                             again ? 200 : 201);
            check_reply(f, list, "POST");
        }
        assert_string_equal(fake_header(fake, "Location"), target);
        assert_int_equal(fake_get(fake, list), 200);
        check_reply(f, list, "GET");
        assert_true(fake_says(fake, "\"built_in\":false"));
        assert_int_equal(fake_get(fake, target), 200);
        check_reply(f, kinds[i].entry, "GET");
        for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
            fake->refuse = bad[k].refuse;
            assert_int_equal(fake_request(fake, "POST", list, bad[k].type,
                                          bad[k].body != NULL ? bad[k].body : kinds[i].body),
                             bad[k].status);
            check_reply(f, list, "POST");
        }
        fake->refuse = SERVICE_OK;
        assert_int_equal(fake_request(fake, "DELETE", target, NULL, NULL), 204);
        check_reply(f, kinds[i].entry, "DELETE");
        assert_int_equal(fake_request(fake, "DELETE", target, NULL, NULL), 404);
        check_reply(f, kinds[i].entry, "DELETE");
    }
    assert_int_equal(fake_request(fake, "DELETE", "/v1/polars/flat-plate-linear", NULL, NULL), 409);
    check_reply(f, "/v1/polars/{name}", "DELETE");
}

static void test_submit_replies(void **state)
{
    struct fixture *f = *state;
    char batch[600];
    char study[800];
    (void)snprintf(batch, sizeof batch, "{\"jobs\":[%s]}", good_case);
    (void)snprintf(study, sizeof study, STUDY, good_case);
    const struct {
        const char *type, *body;
        enum service_status refuse;
        int status;
    } posts[] = {
        {"application/json", good_case, SERVICE_OK, 202},
        {"application/json", good_case, SERVICE_OK, 200},
        {"application/json", batch, SERVICE_OK, 200},
        {"application/json", "{", SERVICE_OK, 400},
        {"application/json", "{}", SERVICE_OK, 422},
        {"text/plain", "{}", SERVICE_OK, 415},
        {"application/json", good_case, SERVICE_BUSY, 503},
        {"application/json", good_case, SERVICE_DISK_FULL, 507},
        {"application/json", good_case, SERVICE_ERROR, 500},
    };
    for (size_t i = 0; i < sizeof posts / sizeof posts[0]; i++) {
        f->fake->refuse = posts[i].refuse;
        assert_int_equal(fake_request(f->fake, "POST", "/v1/jobs", posts[i].type, posts[i].body),
                         posts[i].status);
        check_reply(f, "/v1/jobs", "POST");
    }
    for (size_t i = 0; i < sizeof posts / sizeof posts[0]; i++) {
        const char *body = posts[i].body == good_case ? study : posts[i].body;
        f->fake->refuse = posts[i].refuse;
        if (body != batch) {
            assert_int_equal(fake_request(f->fake, "POST", "/v1/studies", posts[i].type, body),
                             posts[i].status);
            check_reply(f, "/v1/studies", "POST");
        }
    }
    f->fake->refuse = SERVICE_OK;
    assert_int_equal(fake_post(f->fake, study), 200); /* the other door */
    check_reply(f, "/v1/jobs", "POST");
    assert_int_equal(fake_request(f->fake, "POST", "/v1/studies", "application/json", good_case),
                     422);
    assert_int_equal(fake_get(f->fake, "/v1/jobs/" ID "/case"), 200);
    check_reply(f, "/v1/jobs/{id}/case", "GET");
}

/* A study of six cells, of which the fake has two. */
static void test_study_replies(void **state)
{
    static const struct {
        const char *path, *tail;
        int status;
        const char *says;
    } gets[] = {
        {"/v1/studies/{id}", "", 200, "\"pending\":4"},
        {"/v1/studies/{id}/case", "/case", 200, "\"vary\""},
        {"/v1/studies/{id}/cells", "/cells", 200, "\"next\":null"},
        {"/v1/studies/{id}/cells", "/cells?limit=1", 200, "\"next\":1"},
        {"/v1/studies/{id}/cells", "/cells?from=1&limit=1", 200, "singular"},
        {"/v1/studies/{id}/cells", "/cells?limit=0", 400, "?limit"},
        {"/v1/studies/{id}/cells/{cell}", "/cells/0", 200, "\"cl\":0.5"},
        {"/v1/studies/{id}/cells/{cell}", "/cells/1", 200, "\"summary\":null"},
        {"/v1/studies/{id}/cells/{cell}", "/cells/5", 200, "\"state\":\"pending\""},
        {"/v1/studies/{id}/cells/{cell}", "/cells/6", 404, "no_cell"},
        {"/v1/studies/{id}/cells/{cell}", "/cells/x", 404, "no_cell"},
        {"/v1/studies/{id}/map", "/map", 200,
         "\"values\":[[\"stable\",null,null],[null,null,null]]"},
        {"/v1/studies/{id}/map", "/map?value=means.cl", 200,
         "\"status\":[[\"done\",\"failed\",\"pending\"]"},
        {"/v1/studies/{id}/map", "/map?value=cl&format=csv", 200, ",0.5,done\n"},
        {"/v1/studies/{id}/map", "/map?format=svg", 200, ">1 of 6 cells, 1 failed<"},
        {"/v1/studies/{id}/map", "/map?format=npy", 200, "NUMPY"},
        {"/v1/studies/{id}/map", "/map?format=hdf5", 200, "HDF"},
        {"/v1/studies/{id}/map", "/map?format=xls", 400, "?format"},
        {"/v1/studies/{id}/map", "/map?value=cd", 400, "unknown_value"},
        {"/v1/studies/{id}/map", "/map?value=means", 400, "more than one value"},
    };
    struct fixture *f = *state;
    char study[800], target[160];
    (void)snprintf(study, sizeof study, STUDY, good_case);
    assert_int_equal(fake_post(f->fake, study), 202);
    for (size_t i = 0; i < sizeof gets / sizeof gets[0]; i++) {
        (void)snprintf(target, sizeof target, "/v1/studies/" ID "%s", gets[i].tail);
        assert_int_equal(fake_get(f->fake, target), gets[i].status);
        check_reply(f, gets[i].path, "GET");
        if (!fake_says(f->fake, gets[i].says)) {
            fail_msg("%s: %s", target, f->fake->answer.body);
        }
    }
    assert_int_equal(fake_get(f->fake, "/v1/jobs/" ID), 200);
    check_reply(f, "/v1/jobs/{id}", "GET");
    assert_int_equal(fake_get(f->fake, "/v1/jobs/" ID "/summary"), 404);
    (void)fake_add(f->fake, CASE_SIMULATION, JOB_DONE, "no study");
    assert_int_equal(fake_get(f->fake, "/v1/studies"), 200);
    check_reply(f, "/v1/studies", "GET");
    assert_false(fake_says(f->fake, "no study"));
    assert_int_equal(fake_get(f->fake, "/v1/studies/00000000-0000-7000-8000-000000000001"), 404);
    check_reply(f, "/v1/studies/{id}", "GET");
    assert_int_equal(fake_request(f->fake, "DELETE", "/v1/studies/" ID, NULL, NULL), 200);
    check_reply(f, "/v1/studies/{id}", "DELETE");
}

/* The checker itself refuses what does not fit: otherwise every test above could not fail. */
static void test_checker_refuses(void **state)
{
    static const struct {
        const char *schema, *value;
        bool fits;
    } table[] = {
        {"Flow", "{\"speed_m_s\":1}", true},
        {"StabilityRange", "{\"from_m_s\":1,\"to_m_s\":2}", true},
        {"StabilityRange", "{}", false},
        {"Flow", "{\"speed_m_s\":0}", false},
        {"Flow", "{\"speed_m_s\":\"1\"}", false},
        {"Flow", "{\"speed_m_s\":1,\"x\":1}", false},
        {"LiftingLine", "null", true},
        {"LiftingLine", "{\"walls\":\"root_and_far\"}", false},
        {"LiftingLine", "{\"walls\":\"root_and_far\",\"width_m\":1}", true},
        {"LiftingLine", "{\"walls\":\"root\",\"width_m\":1}", false},
        {"Dynamic", "{\"type\":\"network\"}", false},
        {"Ready", "{\"status\":\"no\"}", false},
        {"Case",
         "{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"section\":{\"type\":"
         "\"strip\",\"chord_m\":1,\"layup\":[]}}}",
         false},
        {"JobList", "{\"jobs\":[],\"next\":null}", true},
        {"JobList", "{\"jobs\":[{}],\"next\":null}", false},
    };
    const struct fixture *f = *state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        struct cJSON *tree = NULL;
        struct failure fail;
        char why[256];
        assert_int_equal(json_parse(table[i].value, strlen(table[i].value), &tree, &fail), ST_OK);
        const bool result = schema_check(f->doc, schema_named(f, table[i].schema), tree, why);
        if (result != table[i].fits) {
            fail_msg("%s %s: %s", table[i].schema, table[i].value, why);
        }
        json_free(tree);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_replies),       TEST(test_submit_replies),  TEST(test_library_replies),
        TEST(test_study_replies), TEST(test_checker_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
