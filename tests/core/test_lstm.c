/* The network with memory: derivatives against differences, and a lag that needs one. */
#include "core/network/lstm_records.h"
#include "core/network/train_lstm.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { IN = 3, HIDDEN = 5, OUT = 2, STEPS = 6, ROWS = 7 * HIDDEN };
enum { COUNT = 4 * HIDDEN * (IN + HIDDEN + 1) + HIDDEN * OUT + OUT };

static const struct lstm shape = {.n_in = IN, .n_hidden = HIDDEN, .n_out = OUT};

static void random_lanes(int n, uint64_t seed, lanes *x)
{
    for (int i = 0; i < n; i++) {
        for (int l = 0; l < LANES; l++) {
            x[i][l] = fixture_normal(&seed);
        }
    }
}

/* The network written out once more, one sequence, with the functions of the C library. */
static void plain(const double *p, int lane, const lanes *x, double y[OUT])
{
    double h[HIDDEN] = {0.0}, c[HIDDEN] = {0.0}, a[4 * HIDDEN];
    const double *u = p + IN * 4 * HIDDEN, *b = u + HIDDEN * 4 * HIDDEN, *w2 = b + 4 * HIDDEN;
    for (int k = 0; k < STEPS; k++) {
        for (int r = 0; r < 4 * HIDDEN; r++) {
            a[r] = b[r];
            for (int i = 0; i < IN; i++) {
                a[r] += p[r * IN + i] * x[k * IN + i][lane];
            }
            for (int j = 0; j < HIDDEN; j++) {
                a[r] += u[r * HIDDEN + j] * h[j];
            }
        }
        for (int j = 0; j < HIDDEN; j++) {
            c[j] =
                c[j] / (1.0 + exp(-a[HIDDEN + j])) + tanh(a[2 * HIDDEN + j]) / (1.0 + exp(-a[j]));
            h[j] = tanh(c[j]) / (1.0 + exp(-a[3 * HIDDEN + j]));
        }
    }
    for (int o = 0; o < OUT; o++) {
        y[o] = w2[HIDDEN * OUT + o];
        for (int j = 0; j < HIDDEN; j++) {
            y[o] += w2[o * HIDDEN + j] * h[j];
        }
    }
}

/* Forward over all steps, in two parts that carry the state. */
static void forward(const double *p, const lanes *x, lanes *tape, lanes *y)
{
    memset(tape, 0, ROWS * sizeof *tape);
    lstm_forward(&shape, p, 2, x, tape, y);
    lstm_forward(&shape, p, STEPS - 2, x + 2 * IN, tape + 2 * ROWS, y + 2 * OUT);
}

static void the_equations_are_those_of_the_literature(void **state)
{
    (void)state;
    double p[COUNT], alone[OUT];
    lanes x[IN * STEPS], tape[ROWS * (STEPS + 1)], y[OUT * STEPS];
    assert_int_equal(lstm_count(&shape), COUNT);
    assert_int_equal(lstm_tape_rows(&shape), ROWS);
    lstm_start(&shape, 3, p);
    random_lanes(IN * STEPS, 8, x);
    forward(p, x, tape, y);
    for (int l = 0; l < LANES; l++) {
        plain(p, l, x, alone);
        for (int o = 0; o < OUT; o++) {
            assert_near_abs(y[(STEPS - 1) * OUT + o][l], alone[o], 1e-14);
        }
    }
}

/* sum over lanes of weight * y */
static double objective(const double *p, const lanes *x, const lanes *dy)
{
    lanes tape[ROWS * (STEPS + 1)], y[OUT * STEPS];
    double sum = 0.0;
    forward(p, x, tape, y);
    for (int i = 0; i < OUT * STEPS; i++) {
        for (int l = 0; l < LANES; l++) {
            sum += dy[i][l] * y[i][l];
        }
    }
    return sum;
}

