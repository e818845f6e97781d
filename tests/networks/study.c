/* Trainings of networks on the records of a folder, for tests/networks/build_networks.py.
 *
 *     network_study FOLDER DRAWS
 *
 * Draw by draw a fifth of the records is held out, the same ones for all networks of the draw. Four
 * inputs of the paper, c_l and c_m, against the shipped polar. Lines of standard output begin with
 * the table they belong to, whose columns tests/networks/study.py names. */
#include "cli/records.h"
#include "cli/report.h"
#include "cli/source.h"
#include "core/network/train_lstm.h"
#include "core/num.h"
#include "tests/networks/study_cost.h"

#include <stdlib.h>
#include <string.h>

enum model { LM, ADAM, LSTM, MODELS };
static const char *const model_name[MODELS] = {"lm", "adam", "lstm"};

/* One network of the study, and in how many of the draws it is trained. Where the curve is drawn
 * the patience is that of all epochs; what is kept is the best in any case. */
struct plan {
    enum model model;
    int hidden, draws_most, epochs, patience;
};
static const struct plan plans[] = {
    {LM, 2, 100, 100, 25},  {LM, 4, 100, 100, 25},   {LM, 8, 100, 100, 25},
    {LM, 16, 100, 100, 25}, {LM, 25, 100, 100, 25},  {LM, 50, 100, 80, 80},
    {LM, 100, 100, 60, 25}, {ADAM, 50, 3, 500, 500}, {LSTM, 7, 100, 400, 400},
};
static const double held_share = 0.2, lstm_step = 0.08;
/* Samples of all records together, so that the cost does not grow with their number. */
enum { SAMPLES = 8000, CYCLE_POINTS = 80, CURVE_POINTS = 125 };

struct study {
    struct sources sources;
    struct records records;
    struct failure_list problems;
    struct dataset_def def;
    struct dataset data;
    struct polar *polar;
    int draw;
};

/* A trained network of either kind. */
struct trained {
    const struct plan *plan;
    struct network_def def;
    struct network *net;
    struct lstm_def lstm;
    struct train_curve curve;
    double seconds;
};

static void trained_done(struct trained *t)
{
    network_destroy(t->net);
    network_def_done(&t->def);
    lstm_def_done(&t->lstm);
    train_curve_done(&t->curve);
}

static enum status train(struct study *s, const struct plan *plan, struct trained *out)
{
    struct train_def def;
    struct network_def net = {.n_in = 4,
                              .n_out = 2,
                              .n_hidden = plan->hidden,
                              .input = {NET_IN_MEAN_ALPHA, NET_IN_DELTA_ALPHA, NET_IN_ALPHA_RATE,
                                        NET_IN_ALPHA_ACCELERATION},
                              .output = {NET_OUT_CL, NET_OUT_CM}};
    struct trained t = {.plan = plan};
    const double start = study_seconds();
    enum status st;
    if (plan->model == LSTM) {
        train_lstm_defaults(&def);
    } else {
        train_def_defaults(plan->model == LM ? TRAIN_LM : TRAIN_ADAM, &def);
    }
    def.epochs = plan->epochs;
    def.patience = plan->patience;
    def.seed = (uint64_t)s->draw;
    if (plan->model == LSTM) {
        t.lstm = (struct lstm_def){.net = net, .step = lstm_step};
        st = train_lstm(&s->def, &s->data, s->records.record, &def, NULL, &t.lstm, &t.curve,
                        &s->problems);
    } else {
        t.def = net;
        st = train_network(&s->data, &def, NULL, &t.def, &t.curve, &s->problems);
        st = st == ST_OK ? network_create(&t.def, &t.net) : st;
    }
    t.seconds = study_seconds() - start;
    if (st == ST_OK) {
        *out = t;
    } else {
        trained_done(&t);
    }
    return st;
}

