/* The facade: reports, starts, and cases that blow up. */
#include "core/num.h"
#include "core/sim.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static struct polar_def polar;

static struct sim *run(const struct case_def *def)
{
    struct sim *sim = NULL;
    struct failure fail = {0};
    assert_ok(sim_create(def, &sim, &fail));
    const enum status st = sim_run(sim, NULL, &fail);
    if (st != ST_OK) {
        print_error("%s: %s\n", status_name(st), fail.detail);
    }
    assert_ok(st);
    return sim;
}

/* A wing in stall, with a lift that falls: the counters say that the lifting line was smoothed, and
 * it converges at every step; attached it is not smoothed. */
static void stall_is_counted(void **state)
{
    (void)state;
    enum { ANGLES = 7 };
    double alpha[ANGLES], plunge[1] = {0.0}, cm[ANGLES] = {0};
    double cl[ANGLES] = {-0.5, -0.45, -0.9, 0.0, 0.9, 0.45, 0.5};
    double cd[ANGLES] = {0.6, 0.3, 0.05, 0.02, 0.05, 0.3, 0.6};
    for (int i = 0; i < ANGLES; i++) {
        alpha[i] = num_rad(10.0 * (i - ANGLES / 2));
    }
    const struct polar_def stalling = {.name = "stalling",
                                       .n_alpha = ANGLES,
                                       .n_plunge = 1,
                                       .alpha = alpha,
                                       .plunge = plunge,
                                       .cl = cl,
                                       .cd = cd,
                                       .cm = cm,
                                       .linear_from = alpha[2],
                                       .linear_to = alpha[4]};
    for (int k = 0; k < 2; k++) {
        struct case_def def;
        fixture_paper_beam(-45.0, &stalling, &def);
        def.flow.speed = 4.0;
        def.flow.incidence = num_rad(k == 0 ? 3.0 : 16.0);
        def.solver.duration = 0.3;
        struct sim *sim = run(&def);
        const struct sim_result *r = sim_result(sim);
        assert_int_equal(r->counters.not_converged, 0);
        assert_true(r->counters.lifting_line_residual <= 1e-9);
        assert_int_equal(r->counters.lifting_line_regularised > 1000, k == 1);
        assert_int_equal(r->counters.lifting_line_smoothing > 0.0, k == 1);
        sim_destroy(sim);
    }
}

/* A run on the structure of another one is the same run, whatever else differs, and needs nothing
 * of the other's case. */
static void a_structure_serves_many_runs(void **state)
{
    (void)state;
    static const enum dynamic_type dynamic[] = {DYNAMIC_NONE, DYNAMIC_ATTACHED};
    for (int k = 0; k < 2; k++) {
        struct case_def *def = malloc(sizeof *def), *first = malloc(sizeof *first);
        assert_non_null(def);
        assert_non_null(first);
        fixture_paper_beam(-45.0, &polar, def);
        def->aero.dynamic = dynamic[k];
        def->solver.duration = 0.2;
        *first = *def;
        struct sim *like = run(first);
        memset(first, 0xff, sizeof *first);
        free(first);
        def->flow.speed = 4.5;
        def->flow.incidence = num_rad(2.0);
        def->solver.modal_damping = 0.01;
        struct sim *alone = run(def), *shared = NULL;
        struct failure fail = {0};
        assert_ok(sim_create_like(def, like, &shared, &fail));
        assert_ok(sim_run(shared, NULL, &fail));
        const struct sim_result *a = sim_result(alone), *b = sim_result(shared);
        assert_memory_equal(&a->means, &b->means, sizeof a->means);
        assert_memory_equal(&a->tip_twist, &b->tip_twist, sizeof a->tip_twist);
        assert_memory_equal(&a->section, &b->section, sizeof a->section);
        assert_memory_equal(a->mode, b->mode, sizeof a->mode);
        assert_true(a->means.tip_plunge > sim_result(like)->means.tip_plunge * 0.1);
        assert_true(a->means.tip_plunge < sim_result(like)->means.tip_plunge * 0.9);
        sim_destroy(shared);
        sim_destroy(alone);
        sim_destroy(like);
        free(def);
    }
}

