/* The time loop: stop rules, cancel, progress, the record. */
#include "core/coupling/march.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

struct setting {
    struct polar_def polar;
    struct case_def def;
    struct model model;
    struct workspace w;
    struct record record;
    struct march march;
};

static void start(struct setting *s)
{
    s->polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    fixture_paper_beam(-45.0, &s->polar, &s->def);
    s->def.solver.duration = 0.2;
}

static enum status run(struct setting *s, const struct sim_control *control)
{
    struct failure fail;
    assert_ok(model_build(&s->def, &s->model, &fail));
    assert_ok(workspace_init(&s->model, &s->w));
    assert_ok(record_init(&s->model, &s->record));
    march_init(&s->model, &s->w, &s->record, &s->march);
    return march_run(&s->march, control);
}

static void finish(struct setting *s)
{
    record_done(&s->record);
    workspace_done(&s->w);
    model_done(&s->model);
    polar_def_done(&s->polar);
}

static void runs_to_the_end(void **state)
{
    (void)state;
    struct setting s;
    start(&s);
    assert_ok(run(&s, NULL));
    assert_int_equal(s.march.stop, STOP_DURATION);
    assert_int_equal(s.march.steps, 1000);
    assert_int_equal(s.record.n, 1001);
    assert_int_equal(s.record.n_sample, 1001);
    assert_true(record_history(&s.record, HISTORY_PLUNGE)[0] == 0.0);
    assert_true(record_history(&s.record, HISTORY_PLUNGE)[1000] > 1e-3);
    /* The record of the tip is the sum of the modes recorded with it. */
    double tip = 0.0;
    for (int j = 0; j < 4; j++) {
        tip += s.model.tip[j].v * record_history(&s.record, HISTORY_MODAL + j)[700];
    }
    assert_near_rel(record_history(&s.record, HISTORY_PLUNGE)[700], tip, 1e-13);
    finish(&s);
}

static void sampling_skips_but_does_not_change(void **state)
{
    (void)state;
    struct setting a, b;
    start(&a);
    start(&b);
    b.def.output.sample_every = 7;
    assert_ok(run(&a, NULL));
    assert_ok(run(&b, NULL));
    assert_int_equal(b.record.n, a.record.n);
    assert_int_equal(b.record.n_sample, 1000 / 7 + 1);
    for (int i = 0; i < b.record.n_sample; i++) {
        for (int c = 0; c < a.record.n_column; c++) {
            assert_true(b.record.sample[num_at(i, c, b.record.sample_capacity)] ==
                        a.record.sample[num_at(7 * i, c, a.record.sample_capacity)]);
        }
    }
    finish(&b);
    finish(&a);
}

static void channels_have_their_columns(void **state)
{
    (void)state;
    struct setting s;
    start(&s);
    s.def.output.n_channel = CHANNEL_COUNT;
    int columns = 0;
    for (int c = 0; c < CHANNEL_COUNT; c++) {
        s.def.output.channel[c] = (enum channel)c;
        columns += case_def_channel_columns(&s.def, (enum channel)c);
    }
    assert_ok(run(&s, NULL));
    assert_int_equal(s.record.n_column, columns);
    assert_true(num_all_finite(s.record.sample_capacity * columns, s.record.sample));
    /* Last station plunge and twist are near those of the tip; lift is c_l times force. */
    const ptrdiff_t rows = s.record.sample_capacity, last = s.record.n_sample - 1;
    const double *sample = s.record.sample;
    const double force = s.model.dynamic_pressure * 0.1 * 0.37;
    assert_near_rel(sample[last + rows * CHANNEL_LIFT], force * sample[last + rows * CHANNEL_CL],
                    1e-12);
    assert_near_rel(sample[last + rows * CHANNEL_DRAG], force * sample[last + rows * CHANNEL_CD],
                    1e-12);
    const int plunge = CHANNEL_MODAL_AMPLITUDE + 2 * 4, twist = plunge + 16;
    assert_near_rel(sample[last + rows * (plunge + 15)], sample[last + rows * CHANNEL_TIP_PLUNGE],
                    0.06);
    double theta = 0.0;
    for (int j = 0; j < 4; j++) {
        theta += s.model.station_theta[num_at(5, j, 16)] *
                 sample[last + rows * (CHANNEL_MODAL_AMPLITUDE + j)];
    }
    assert_near_abs(sample[last + rows * (twist + 5)], theta, 1e-13);
    finish(&s);
}

