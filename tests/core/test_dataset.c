/* Records made by formula, whose increments and means are known. */
#include "core/network/assess.h"
#include "core/network/train.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 1201 };
static const double mean = 0.05, amplitude = 0.08, plunge = 0.1, step = 0.05;
/* c_l and c_m beyond the polar, by alpha_dot c/V, and c_d beyond it by nothing. */
static const double lift_rate = 1.3, moment_rate = -0.4;
static const double slope = 6.0, moment_slope = 1.5, drag = 0.01;

static double *at(const struct flow_record *r, enum flow_row k, int i)
{
    return r->value + num_at(i, (int)k, r->n);
}

/* A sine of frequency f from t = 0 on: theta by sin, w by cos. */
static struct flow_record sine(const char *name, double f, double size)
{
    struct flow_record r = {.n = N, .period = 1.0 / f, .start = 1.0 / f};
    const double omega = 2.0 * NUM_PI * f;
    (void)snprintf(r.name, sizeof r.name, "%s", name);
    r.value = calloc(N * FLOW_ROWS, sizeof *r.value);
    for (int i = 0; i < N; i++) {
        const double t = i * step, s = sin(omega * t), c = cos(omega * t);
        *at(&r, FLOW_TIME, i) = t;
        *at(&r, FLOW_THETA, i) = mean + size * amplitude * s;
        *at(&r, FLOW_THETA_RATE, i) = size * amplitude * omega * c;
        *at(&r, FLOW_THETA_ACCELERATION, i) = -size * amplitude * omega * omega * s;
        *at(&r, FLOW_W, i) = size * plunge * c;
        *at(&r, FLOW_W_RATE, i) = -size * plunge * omega * s;
        *at(&r, FLOW_W_ACCELERATION, i) = -size * plunge * omega * omega * c;
        const double alpha = *at(&r, FLOW_THETA, i) - *at(&r, FLOW_W_RATE, i);
        const double rate = *at(&r, FLOW_THETA_RATE, i) - *at(&r, FLOW_W_ACCELERATION, i);
        *at(&r, FLOW_CL, i) = slope * alpha + lift_rate * rate;
        *at(&r, FLOW_CM, i) = moment_slope * alpha + moment_rate * rate;
        *at(&r, FLOW_CD, i) = drag;
    }
    return r;
}

static int problems_of(const struct flow_record *r, char pointer[160], char code[40])
{
    struct failure_list *list = calloc(1, sizeof *list);
    flow_record_check(r, list);
    const int n = list->total;
    memcpy(pointer, list->item[0].pointer, sizeof list->item[0].pointer);
    memcpy(code, list->item[0].code, sizeof list->item[0].code);
    free(list);
    return n;
}

static void inputs_are_those_of_the_motion(void **state)
{
    (void)state;
    const double f = 0.1, omega = 2.0 * NUM_PI * f;
    struct flow_record r = sine("a", f, 1.0);
    double *x = calloc(N * NET_IN_COUNT, sizeof *x);
    flow_record_inputs(&r, 12.5, x); /* 12.5 is nearest to one period of 10 */
    for (int i = flow_record_first(&r) + 1; i < N - 3; i++) {
        const double *in = x + num_at(0, i, NET_IN_COUNT), t = i * step;
        const double alpha = mean + amplitude * sin(omega * t) + plunge * omega * sin(omega * t);
        const double rate = (amplitude * omega + plunge * omega * omega) * cos(omega * t);
        assert_near_abs(in[NET_IN_MEAN_ALPHA], mean, 1e-12);
        assert_near_abs(in[NET_IN_DELTA_ALPHA], alpha - mean, 1e-12);
        assert_near_abs(in[NET_IN_ALPHA_RATE], rate, 1e-12);
        assert_near_abs(in[NET_IN_ALPHA_ACCELERATION], -omega * omega * (alpha - mean), 1e-7);
        assert_near_abs(in[NET_IN_PLUNGE_RATE], -plunge * omega * sin(omega * t), 1e-12);
    }
    /* Nothing moved before: the mean starts at the first angle. */
    assert_near_abs(x[NET_IN_MEAN_ALPHA], mean, 1e-12);
    free(x);
    free(r.value);
}

