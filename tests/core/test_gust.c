/* Gusts: their velocity in time, Kuessner's lag, the verdict after one, and the load in the clamp.
 */
#include "core/la.h"
#include "core/num.h"
#include "core/sim.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"
#include "tests/support/wake_functions.h"

#include <stdlib.h>
#include <string.h>

static struct case_def def;

static void velocity_in_time(void **state)
{
    (void)state;
    struct gust_def g = {.given = true, .amplitude = 3.0, .start = 1.0, .length = 10.0};
    assert_near_abs(gust_at(&g, 20.0, 0.9), 0.0, 0.0);
    assert_near_rel(gust_at(&g, 20.0, 1.25), 3.0, 1e-14); /* half of 10 m at 20 m/s */
    assert_near_rel(gust_at(&g, 20.0, 1.125), 1.5, 1e-14);
    assert_near_abs(gust_at(&g, 20.0, 1.6), 0.0, 0.0);
    assert_near_abs(gust_end(&g, 20.0), 1.5, 1e-15);
    g.type = GUST_STEP;
    assert_near_abs(gust_at(&g, 20.0, 1.0), 0.0, 0.0);
    assert_near_abs(gust_at(&g, 20.0, 1.01), 3.0, 0.0);
    assert_near_abs(gust_end(&g, 20.0), 1.0, 0.0);
    g = (struct gust_def){.given = true, .type = GUST_TABLE, .n = 3};
    memcpy(g.time, (double[]){0.5, 1.0, 2.0}, 3 * sizeof(double));
    memcpy(g.velocity, (double[]){1.0, 2.0, -2.0}, 3 * sizeof(double));
    assert_near_abs(gust_at(&g, 20.0, 0.0), 1.0, 0.0);
    assert_near_rel(gust_at(&g, 20.0, 0.75), 1.5, 1e-14);
    assert_near_rel(gust_at(&g, 20.0, 1.25), 1.0, 1e-14);
    assert_near_abs(gust_at(&g, 20.0, 9.0), -2.0, 0.0);
    assert_near_abs(gust_at(&(struct gust_def){.given = false}, 20.0, 1.0), 0.0, 0.0);
}

/* The lags against Kuessner's function at all travels. */
static void lags_follow_kuessner(void **state)
{
    (void)state;
    const double chord = 2.0, speed = 1.0, step = 1e-3; /* semichords of travel a step */
    struct kuessner k;
    double x[KUESSNER_LAGS] = {0};
    assert_ok(kuessner_init(1, &chord, speed, step, &k));
    kuessner_step(&k, 0.0, 1.0, x);
    for (int i = 1; i <= 30000; i++) {
        kuessner_step(&k, 1.0, 1.0, x);
        if (i == 10 || i == 100 || i == 300 || i == 1500 || i == 4000 || i == 30000) {
            double angle = 0.0;
            kuessner_add(&k, x, &angle);
            assert_near_abs(angle, wake_kuessner((i + 0.5) * step), 0.0021);
        }
    }
    double angle = 0.0;
    kuessner_steady(&k, 0.3, x);
    kuessner_add(&k, x, &angle);
    assert_near_rel(angle, 0.3, 1e-14);
    kuessner_done(&k);
    kuessner_done(&k); /* twice is once */
}

/* A soft wing in a gust of 1 - cosine. */
static const struct sim_result *run(const struct polar_def *polar, double speed, struct sim **sim)
{
    struct failure fail;
    case_def_defaults(&def);
    def.beam.length = 4.0;
    section_def_defaults(SECTION_PROPERTIES, &def.beam.section);
    struct properties *p = &def.beam.section.properties;
    p->chord = 0.5;
    p->ei_flap = 2e3;
    p->gj = 1e3;
    p->mass = 0.75;
    p->torsion_inertia = 0.03;
    properties_complete(p);
    def.flow.speed = speed;
    def.flow.gust =
        (struct gust_def){.given = true, .amplitude = 1.0, .start = 0.1, .duration = 0.2};
    def.aero.polar = polar;
    def.aero.lifting_line = false;
    def.aero.dynamic = DYNAMIC_ATTACHED;
    def.solver.duration = 4.0;
    assert_ok(sim_create(&def, sim, &fail));
    assert_ok(sim_run(*sim, NULL, &fail));
    return sim_result(*sim);
}

