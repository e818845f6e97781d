/* Verdicts on made-up histories: a record is filled by hand, nothing is marched. */
#include "core/analysis/doubt.h"
#include "core/analysis/verdict.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

/* Twist = amplitude e^{sigma t} cos(2 pi hz t) + drift t, plunge likewise at a hundredth. */
struct history {
    double amplitude, sigma, hz, drift;
    double saturation;   /* the amplitude stays below it; 0 for none */
    double stalled_from; /* stalled from this share of the record on */
    enum stop_reason stop;
    double outside; /* share of the steps outside the polar */
    double duration;
    double jitter; /* of c_l, with the other sign at every step */
};

struct march_of {
    struct model model;
    struct record record;
    struct march march;
    double omega;
};

static void build(const struct history *h, double dt, struct march_of *out)
{
    const int n = (int)(h->duration / dt + 0.5) + 1;
    out->omega = 2.0 * NUM_PI * 4.0;
    out->model = (struct model){.modes = {.n_mode = 1, .omega = &out->omega}};
    out->model.def.solver.time_step = dt;
    out->model.def.beam.length = 0.37;
    out->record = (struct record){.capacity = n, .n = n};
    out->record.history = calloc((size_t)n * HISTORY_MODAL, sizeof *out->record.history);
    out->record.stalled = calloc((size_t)n, 1);
    for (int i = 0; i < n; i++) {
        const double t = i * dt;
        double size = h->amplitude * exp(h->sigma * t);
        size = h->saturation > 0.0 && size > h->saturation ? h->saturation : size;
        const double y = size * cos(2.0 * NUM_PI * h->hz * t) + h->drift * t;
        out->record.history[i + n * HISTORY_PLUNGE] = 0.01 * y;
        out->record.history[i + n * HISTORY_TWIST] = y;
        out->record.history[i + n * HISTORY_CL] = 5.0 * y + (i % 2 == 0 ? 1.0 : -1.0) * h->jitter;
        out->record.stalled[i] = i >= h->stalled_from * n;
    }
    out->march = (struct march){.model = &out->model,
                                .record = &out->record,
                                .outside_steps = (long)(h->outside * (n - 1)),
                                .stop = h->stop,
                                .steps = n - 1};
}

static enum verdict verdict(const struct history *h, double dt)
{
    struct march_of m;
    char reason[VERDICT_REASON] = "";
    build(h, dt, &m);
    const enum verdict v = verdict_of(&m.march, reason);
    assert_true(strlen(reason) > 20);
    assert_true(strlen(reason) < VERDICT_REASON);
    free(m.record.history);
    free(m.record.stalled);
    return v;
}

static void table(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        struct history history;
        enum verdict verdict;
    } row[] = {
        {"decays", {0.1, -1.0, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 3.0, 0}, VERDICT_STABLE},
        {"rests", {1e-6, 0.0, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 3.0, 0}, VERDICT_STABLE},
        {"never disturbed, but its noise grows",
         {1e-13, 0.5, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 3.0, 0},
         VERDICT_INDETERMINATE},
        {"decays while stalled",
         {0.1, -1.0, 4.0, 0, 0, 0, STOP_DURATION, 0, 3.0, 0},
         VERDICT_STABLE},
        {"grows", {0.01, 1.0, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 3.0, 0}, VERDICT_FLUTTER},
        {"grows, stalled",
         {0.01, 1.0, 4.0, 0, 0, 0.5, STOP_DURATION, 0, 3.0, 0},
         VERDICT_STALL_FLUTTER},
        {"stays, stalled", {0.1, 0, 4.0, 0, 0, 0, STOP_DURATION, 0, 3.0, 0}, VERDICT_STALL_FLUTTER},
        {"grew to a limit",
         {0.001, 3.0, 4.0, 0, 0.1, 2.0, STOP_DURATION, 0, 6.0, 0},
         VERDICT_LIMIT_CYCLE},
        {"neither grows nor decays",
         {0.1, 0, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 3.0, 0},
         VERDICT_INDETERMINATE},
        {"too short", {0.1, -1.0, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 0.7, 0}, VERDICT_INDETERMINATE},
        {"runs away", {0, 0, 4.0, 1.0, 0, 2.0, STOP_AMPLITUDE, 0, 1.0, 0}, VERDICT_DIVERGENCE},
        {"runs away at once",
         {0, 0, 4.0, 9.0, 0, 2.0, STOP_AMPLITUDE, 0, 0.1, 0},
         VERDICT_DIVERGENCE},
        {"swings out", {0.01, 4.0, 4.0, 0, 0, 2.0, STOP_AMPLITUDE, 0, 1.0, 0}, VERDICT_FLUTTER},
        {"swings out, not finite",
         {0.01, 4.0, 4.0, 0, 0, 2.0, STOP_NOT_FINITE, 0, 1.0, 0},
         VERDICT_FLUTTER},
        {"swings out, stalled",
         {0.01, 4.0, 4.0, 0, 0, 0.8, STOP_AMPLITUDE, 0, 1.0, 0},
         VERDICT_STALL_FLUTTER},
        {"sits outside the polar",
         {0.1, -2.0, 4.0, 0, 0, 0, STOP_DURATION, 0.9, 3.0, 0},
         VERDICT_DIVERGENCE},
        {"stopped outside the polar",
         {0.1, -2.0, 4.0, 0, 0, 0, STOP_OUTSIDE_POLAR, 0.3, 3.0, 0},
         VERDICT_DIVERGENCE},
        {"decays, its load turns back at every step",
         {0.1, -1.0, 4.0, 0, 0, 2.0, STOP_DURATION, 0, 3.0, 0.05},
         VERDICT_INDETERMINATE},
        {"swings out, its load turns back at every step",
         {0.01, 4.0, 4.0, 0, 0, 2.0, STOP_AMPLITUDE, 0, 1.0, 0.5},
         VERDICT_INDETERMINATE},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        const enum verdict v = verdict(&row[i].history, 1e-3);
        if (v != row[i].verdict) {
            print_error("%s: %s instead of %s\n", row[i].what, verdict_name(v),
                        verdict_name(row[i].verdict));
        }
        assert_int_equal(v, row[i].verdict);
    }
}