/* What comes every other cycle only, as vortices at half the frequency would, is not what the
 * motion does: over four cycles it goes out of the increments, but for the cubic between samples.
 * Without a period it stays. */
static void increments_of_a_sine_are_means_over_its_cycles(void **state)
{
    (void)state;
    const double f = 1.0 / (270.25 * step), omega = 2.0 * NUM_PI * f, size = 0.3;
    struct flow_record r = sine("a", f, 1.0);
    r.start = (N - 1082.5) * step;
    double *y = malloc(N * NET_OUT_COUNT * sizeof *y);
    for (int i = 0; i < N; i++) {
        *at(&r, FLOW_CL, i) += size * sin(0.5 * omega * i * step);
    }
    const int first = flow_record_first(&r);
    for (int periodic = 0; periodic < 2; periodic++) {
        r.period = periodic ? 1.0 / f : 0.0;
        memset(y, 0, N * NET_OUT_COUNT * sizeof *y);
        for (int i = 0; i < N; i++) {
            flow_record_subtract(&r, first, i, y + num_at(0, i, NET_OUT_COUNT));
        }
        for (int i = first; i < N; i++) {
            const double phase = 0.5 * omega * i * step, swing = size * sin(phase);
            const double cl = *at(&r, FLOW_CL, i) - (periodic ? swing : 0.0);
            if (i > first && i < N - 1) { /* these two have the phase of a fifth cycle */
                assert_near_abs(y[num_at(NET_OUT_CL, i, NET_OUT_COUNT)], cl, 1e-6);
            }
            assert_near_abs(y[num_at(NET_OUT_CD, i, NET_OUT_COUNT)], drag, 1e-12);
        }
        assert_near_abs(y[num_at(NET_OUT_CL, first - 1, NET_OUT_COUNT)],
                        *at(&r, FLOW_CL, first - 1), 0.0);
    }
    free(y);
    free(r.value);
}

/* Without a period the mean is over the window: of a sine its closed form. */
static void the_mean_slides_over_the_window(void **state)
{
    (void)state;
    const double f = 0.1, omega = 2.0 * NUM_PI * f, window = 4.0;
    struct flow_record r = sine("a", f, 1.0);
    double *x = calloc(N * NET_IN_COUNT, sizeof *x);
    r.period = 0.0;
    flow_record_inputs(&r, window, x);
    const double size = amplitude + plunge * omega;
    for (int i = 100; i < N; i++) {
        const double t = i * step + 0.5 * step; /* the window's samples stand for its steps */
        const double exact =
            mean + size * (cos(omega * (t - window)) - cos(omega * t)) / (omega * window);
        assert_near_abs(x[num_at(NET_IN_MEAN_ALPHA, i, NET_IN_COUNT)], exact, 3e-5);
    }
    free(x);
    free(r.value);
}

static void every_fault_of_a_record_is_named(void **state)
{
    (void)state;
    struct flow_record r = sine("a", 0.1, 1.0);
    char pointer[160], code[40];
    assert_int_equal(problems_of(&r, pointer, code), 0);
    static const struct {
        enum flow_row row;
        int from, to;
        double factor, add;
        const char *pointer, *code;
    } fault[] = {
        {FLOW_TIME, 700, 701, 1.0, -0.05, "/a/t", "not_increasing"},
        {FLOW_TIME, 700, N, 1.0, 0.5, "/a/t", "gap"},
        {FLOW_CL, 5, 6, 1.0, HUGE_VAL, "/a/cl", "out_of_range"},
        {FLOW_CM, 5, 6, HUGE_VAL, 0.0, "/a/cm", "out_of_range"},
        {FLOW_THETA, 0, N, 180.0 / 3.14159, 0.0, "/a/alpha_deg", "out_of_range"},
        {FLOW_W, 0, N, 1000.0, 0.0, "/a/w", "out_of_range"},
        {FLOW_W_RATE, 0, N, 2.0, 0.0, "/a/w_dot", "contradiction"},
        {FLOW_THETA_ACCELERATION, 0, N, 57.3, 0.0, "/a/alpha_ddot", "contradiction"},
        {FLOW_THETA_RATE, 0, N, 0.0, 0.0, "/a/alpha_dot", "contradiction"},
    };
    for (size_t k = 0; k < sizeof fault / sizeof fault[0]; k++) {
        struct flow_record wrong = sine("a", 0.1, 1.0);
        for (int i = fault[k].from; i < fault[k].to; i++) {
            double *v = at(&wrong, fault[k].row, i);
            *v = *v * fault[k].factor + fault[k].add;
        }
        assert_true(problems_of(&wrong, pointer, code) >= 1);
        assert_string_equal(pointer, fault[k].pointer);
        assert_string_equal(code, fault[k].code);
        free(wrong.value);
    }
    r.n = FLOW_SAMPLES_MIN - 1;
    assert_int_equal(problems_of(&r, pointer, code), 1);
    assert_string_equal(code, "too_few");
    free(r.value);
}