static void the_gradient_is_that_of_differences(void **state)
{
    (void)state;
    double p[COUNT];
    lanes x[IN * STEPS], dy[OUT * STEPS], tape[ROWS * (STEPS + 1)], y[OUT * STEPS], g[COUNT];
    lstm_start(&shape, 5, p);
    random_lanes(IN * STEPS, 1, x);
    random_lanes(OUT * STEPS, 2, dy);
    forward(p, x, tape, y);
    memset(g, 0, sizeof g);
    lstm_backward(&shape, p, STEPS, x, tape, dy, g);
    for (int i = 0; i < COUNT; i++) {
        const double h = 1e-6, keep = p[i];
        double sum = 0.0;
        for (int l = 0; l < LANES; l++) {
            sum += g[i][l];
        }
        p[i] = keep + h;
        const double up = objective(p, x, dy);
        p[i] = keep - h;
        const double down = objective(p, x, dy);
        p[i] = keep;
        assert_near_abs(sum, (up - down) / (2.0 * h), 1e-7);
    }
}

/* Records of three tones whose increments are a first-order lag of the rate of the angle. */
enum { RECORDS = 12, SAMPLES = 700 };
static const double spacing = 0.1, lag = 1.5;

static struct flow_record lagged(int number)
{
    struct flow_record r = {.n = SAMPLES, .start = 12.0};
    uint64_t seed = (uint64_t)number + 11;
    double f[3], phase[3], lagged = 0.0;
    (void)snprintf(r.name, sizeof r.name, "r%d", number);
    r.value = calloc(SAMPLES * FLOW_ROWS, sizeof *r.value);
    for (int j = 0; j < 3; j++) {
        f[j] = 0.03 * pow(10.0, random_uniform(&seed));
        phase[j] = 2.0 * NUM_PI * random_uniform(&seed);
    }
    for (int i = 0; i < SAMPLES; i++) {
        double *v = r.value + i;
        v[(ptrdiff_t)FLOW_TIME * SAMPLES] = i * spacing;
        for (int j = 0; j < 3; j++) {
            const double w = 2.0 * NUM_PI * f[j], a = 0.02 / f[j] / 20.0;
            const double s = sin(w * i * spacing + phase[j]), c = cos(w * i * spacing + phase[j]);
            v[(ptrdiff_t)FLOW_THETA * SAMPLES] += a * s;
            v[(ptrdiff_t)FLOW_THETA_RATE * SAMPLES] += a * w * c;
            v[(ptrdiff_t)FLOW_THETA_ACCELERATION * SAMPLES] -= a * w * w * s;
        }
        const double keep = exp(-spacing / lag);
        lagged = keep * lagged + (1.0 - keep) * v[(ptrdiff_t)FLOW_THETA_RATE * SAMPLES];
        v[(ptrdiff_t)FLOW_CL * SAMPLES] = 3.0 * lagged;
        v[(ptrdiff_t)FLOW_CM * SAMPLES] = -lagged;
    }
    return r;
}

struct trial {
    struct flow_record record[RECORDS];
    struct polar_def polar; /* of nothing: the increment is the whole coefficient */
    struct dataset_def def;
    struct dataset data;
    struct failure_list *problems;
    struct train_def train;
    struct lstm_def net;
    struct train_curve curve;
};

static struct trial *trial_new(void)
{
    struct trial *t = calloc(1, sizeof *t);
    t->problems = calloc(1, sizeof *t->problems);
    t->polar = fixture_linear_polar(0.0, 0.0, 0.0, 1.5);
    dataset_def_defaults(&t->def);
    t->def.polar = &t->polar;
    t->def.held_share = 0.25;
    t->def.samples_max = 200;
    for (int i = 0; i < RECORDS; i++) {
        t->record[i] = lagged(i);
        flow_record_check(&t->record[i], t->problems);
    }
    assert_ok(dataset_build(&t->def, RECORDS, t->record, t->problems, &t->data));
    train_lstm_defaults(&t->train);
    t->net.step = 2.0 * spacing;
    t->net.net = (struct network_def){.n_in = 2,
                                      .n_hidden = 7,
                                      .n_out = 2,
                                      .input = {NET_IN_DELTA_ALPHA, NET_IN_ALPHA_RATE},
                                      .output = {NET_OUT_CL, NET_OUT_CM}};
    return t;
}

static void trial_free(struct trial *t)
{
    for (int i = 0; i < RECORDS; i++) {
        free(t->record[i].value);
    }
    dataset_done(&t->data);
    train_curve_done(&t->curve);
    lstm_def_done(&t->net);
    polar_def_done(&t->polar);
    free(t->problems);
    free(t);
}

static enum status train(struct trial *t, const struct sim_control *control)
{
    return train_lstm(&t->def, &t->data, t->record, &t->train, control, &t->net, &t->curve,
                      t->problems);
}