/* Records of a few samples, and time steps longer than the first period. */
static void tiny_records(void **state)
{
    (void)state;
    static const double step[] = {1e-3, 0.1, 0.25, 0.3, 2.0, 1000.0};
    for (size_t k = 0; k < sizeof step / sizeof step[0]; k++) {
        for (int n = 0; n < 8; n++) {
            for (int stop = 0; stop < STOP_REASON_COUNT; stop++) {
                const struct history h = {.amplitude = 0.1,
                                          .hz = 4.0,
                                          .stalled_from = 2.0,
                                          .stop = (enum stop_reason)stop,
                                          .duration = n * step[k]};
                const enum verdict v = verdict(&h, step[k]);
                assert_true((unsigned)v < VERDICT_COUNT);
            }
        }
    }
}

/* Twice a period for an oscillation; every step for a zigzag. */
static void steps_that_turn_back(void **state)
{
    (void)state;
    struct history h = {.amplitude = 0.1, .hz = 4.0, .duration = 3.0};
    struct march_of m;
    build(&h, 1e-3, &m);
    assert_int_equal(doubt_alternations(&m.record, 0), 23);
    assert_true(doubt_of(&m.march).outside_hull == 0.0);
    free(m.record.history);
    free(m.record.stalled);
    h.jitter = 0.05;
    build(&h, 1e-3, &m);
    assert_int_equal(doubt_alternations(&m.record, 0), 2999);
    assert_near_rel(doubt_of(&m.march).alternations, 1.0, 1e-15);
    free(m.record.history);
    free(m.record.stalled);
    /* What a lifting line leaves is no zigzag. */
    h = (struct history){.amplitude = 1e-4, .sigma = -1.0, .hz = 4.0, .duration = 30.0};
    h.jitter = 1e-8;
    assert_int_equal(verdict(&h, 1e-3), VERDICT_STABLE);
}

/* The same history with a network that was asked ever farther outside its hull. */
static void a_network_outside_its_hull(void **state)
{
    (void)state;
    static const struct {
        double share;
        enum verdict verdict;
        const char *word;
    } row[] = {{0.0, VERDICT_STABLE, NULL},
               {0.005, VERDICT_STABLE, NULL},
               {0.2, VERDICT_STABLE, "20 % of the evaluations"},
               {0.8, VERDICT_INDETERMINATE, "80 % of the evaluations"}};
    const struct history h = {
        .amplitude = 0.1, .sigma = -1.0, .hz = 4.0, .stalled_from = 2.0, .duration = 3.0};
    struct network_def def = fixture_network(3, 1.0, 1);
    struct workspace w = {0};
    struct march_of m;
    build(&h, 1e-3, &m);
    assert_ok(network_create(&def, &m.model.network));
    m.model.n_station = 10;
    m.march.w = &w;
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        char reason[VERDICT_REASON] = "";
        w.counters.outside_hull = lround(row[i].share * 10.0 * (m.march.steps + 1));
        assert_int_equal(verdict_of(&m.march, reason), row[i].verdict);
        assert_int_equal(strstr(reason, "hull") != NULL, row[i].word != NULL);
        assert_true(row[i].word == NULL || strstr(reason, row[i].word) != NULL);
    }
    network_destroy(m.model.network);
    network_def_done(&def);
    free(m.record.history);
    free(m.record.stalled);
}

static void names(void **state)
{
    (void)state;
    assert_string_equal(verdict_name(VERDICT_STABLE), "stable");
    assert_string_equal(verdict_name(VERDICT_STALL_FLUTTER), "stall_flutter");
    assert_string_equal(verdict_name(VERDICT_INDETERMINATE), "indeterminate");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table),
        cmocka_unit_test(tiny_records),
        cmocka_unit_test(steps_that_turn_back),
        cmocka_unit_test(a_network_outside_its_hull),
        cmocka_unit_test(names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