enum { RECORDS = 21 };

static void records_new(struct flow_record *record)
{
    for (int k = 0; k < RECORDS; k++) {
        char name[16];
        (void)snprintf(name, sizeof name, "r%d", k);
        /* The last one is at rest. */
        record[k] = sine(name, 0.1 + 0.01 * k, k == RECORDS - 1 ? 0.0 : 1.0);
        record[k].start = 15.0;
    }
}

static void records_free(struct flow_record *record)
{
    for (int k = 0; k < RECORDS; k++) {
        free(record[k].value);
    }
}

/* alpha_ddot is -omega^2 times the deviation: each sample says which record it came from. */
static void assert_only_held(const struct dataset *d, const struct flow_record *record)
{
    for (int k = 0; k < d->held.n; k++) {
        const double *x = d->held.x + num_at(0, k, NET_IN_COUNT);
        const double omega2 = -x[NET_IN_ALPHA_ACCELERATION] / x[NET_IN_DELTA_ALPHA];
        bool found = fabs(x[NET_IN_DELTA_ALPHA]) < 0.06; /* the mean's rounding counts */
        for (int i = 0; i < RECORDS; i++) {
            const double own = num_sq(2.0 * NUM_PI / record[i].period);
            found |= d->is_held[i] && fabs(omega2 / own - 1.0) < 0.03;
        }
        assert_true(found);
    }
}

static void increments_are_mirrored_and_records_stay_whole(void **state)
{
    (void)state;
    struct polar_def polar = fixture_linear_polar(slope, moment_slope, drag, 1.5);
    struct flow_record record[RECORDS];
    struct failure_list *list = calloc(1, sizeof *list);
    struct dataset_def def;
    struct dataset d[3];
    records_new(record);
    dataset_def_defaults(&def);
    def.polar = &polar;
    def.samples_max = 100;
    def.anchors = 10;
    for (int k = 0; k < 3; k++) {
        def.seed = k == 2 ? 5 : 1;
        assert_ok(dataset_build(&def, RECORDS, record, list, &d[k]));
        assert_int_equal(d[k].n_held, 2); /* a tenth of the twenty that move */
        int held = 0;
        for (int i = 0; i < RECORDS; i++) {
            held += d[k].is_held[i];
        }
        assert_int_equal(held, 2);
        assert_false(d[k].is_held[RECORDS - 1]);
        /* 901 samples behind the start, every tenth of them, mirrored. */
        assert_int_equal(d[k].held.n, 2 * 2 * 91);
        assert_int_equal(d[k].trained.n, 19 * 2 * 91 + 2 * def.anchors);
        assert_int_equal(d[k].outside_polar, 0);
    }
    assert_memory_equal(d[0].is_held, d[1].is_held, RECORDS * sizeof(bool));
    assert_memory_not_equal(d[0].is_held, d[2].is_held, RECORDS * sizeof(bool));
    const struct sample_set *s = &d[0].trained;
    /* Cycles are not whole samples: what the cubic between samples may be off, 3/128 of the fourth
     * difference, of a swing in c_l below 3 at f = 0.3. */
    const double cubic = 3.0 / 128.0 * pow(2.0 * NUM_PI * 0.3 * step, 4.0) * 3.0;
    for (int k = 0; k < s->n; k++) {
        const double *x = s->x + num_at(0, k, NET_IN_COUNT),
                     *y = s->y + num_at(0, k, NET_OUT_COUNT);
        assert_near_abs(y[NET_OUT_CL], lift_rate * x[NET_IN_ALPHA_RATE], cubic);
        assert_near_abs(y[NET_OUT_CM], moment_rate * x[NET_IN_ALPHA_RATE], cubic);
        assert_near_abs(y[NET_OUT_CD], 0.0, 1e-12);
        for (int i = 0; i < NET_IN_COUNT && k % 2 == 1; i++) {
            assert_near_abs(x[i], -x[i - NET_IN_COUNT], 0.0);
        }
    }
    assert_only_held(&d[0], record);
    for (int k = 0; k < 3; k++) {
        dataset_done(&d[k]);
    }
    records_free(record);
    polar_def_done(&polar);
    free(list);
}