static void stops_at_the_amplitude(void **state)
{
    (void)state;
    struct setting s;
    start(&s);
    s.def.solver.plunge_max = 0.02; /* of the length: 7.4 mm */
    assert_ok(run(&s, NULL));
    assert_int_equal(s.march.stop, STOP_AMPLITUDE);
    const double *plunge = record_history(&s.record, HISTORY_PLUNGE);
    assert_true(fabs(plunge[s.record.n - 1]) > 0.02 * 0.37);
    assert_true(fabs(plunge[s.record.n - 2]) <= 0.02 * 0.37);
    finish(&s);
}

/* The rule also holds for the very last state. */
static void stops_at_the_amplitude_of_the_last_step(void **state)
{
    (void)state;
    struct setting s;
    start(&s);
    s.def.solver.plunge_max = 0.02;
    assert_ok(run(&s, NULL));
    const int steps = s.march.steps;
    finish(&s);
    start(&s);
    s.def.solver.plunge_max = 0.02;
    s.def.solver.duration = steps * s.def.solver.time_step;
    assert_ok(run(&s, NULL));
    assert_int_equal(s.march.steps, steps);
    assert_int_equal(s.march.stop, STOP_AMPLITUDE);
    finish(&s);
}

static void stops_outside_the_polar(void **state)
{
    (void)state;
    struct setting s;
    start(&s);
    s.def.flow.incidence = 0.7; /* the polar ends at 0.6 */
    s.def.aero.lifting_line = false;
    s.def.solver.outside_max = 0.25;
    assert_ok(run(&s, NULL));
    assert_int_equal(s.march.stop, STOP_OUTSIDE_POLAR);
    assert_int_equal(s.march.steps, 250);
    finish(&s);
}

static void a_raised_flag_cancels(void **state)
{
    (void)state;
    struct setting s;
    atomic_bool cancel = true;
    _Atomic double progress = -1.0;
    const struct sim_control control = {.cancel = &cancel, .progress = &progress};
    start(&s);
    assert_int_equal(run(&s, &control), ST_CANCELLED);
    assert_int_equal(s.march.steps, 0);
    finish(&s);
    atomic_store(&cancel, false);
    start(&s);
    assert_ok(run(&s, &control));
    assert_true(atomic_load(&progress) > 0.9 && atomic_load(&progress) <= 1.0);
    finish(&s);
}

/* Same case, same bits: nothing is left over from where or when it runs. */
static void runs_repeat_bit_for_bit(void **state)
{
    (void)state;
    struct setting a, b;
    start(&a);
    start(&b);
    assert_ok(run(&a, NULL));
    assert_ok(run(&b, NULL));
    for (int i = 0; i < a.record.n; i++) {
        assert_true(record_history(&a.record, HISTORY_TWIST)[i] ==
                    record_history(&b.record, HISTORY_TWIST)[i]);
    }
    finish(&b);
    finish(&a);
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
        cmocka_unit_test(runs_to_the_end),
        cmocka_unit_test(sampling_skips_but_does_not_change),
        cmocka_unit_test(channels_have_their_columns),
        cmocka_unit_test(stops_at_the_amplitude),
        cmocka_unit_test(stops_at_the_amplitude_of_the_last_step),
        cmocka_unit_test(stops_outside_the_polar),
        cmocka_unit_test(a_raised_flag_cancels),
        cmocka_unit_test(runs_repeat_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
