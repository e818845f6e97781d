#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/http_listen.h"

static void test_good(void **state)
{
    (void)state;
    static const struct {
        const char *text, *url;
        bool loopback;
    } good[] = {
        {"127.0.0.1:8080", "http://127.0.0.1:99", true},
        {"localhost:0", "http://127.0.0.1:99", true},
        {"0.0.0.0:80", "http://0.0.0.0:99", false},
        {"[::1]:80", "http://[::1]:99", true},
        {"[::]:80", "http://[::]:99", false},
        {"127.1.2.3:1", "http://127.1.2.3:99", true},
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct sockaddr_storage address;
        socklen_t size = 0;
        char url[128];
        assert_true(listen_parse(good[i].text, &address, &size));
        listen_url(&address, 99, url, sizeof url);
        assert_string_equal(url, good[i].url);
        assert_int_equal(listen_is_loopback(&address), good[i].loopback);
    }
}

static void test_bad(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "",     "8080",        ":8080",          "127.0.0.1:", "::1:80",
        "[]:1", "127.0.0.1:x", "example.com:80", "127.0.0.1"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct sockaddr_storage address;
        socklen_t size = 0;
        assert_false(listen_parse(bad[i], &address, &size));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_good), cmocka_unit_test(test_bad)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