static void the_report_hangs_together(void **state)
{
    (void)state;
    struct case_def def;
    fixture_paper_beam(-45.0, &polar, &def);
    def.flow.speed = 3.0;
    def.solver.duration = 3.0;
    struct sim *sim = run(&def);
    const struct sim_result *r = sim_result(sim);
    assert_int_equal(r->n_mode, 4);
    assert_int_equal(r->steps, 15000);
    assert_near_rel(r->stop_time, 3.0, 1e-12);
    assert_int_equal(r->n_sample, 15001);
    assert_int_equal(r->n_column, 5);
    assert_near_rel(r->e_star, 141.96e9 * 0.04 * 0.04 * 0.04 / (0.5 * 1.225 * 9.0), 1e-12);
    assert_near_rel(r->reynolds, 3.0 * 0.1 / 1.5e-5, 1e-12);
    assert_int_equal(r->section.wash, WASH_OUT);
    assert_near_rel(r->section.thickness, 0.004, 1e-12);
    /* Means over the last second, from the record. */
    double cl = 0.0;
    for (int i = 10000; i <= 15000; i++) {
        cl += sim_column(sim, 2)[i] / 5001.0;
    }
    assert_near_rel(r->means.cl, cl, 1e-10);
    for (int k = 0; k < 2; k++) { /* and what the tip swings about them */
        const double *y = sim_column(sim, k);
        const double mean = k == 0 ? r->means.tip_plunge : r->means.tip_twist;
        double square = 0.0;
        for (int i = 10000; i <= 15000; i++) {
            square += num_sq(y[i] - mean) / 5001.0;
        }
        assert_near_rel(k == 0 ? r->means.plunge_rms : r->means.twist_rms, sqrt(square), 1e-9);
    }
    assert_near_rel(r->means.window_from, 2.0, 1e-9);
    /* The loads along the span are of the same window and sum up to its means. */
    double lift = 0.0, drag = 0.0;
    assert_int_equal(r->loads.n_station, 16);
    for (int i = 0; i < 16; i++) {
        lift += r->loads.lift[i] * 0.37 / 16.0;
        drag += r->loads.drag[i] * 0.37 / 16.0;
        assert_near_rel(r->loads.z[i], 0.37 * (i + 0.5) / 16.0, 1e-12);
    }
    assert_near_rel(r->loads.window_from, 2.0, 1e-9);
    assert_near_rel(r->loads.window_to, 3.0, 1e-9);
    assert_near_rel(lift, r->means.lift, 1e-11);
    assert_near_rel(drag, r->means.drag, 1e-11);
    assert_near_rel(r->means.efficiency, r->means.lift / r->means.drag, 1e-15);
    assert_true(r->loads.induced[15] > r->loads.induced[0]); /* downwash grows towards the tip */
    double position = 0.0, velocity = 0.0;
    for (int j = 0; j < 4; j++) {
        position += r->contribution_position[j];
        velocity += r->contribution_velocity[j];
        assert_near_rel(r->mode[j].share[0] + r->mode[j].share[1] + r->mode[j].share[2] +
                            r->mode[j].share[3],
                        1.0, 1e-12);
    }
    assert_near_rel(position, 1.0, 1e-12);
    assert_near_rel(velocity, 1.0, 1e-12);
    assert_true(r->tip_plunge.n_root >= 1);
    assert_near_rel(r->tip_plunge.root[0].frequency_hz, r->mode[0].frequency_hz, 0.25);
    assert_int_equal(r->counters.not_converged, 0);
    sim_destroy(sim);
}

static void wash_follows_the_ply_angle(void **state)
{
    (void)state;
    static const struct {
        double degrees;
        enum wash wash;
    } row[] = {{-45.0, WASH_OUT}, {-10.0, WASH_OUT}, {0.0, WASH_NONE},
               {90.0, WASH_NONE}, {30.0, WASH_IN},   {45.0, WASH_IN}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct case_def def;
        fixture_paper_beam(row[i].degrees, NULL, &def);
        def.kind = CASE_SECTION;
        struct sim *sim = run(&def);
        assert_int_equal(sim_result(sim)->section.wash, row[i].wash);
        sim_destroy(sim);
    }
}

