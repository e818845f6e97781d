/* Every allocation fails once: each request still gets exactly one answer, the one it would have
 * got or a 500, nothing is stored by halves, and nothing leaks (the sanitizer looks). The linker
 * sends the allocation calls of the program here (--wrap). */
#include "api/result.h"
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

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *block, size_t size);
char *__real_strdup(const char *text);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *block, size_t size);
char *__wrap_strdup(const char *text);

/* Calls until the one that fails; negative: none will. */
static long countdown = -1;

static bool fails_now(void)
{
    return countdown >= 0 && countdown-- == 0;
}

void *__wrap_malloc(size_t size)
{
    return fails_now() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size)
{
    return fails_now() ? NULL : __real_calloc(n, size);
}

void *__wrap_realloc(void *block, size_t size)
{
    return fails_now() ? NULL : __real_realloc(block, size);
}

char *__wrap_strdup(const char *text)
{
    return fails_now() ? NULL : __real_strdup(text);
}

static void release(void *block)
{
    free(block);
}

static const char own_definitions[] =
    "{\"schema_version\":1,\"kind\":\"simulation\",\"materials\":[{\"name\":\"m\",\"e_l_pa\":1e9,"
    "\"e_t_pa\":1e9,\"g_lt_pa\":1e9,\"g_tt_pa\":1e9,\"nu_lt\":0.3,\"nu_tt\":0.3,"
    "\"density_kg_m3\":1000}],\"polars\":[{\"name\":\"p\",\"provenance\":{\"a\":[1]},"
    "\"alpha_deg\":[-1,1],\"cl\":[[-1,1]],\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":-1,"
    "\"linear_to_deg\":1}],\"beam\":{\"length_m\":1,\"section\":{\"type\":\"strip\","
    "\"chord_m\":0.1,\"layup\":[{\"material\":\"m\",\"thickness_m\":0.01}]}},"
    "\"flow\":{\"speed_m_s\":1},\"aerodynamics\":{\"polar\":\"p\"},\"solver\":{\"duration_s\":1}}";

#define STATION(z_)                                                                                \
    "{\"z_m\":" #z_ ",\"section\":{\"type\":\"contour\",\"layups\":[{\"name\":\"a\",\"layup\":["   \
    "{\"material\":\"foam\",\"thickness_m\":0.01}]}],\"points\":[{\"x_m\":0,\"y_m\":0},{\"x_m\":"  \
    "1,"                                                                                           \
    "\"y_m\":0}],\"walls\":[{\"from\":0,\"to\":1,\"layup\":\"a\"}]}}"
static const char with_stations[] =
    "{\"schema_version\":1,\"kind\":\"static\",\"beam\":{\"length_m\":1,\"stations\":[" STATION(
        0) "," STATION(1) "]},\"loads\":{\"tip\":{\"force_y_n\":1}}}";

static const char study[] =
    "{\"schema_version\":1,\"kind\":\"study\",\"type\":\"grid\",\"case\":{\"schema_version\":1,"
    "\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["
    "{\"material\":\"foam\",\"thickness_m\":0.001}]}}},\"vary\":["
    "{\"pointer\":\"/beam/section/layup/0/material\",\"values\":[\"foam\",\"AS4/3501-6\"]},"
    "{\"pointer\":\"/beam/section/chord_m\",\"from\":1,\"to\":2,\"count\":2}]}";

#define ID "00000000-0000-7000-8000-000000000000"
#define STUDY_ID "00000000-0000-7000-8000-000000000001"
static const struct {
    const char *method, *target, *body;
    int status;
} requests[] = {
    {"POST", "/v1/jobs", own_definitions, 202},
    {"POST", "/v1/jobs", with_stations, 202},
    {"POST", "/v1/studies", study, 202},
    {"POST", "/v1/jobs", "{\"jobs\":[{},{}]}", 422},
    {"POST", "/v1/jobs", "{", 400},
    {"GET", "/v1/jobs?limit=1&name=a", NULL, 200},
    {"GET", "/v1/jobs?limit=x", NULL, 400},
    {"GET", "/v1/jobs/" ID, NULL, 200},
    {"DELETE", "/v1/jobs/" ID, NULL, 200},
    {"GET", "/v1/jobs/" ID "/summary", NULL, 200},
    {"GET", "/v1/jobs/" ID "/series?channels=tip_plunge_m", NULL, 200},
    {"GET", "/v1/jobs/" ID "/series?points=10", NULL, 200},
    {"GET", "/v1/jobs/" ID "/series?points=10&format=csv", NULL, 200},
    {"GET", "/v1/jobs/" ID "/series?channels=x", NULL, 400},
    {"GET", "/v1/materials/foam", NULL, 200},
    {"GET", "/v1/polars/plate-4pct-channel", NULL, 200},
    {"GET", "/v1/networks", NULL, 200},
    {"GET", "/v1/studies/" STUDY_ID, NULL, 200},
    {"GET", "/v1/studies/" STUDY_ID "/map?value=cl", NULL, 200},
    {"GET", "/v1/studies/" STUDY_ID "/cells", NULL, 200},
    {"GET", "/v1/studies/" STUDY_ID "/cells/0", NULL, 200},
    {"GET", "/nothing", NULL, 404},
    {"GET", "/openapi.json", NULL, 200},
    {"GET", "/healthz", NULL, 200},
};

static void test_requests(void **state)
{
    struct fake *f = fake_create();
    int failed = 0;
    (void)state;
    for (size_t i = 0; i < sizeof requests / sizeof requests[0]; i++) {
        bool reached = true;
        for (long n = 0; reached; n++) {
            fake_reset(f);
            (void)fake_add(f, CASE_SIMULATION, JOB_DONE, "a");
            if (strstr(requests[i].target, STUDY_ID) != NULL) {
                fake_add(f, JOB_STUDY, JOB_RUNNING, "b")->case_json = strdup(study);
            }
            const int stored = f->n_job;
            countdown = n;
            const int status = fake_request(f, requests[i].method, requests[i].target,
                                            "application/json", requests[i].body);
            reached = countdown < 0;
            countdown = -1;
            failed += status == 500;
            if (status != requests[i].status && (status != 500 || !reached)) {
                fail_msg("%s %s answers %d when allocation %ld fails", requests[i].method,
                         requests[i].target, status, n);
            }
            /* After the commit only the answer can be lost: the client asks again and is told. */
            const bool may_store = requests[i].status == 202 && status == 500;
            assert_true(f->n_job == (status == 202 ? 2 : stored) || (may_store && f->n_job == 2));
        }
    }
    assert_true(failed > 100); /* or the calls are not sent here */
    fake_destroy(f);
}

static void test_library(void **state)
{
    enum status st = ST_NO_MEMORY;
    long n = 0;
    (void)state;
    for (; st != ST_OK; n++) {
        struct library *lib = NULL;
        struct failure fail = {.detail = ""};
        countdown = n;
        st = library_create_builtin(&lib, &fail);
        countdown = -1;
        assert_int_equal(st == ST_OK, lib != NULL);
        assert_true(st == ST_OK || fail.detail[0] != '\0');
        library_destroy(lib);
    }
    assert_true(n > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_requests),
        cmocka_unit_test(test_library),
    };
    cJSON_InitHooks(&(cJSON_Hooks){__wrap_malloc, release});
    return cmocka_run_group_tests(tests, NULL, NULL);
}
