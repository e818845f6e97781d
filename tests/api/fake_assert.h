/* tests/api/fake_assert.h
 * What tests say about the last answer of a fake service. Include after <cmocka.h>. */
#ifndef AEROM_TESTS_API_FAKE_ASSERT_H
#define AEROM_TESTS_API_FAKE_ASSERT_H

#include "api/json.h"
#include "tests/api/fake_service.h"

#include <cjson/cJSON.h>
#include <string.h>

/* The last answer is a problem document with this code; its status is that of the answer. */
static inline void assert_problem(const struct fake *f, int status, const char *code)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    assert_int_equal(f->answer.status, status);
    assert_string_equal(f->answer.content_type, "application/problem+json");
    assert_int_equal(json_parse(f->answer.body, f->answer.body_size, &tree, &fail), ST_OK);
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(tree, "code")->valuestring, code);
    assert_int_equal(cJSON_GetObjectItemCaseSensitive(tree, "status")->valueint, status);
    static const char *const members[] = {"type", "title", "detail"};
    for (int i = 0; i < 3; i++) {
        assert_true(cJSON_IsString(cJSON_GetObjectItemCaseSensitive(tree, members[i])));
    }
    json_free(tree);
}

/* The first of the errors of the last answer. */
static inline void assert_first_error(const struct fake *f, const char *pointer, const char *code)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    assert_int_equal(json_parse(f->answer.body, f->answer.body_size, &tree, &fail), ST_OK);
    const cJSON *e = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(tree, "errors"), 0);
    assert_non_null(e);
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(e, "pointer")->valuestring, pointer);
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(e, "code")->valuestring, code);
    json_free(tree);
}

#endif