static void modes_are_labelled(void **state)
{
    (void)state;
    struct case_def def;
    const struct material aluminium = fixture_isotropic(70e9, 0.33, 2700.0);
    fixture_strip(&aluminium, 0.5, 0.03, 0.001, &def);
    def.solver.modes = 12;
    struct sim *sim = run(&def);
    const struct sim_result *r = sim_result(sim);
    int count[MODE_LABEL_COUNT] = {0};
    for (int j = 0; j < 12; j++) {
        count[r->mode[j].label]++;
        assert_true(r->mode[j].modal_mass > 0.0);
        assert_near_abs(r->mode[j].plunge[0], 0.0, 1e-12);
    }
    assert_true(count[MODE_BENDING] >= 6);
    assert_true(count[MODE_TORSION] >= 2);
    assert_true(count[MODE_LAG] >= 1);
    /* First bending of a uniform cantilever carries a quarter of the mass at its tip. */
    assert_near_rel(r->mode[0].modal_mass, 0.25 * 2700.0 * 0.03 * 0.001 * 0.5, 1e-3);
    sim_destroy(sim);
}

static void starts_from_equilibrium_and_stays(void **state)
{
    (void)state;
    struct case_def def;
    fixture_paper_beam(-45.0, &polar, &def);
    def.flow.speed = 3.0;
    def.solver.start = START_EQUILIBRIUM;
    def.solver.modal_damping = 0.01; /* so that not even the noise of the numbers grows */
    struct sim *sim = run(&def);
    const double *plunge = sim_column(sim, 0);
    const int last = sim_result(sim)->n_sample - 1;
    assert_true(plunge[0] > 1e-4);
    assert_near_rel(plunge[last], plunge[0], 1e-5);
    assert_int_equal(sim_result(sim)->verdict, VERDICT_STABLE);
    sim_destroy(sim);
}

/* Either a verdict with its numbers, or a failure that says where and when. */
static void assert_ends_in_order(const struct case_def *def)
{
    struct sim *sim = NULL;
    struct failure fail = {0};
    struct failure_list *list = calloc(1, sizeof *list);
    case_def_check(def, list);
    if (list->count > 0) {
        print_error("%s\n", list->item[0].pointer);
    }
    assert_int_equal(list->count, 0);
    free(list);
    enum status st = sim_create(def, &sim, &fail);
    if (st == ST_OK) {
        st = sim_run(sim, NULL, &fail);
    }
    if (st == ST_OK) {
        const struct sim_result *r = sim_result(sim);
        assert_true((unsigned)r->verdict < VERDICT_COUNT);
        assert_true(strlen(r->verdict_reason) > 20);
        assert_true(r->n_sample >= 1);
        assert_true(isfinite(r->stop_time));
        for (int k = 0; k < r->tip_twist.n_root; k++) {
            assert_true(isfinite(r->tip_twist.root[k].ratio));
            assert_true(isfinite(r->tip_twist.root[k].amplitude));
        }
    } else {
        assert_true(strstr(fail.detail, " s, step ") != NULL);
        assert_true(fail.pointer[0] == '/');
    }
    sim_destroy(sim);
}

static void huge_time_steps(void **state)
{
    (void)state;
    for (double step = 1e-3; step < 1e6; step *= 30.0) {
        for (int order = 0; order <= LIMIT_LOAD_ORDER; order += 4) {
            for (int integrator = 0; integrator < 2; integrator++) {
                struct case_def def;
                fixture_paper_beam(-45.0, &polar, &def);
                def.solver.time_step = step;
                def.solver.duration = 30.0 * step;
                def.solver.load_order = order;
                def.solver.integrator = (enum integrator)integrator;
                def.solver.plunge_max = 1e300;
                def.solver.twist_max = NUM_PI;
                assert_ends_in_order(&def);
            }
        }
    }
}

static void wild_networks(void **state)
{
    (void)state;
    static const double size[] = {1.0, 1e3, 1e30, 1e150, 1e300};
    for (size_t k = 0; k < sizeof size / sizeof size[0]; k++) {
        for (int integrator = 0; integrator < 2; integrator++) {
            struct network_def network = fixture_network(50, size[k], 9);
            struct case_def def;
            fixture_paper_beam(-45.0, &polar, &def);
            def.aero.dynamic = DYNAMIC_NETWORK;
            def.aero.network = &network;
            def.solver.integrator = (enum integrator)integrator;
            def.solver.plunge_max = 1e300;
            def.solver.duration = 0.3;
            assert_ends_in_order(&def);
            network_def_done(&network);
        }
    }
}

