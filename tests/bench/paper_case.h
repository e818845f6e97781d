/* tests/bench/paper_case.h
 * The case all benchmarks of the step share: the shipped paper's beam (16 elements, 4 modes,
 * lifting line) and a network of the paper's size. */
#ifndef AEROM_TESTS_BENCH_PAPER_CASE_H
#define AEROM_TESTS_BENCH_PAPER_CASE_H

#include "api/case.h"
#include "core/aero/network.h"

enum { PAPER_INPUTS = 4, PAPER_HIDDEN = 50, PAPER_OUTPUTS = 2 };

struct paper_case {
    struct library *library;
    struct api_case *parsed;
    struct network_def network; /* small outputs: its cost is that of a trained one */
};

/* Ends the program when the case cannot be read. The network's arrays are static. */
void paper_case_read(struct paper_case *out);
void paper_case_done(struct paper_case *c);

/* Processor seconds of this thread. */
double paper_cpu_now(void);
/* In [-1, 1). */
double paper_random(uint64_t *state);
/* Sorts x (n). */
double paper_median(int n, double *x);

#endif
