#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/uri.h"

#include <stdio.h>
#include <string.h>

static enum uri_status split(const char *text, char *buffer, struct api_request *req)
{
    (void)strcpy(buffer, text);
    *req = (struct api_request){0};
    return uri_split(buffer, req);
}

static void test_path_stays_raw(void **state)
{
    (void)state;
    char buffer[256];
    struct api_request req;
    assert_int_equal(split("/v1/materials/AS4%2F3501-6", buffer, &req), URI_OK);
    assert_string_equal(req.path, "/v1/materials/AS4%2F3501-6");
    assert_int_equal(req.n_query, 0);
}

static void test_query_is_decoded(void **state)
{
    (void)state;
    char buffer[256];
    struct api_request req;
    assert_int_equal(split("/v1/jobs?name=a+b%26c&&limit=3&flag&x=%3D=", buffer, &req), URI_OK);
    assert_string_equal(req.path, "/v1/jobs");
    assert_int_equal(req.n_query, 4);
    assert_string_equal(api_query_get(&req, "name"), "a b&c");
    assert_string_equal(api_query_get(&req, "limit"), "3");
    assert_string_equal(api_query_get(&req, "flag"), "");
    assert_string_equal(api_query_get(&req, "x"), "==");
}

static void test_bad_targets(void **state)
{
    (void)state;
    static const char *const bad[] = {"",         "v1",      "http://x/",      "*",
                                      "/a?b=%",   "/a?b=%4", "/a?b=%zz",       "/a?b=%00c",
                                      "/a?%0a=1", "/a\tb",   "/a?b=%0d%0aX: y"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char buffer[256];
        struct api_request req;
        assert_int_equal(split(bad[i], buffer, &req), URI_BAD);
    }
}

static void test_too_many(void **state)
{
    (void)state;
    char text[512] = "/a?", buffer[512];
    struct api_request req;
    for (int i = 0; i < API_QUERY_MAX; i++) {
        (void)strcat(text, "k=v&");
    }
    assert_int_equal(split(text, buffer, &req), URI_OK);
    assert_int_equal(req.n_query, API_QUERY_MAX);
    (void)strcat(text, "k=v");
    assert_int_equal(split(text, buffer, &req), URI_TOO_MANY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_path_stays_raw),
        cmocka_unit_test(test_query_is_decoded),
        cmocka_unit_test(test_bad_targets),
        cmocka_unit_test(test_too_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