static void wild_flows(void **state)
{
    (void)state;
    static const double speed[] = {1e-12, 1e-3, 300.0, 1e6, 1e150, 1e300};
    for (size_t k = 0; k < sizeof speed / sizeof speed[0]; k++) {
        struct case_def def;
        fixture_paper_beam(45.0, &polar, &def);
        def.flow.speed = speed[k];
        def.solver.duration = 0.3;
        assert_ends_in_order(&def);
        def.solver.modal_damping = nextafter(1.0, 0.0);
        assert_ends_in_order(&def);
    }
}

/* A time step so short that the sliding mean over one period would fill the memory. */
static void a_mean_too_long_is_refused(void **state)
{
    (void)state;
    struct network_def network = fixture_network(5, 0.01, 9);
    struct case_def def;
    struct sim *sim = NULL;
    struct failure fail = {0};
    fixture_paper_beam(-45.0, &polar, &def);
    def.aero.dynamic = DYNAMIC_NETWORK;
    def.aero.network = &network;
    def.beam.elements = 64;
    def.solver.time_step = 1e-7;
    def.solver.duration = 0.1;
    assert_int_equal(sim_create(&def, &sim, &fail), ST_LIMIT);
    assert_null(sim);
    assert_string_equal(fail.code, "limit");
    network_def_done(&network);
}

/* Bent beyond the limit by the load at rest, a beam that settles is no flutter; where the limit
 * lets it, the same beam is stable. What grows, at a speed far beyond both, flutters still. */
static void large_deflection_is_no_flutter(void **state)
{
    (void)state;
    static const struct {
        double angle, plunge_max;
        enum verdict verdict;
    } row[] = {{-45.0, 0.3, VERDICT_LARGE_DEFLECTION},
               {-45.0, 5.0, VERDICT_STABLE},
               {45.0, 5.0, VERDICT_FLUTTER}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct case_def def;
        fixture_paper_beam(row[i].angle, &polar, &def);
        def.flow.speed = row[i].verdict == VERDICT_FLUTTER ? 40.0 : 9.0;
        def.aero.dynamic = DYNAMIC_ATTACHED;
        def.solver.plunge_max = row[i].plunge_max;
        def.solver.duration = 2.0;
        struct sim *sim = run(&def);
        const struct sim_result *r = sim_result(sim);
        if (r->verdict != row[i].verdict) {
            print_error("row %zu: %s\n", i, r->verdict_reason);
        }
        assert_int_equal(r->verdict, row[i].verdict);
        sim_destroy(sim);
    }
}

/* One step, one element, one mode: the smallest run there is. */
static void the_smallest_run(void **state)
{
    (void)state;
    struct case_def def;
    fixture_paper_beam(0.0, &polar, &def);
    def.beam.elements = 1;
    def.solver.modes = 1;
    def.solver.duration = 1e-9;
    def.output.n_channel = 0;
    struct sim *sim = run(&def);
    assert_int_equal(sim_result(sim)->steps, 1);
    assert_int_equal(sim_result(sim)->n_column, 0);
    assert_int_equal(sim_result(sim)->verdict, VERDICT_INDETERMINATE);
    sim_destroy(sim);
}

static int setup(void **state)
{
    (void)state;
    sim_process_init();
    polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    polar_def_done(&polar);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_report_hangs_together),
        cmocka_unit_test(a_structure_serves_many_runs),
        cmocka_unit_test(stall_is_counted),
        cmocka_unit_test(wash_follows_the_ply_angle),
        cmocka_unit_test(modes_are_labelled),
        cmocka_unit_test(starts_from_equilibrium_and_stays),
        cmocka_unit_test(huge_time_steps),
        cmocka_unit_test(wild_networks),
        cmocka_unit_test(wild_flows),
        cmocka_unit_test(a_mean_too_long_is_refused),
        cmocka_unit_test(large_deflection_is_no_flutter),
        cmocka_unit_test(the_smallest_run),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