static void print_curve(const struct study *s, const struct trained *t)
{
    const int every = (t->curve.n + CURVE_POINTS - 1) / CURVE_POINTS;
    for (int i = 0; i < t->curve.n; i++) {
        if (i % every == 0 || i == t->curve.best) {
            (void)printf("curve,%s,%d,%d,%d,%.5g,%.5g\n", model_name[t->plan->model],
                         t->plan->hidden, s->draw, i, t->curve.trained[i], t->curve.held[i]);
        }
    }
}

static int weights_of(const struct trained *t)
{
    const struct lstm lstm = lstm_shape(&t->lstm);
    const struct perceptron net = {
        .n_in = t->def.n_in, .n_hidden = t->def.n_hidden, .n_out = t->def.n_out};
    return t->plan->model == LSTM ? lstm_count(&lstm) : perceptron_count(&net);
}

/* Coefficients of the model at every sample: y (NET_OUT_COUNT x n). */
static enum status coefficients(const struct trained *t, const struct flow_record *r,
                                const double *x, const double *steady, double *y)
{
    enum status st = ST_OK;
    if (t->plan->model == LSTM) {
        st = lstm_predict(&t->lstm, r, x, y);
    }
    for (int i = 0; i < r->n && st == ST_OK; i++) {
        double *out = y + num_at(0, i, NET_OUT_COUNT);
        if (t->plan->model != LSTM) {
            (void)network_eval(t->net, 1, x + num_at(0, i, NET_IN_COUNT), out);
        }
        for (int o = 0; o < NET_OUT_COUNT; o++) {
            out[o] += steady[num_at(o, i, NET_OUT_COUNT)];
        }
    }
    return st;
}

/* The last period. */
static void print_cycle(const struct study *s, const struct trained *t, int record,
                        const double *steady, const double *y)
{
    const struct flow_record *r = &s->records.record[record];
    const double samples = r->period / flow_record_step(r);
    for (int k = 0; k <= CYCLE_POINTS; k++) {
        const int i = r->n - 1 - (int)lround(samples * (CYCLE_POINTS - k) / CYCLE_POINTS);
        const double *a = steady + num_at(0, i, NET_OUT_COUNT);
        const double *b = y + num_at(0, i, NET_OUT_COUNT);
        const double alpha =
            r->value[num_at(i, FLOW_THETA, r->n)] - r->value[num_at(i, FLOW_W_RATE, r->n)];
        (void)printf("cycle,%s,%d,%s,%s,%.3f,%.4g,%.3f,%.4f,%.3f,%.4f,%.3f,%.4f\n",
                     model_name[t->plan->model], t->plan->hidden, r->name,
                     s->data.is_held[record] ? "held" : "trained", num_deg(alpha),
                     r->value[num_at(i, FLOW_THETA_RATE, r->n)], r->value[num_at(i, FLOW_CL, r->n)],
                     r->value[num_at(i, FLOW_CM, r->n)], a[NET_OUT_CL], a[NET_OUT_CM],
                     b[NET_OUT_CL], b[NET_OUT_CM]);
    }
}

static enum status print_record(const struct study *s, const struct trained *t, int record)
{
    const struct flow_record *r = &s->records.record[record];
    const size_t n = (size_t)r->n;
    double *x = malloc(n * (NET_IN_COUNT + 2 * NET_OUT_COUNT) * sizeof *x);
    struct assessment a;
    if (x == NULL) {
        return ST_NO_MEMORY;
    }
    double *steady = x + n * NET_IN_COUNT, *y = steady + n * NET_OUT_COUNT;
    flow_record_inputs(r, s->def.window, x);
    flow_record_steady(r, s->polar, steady);
    enum status st = coefficients(t, r, x, steady, y);
    st = st == ST_OK ? assess_coefficients(r, steady, y, &a) : st;
    if (st == ST_OK) {
        if (s->draw == 1 && t->plan == plans) {
            (void)printf("record,%d,%s,%.6g,%.4f,%.4f,%.4f,%.4f,%.5g,%.5g\n", record, r->name,
                         r->period, a.steady_cl, a.range_cl, a.steady_cm, a.range_cm,
                         a.record.pitch, a.record.plunge);
        }
        (void)printf("error,%s,%d,%d,%d,%s,%.4f,%.4f,%.4g,%.4g\n", model_name[t->plan->model],
                     t->plan->hidden, s->draw, record, s->data.is_held[record] ? "held" : "trained",
                     a.network_cl, a.network_cm, a.network.pitch, a.network.plunge);
        if (s->draw == 1 && r->period > 0.0) {
            print_cycle(s, t, record, steady, y);
        }
    }
    free(x);
    return st;
}

