/* tests/bench/bench_stability.c
 * Cost of the speeds of flutter and divergence of the paper's beam over eleven fibre angles, from
 * the case to the answer (section, modes, sweep of 40 speeds, root finding), one thread, for each
 * model that has states; and of the eigenvalues alone, the part LAPACK does.
 *
 * Usage: bench_stability [rounds] */
#include "core/analysis/linear.h"
#include "core/la.h"
#include "core/num.h"
#include "core/sim.h"
#include "tests/support/fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ANGLES = 11, ROUNDS_MAX = 101 };

static double cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void make_case(double degrees, const struct polar_def *polar, enum dynamic_type dynamic,
                      struct case_def *def)
{
    fixture_paper_beam(degrees, polar, def);
    def->kind = CASE_STABILITY;
    def->aero.dynamic = dynamic;
    def->flow.incidence = 0.0;
    def->stability.from = 2.0;
    def->stability.to = 25.0;
}

/* CPU seconds of all angles; *solves receives how many eigenvalue problems they took. */
static double run_angles(const struct polar_def *polar, enum dynamic_type dynamic, int *solves)
{
    static struct case_def def; /* large */
    struct failure fail;
    *solves = 0;
    const double start = cpu_now();
    for (int i = 0; i < ANGLES; i++) {
        struct sim *sim = NULL;
        make_case(-90.0 + 180.0 * i / (ANGLES - 1), polar, dynamic, &def);
        if (sim_create(&def, &sim, &fail) != ST_OK || sim_run(sim, NULL, &fail) != ST_OK) {
            (void)fprintf(stderr, "%s\n", fail.detail);
            exit(1);
        }
        *solves += sim_result(sim)->stability.solves;
        sim_destroy(sim);
    }
    return cpu_now() - start;
}

/* CPU seconds of LAPACK for one eigenvalue problem of the sweep, and its order. */
static double eigen_alone(const struct polar_def *polar, enum dynamic_type dynamic, int *order)
{
    enum { REPEAT = 50 };
    static struct case_def def; /* large */
    struct failure fail;
    struct model m;
    struct workspace w;
    struct linear l;
    make_case(-45.0, polar, dynamic, &def);
    if (model_build(&def, &m, &fail) != ST_OK || workspace_init(&m, &w) != ST_OK ||
        linear_init(&m, &l) != ST_OK || linear_fill(&m, &w, &l) != ST_OK) {
        exit(1);
    }
    const size_t n = (size_t)l.n_state, bytes = n * n * sizeof(double);
    double *a = malloc(2 * bytes), *x = malloc(2 * n * sizeof *x), used = 0.0;
    if (a == NULL || x == NULL) {
        exit(1);
    }
    for (int k = 0; k < REPEAT; k++) {
        memcpy(a, l.a, bytes);
        const double start = cpu_now();
        if (la_eigen(l.n_state, a, x, x + n, a + n * n) != ST_OK) {
            exit(1);
        }
        used += cpu_now() - start;
    }
    *order = l.n_state;
    free(a);
    free(x);
    linear_done(&l);
    workspace_done(&w);
    model_done(&m);
    return used / REPEAT;
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        enum dynamic_type dynamic;
    } row[] = {{"quasi-steady", DYNAMIC_NONE},
               {"attached", DYNAMIC_ATTACHED},
               {"dynamic_stall", DYNAMIC_STALL}};
    int rounds = argc > 1 ? (int)strtol(argv[1], NULL, 10) : 5;
    rounds = rounds < 1 ? 1 : (rounds > ROUNDS_MAX ? ROUNDS_MAX : rounds);
    sim_process_init();
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, 0.5 * NUM_PI, 0.01, 1.5);
    (void)printf("flutter and divergence of the paper's beam at %d fibre angles, lifting line on, "
                 "median of %d rounds\n",
                 ANGLES, rounds);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double used[ROUNDS_MAX];
        int solves = 0;
        for (int r = 0; r < rounds; r++) {
            used[r] = run_angles(&polar, row[i].dynamic, &solves);
        }
        qsort(used, (size_t)rounds, sizeof used[0], ascending);
        int order = 0;
        const double whole = used[rounds / 2];
        const double eigen = eigen_alone(&polar, row[i].dynamic, &order) * solves;
        (void)printf("%-14s %7.3f CPU s, %4d eigenvalue problems of order %3d, LAPACK alone %7.3f "
                     "CPU s, ratio %.2f\n",
                     row[i].name, whole, solves, order, eigen, whole / eigen);
    }
    polar_def_done(&polar);
    return 0;
}
