/* Levenberg-Marquardt training of the 4-50-2 network on all records of a folder; for
 * bench_training.py, which trains the same in NumPy.
 *
 *     bench_training FOLDER FILE
 *
 * FILE receives, as doubles, the numbers of samples trained and held out and of parameters, then x
 * and t of the trained, of the held out, and the start. Standard output: seconds, then a line
 * `epoch trained held` each. */
#include "cli/records.h"
#include "cli/report.h"
#include "cli/source.h"
#include "core/network/train_lm.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { IN = 4, OUT = 2, HIDDEN = 50 };

struct part {
    int n;
    double *x, *t; /* scaled */
};

static double seconds(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool part_init(const struct sample_set *s, const struct network_def *net, struct part *out)
{
    *out = (struct part){.n = s->n,
                         .x = malloc((size_t)s->n * IN * sizeof(double)),
                         .t = malloc((size_t)s->n * OUT * sizeof(double))};
    for (int k = 0; k < s->n && out->x != NULL && out->t != NULL; k++) {
        for (int i = 0; i < IN; i++) {
            const double v = s->x[num_at((int)net->input[i], k, NET_IN_COUNT)];
            out->x[num_at(i, k, IN)] = (v - net->in_offset[i]) / net->in_scale[i];
        }
        for (int o = 0; o < OUT; o++) {
            const double v = s->y[num_at((int)net->output[o], k, NET_OUT_COUNT)];
            out->t[num_at(o, k, OUT)] = (v - net->out_offset[o]) / net->out_scale[o];
        }
    }
    return out->x != NULL && out->t != NULL;
}

static bool put(FILE *file, size_t n, const double *x)
{
    return fwrite(x, sizeof *x, n, file) == n;
}

static bool dump(const char *path, const struct part part[2], int count, const double *start)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL) {
        return false;
    }
    const double head[3] = {part[0].n, part[1].n, count};
    bool done = put(file, 3, head);
    for (int i = 0; i < 2; i++) {
        done = done && put(file, (size_t)part[i].n * IN, part[i].x) &&
               put(file, (size_t)part[i].n * OUT, part[i].t);
    }
    done = done && put(file, (size_t)count, start);
    return fclose(file) == 0 && done;
}

static enum status train(const struct part part[2], const char *path)
{
    const struct train_problem problem = {.shape = {.n_in = IN, .n_hidden = HIDDEN, .n_out = OUT},
                                          .n_trained = part[0].n,
                                          .n_held = part[1].n,
                                          .trained_x = part[0].x,
                                          .trained_t = part[0].t,
                                          .held_x = part[1].x,
                                          .held_t = part[1].t};
    const int count = perceptron_count(&problem.shape);
    struct train_def def;
    struct train_curve curve = {0};
    double *p = malloc(2 * (size_t)count * sizeof *p);
    train_def_defaults(TRAIN_LM, &def);
    enum status st = p != NULL ? train_curve_init(def.epochs, &curve) : ST_NO_MEMORY;
    if (st == ST_OK) {
        perceptron_start(&problem.shape, def.seed, p);
        st = dump(path, part, count, p) ? ST_OK : ST_INVALID;
    }
    if (st == ST_OK) {
        const double start = seconds();
        st = train_lm(&problem, &def, NULL, p, p + count, &curve);
        (void)printf("%.4f\n", seconds() - start);
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
    struct part part[2] = {{0}, {0}};
    enum status st = dataset_build(def, records->n, records->record, problems, &data);
    if (st == ST_OK) {
        dataset_scaling(&data.trained, &net, problems);
        const bool done =
            part_init(&data.trained, &net, &part[0]) && part_init(&data.held, &net, &part[1]);
        st = done ? train(part, path) : ST_NO_MEMORY;
    }
    for (int i = 0; i < 2; i++) {
        free(part[i].x);
        free(part[i].t);
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
