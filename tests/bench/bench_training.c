/* Levenberg-Marquardt training of the 4-50-2 network on all records of a folder; for
 * bench_training.py, which trains the same in NumPy.
 *
 *     bench_training FOLDER FILE
 *
 * FILE receives, as doubles, the numbers of samples trained and held out and of parameters, then x
 * and t of the trained, of the held out, and the start. Standard output: seconds of the clock with
 * one thread and with two, then a line `epoch trained held` each. */
#include "api/both_threads.h"
#include "cli/records.h"
#include "cli/report.h"
#include "cli/source.h"
#include "core/network/train_lm.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { IN = 4, OUT = 2, HIDDEN = 50 };

static double seconds(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool put(FILE *file, size_t n, const double *x)
{
    return fwrite(x, sizeof *x, n, file) == n;
}

static bool dump(const char *path, const struct train_problem *p, int count, const double *start)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL) {
        return false;
    }
    const double head[3] = {p->trained.n, p->held.n, count};
    const size_t n_trained = (size_t)p->trained.n, n_held = (size_t)p->held.n;
    const bool done = put(file, 3, head) && put(file, n_trained * IN, p->trained.x) &&
                      put(file, n_trained * OUT, p->trained.t) &&
                      put(file, n_held * IN, p->held.x) && put(file, n_held * OUT, p->held.t) &&
                      put(file, (size_t)count, start);
    return fclose(file) == 0 && done;
}

static enum status train(const struct train_problem *problem, const char *path)
{
    const int count = perceptron_count(&problem->shape);
    struct train_def def;
    struct train_curve curve = {0};
    double *p = malloc(3 * (size_t)count * sizeof *p); /* the last, and the best of either run */
    train_def_defaults(TRAIN_LM, &def);
    enum status st = p != NULL ? train_curve_init(def.epochs, &curve) : ST_NO_MEMORY;
    if (st == ST_OK) {
        perceptron_start(&problem->shape, def.seed, p);
        st = dump(path, problem, count, p) ? ST_OK : ST_INVALID;
    }
    for (int threads = 1; threads <= 2 && st == ST_OK; threads++) {
        const struct sim_control control = {.both = threads == 2 ? both_threads : NULL};
        perceptron_start(&problem->shape, def.seed, p);
        curve.n = 0;
        const double start = seconds();
        st = train_lm(problem, &def, &control, p, p + (ptrdiff_t)threads * count, &curve);
        (void)printf("%.4f ", seconds() - start);
    }
    if (st == ST_OK &&
        memcmp(p + count, p + 2 * (ptrdiff_t)count, (size_t)count * sizeof *p) != 0) {
        (void)fprintf(stderr, "bench_training: two threads give other bits than one\n");
        st = ST_INVALID;
    }
    if (st == ST_OK) {
        (void)printf("\n");
        for (int i = 0; i < curve.n; i++) {
            (void)printf("%d %.12g %.12g\n", i, curve.trained[i], curve.held[i]);
        }
    }
    train_curve_done(&curve);
    free(p);
    return st;
}

static enum status run(const struct dataset_def *def, const struct records *records,
                       const char *path, struct failure_list *problems)
{
    struct network_def net = {.n_in = IN,
                              .n_hidden = HIDDEN,
                              .n_out = OUT,
                              .input = {NET_IN_MEAN_ALPHA, NET_IN_DELTA_ALPHA, NET_IN_ALPHA_RATE,
                                        NET_IN_ALPHA_ACCELERATION},
                              .output = {NET_OUT_CL, NET_OUT_CM}};
    struct dataset data = {0};
    enum status st = dataset_build(def, records->n, records->record, problems, &data);
    if (st == ST_OK) {
        struct train_def plain;
        struct train_problem problem;
        train_def_defaults(TRAIN_LM, &plain);
        dataset_scaling(&data.trained, &net, problems);
        st = train_problem_init(&data, &net, &plain, &problem);
        if (st == ST_OK) {
            st = train(&problem, path);
            train_problem_done(&problem);
        }
    }
    dataset_done(&data);
    return st;
}

int main(int argc, char **argv)
{
    struct failure_list *problems = calloc(1, sizeof *problems);
    struct sources sources = {0};
    struct records records = {0};
    struct dataset_def def;
    enum status st = ST_INVALID;
    if (problems == NULL || argc != 3) {
        (void)fprintf(stderr, "usage: bench_training FOLDER FILE\n");
        free(problems);
        return 2;
    }
    dataset_def_defaults(&def);
    if (sources_init(&sources) && source_polar(NULL, &sources, problems, &def.polar) &&
        records_read(argv[1], problems, &records)) {
        st = run(&def, &records, argv[2], problems);
        if (st != ST_OK) {
            (void)fprintf(stderr, "bench_training: %s\n", status_text(st));
            report_failures(stderr, argv[1], problems);
        }
    }
    records_done(&records);
    sources_done(&sources);
    free(problems);
    return st == ST_OK ? 0 : 1;
}