/* With a balance the samples of records weigh by what their ranges are: sixteen times the weight
 * for a quarter of the range. Anchors weigh one, as all do in the mean. */
static void samples_weigh_by_the_range_of_their_record(void **state)
{
    (void)state;
    struct polar_def polar = fixture_linear_polar(slope, moment_slope, drag, 1.5);
    struct flow_record record[4] = {sine("a", 0.1, 1.0), sine("b", 0.1, 1.0), sine("c", 0.1, 0.25),
                                    sine("d", 0.1, 0.25)};
    struct failure_list *list = calloc(1, sizeof *list);
    struct dataset_def def;
    struct dataset d = {0};
    dataset_def_defaults(&def);
    def.polar = &polar;
    def.anchors = 10;
    for (int balanced = 0; balanced < 2; balanced++) {
        def.balance = balanced ? 1e-6 : 0.0;
        assert_ok(dataset_build(&def, 4, record, list, &d));
        const struct sample_set *s = &d.trained;
        double sum = 0.0, least = s->weight[0], most = s->weight[0];
        for (int k = 0; k < s->n - 2 * def.anchors; k++) {
            sum += s->weight[k];
            least = fmin(least, s->weight[k]);
            most = fmax(most, s->weight[k]);
        }
        assert_near_rel(sum, s->n - 2.0 * def.anchors, 1e-12);
        assert_near_rel(most / least, balanced ? 16.0 : 1.0, 1e-6);
        assert_near_abs(s->weight[s->n - 1], 1.0, 0.0);
        /* Records in the order in which they were given, each as long as the others, then the
         * anchors. */
        assert_int_equal(s->n_group, 4 - d.n_held + 1);
        for (int g = 0; g < s->n_group - 1; g++) {
            assert_int_equal(s->end[g], (g + 1) * s->end[0]);
        }
        assert_int_equal(s->end[s->n_group - 1], s->n);
        /* A tenth of the range of a small record, weighed, is a tenth of the unit. */
        const double range = flow_record_range(&record[3], FLOW_CL, flow_record_first(&record[3]));
        if (balanced) {
            assert_near_rel(sqrt(most) * 0.1 * range, 0.1 * d.unit[NET_OUT_CL], 1e-6);
        } else {
            const double mean_square = 0.5 * (1.0 + 1.0 / 16.0); /* of the large ones' ranges */
            assert_near_rel(d.unit[NET_OUT_CL], 4.0 * range * sqrt(mean_square), 1e-6);
        }
        dataset_done(&d);
    }
    for (int i = 0; i < 4; i++) {
        free(record[i].value);
    }
    polar_def_done(&polar);
    free(list);
}

static void too_few_records_are_refused(void **state)
{
    (void)state;
    struct polar_def polar = fixture_linear_polar(slope, moment_slope, drag, 1.5);
    struct flow_record record[2] = {sine("a", 0.1, 1.0), sine("b", 0.1, 0.0)};
    struct failure_list *list = calloc(1, sizeof *list);
    struct dataset_def def;
    struct dataset d = {0};
    dataset_def_defaults(&def);
    def.polar = &polar;
    assert_int_equal(dataset_build(&def, 2, record, list, &d), ST_INVALID);
    assert_string_equal(list->item[0].code, "too_few");
    assert_string_equal(list->item[0].got, "1");
    record[0].start = 1e6;
    assert_int_equal(dataset_build(&def, 2, record, list, &d), ST_INVALID);
    assert_string_equal(list->item[1].pointer, "a");
    assert_int_equal(dataset_build(&def, 0, record, list, &d), ST_INVALID);
    assert_null(d.is_held);
    free(record[0].value);
    free(record[1].value);
    polar_def_done(&polar);
    free(list);
}

