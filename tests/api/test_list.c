/* GET /v1/jobs: filters, pages, cursors. */
#include "api/json.h"
#include "tests/api/fake_service.h"

#include <cjson/cJSON.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/api/fake_assert.h"

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

/* Follows the cursor to the end. Returns the number of jobs and of pages. */
static int walk(struct fake *f, const char *query, int *pages)
{
    char target[512];
    int jobs = 0;
    *pages = 0;
    (void)snprintf(target, sizeof target, "/v1/jobs?%s", query);
    while (target[0] != '\0') {
        struct cJSON *tree = NULL;
        struct failure fail;
        assert_int_equal(fake_get(f, target), 200);
        assert_int_equal(json_parse(f->answer.body, f->answer.body_size, &tree, &fail), ST_OK);
        jobs += cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(tree, "jobs"));
        (*pages)++;
        const cJSON *next = cJSON_GetObjectItemCaseSensitive(tree, "next");
        const char *link = fake_header(f, "Link");
        assert_int_equal(cJSON_IsString(next), link != NULL);
        target[0] = '\0';
        if (link != NULL) { /* <url>; rel="next" */
            (void)snprintf(target, sizeof target, "%.*s", (int)strcspn(link + 1, ">"), link + 1);
            assert_non_null(strstr(target, next->valuestring));
            assert_non_null(strstr(link, "; rel=\"next\""));
        }
        json_free(tree);
    }
    return jobs;
}

static void test_list(void **state)
{
    struct fake *f = *state;
    int pages = 0;
    for (int i = 0; i < 120; i++) {
        (void)fake_add(f, i % 3 == 0 ? CASE_MODES : CASE_SIMULATION,
                       i % 2 == 0 ? JOB_DONE : JOB_QUEUED, i < 10 ? "a b&c/\xc3\xa9" : "other");
    }
    assert_int_equal(walk(f, "", &pages), 120);
    assert_int_equal(pages, 3); /* 50 by default */
    assert_int_equal(walk(f, "limit=1000", &pages), 120);
    assert_int_equal(pages, 1);
    assert_int_equal(walk(f, "limit=7&kind=modes&state=done", &pages), 20);
    assert_int_equal(pages, 3);
    assert_int_equal(walk(f, "name=a%20b%26c%2F%C3%A9&limit=4", &pages), 10);
    assert_int_equal(pages, 3);
    assert_int_equal(walk(f, "name=none", &pages), 0);
}

static void test_bad_list_queries(void **state)
{
    static const char *const bad[] = {
        "limit=0",    "limit=1001", "limit=x", "limit=",       "limit=1.5",
        "limit=0x10", "limit=1e9",  "kind=x",  "state=Queued", "cursor=abcd",
        "cursor=",    "cursor=%21", "kind="};
    struct fake *f = *state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char target[64], pointer[32];
        (void)snprintf(target, sizeof target, "/v1/jobs?%s", bad[i]);
        (void)snprintf(pointer, sizeof pointer, "?%.*s", (int)strcspn(bad[i], "="), bad[i]);
        (void)fake_get(f, target);
        assert_problem(f, 400, "bad_query");
        assert_first_error(f, pointer, "out_of_range");
    }
    (void)fake_get(f, "/v1/jobs?limit=0&kind=x&state=y&cursor=z");
    assert_true(fake_says(f, "\"errors_total\":4"));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_list),
        TEST(test_bad_list_queries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
