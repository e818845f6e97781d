#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/config.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ARGS_MAX = 8 };

struct sources {
    const char *file; /* contents, NULL = no file */
    const char *environment[ARGS_MAX];
    const char *flags[ARGS_MAX];
};

static char path[] = "/tmp/aerom-config-XXXXXX";

/* Loads from the sources; the strings are copied because argv and environ are writable. */
static bool load(const struct sources *s, struct config *c, enum config_action *action, char *why)
{
    char *argv[ARGS_MAX + 3] = {0}, *environment[ARGS_MAX + 1] = {0};
    int argc = 0, n = 0;
    argv[argc++] = strdup("aeromd");
    if (s->file != NULL) {
        FILE *f = fopen(path, "w");
        assert_non_null(f);
        (void)fputs(s->file, f);
        (void)fclose(f);
        argv[argc++] = strdup("--config");
        argv[argc++] = strdup(path);
    }
    for (int i = 0; i < ARGS_MAX && s->flags[i] != NULL; i++) {
        argv[argc++] = strdup(s->flags[i]);
    }
    for (int i = 0; i < ARGS_MAX && s->environment[i] != NULL; i++) {
        environment[n++] = strdup(s->environment[i]);
    }
    why[0] = '\0';
    const bool ok = config_load(argc, argv, environment, c, action, why);
    for (int i = 0; i < argc; i++) {
        free(argv[i]);
    }
    for (int i = 0; i < n; i++) {
        free(environment[i]);
    }
    return ok;
}

static void test_defaults(void **state)
{
    (void)state;
    struct config c;
    enum config_action action;
    char why[CONFIG_MESSAGE];
    const struct sources home = {.environment = {"HOME=/home/a"}};
    assert_true(load(&home, &c, &action, why));
    assert_int_equal(action, CONFIG_RUN);
    assert_string_equal(c.listen, "127.0.0.1:8080");
    assert_string_equal(c.store, "sqlite:/home/a/.local/state/aeromd/aeromd.db");
    assert_int_equal(c.workers, sysconf(_SC_NPROCESSORS_ONLN));
    assert_int_equal(c.queue_limit, 1000000);
    const struct sources xdg = {.environment = {"HOME=/home/a", "XDG_STATE_HOME=/var/s"}};
    assert_true(load(&xdg, &c, &action, why));
    assert_string_equal(c.store, "sqlite:/var/s/aeromd/aeromd.db");
}

static void test_precedence(void **state)
{
    (void)state;
    struct config c;
    enum config_action action;
    char why[CONFIG_MESSAGE];
    const struct sources all = {
        .file = "# comment\nworkers = 3\nqueue_limit = 30\nattempts = 7\nlisten = [::1]:1\n",
        .environment = {"AEROMD_WORKERS=4", "AEROMD_QUEUE_LIMIT=40"},
        .flags = {"--workers", "5", "--log-level=debug"}};
    assert_true(load(&all, &c, &action, why));
    assert_int_equal(c.workers, 5);
    assert_int_equal(c.queue_limit, 40);
    assert_int_equal(c.attempts, 7);
    assert_string_equal(c.listen, "[::1]:1");
    assert_string_equal(c.log_level, "debug");
}

static void test_refusals_name_the_place(void **state)
{
    (void)state;
    static const struct {
        struct sources sources;
        const char *part; /* of the message */
    } bad[] = {
        {{.file = "workers = 2\n\nworker = 2\n"}, ":3: unknown key 'worker'"},
        {{.file = "[server]\nworkers = 2\n"}, ":2: unknown key 'server.workers'"},
        {{.file = "workers = 2\nworkers = 2\n"}, ":2: workers is given twice"},
        {{.file = "workers = -1\n"}, ":1: workers must be a whole number from 0 to 1024"},
        {{.file = "workers = 2x\n"}, ":1: workers must be"},
        {{.file = "\nnonsense\n"}, ":2: not of the form"},
        {{.environment = {"AEROMD_WORKER=1"}}, "environment: unknown key 'AEROMD_worker'"},
        {{.environment = {"AEROMD_ATTEMPTS=0"}}, "environment: attempts must be"},
        {{.environment = {"AEROMD_CONFIG=/nonexistent/a.ini"}}, "/nonexistent/a.ini: "},
        {{.flags = {"--workers"}}, "'--workers'"},
        {{.flags = {"--wrokers", "2"}}, "'--wrokers'"},
        {{.flags = {"8080"}}, "'8080'"},
        {{.flags = {"--workers", "99999999999999999999"}}, "command line: workers must be"},
        {{.flags = {"--store", ""}}, "command line: store must have"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct config c;
        enum config_action action;
        char why[CONFIG_MESSAGE];
        assert_false(load(&bad[i].sources, &c, &action, why));
        if (strstr(why, bad[i].part) == NULL) {
            print_error("'%s' does not say '%s'\n", why, bad[i].part);
            fail();
        }
    }
}

static void test_actions(void **state)
{
    (void)state;
    struct config c;
    enum config_action action;
    char why[CONFIG_MESSAGE];
    const struct sources version = {.flags = {"--version"}};
    assert_true(load(&version, &c, &action, why));
    assert_int_equal(action, CONFIG_VERSION);
    const struct sources print = {.flags = {"--workers", "9", "--print-config"}};
    assert_true(load(&print, &c, &action, why));
    assert_int_equal(action, CONFIG_PRINT);
    assert_int_equal(c.workers, 9);
}

/* What --print-config prints is a file that gives the same settings. */
static void test_print_round_trip(void **state)
{
    (void)state;
    struct config c, back;
    enum config_action action;
    char why[CONFIG_MESSAGE];
    const struct sources all = {
        .flags = {"--workers", "7", "--listen", "[::1]:0", "--store", "sqlite:/tmp/x y.db"}};
    assert_true(load(&all, &c, &action, why));
    char text[4096] = "";
    FILE *f = fmemopen(text, sizeof text, "w");
    assert_non_null(f);
    config_print(&c, f);
    (void)fclose(f);
    const struct sources file = {.file = text};
    assert_true(load(&file, &back, &action, why));
    assert_string_equal(c.listen, back.listen);
    assert_string_equal(c.store, back.store);
    assert_string_equal(c.log_level, back.log_level);
    assert_int_equal(c.workers, back.workers);
    assert_int_equal(c.http_threads, back.http_threads);
    assert_int_equal(c.disk_reserve_mb, back.disk_reserve_mb);
}

static int setup(void **state)
{
    (void)state;
    const int fd = mkstemp(path);
    return fd < 0 ? -1 : close(fd);
}

static int teardown(void **state)
{
    (void)state;
    return unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_precedence),
        cmocka_unit_test(test_refusals_name_the_place),
        cmocka_unit_test(test_actions),
        cmocka_unit_test(test_print_round_trip),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
