/* The test program of one group (VERIFY_GROUP): every check is a test of its own. */
#include "core/sim.h"
#include "tests/verify/check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static void run_check(void **state)
{
    const struct check *c = *state;
    print_message("%s: %.10g %s", c->what, c->value, c->unit);
    if (c->kind == CHECK_RELATIVE || c->kind == CHECK_ABSOLUTE) {
        print_message(", reference %.10g, error %.3g", c->reference, check_error(c));
    }
    print_message(", tolerance %.3g\n", c->tolerance);
    assert_true(check_passes(c));
}

int main(void)
{
    static struct check_list list;
    static struct CMUnitTest test[CHECK_MAX];
    sim_process_init();
    VERIFY_GROUP.fill(&list);
    for (int i = 0; i < list.n; i++) {
        test[i] = (struct CMUnitTest){
            .name = list.item[i].what, .test_func = run_check, .initial_state = &list.item[i]};
    }
    if (list.n == 0) {
        print_error("the group %s checks nothing\n", VERIFY_GROUP.name);
        return EXIT_FAILURE;
    }
    return _cmocka_run_group_tests(VERIFY_GROUP.name, test, (size_t)list.n, NULL, NULL);
}
