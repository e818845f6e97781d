/* Cross-validation of a network with memory, fold by fold on the records `aerom train --folds`
 * deals to the same fold, for tests/plate_network/build_network.py.
 *
 *     lstm_folds FOLDER FOLDS CELLS
 *
 * Four inputs of the paper, c_l and c_m, against the shipped polar. Prints the columns of `aerom
 * train` that the page needs. */
#include "cli/records.h"
#include "cli/report.h"
#include "cli/source.h"
#include "core/network/train_lstm.h"
#include "core/network/training.h"

#include <stdlib.h>

enum {
    SAMPLES = 60
}; /* of a record, as the network of the paper has them; here they set the scaling */
static const double step = 0.08;

struct folds {
    struct sources sources;
    struct records records;
    struct failure_list problems;
    struct dataset_def def;
    struct polar *polar;
    int *fold;                /* (records) */
    struct flow_record *rest; /* (records) */
};

static void print_row(const struct flow_record *r, const struct assessment *a)
{
    (void)printf("%s,fold,%.5f,%.5f,%.5f,%.5f,%.6f\n", r->name, a->network_cl, a->range_cl,
                 a->network_cm, a->range_cm, a->network.pitch + a->network.plunge);
}

static enum status train(struct folds *f, int n, int cells, struct lstm_def *out)
{
    struct dataset data = {0};
    struct train_def def;
    struct train_curve curve = {0};
    *out = (struct lstm_def){.step = step,
                             .net = {.n_in = 4,
                                     .n_out = 2,
                                     .n_hidden = cells,
                                     .input = {NET_IN_MEAN_ALPHA, NET_IN_DELTA_ALPHA,
                                               NET_IN_ALPHA_RATE, NET_IN_ALPHA_ACCELERATION},
                                     .output = {NET_OUT_CL, NET_OUT_CM}}};
    train_lstm_defaults(&def);
    enum status st = dataset_build(&f->def, n, f->rest, &f->problems, &data);
    if (st == ST_OK) {
        st = train_lstm(&f->def, &data, f->rest, &def, NULL, out, &curve, &f->problems);
    }
    train_curve_done(&curve);
    dataset_done(&data);
    return st;
}

static enum status run_fold(struct folds *f, int number, int cells)
{
    struct lstm_def lstm = {.p = NULL};
    int n = 0;
    for (int i = 0; i < f->records.n; i++) {
        if (f->fold[i] != number) {
            f->rest[n++] = f->records.record[i];
        }
    }
    enum status st = train(f, n, cells, &lstm);
    for (int i = 0; i < f->records.n && st == ST_OK; i++) {
        struct assessment a;
        if (f->fold[i] == number) {
            st = lstm_assess(&f->records.record[i], f->def.window, f->polar, &lstm, &a);
            if (st == ST_OK) {
                print_row(&f->records.record[i], &a);
            }
        }
    }
    lstm_def_done(&lstm);
    return st;
}

static enum status run(struct folds *f, int folds, int cells)
{
    const size_t n = (size_t)f->records.n;
    f->fold = malloc(n * sizeof *f->fold);
    f->rest = malloc(n * sizeof *f->rest);
    enum status st =
        f->fold != NULL && f->rest != NULL ? polar_create(f->def.polar, &f->polar) : ST_NO_MEMORY;
    if (st == ST_OK) {
        training_deal(f->def.seed, folds, f->records.n, f->records.record, f->fold);
        (void)printf("record,part,cl_rms,cl_range,cm_rms,cm_range,network_work\n");
    }
    for (int k = 0; k < folds && st == ST_OK; k++) {
        st = run_fold(f, k, cells);
    }
    polar_destroy(f->polar);
    free(f->fold);
    free(f->rest);
    return st;
}

int main(int argc, char **argv)
{
    struct folds *f = calloc(1, sizeof *f);
    const long folds = argc == 4 ? strtol(argv[2], NULL, 10) : 0;
    const long cells = argc == 4 ? strtol(argv[3], NULL, 10) : 0;
    bool done = false;
    if (f == NULL || folds < 2 || folds > TRAINING_FOLDS_MAX || cells < 1 ||
        cells > LSTM_HIDDEN_MAX) {
        (void)fprintf(stderr, "usage: lstm_folds FOLDER FOLDS CELLS\n");
        free(f);
        return 2;
    }
    dataset_def_defaults(&f->def);
    f->def.samples_max = SAMPLES;
    if (sources_init(&f->sources) && source_polar(NULL, &f->sources, &f->problems, &f->def.polar) &&
        records_read(argv[1], &f->problems, &f->records)) {
        const enum status st = run(f, (int)folds, (int)cells);
        done = st == ST_OK;
        if (!done) {
            (void)fprintf(stderr, "lstm_folds: %s\n", status_text(st));
            report_failures(stderr, argv[1], &f->problems);
        }
    }
    records_done(&f->records);
    sources_done(&f->sources);
    free(f);
    return done ? 0 : 1;
}
