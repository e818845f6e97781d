#include "tests/networks/study_cost.h"

#include "core/num.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 20000, SECTIONS_MAX = 64, STEPS = 100 };

double study_seconds(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double study_cost_feed_forward(const struct network *net, int sections)
{
    double x[NET_IN_COUNT * SECTIONS_MAX], y[NET_OUT_COUNT * SECTIONS_MAX];
    for (int i = 0; i < NET_IN_COUNT * SECTIONS_MAX; i++) {
        x[i] = 1e-4 * i;
    }
    const double start = study_seconds();
    for (int k = 0; k < ROUNDS; k++) {
        (void)network_eval(net, sections, x, y);
        x[k % sections] += 1e-9 * y[0]; /* each step needs the one before */
    }
    return 1e9 * (study_seconds() - start) / ((double)ROUNDS * sections);
}

double study_cost_lstm(const struct lstm_def *net)
{
    const struct lstm shape = lstm_shape(net);
    const int rows = lstm_tape_rows(&shape);
    const size_t size = (size_t)rows * (STEPS + 1) + (size_t)(shape.n_in + shape.n_out) * STEPS;
    lanes *tape = aligned_alloc(sizeof(lanes), size * sizeof *tape);
    if (tape == NULL) {
        return (double)NAN;
    }
    memset(tape, 0, size * sizeof *tape);
    lanes *x = tape + (ptrdiff_t)rows * (STEPS + 1), *y = x + (ptrdiff_t)shape.n_in * STEPS;
    const double start = study_seconds();
    for (int k = 0; k < ROUNDS / STEPS; k++) {
        lstm_forward(&shape, net->p, STEPS, x, tape, y);
        memcpy(tape, tape + num_at(0, STEPS, rows), (size_t)rows * sizeof *tape);
    }
    const double seconds = study_seconds() - start;
    free(tape);
    return 1e9 * seconds / ((double)ROUNDS * LANES);
}
