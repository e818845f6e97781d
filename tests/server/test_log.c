#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/log.h"

#include <string.h>
#include <unistd.h>

static void read_lines(int fd, char *out, size_t size)
{
    const ssize_t n = read(fd, out, size - 1);
    assert_true(n >= 0);
    out[n] = '\0';
}

static void test_line(void **state)
{
    (void)state;
    int fd[2];
    assert_int_equal(pipe(fd), 0);
    const struct log log = {.fd = fd[1], .level = LOG_LEVEL_INFO};
    LOG(&log, LOG_LEVEL_INFO, "job_done", log_s("id", "abc"), log_i("n", -3), log_f("t", 0.25));
    LOG(&log, LOG_LEVEL_DEBUG, "dropped", log_i("n", 1));
    LOG(&log, LOG_LEVEL_ERROR, "bad", log_s("why", "a \"b\"\nforged line"), log_s("empty", ""));
    char text[1024];
    read_lines(fd[0], text, sizeof text);
    /* 2026-01-31T12:00:00.123456Z */
    assert_int_equal(text[10], 'T');
    assert_int_equal(text[26], 'Z');
    assert_non_null(strstr(text, " info job_done id=abc n=-3 t=0.25\n"));
    assert_null(strstr(text, "dropped"));
    assert_non_null(strstr(text, " error bad why=\"a \\\"b\\\"\\x0aforged line\" empty=\"\"\n"));
    (void)close(fd[0]);
    (void)close(fd[1]);
}

static void test_long_value_is_cut_not_split(void **state)
{
    (void)state;
    int fd[2];
    assert_int_equal(pipe(fd), 0);
    const struct log log = {.fd = fd[1], .level = LOG_LEVEL_INFO};
    char big[5000];
    memset(big, 'x', sizeof big - 1);
    big[sizeof big - 1] = '\0';
    LOG(&log, LOG_LEVEL_INFO, "e", log_s("v", big), log_i("n", 1));
    char text[8192];
    read_lines(fd[0], text, sizeof text);
    const size_t n = strlen(text);
    assert_true(n <= 2048);
    assert_int_equal(text[n - 1], '\n');
    assert_ptr_equal(strchr(text, '\n'), text + n - 1);
    (void)close(fd[0]);
    (void)close(fd[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),
        cmocka_unit_test(test_long_value_is_cut_not_split),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
