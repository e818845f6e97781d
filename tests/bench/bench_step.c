/* tests/bench/bench_step.c
 * Cost of one time step of the paper's case (16 elements, 4 modes), one thread, and of its parts
 * against plain references in the same run. Prints medians of interleaved rounds.
 *
 * Usage: bench_step [rounds] */
#include "core/num.h"
#include "core/sim.h"
#include "tests/bench/paper_case.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { STATIONS = 16, ROUNDS_MAX = 101, VARIANTS = 8 };

/* Microseconds of one whole run per step, and of the steps alone. */
static double run_once(const struct case_def *def, long *steps)
{
    struct failure fail;
    struct sim *sim = NULL;
    if (sim_create(def, &sim, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s\n", fail.detail);
        exit(1);
    }
    const double start = paper_cpu_now();
    if (sim_run(sim, NULL, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s\n", fail.detail);
        exit(1);
    }
    const double used = paper_cpu_now() - start;
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
        x[i] = 0.1 * paper_random(&seed);
    }
    double sink = 0.0;
    for (int r = 0; r < rounds; r++) {
        double start = paper_cpu_now();
        for (int k = 0; k < REPEAT; k++) {
            x[0] = 1e-6 * k;
            (void)network_eval(net, STATIONS, x, y);
            sink += y[0];
        }
        fast[r] = 1e9 * (paper_cpu_now() - start) / (REPEAT * STATIONS);
        start = paper_cpu_now();
        for (int k = 0; k < REPEAT; k++) {
            x[0] = 1e-6 * k;
            plain_network(def, STATIONS, x, y);
            sink += y[0];
        }
        plain[r] = 1e9 * (paper_cpu_now() - start) / (REPEAT * STATIONS);
    }
    network_destroy(net);
    const double a = paper_median(rounds, fast), b = paper_median(rounds, plain);
    (void)printf("network 4-50-2        %8.1f ns/station   plain libm %8.1f   ratio %.2f%s\n", a, b,
                 b / a, sink == 0.5 ? " " : "");
}

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
        (void)printf("%-38s %7.2f us/step\n", row[v].label, paper_median(rounds, us[v]));
    }
}

int main(int argc, char **argv)
{
    int rounds = argc > 1 ? (int)strtol(argv[1], NULL, 10) : 11;
    rounds = rounds < 1 ? 1 : (rounds > ROUNDS_MAX ? ROUNDS_MAX : rounds);
    sim_process_init();
    struct paper_case paper;
    paper_case_read(&paper);
    bench_variants(api_case_def(paper.parsed), &paper.network, rounds);
    bench_network(&paper.network, rounds);
    paper_case_done(&paper);
    return 0;
}