static void print_cost(const struct trained *t)
{
    const char *name = model_name[t->plan->model];
    if (t->plan->model == LSTM) {
        const double ns = study_cost_lstm(&t->lstm); /* a lone section takes all lanes with it */
        (void)printf("cost,%s,%d,%d,%.1f\n", name, t->plan->hidden, LANES, ns);
        (void)printf("cost,%s,%d,1,%.1f\n", name, t->plan->hidden, LANES * ns);
        return;
    }
    for (int sections = 1; sections <= 2 * LANES; sections *= 2) {
        (void)printf("cost,%s,%d,%d,%.1f\n", name, t->plan->hidden, sections,
                     study_cost_feed_forward(t->net, sections));
    }
}

static enum status trial(struct study *s, const struct plan *plan)
{
    struct trained t;
    enum status st = train(s, plan, &t);
    if (st != ST_OK) {
        return st;
    }
    (void)printf("trial,%s,%d,%d,%d,%.2f,%d,%d,%.5g,%.5g\n", model_name[plan->model], plan->hidden,
                 s->draw, weights_of(&t), t.seconds, t.curve.n - 1, t.curve.best,
                 t.curve.trained[t.curve.best], t.curve.held[t.curve.best]);
    (void)fprintf(stderr, "draw %d: %s %d, %.1f s\n", s->draw, model_name[plan->model],
                  plan->hidden, t.seconds);
    if (plan->patience == plan->epochs) {
        print_curve(s, &t);
    }
    for (int i = 0; i < s->records.n && st == ST_OK; i++) {
        st = print_record(s, &t, i);
    }
    if (s->draw == 1) {
        print_cost(&t);
    }
    trained_done(&t);
    return st;
}

static enum status run(struct study *s, int draws)
{
    enum status st = polar_create(s->def.polar, &s->polar);
    for (s->draw = 1; s->draw <= draws && st == ST_OK; s->draw++) {
        s->def.seed = (uint64_t)s->draw;
        st = dataset_build(&s->def, s->records.n, s->records.record, &s->problems, &s->data);
        for (size_t i = 0; i < sizeof plans / sizeof plans[0] && st == ST_OK; i++) {
            st = s->draw <= plans[i].draws_most ? trial(s, &plans[i]) : ST_OK;
        }
        dataset_done(&s->data);
    }
    polar_destroy(s->polar);
    return st;
}

int main(int argc, char **argv)
{
    struct study *s = calloc(1, sizeof *s);
    const long draws = argc == 3 ? strtol(argv[2], NULL, 10) : 0;
    bool done = false;
    if (s == NULL || draws < 1 || draws > 100) {
        (void)fprintf(stderr, "usage: network_study FOLDER DRAWS\n");
        free(s);
        return 2;
    }
    dataset_def_defaults(&s->def);
    s->def.held_share = held_share;
    if (sources_init(&s->sources) && source_polar(NULL, &s->sources, &s->problems, &s->def.polar) &&
        records_read(argv[1], &s->problems, &s->records)) {
        s->def.samples_max = (int)num_clamp(SAMPLES / s->records.n, 50, s->def.samples_max);
        const enum status st = run(s, (int)draws);
        done = st == ST_OK;
        if (!done) {
            (void)fprintf(stderr, "network_study: %s\n", status_text(st));
            report_failures(stderr, argv[1], &s->problems);
        }
    }
    records_done(&s->records);
    sources_done(&s->sources);
    free(s);
    return done ? 0 : 1;
}