static void a_gust_that_has_passed_leaves_a_stable_beam(void **state)
{
    (void)state;
    struct sim *sim = NULL;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    const struct sim_result *r = run(&polar, 15.0, &sim);
    assert_int_equal(r->verdict, VERDICT_STABLE);
    assert_true(r->peak_plunge.max > 0.0);
    assert_true(r->peak_plunge.max_time > 0.1);
    assert_true(r->peak_plunge.max_time < 0.6);
    assert_true(r->peak_bending.max > 0.0);
    assert_near_abs(r->means.tip_plunge, 0.0, 1e-2 * r->peak_plunge.max);
    sim_destroy(sim);
    polar_def_done(&polar);
}

/* Long after a step has come the clamp carries the moment of the steady lift. */
static void bending_of_a_lasting_gust(void **state)
{
    (void)state;
    struct sim *sim = NULL;
    struct failure fail;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    (void)run(&polar, 15.0, &sim);
    sim_destroy(sim);
    def.flow.gust = (struct gust_def){.given = true, .type = GUST_STEP, .amplitude = 0.5};
    def.solver.duration = 20.0;
    def.solver.time_step = 1e-3;
    def.output.n_channel = 2;
    def.output.channel[0] = CHANNEL_ROOT_BENDING;
    def.output.channel[1] = CHANNEL_GUST;
    assert_ok(sim_create(&def, &sim, &fail));
    assert_ok(sim_run(sim, NULL, &fail));
    const int last = sim_result(sim)->n_sample - 1;
    const double bending = sim_column(sim, 0)[last];
    assert_near_abs(sim_column(sim, 1)[last], 0.5, 0.0);
    sim_destroy(sim);
    def.flow.gust.given = false; /* the same angle by incidence */
    def.flow.incidence = 0.5 / 15.0;
    assert_ok(sim_create(&def, &sim, &fail));
    assert_ok(sim_run(sim, NULL, &fail));
    assert_near_rel(bending, sim_column(sim, 0)[last], 2e-3);
    sim_destroy(sim);
    polar_def_done(&polar);
}

/* A clamp that swings: bounded below flutter, growing beyond. */
static void verdict_of_a_forced_motion(void **state)
{
    (void)state;
    struct sim *sim = NULL;
    struct failure fail;
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    (void)run(&polar, 15.0, &sim);
    sim_destroy(sim);
    def.flow.gust.given = false;
    drive_defaults(DRIVE_SINE, &def.beam.root_pitch);
    def.beam.root_pitch.amplitude = 0.01;
    def.beam.root_pitch.frequency = 2.0;
    drive_complete(&def.beam.root_pitch);
    def.solver.duration = 8.0;
    assert_ok(sim_create(&def, &sim, &fail));
    assert_ok(sim_run(sim, NULL, &fail));
    assert_int_equal(sim_result(sim)->verdict, VERDICT_FORCED);
    assert_near_rel(sim_result(sim)->peak_twist.max, 0.01, 0.2); /* the wing is stiff in torsion */
    sim_destroy(sim);
    def.solver.duration = 1.5; /* too short to tell */
    assert_ok(sim_create(&def, &sim, &fail));
    assert_ok(sim_run(sim, NULL, &fail));
    assert_int_equal(sim_result(sim)->verdict, VERDICT_INDETERMINATE);
    sim_destroy(sim);
    polar_def_done(&polar);
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(velocity_in_time),
        cmocka_unit_test(lags_follow_kuessner),
        cmocka_unit_test(a_gust_that_has_passed_leaves_a_stable_beam),
        cmocka_unit_test(bending_of_a_lasting_gust),
        cmocka_unit_test(verdict_of_a_forced_motion),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