static struct network_def untrained(int hidden)
{
    return (struct network_def){.name = "n",
                                .n_in = 2,
                                .n_hidden = hidden,
                                .n_out = 2,
                                .input = {NET_IN_DELTA_ALPHA, NET_IN_ALPHA_RATE},
                                .output = {NET_OUT_CM, NET_OUT_CL}};
}

/* From records to a network that says what was put into them, with the work of a cycle. */
static void a_network_learns_the_increment(void **state)
{
    (void)state;
    struct polar_def polar_def = fixture_linear_polar(slope, moment_slope, drag, 1.5);
    struct flow_record record[RECORDS];
    struct failure_list *list = calloc(1, sizeof *list);
    struct dataset_def def;
    struct train_def train;
    struct dataset d;
    struct train_curve curve = {0};
    struct network_def net = untrained(4);
    struct network *network = NULL;
    struct polar *polar = NULL;
    records_new(record);
    dataset_def_defaults(&def);
    def.polar = &polar_def;
    assert_ok(dataset_build(&def, RECORDS, record, list, &d));
    train_def_defaults(TRAIN_LM, &train);
    train.decay = 0.0;
    assert_ok(train_network(&d, &train, NULL, &net, &curve, list));
    assert_ok(network_create(&net, &network));
    assert_ok(polar_create(&polar_def, &polar));
    for (int k = 0; k + 1 < RECORDS; k++) {
        struct assessment a;
        assert_ok(assess_record(&record[k], def.window, polar, network, &a));
        assert_true(a.network_cl < 0.002 * a.range_cl);
        assert_true(a.network_cm < 0.002 * a.range_cm);
        assert_true(a.steady_cl > 0.02 * a.range_cl);
        /* Work of pitch: c_m in phase with theta_dot, over one period. */
        const double omega = 2.0 * NUM_PI / record[k].period;
        const double work =
            NUM_PI * amplitude * (moment_rate * (amplitude * omega + plunge * omega * omega));
        assert_near_rel(a.record.pitch, work, 0.01);
        assert_near_rel(a.network.pitch, a.record.pitch, 0.01);
        assert_near_abs(assess_energy_error(&a.network, &a.record), 0.0, 0.01);
        assert_true(fabs(a.steady.pitch) < 0.01 * fabs(work));
    }
    network_destroy(network);
    polar_destroy(polar);
    network_def_done(&net);
    train_curve_done(&curve);
    dataset_done(&d);
    records_free(record);
    polar_def_done(&polar_def);
    free(list);
}

/* Drag has no increment here. */
static void a_constant_channel_is_refused(void **state)
{
    (void)state;
    struct polar_def polar = fixture_linear_polar(slope, moment_slope, drag, 1.5);
    struct flow_record record[RECORDS];
    struct failure_list *list = calloc(1, sizeof *list);
    struct dataset_def def;
    struct train_def train;
    struct dataset d;
    struct train_curve curve = {0};
    struct network_def net = untrained(4);
    net.output[1] = NET_OUT_CD;
    records_new(record);
    dataset_def_defaults(&def);
    def.polar = &polar;
    assert_ok(dataset_build(&def, RECORDS, record, list, &d));
    train_def_defaults(TRAIN_LM, &train);
    assert_int_equal(train_network(&d, &train, NULL, &net, &curve, list), ST_INVALID);
    assert_int_equal(list->total, 1);
    assert_string_equal(list->item[0].pointer, "cd");
    assert_string_equal(list->item[0].code, "constant");
    assert_null(net.w1);
    dataset_done(&d);
    records_free(record);
    polar_def_done(&polar);
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inputs_are_those_of_the_motion),
        cmocka_unit_test(the_mean_slides_over_the_window),
        cmocka_unit_test(increments_of_a_sine_are_means_over_its_cycles),
        cmocka_unit_test(every_fault_of_a_record_is_named),
        cmocka_unit_test(increments_are_mirrored_and_records_stay_whole),
        cmocka_unit_test(samples_weigh_by_the_range_of_their_record),
        cmocka_unit_test(too_few_records_are_refused),
        cmocka_unit_test(a_network_learns_the_increment),
        cmocka_unit_test(a_constant_channel_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
