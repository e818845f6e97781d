#include "tests/bench/paper_case.h"

#include "core/sim.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double paper_cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double paper_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1.0; /* [-1, 1) */
}

/* A network of the paper's size with small outputs: its cost is that of a trained one. */
static void make_network(struct network_def *net)
{
    static double w1[PAPER_INPUTS * PAPER_HIDDEN], b1[PAPER_HIDDEN],
        w2[PAPER_HIDDEN * PAPER_OUTPUTS], b2[PAPER_OUTPUTS];
    uint64_t seed = 1;
    *net = (struct network_def){.name = "bench",
                                .n_in = PAPER_INPUTS,
                                .n_hidden = PAPER_HIDDEN,
                                .n_out = PAPER_OUTPUTS,
                                .output = {NET_OUT_CL, NET_OUT_CM},
                                .w1 = w1,
                                .b1 = b1,
                                .w2 = w2,
                                .b2 = b2};
    for (int i = 0; i < PAPER_INPUTS; i++) {
        net->input[i] = (enum network_input)i;
        net->in_scale[i] = 0.2;
        net->hull_min[i] = -1.0;
        net->hull_max[i] = 1.0;
    }
    for (int i = 0; i < PAPER_INPUTS * PAPER_HIDDEN; i++) {
        w1[i] = paper_random(&seed);
    }
    for (int i = 0; i < PAPER_HIDDEN; i++) {
        b1[i] = paper_random(&seed);
    }
    for (int i = 0; i < PAPER_HIDDEN * PAPER_OUTPUTS; i++) {
        w2[i] = paper_random(&seed);
    }
    for (int o = 0; o < PAPER_OUTPUTS; o++) {
        net->out_scale[o] = 2e-4;
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double paper_median(int n, double *x)
{
    qsort(x, (size_t)n, sizeof *x, ascending);
    return x[n / 2];
}

void paper_case_read(struct paper_case *out)
{
    static struct failure_list problems;
    struct failure fail;
    if (library_create_builtin(&out->library, &fail) != ST_OK) {
        (void)fprintf(stderr, "%s: %s\n", fail.pointer, fail.detail);
        exit(1);
    }
    const char *text = NULL, *name = NULL;
    size_t size = 0;
    for (int i = 0; (name = library_example_case(i, &text, &size)) != NULL; i++) {
        if (strstr(name, "paper-beam.json") != NULL) {
            break;
        }
    }
    if (name == NULL ||
        api_case_parse(out->library, text, size, "", &out->parsed, &problems) != ST_OK) {
        (void)fprintf(stderr, "the shipped paper case cannot be read\n");
        exit(1);
    }
    make_network(&out->network);
}

void paper_case_done(struct paper_case *c)
{
    api_case_destroy(c->parsed);
    library_destroy(c->library);
}
