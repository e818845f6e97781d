/* Prescribed motion: the faded-in sine, the curve through a table, and what is refused. */
#include "core/drive.h"
#include "core/num.h"
#include "tests/support/unit.h"

#include <string.h>

/* Rate and acceleration are those of the value. */
static void expect_consistent(const struct drive *d, double t)
{
    const double h = 1e-5;
    const struct drive_state at = drive_at(d, t), up = drive_at(d, t + h),
                             down = drive_at(d, t - h);
    assert_near_abs(at.rate, (up.value - down.value) / (2.0 * h), 1e-6);
    assert_near_abs(at.acceleration, (up.rate - down.rate) / (2.0 * h), 1e-5);
}

static void sine_fades_in(void **state)
{
    (void)state;
    struct drive_def def;
    struct drive d;
    drive_defaults(DRIVE_SINE, &def);
    def.amplitude = 0.2;
    def.frequency = 1.5;
    def.phase = 0.4;
    def.start = 0.5;
    drive_complete(&def);
    assert_near_rel(def.ramp, 1.0 / 1.5, 1e-15);
    drive_init(&def, &d);
    assert_near_abs(drive_at(&d, 0.4).value, 0.0, 0.0);
    assert_near_abs(drive_at(&d, 0.5 + 1e-9).acceleration, 0.0, 1e-6);
    for (int i = 1; i < 40; i++) {
        expect_consistent(&d, 0.5 + 0.05 * i);
    }
    assert_near_rel(drive_at(&d, 3.0).value, 0.2 * sin(2.0 * NUM_PI * 1.5 * 2.5 + 0.4), 1e-13);
    assert_true(isinf(drive_end(&def)));
}

/* 3 x^2 - 2 x^3 is a cubic at rest at both ends: the spline is it, wherever its rows are. */
static void table_is_a_spline_at_rest_at_its_ends(void **state)
{
    (void)state;
    static const double x[6] = {0.0, 0.13, 0.2, 0.55, 0.9, 1.0};
    struct drive_def def;
    struct drive d;
    drive_defaults(DRIVE_TABLE, &def);
    def.n = 6;
    for (int i = 0; i < 6; i++) {
        def.time[i] = 2.0 + x[i];
        def.value[i] = x[i] * x[i] * (3.0 - 2.0 * x[i]);
    }
    drive_init(&def, &d);
    for (int i = 1; i < 20; i++) {
        const double u = 0.05 * i;
        const struct drive_state at = drive_at(&d, 2.0 + u);
        assert_near_abs(at.value, u * u * (3.0 - 2.0 * u), 1e-13);
        assert_near_abs(at.rate, 6.0 * u * (1.0 - u), 1e-12);
        assert_near_abs(at.acceleration, 6.0 - 12.0 * u, 1e-11);
    }
    assert_near_abs(drive_at(&d, 1.0).value, 0.0, 0.0);
    assert_near_abs(drive_at(&d, 4.0).value, 1.0, 0.0);
    assert_near_abs(drive_at(&d, 4.0).rate, 0.0, 0.0);
    assert_near_abs(drive_end(&def), 3.0, 0.0);
}

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    static struct failure_list found;
    struct drive_def def;
    drive_defaults(DRIVE_TABLE, &def);
    def.n = 3;
    memcpy(def.time, (double[]){0.0, 1.0, 1.0}, 3 * sizeof(double));
    memset(&found, 0, sizeof found);
    drive_check(&def, "/p", "angle_deg", &found);
    assert_int_equal(found.total, 1);
    assert_string_equal(found.item[0].pointer, "/p/time_s/2");
    drive_defaults(DRIVE_SINE, &def);
    memset(&found, 0, sizeof found);
    drive_check(&def, "/p", "angle_deg", &found);
    assert_int_equal(found.total, 1);
    assert_string_equal(found.item[0].pointer, "/p/frequency_hz");
    def.given = false;
    drive_check(&def, "/p", "angle_deg", &found);
    assert_int_equal(found.total, 1);
    struct drive d;
    drive_init(&def, &d);
    assert_near_abs(drive_at(&d, 1.0).value, 0.0, 0.0);
    assert_near_abs(drive_end(&def), 0.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sine_fades_in),
        cmocka_unit_test(table_is_a_spline_at_rest_at_its_ends),
        cmocka_unit_test(what_is_wrong_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
