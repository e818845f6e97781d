#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/id.h"

#include <stdio.h>
#include <string.h>

static void test_form_and_time(void **state)
{
    (void)state;
    struct id_generator g = {0};
    char id[JOB_ID_SIZE];
    /* RFC 9562, appendix A.6: 0x017F22E279B0 milliseconds */
    id_next(&g, 0x017F22E279B0 * INT64_C(1000), id);
    assert_int_equal(strlen(id), 36);
    assert_memory_equal(id, "017f22e2-79b0-7", 15);
    assert_non_null(strchr("89ab", id[19])); /* variant */
    assert_int_equal(id[8], '-');
    assert_int_equal(id[23], '-');
}

/* More identifiers in one instant than the counter holds, then the clock runs back. */
static void test_monotonic(void **state)
{
    (void)state;
    struct id_generator g = {0};
    char last[JOB_ID_SIZE] = "", id[JOB_ID_SIZE];
    for (int i = 0; i < 10000; i++) {
        id_next(&g, i < 5000 ? 1700000000000000 : 1600000000000000, id);
        assert_true(strcmp(id, last) > 0);
        (void)strcpy(last, id);
    }
    struct id_generator next = {0};
    assert_true(id_continue(&next, last));
    id_next(&next, 1600000000000000, id);
    assert_true(strcmp(id, last) > 0);
}

static void test_continue_refuses(void **state)
{
    (void)state;
    struct id_generator g = {0};
    assert_false(id_continue(&g, ""));
    assert_false(id_continue(&g, "017f22e2-79b0-4cc3-98c4-dc0c0c07398f")); /* version 4 */
    assert_false(id_continue(&g, "017f22e2-79x0-7cc3-98c4-dc0c0c07398f"));
    assert_int_equal(g.last, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_form_and_time),
        cmocka_unit_test(test_monotonic),
        cmocka_unit_test(test_continue_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
