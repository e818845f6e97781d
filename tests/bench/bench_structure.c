/* tests/bench/bench_structure.c
 * Cost of a section solve (100 elements along the wall) and of the modes of the paper's beam, on
 * one thread. bench_structure.py runs it beside the same computations in NumPy and SciPy.
 *
 * Usage: bench_structure [rounds]; prints `name seconds` lines, medians, and the numbers that the
 * other side must find as well, as `value name number` lines. */
#include "core/coupling/model.h"
#include "core/num.h"
#include "core/sim.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS_MAX = 1001 };

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

static void paper_beam(struct case_def *def)
{
    const struct material skin = {.name = "AS4/3501-6",
                                  .e_l = 141.96e9,
                                  .e_t = 9.78e9,
                                  .g_lt = 6e9,
                                  .g_tt = 4.83e9,
                                  .nu_lt = 0.42,
                                  .nu_tt = 0.5,
                                  .density = 1445};
    const struct material foam = {.name = "foam",
                                  .e_l = 15e6,
                                  .e_t = 15e6,
                                  .g_lt = 8e6,
                                  .g_tt = 8e6,
                                  .nu_lt = 0.28,
                                  .nu_tt = 0.28,
                                  .density = 35};
    case_def_defaults(def);
    def->beam.length = 0.37;
    def->beam.section.shape.width = 0.1;
    def->beam.section.shape.layup[0].n_ply = 2;
    def->beam.section.shape.layup[0].ply[0] =
        (struct ply){.material = skin, .angle = num_rad(-45.0), .thickness = 0.00013};
    def->beam.section.shape.layup[0].ply[1] = (struct ply){.material = foam, .thickness = 0.00387};
}

static void build(const struct case_def *def, struct model *out)
{
    struct failure fail;
    if (model_build(def, out, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s\n", fail.detail);
        exit(1);
    }
}

/* Median time of building the model of a case. */
static double time_model(const struct case_def *def, int rounds)
{
    static double seconds[ROUNDS_MAX];
    for (int i = 0; i < rounds; i++) {
        struct model m;
        const double start = cpu_now();
        build(def, &m);
        seconds[i] = cpu_now() - start;
        model_done(&m);
    }
    qsort(seconds, (size_t)rounds, sizeof *seconds, ascending);
    return seconds[rounds / 2];
}

static void print_values(const struct case_def *def)
{
    struct model m;
    build(def, &m);
    if (def->kind == CASE_SECTION) {
        for (int i = 0; i < SECTION_CLASSIC; i++) {
            (void)printf("value stiffness_%d%d %.17g\n", i, i,
                         m.section.classic[num_at(i, i, SECTION_CLASSIC)]);
        }
    }
    for (int j = 0; j < m.modes.n_mode; j++) {
        (void)printf("value frequency_%d %.17g\n", j + 1, m.modes.omega[j] / (2.0 * NUM_PI));
    }
    model_done(&m);
}

int main(int argc, char **argv)
{
    int rounds = argc > 1 ? (int)strtol(argv[1], NULL, 10) : 101;
    rounds = rounds < 1 ? 1 : (rounds > ROUNDS_MAX ? ROUNDS_MAX : rounds);
    sim_process_init();
    static struct case_def def;
    paper_beam(&def);
    def.kind = CASE_SECTION;
    def.beam.section.shape.contour_elements = 100;
    (void)printf("section_100 %.3e\n", time_model(&def, rounds));
    print_values(&def);
    def.beam.section.shape.contour_elements = 16;
    (void)printf("section_16 %.3e\n", time_model(&def, rounds));
    def.kind = CASE_MODES;
    (void)printf("modes %.3e\n", time_model(&def, rounds));
    print_values(&def);
    return 0;
}