/* Inputs at one instant do not say what the lag holds, several tones after another: the network
 * without memory keeps a large error on the records held out. */
static void memory_learns_a_lag(void **state)
{
    (void)state;
    struct trial *t = trial_new();
    t->train.epochs = 150;
    assert_ok(train(t, NULL));
    const double held = t->curve.held[t->curve.best];
    struct network_def net = t->net.net;
    struct train_def def;
    struct train_curve curve;
    train_def_defaults(TRAIN_LM, &def);
    net.n_hidden = 20;
    assert_ok(train_network(&t->data, &def, NULL, &net, &curve, t->problems));
    print_message("held out: %.3g with memory after %d epochs, %.3g without\n", held,
                  t->curve.n - 1, curve.held[curve.best]);
    assert_true(held < 0.02);
    assert_true(curve.held[curve.best] > 5.0 * held);
    train_curve_done(&curve);
    network_def_done(&net);
    trial_free(t);
}

static void the_same_seed_gives_the_same_bits(void **state)
{
    (void)state;
    struct trial *t[3];
    for (int i = 0; i < 3; i++) {
        t[i] = trial_new();
        t[i]->train.epochs = 5;
        t[i]->train.seed = i < 2 ? 1 : 2;
        assert_ok(train(t[i], NULL));
    }
    const struct lstm used = lstm_shape(&t[0]->net);
    const size_t size = (size_t)lstm_count(&used) * sizeof(double);
    assert_memory_equal(t[0]->net.p, t[1]->net.p, size);
    assert_memory_not_equal(t[0]->net.p, t[2]->net.p, size);
    for (int i = 0; i < 3; i++) {
        trial_free(t[i]);
    }
}

/* Mean square error of the records held out, scaled. */
static double assessed(struct trial *t, const struct polar *polar)
{
    double square = 0.0;
    for (int i = 0; i < RECORDS; i++) {
        struct assessment a;
        assert_ok(lstm_assess(&t->record[i], t->def.window, polar, &t->net, &a));
        assert_true(a.steady_cl > 0.0);
        square += t->data.is_held[i] ? 0.5 * num_sq(a.network_cl / t->net.net.out_scale[0]) +
                                           0.5 * num_sq(a.network_cm / t->net.net.out_scale[1])
                                     : 0.0;
    }
    return square / t->data.n_held;
}

/* What is assessed is what was trained: records and their mirror images have the error of the
 * curve.
 */
static void assessment_is_that_of_the_training(void **state)
{
    (void)state;
    struct trial *t = trial_new();
    struct polar *polar = NULL;
    t->train.epochs = 10;
    t->net.step = spacing;
    assert_ok(train(t, NULL));
    assert_ok(polar_create(&t->polar, &polar));
    const double as_it_is = assessed(t, polar);
    for (int i = 0; i < RECORDS; i++) {
        for (int k = SAMPLES; k < FLOW_ROWS * SAMPLES; k++) { /* all but the time */
            t->record[i].value[k] *= -1.0;
        }
    }
    assert_near_rel(0.5 * (as_it_is + assessed(t, polar)), t->curve.held[t->curve.best], 1e-12);
    polar_destroy(polar);
    trial_free(t);
}

static void faults_have_a_status(void **state)
{
    (void)state;
    struct trial *t = trial_new();
    atomic_bool cancel = true;
    const struct sim_control control = {.cancel = &cancel};
    assert_int_equal(lstm_stride(&t->record[0], 0.2), 2);
    assert_int_equal(lstm_stride(&t->record[0], 0.15), 0);
    assert_int_equal(lstm_stride(&t->record[0], 0.04), 0);
    assert_int_equal(train(t, &control), ST_CANCELLED);
    assert_null(t->net.p);
    t->net.step = 0.15;
    assert_int_equal(train(t, NULL), ST_INVALID);
    assert_int_equal(t->problems->total, RECORDS);
    assert_string_equal(t->problems->item[0].pointer, "r0");
    trial_free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_equations_are_those_of_the_literature),
        cmocka_unit_test(the_gradient_is_that_of_differences),
        cmocka_unit_test(memory_learns_a_lag),
        cmocka_unit_test(the_same_seed_gives_the_same_bits),
        cmocka_unit_test(assessment_is_that_of_the_training),
        cmocka_unit_test(faults_have_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
