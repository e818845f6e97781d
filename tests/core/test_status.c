#include "core/status.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static void names_are_distinct(void **state)
{
    (void)state;
    for (int a = 0; a < STATUS_COUNT; a++) {
        assert_true(strlen(status_name((enum status)a)) > 0);
        assert_true(strlen(status_text((enum status)a)) > 0);
        for (int b = 0; b < a; b++) {
            assert_string_not_equal(status_name((enum status)a), status_name((enum status)b));
        }
    }
}

static void a_failure_takes_what_it_is_given(void **state)
{
    (void)state;
    struct failure f;
    failure_set(&f, ST_INVALID, "/a/b", "bad", "a number", "x", "value %d of %s", 3, "list");
    assert_int_equal(f.status, ST_INVALID);
    assert_string_equal(f.pointer, "/a/b");
    assert_string_equal(f.code, "bad");
    assert_string_equal(f.expected, "a number");
    assert_string_equal(f.got, "x");
    assert_string_equal(f.detail, "value 3 of list");
    failure_set(&f, ST_LIMIT, "", "c", NULL, NULL, "d");
    assert_string_equal(f.expected, "");
    assert_string_equal(f.got, "");
}

static void long_texts_are_cut(void **state)
{
    (void)state;
    char text[1000];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    struct failure f;
    failure_set(&f, ST_INVALID, text, text, text, text, "%s", text);
    assert_int_equal(strlen(f.pointer), sizeof f.pointer - 1);
    assert_int_equal(strlen(f.detail), sizeof f.detail - 1);
    assert_int_equal(strlen(f.got), sizeof f.got - 1);
}

static void a_full_list_still_counts(void **state)
{
    (void)state;
    struct failure_list *list = calloc(1, sizeof *list);
    for (int i = 0; i < FAILURE_LIST_MAX + 7; i++) {
        failure_set(failure_add(list), ST_INVALID, "", "c", NULL, NULL, "%d", i);
    }
    assert_int_equal(list->count, FAILURE_LIST_MAX);
    assert_int_equal(list->total, FAILURE_LIST_MAX + 7);
    assert_string_equal(list->item[0].detail, "0");
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_distinct),
        cmocka_unit_test(a_failure_takes_what_it_is_given),
        cmocka_unit_test(long_texts_are_cut),
        cmocka_unit_test(a_full_list_still_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
