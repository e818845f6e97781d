/* The mean of networks as one network, and its training on records. */
#include "core/aero/network_memory.h"
#include "core/network/ensemble.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

enum { MEMBERS = 3, SAMPLES = 400, RECORDS = 8 };

/* Members with scalings and hulls of their own. */
static void the_merged_network_is_the_mean(void **state)
{
    (void)state;
    struct network_def member[MEMBERS], mean;
    struct network *one[MEMBERS + 1] = {NULL};
    uint64_t seed = 4;
    for (int k = 0; k < MEMBERS; k++) {
        member[k] = fixture_network(4 + 3 * k, 0.5 + k, 10 + (uint64_t)k);
        for (int i = 0; i < member[k].n_in; i++) {
            member[k].in_offset[i] = 0.1 * k - 0.05 * i;
            member[k].in_scale[i] *= 1.0 + 0.3 * k;
            member[k].hull_max[i] = 1.0 + k;
        }
        member[k].out_offset[0] = 0.2 * k;
        assert_ok(network_create(&member[k], &one[k]));
    }
    assert_ok(ensemble_merge(MEMBERS, member, &mean));
    assert_int_equal(mean.n_hidden, 4 + 7 + 10);
    assert_true(mean.hull_max[0] == MEMBERS && mean.hull_min[0] == -10.0);
    assert_ok(network_create(&mean, &one[MEMBERS]));
    for (int k = 0; k < 50; k++) {
        double x[NET_IN_COUNT] = {0.0}, y[NET_OUT_COUNT], sum[NET_OUT_COUNT] = {0.0};
        for (int i = 0; i < 4; i++) {
            x[i] = 0.5 * fixture_normal(&seed);
        }
        for (int m = 0; m < MEMBERS; m++) {
            (void)network_eval(one[m], 1, x, y);
            sum[NET_OUT_CL] += y[NET_OUT_CL] / MEMBERS;
            sum[NET_OUT_CM] += y[NET_OUT_CM] / MEMBERS;
        }
        (void)network_eval(one[MEMBERS], 1, x, y);
        assert_near_abs(y[NET_OUT_CL], sum[NET_OUT_CL], 1e-13);
        assert_near_abs(y[NET_OUT_CM], sum[NET_OUT_CM], 1e-13);
    }
    for (int k = 0; k <= MEMBERS; k++) {
        network_destroy(one[k]);
        network_def_done(k < MEMBERS ? &member[k] : &mean);
    }
}

static void too_many_neurons(void **state)
{
    (void)state;
    struct network_def member[2], mean = {0};
    for (int k = 0; k < 2; k++) {
        member[k] = fixture_network(LIMIT_NET_HIDDEN / 2 + k, 1.0, 1);
    }
    assert_int_equal(ensemble_merge(2, member, &mean), ST_LIMIT);
    assert_null(mean.w1);
    network_def_done(&member[0]);
    network_def_done(&member[1]);
}

/* Pitch theta = a sin(omega t) with c_l = slope alpha_lag(1.5): the lag is what there is to learn.
 */
static struct flow_record lagging(const char *name, double a, double omega, double slope)
{
    struct flow_record r = {.n = SAMPLES, .period = 2.0 * NUM_PI / omega, .start = 12.0};
    struct network_frame frame = {.n_lag = 1, .lag = {1.5}};
    const double chord = 1.0, step = 0.1;
    struct network_memory lags;
    double in[NET_IN_COUNT];
    (void)strcpy(r.name, name);
    r.value = calloc((size_t)SAMPLES * FLOW_ROWS, sizeof *r.value);
    assert_ok(network_memory_init(1, &chord, 1.0, step, &frame, &lags));
    for (int i = 0; i < SAMPLES; i++) {
        const double t = i * step, alpha = a * sin(omega * t), rate = a * omega * cos(omega * t);
        const double none = 0.0;
        if (i == 0) {
            network_memory_steady(&lags, &alpha, &none, in);
        } else {
            network_memory_step(&lags, &alpha, &rate, in);
        }
        r.value[num_at(i, FLOW_TIME, SAMPLES)] = t;
        r.value[num_at(i, FLOW_THETA, SAMPLES)] = alpha;
        r.value[num_at(i, FLOW_THETA_RATE, SAMPLES)] = rate;
        r.value[num_at(i, FLOW_THETA_ACCELERATION, SAMPLES)] = -omega * omega * alpha;
        r.value[num_at(i, FLOW_CL, SAMPLES)] = slope * in[NET_IN_ALPHA_LAG_1];
        r.value[num_at(i, FLOW_CM, SAMPLES)] = 0.1 * slope * in[NET_IN_ALPHA_LAG_1];
    }
    network_memory_done(&lags);
    return r;
}

