/* tests/bench/bench_step.c
 * Cost of one time step of the paper's case (16 elements, 4 modes), one thread, and of its parts
 * against plain references in the same run. Prints medians of interleaved rounds.
 *
 * Usage: bench_step [rounds] */
#include "api/case.h"
#include "core/num.h"
#include "core/sim.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { HIDDEN = 50, INPUTS = 4, OUTPUTS = 2, STATIONS = 16, ROUNDS_MAX = 101, VARIANTS = 8 };

static double cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1.0; /* [-1, 1) */
}

/* A network of the paper's size with small outputs: its cost is that of a trained one. */
static void make_network(struct network_def *net)
{
    static double w1[INPUTS * HIDDEN], b1[HIDDEN], w2[HIDDEN * OUTPUTS], b2[OUTPUTS];
    uint64_t seed = 1;
    *net = (struct network_def){.name = "bench",
                                .n_in = INPUTS,
                                .n_hidden = HIDDEN,
                                .n_out = OUTPUTS,
                                .output = {NET_OUT_CL, NET_OUT_CM},
                                .w1 = w1,
                                .b1 = b1,
                                .w2 = w2,
                                .b2 = b2};
    for (int i = 0; i < INPUTS; i++) {
        net->input[i] = (enum network_input)i;
        net->in_scale[i] = 0.2;
        net->hull_min[i] = -1.0;
        net->hull_max[i] = 1.0;
    }
    for (int i = 0; i < INPUTS * HIDDEN; i++) {
        w1[i] = random_unit(&seed);
    }
    for (int i = 0; i < HIDDEN; i++) {
        b1[i] = random_unit(&seed);
    }
    for (int i = 0; i < HIDDEN * OUTPUTS; i++) {
        w2[i] = random_unit(&seed);
    }
    for (int o = 0; o < OUTPUTS; o++) {
        net->out_scale[o] = 2e-4;
    }
}

