#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/clock.h"
#include "server/http_watch.h"

#include <sys/socket.h>
#include <unistd.h>

static bool is_shut(int fd)
{
    char c;
    return recv(fd, &c, 1, MSG_DONTWAIT) == 0;
}

static void test_each_phase_has_its_limit(void **state)
{
    (void)state;
    struct http_watch *w = http_watch_create();
    assert_non_null(w);
    int pair[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
    struct watched *c = http_watch_open(w, pair[0]);
    const int64_t now = clock_mono_us();
    const int64_t s = 1000000;
    assert_int_equal(http_watch_tick(w, now + (WATCH_FIRST_HEADER_S - 1) * s), 0);
    http_watch_body(w, c, 3 << 20);
    assert_int_equal(http_watch_tick(w, now + (WATCH_BODY_S + 2) * s), 0);
    http_watch_answer(w, c);
    assert_int_equal(http_watch_tick(w, now + 100000 * s), 0);
    http_watch_next(w, c);
    assert_int_equal(http_watch_tick(w, now + (WATCH_NEXT_HEADER_S - 1) * s), 0);
    assert_false(is_shut(pair[1]));
    assert_int_equal(http_watch_tick(w, now + (WATCH_NEXT_HEADER_S + 1) * s), 1);
    assert_true(is_shut(pair[1]));
    assert_int_equal(http_watch_tick(w, now + 100000 * s), 0); /* only once */
    http_watch_close(w, c);
    (void)close(pair[0]);
    (void)close(pair[1]);
    http_watch_destroy(w);
}

static void test_list_survives_closing_in_any_order(void **state)
{
    (void)state;
    struct http_watch *w = http_watch_create();
    assert_non_null(w);
    struct watched *c[5];
    int pair[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
    for (int i = 0; i < 5; i++) {
        c[i] = http_watch_open(w, pair[0]);
    }
    http_watch_close(w, c[2]);
    http_watch_close(w, c[4]);
    http_watch_close(w, c[0]);
    assert_int_equal(http_watch_tick(w, clock_mono_us() + INT64_C(3600000000)), 2);
    http_watch_close(w, c[1]);
    http_watch_close(w, c[3]);
    assert_int_equal(http_watch_tick(w, clock_mono_us() + INT64_C(3600000000)), 0);
    (void)close(pair[0]);
    (void)close(pair[1]);
    http_watch_destroy(w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_phase_has_its_limit),
        cmocka_unit_test(test_list_survives_closing_in_any_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