/* Every member holds out other records; together they know all, and what they learn is the lag. */
static void members_share_the_records(void **state)
{
    (void)state;
    struct polar_def polar = fixture_linear_polar(5.0, 0.5, 0.0, 1.0);
    struct flow_record record[RECORDS];
    struct failure_list *list = calloc(1, sizeof *list);
    struct ensemble_member member[MEMBERS];
    struct dataset_def data;
    struct train_def def;
    struct network_def net = {.n_in = 2,
                              .n_hidden = 4,
                              .n_out = 2,
                              .input = {NET_IN_ALPHA, NET_IN_ALPHA_LAG_1},
                              .output = {NET_OUT_CL, NET_OUT_CM},
                              .frame = {.n_lag = 1, .lag = {1.5}}};
    for (int i = 0; i < RECORDS; i++) {
        const char name[] = {(char)('a' + i), '\0'};
        record[i] = lagging(name, 0.03 + 0.01 * i, 0.4 + 0.2 * i, 5.0);
    }
    dataset_def_defaults(&data);
    data.polar = &polar;
    data.frame = net.frame;
    data.samples_max = 100;
    train_def_defaults(TRAIN_LM, &def);
    assert_ok(ensemble_train(&data, &def, MEMBERS, RECORDS, record, NULL, &net, member, list));
    assert_int_equal(net.n_hidden, 4 * MEMBERS);
    int different = 0;
    for (int k = 0; k < MEMBERS; k++) {
        assert_int_equal(member[k].n_held_record, 1);
        different += memcmp(member[k].is_held, member[0].is_held, RECORDS * sizeof(bool)) != 0;
    }
    assert_true(different > 0);
    struct network *eval = NULL;
    assert_ok(network_create(&net, &eval));
    double x[NET_IN_COUNT] = {0.0}, y[NET_OUT_COUNT];
    x[NET_IN_ALPHA] = 0.04;
    x[NET_IN_ALPHA_LAG_1] = 0.02;
    (void)network_eval(eval, 1, x, y);
    assert_near_abs(y[NET_OUT_CL], 5.0 * (0.02 - 0.04), 2e-3); /* beyond the polar */
    network_destroy(eval);
    network_def_done(&net);
    ensemble_members_done(MEMBERS, member);
    for (int i = 0; i < RECORDS; i++) {
        free(record[i].value);
    }
    polar_def_done(&polar);
    free(list);
}

/* Members share the way from 0 to 1; a training alone has all of it. */
static void progress_runs_over_all_members(void **state)
{
    (void)state;
    _Atomic double progress = -1.0;
    struct sim_control control = {.progress = &progress};
    assert_false(train_is_cancelled(&control, 1, 4));
    assert_true(progress == 0.25);
    control.parts = 4;
    control.part = 3;
    assert_false(train_is_cancelled(&control, 1, 2));
    assert_true(progress == 0.875);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_merged_network_is_the_mean),
        cmocka_unit_test(too_many_neurons),
        cmocka_unit_test(members_share_the_records),
        cmocka_unit_test(progress_runs_over_all_members),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
