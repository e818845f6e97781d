#include "core/structure/material.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>

static int problems(const struct material *m, struct failure_list *list)
{
    *list = (struct failure_list){0};
    material_check(m, "/materials/2", list);
    return list->count;
}

static void table_1_is_admissible(void **state)
{
    struct failure_list *list = *state;
    const struct material skin = fixture_skin(), foam = fixture_foam();
    assert_int_equal(problems(&skin, list), 0);
    assert_int_equal(problems(&foam, list), 0);
}

static void each_modulus_must_be_positive(void **state)
{
    struct failure_list *list = *state;
    static const char *const pointer[] = {"/materials/2/e_l_pa", "/materials/2/e_t_pa",
                                          "/materials/2/g_lt_pa", "/materials/2/g_tt_pa",
                                          "/materials/2/density_kg_m3"};
    static const double wrong[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
    for (size_t field = 0; field < sizeof pointer / sizeof pointer[0]; field++) {
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
            struct material m = fixture_skin();
            m.nu_lt = 0.0; /* its own rule compares the moduli */
            double *const value[] = {&m.e_l, &m.e_t, &m.g_lt, &m.g_tt, &m.density};
            *value[field] = wrong[k];
            assert_true(problems(&m, list) >= 1);
            assert_string_equal(list->item[0].pointer, pointer[field]);
        }
    }
}

static void poisson_ratios_keep_the_energy_positive(void **state)
{
    struct failure_list *list = *state;
    struct material m = fixture_skin();
    const double limit = sqrt(m.e_l / m.e_t);
    m.nu_lt = 0.999 * limit;
    assert_int_equal(problems(&m, list), 0);
    m.nu_lt = -0.999 * limit;
    assert_int_equal(problems(&m, list), 0);
    m.nu_lt = 1.001 * limit;
    assert_int_equal(problems(&m, list), 1);
    assert_string_equal(list->item[0].pointer, "/materials/2/nu_lt");
    m = fixture_skin();
    m.nu_tt = 1.0;
    assert_int_equal(problems(&m, list), 1);
    assert_string_equal(list->item[0].pointer, "/materials/2/nu_tt");
    m.nu_tt = (double)NAN;
    assert_int_equal(problems(&m, list), 1);
}

static int setup(void **state)
{
    *state = calloc(1, sizeof(struct failure_list));
    return *state == NULL;
}

static int teardown(void **state)
{
    free(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_1_is_admissible),
        cmocka_unit_test(each_modulus_must_be_positive),
        cmocka_unit_test(poisson_ratios_keep_the_energy_positive),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