/* Microseconds of one whole run per step, and of the steps alone. */
static double run_once(const struct case_def *def, long *steps)
{
    struct failure fail;
    struct sim *sim = NULL;
    if (sim_create(def, &sim, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s\n", fail.detail);
        exit(1);
    }
    const double start = cpu_now();
    if (sim_run(sim, NULL, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s\n", fail.detail);
        exit(1);
    }
    const double used = cpu_now() - start;
    *steps = sim_result(sim)->steps;
    sim_destroy(sim);
    return 1e6 * used / (double)*steps;
}

/* The same forward pass written plainly with libm: the reference of the network kernel. */
static void plain_network(const struct network_def *d, int n, const double *x, double *y)
{
    for (int s = 0; s < n; s++) {
        for (int o = 0; o < d->n_out; o++) {
            double sum = d->b2[o];
            for (int j = 0; j < d->n_hidden; j++) {
                double v = d->b1[j];
                for (int i = 0; i < d->n_in; i++) {
                    v += d->w1[i + d->n_in * j] * (x[num_at(s, i, n)] - d->in_offset[i]) /
                         d->in_scale[i];
                }
                sum += d->w2[j + d->n_hidden * o] * tanh(v);
            }
            y[num_at(s, o, n)] = sum * d->out_scale[o] + d->out_offset[o];
        }
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(int n, double *x)
{
    qsort(x, (size_t)n, sizeof *x, ascending);
    return x[n / 2];
}

static void bench_network(const struct network_def *def, int rounds)
{
    enum { REPEAT = 2000 };
    struct network *net = NULL;
    double x[STATIONS * NET_IN_COUNT], y[STATIONS * NET_OUT_COUNT], fast[ROUNDS_MAX],
        plain[ROUNDS_MAX];
    uint64_t seed = 7;
    if (network_create(def, &net) != ST_OK) {
        exit(1);
    }
    for (int i = 0; i < STATIONS * NET_IN_COUNT; i++) {
        x[i] = 0.1 * random_unit(&seed);
    }
    double sink = 0.0;
    for (int r = 0; r < rounds; r++) {
        double start = cpu_now();
        for (int k = 0; k < REPEAT; k++) {
            x[0] = 1e-6 * k;
            (void)network_eval(net, STATIONS, x, y);
            sink += y[0];
        }
        fast[r] = 1e9 * (cpu_now() - start) / (REPEAT * STATIONS);
        start = cpu_now();
        for (int k = 0; k < REPEAT; k++) {
            x[0] = 1e-6 * k;
            plain_network(def, STATIONS, x, y);
            sink += y[0];
        }
        plain[r] = 1e9 * (cpu_now() - start) / (REPEAT * STATIONS);
    }
    network_destroy(net);
    const double a = median(rounds, fast), b = median(rounds, plain);
    (void)printf("network 4-50-2        %8.1f ns/station   plain libm %8.1f   ratio %.2f%s\n", a, b,
                 b / a, sink == 0.5 ? " " : "");
}

/* Reads the shipped paper case and gives its definition three dynamic set-ups. */
/* The same case with and without its parts. */
static void bench_variants(const struct case_def *def, const struct network_def *net, int rounds)
{
    static const struct {
        const char *label;
        bool lifting_line;
        enum dynamic_type dynamic;
        enum integrator integrator;
    } row[VARIANTS] = {
        {"quasi-steady, no lifting line", false, DYNAMIC_NONE, INTEGRATOR_EXPONENTIAL},
        {"lifting line", true, DYNAMIC_NONE, INTEGRATOR_EXPONENTIAL},
        {"lifting line, network", true, DYNAMIC_NETWORK, INTEGRATOR_EXPONENTIAL},
        {"lifting line, network, rk4_adaptive", true, DYNAMIC_NETWORK, INTEGRATOR_RK4_ADAPTIVE},
        {"lifting line, attached", true, DYNAMIC_ATTACHED, INTEGRATOR_EXPONENTIAL},
        {"lifting line, dynamic_stall", true, DYNAMIC_STALL, INTEGRATOR_EXPONENTIAL},
        {"attached, no lifting line", false, DYNAMIC_ATTACHED, INTEGRATOR_EXPONENTIAL},
        {"dynamic_stall, no lifting line", false, DYNAMIC_STALL, INTEGRATOR_EXPONENTIAL},
    };
    struct case_def variant[VARIANTS];
    for (int v = 0; v < VARIANTS; v++) {
        variant[v] = *def;
        variant[v].aero.lifting_line = row[v].lifting_line;
        variant[v].aero.dynamic = row[v].dynamic;
        variant[v].aero.network = row[v].dynamic == DYNAMIC_NETWORK ? net : NULL;
        variant[v].solver.integrator = row[v].integrator;
    }
    double us[VARIANTS][ROUNDS_MAX];
    long steps = 0;
    for (int r = 0; r < rounds; r++) {
        for (int v = 0; v < VARIANTS; v++) {
            us[v][r] = run_once(&variant[v], &steps);
        }
    }
    (void)printf("paper's case, %d elements, %d modes, %ld steps, median of %d rounds; record and "
                 "damping included\n",
                 variant[0].beam.elements, variant[0].solver.modes, steps, rounds);
    for (int v = 0; v < VARIANTS; v++) {
        (void)printf("%-38s %7.2f us/step\n", row[v].label, median(rounds, us[v]));
    }
}

int main(int argc, char **argv)
{
    int rounds = argc > 1 ? (int)strtol(argv[1], NULL, 10) : 11;
    rounds = rounds < 1 ? 1 : (rounds > ROUNDS_MAX ? ROUNDS_MAX : rounds);
    sim_process_init();
    struct failure fail;
    struct library *lib = NULL;
    if (library_create_builtin(&lib, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s: %s\n", fail.pointer, fail.detail);
        return 1;
    }
    const char *text = NULL, *name = NULL;
    size_t size = 0;
    for (int i = 0; (name = library_example_case(i, &text, &size)) != NULL; i++) {
        if (strstr(name, "paper-beam.json") != NULL) {
            break;
        }
    }
    static struct failure_list problems;
    struct api_case *c = NULL;
    if (name == NULL || api_case_parse(lib, text, size, "", &c, &problems) != ST_OK) {
        (void)fprintf(stderr, "the shipped paper case cannot be read\n");
        return 1;
    }
    struct network_def net;
    make_network(&net);
    bench_variants(api_case_def(c), &net, rounds);
    bench_network(&net, rounds);
    api_case_destroy(c);
    library_destroy(lib);
    return 0;
}
