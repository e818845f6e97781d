#include "core/network/adam.h"

#include "core/num.h"

#include <stdlib.h>

/* The constants Kingma & Ba recommend: memory of the mean and of the square, and the guard. */
static const double memory_mean = 0.9, memory_square = 0.999, guard = 1e-8;

enum status adam_init(int count, double rate, double decay, struct adam *s)
{
    double *block = calloc(2 * (size_t)count, sizeof *block);
    if (block == NULL) {
        return ST_NO_MEMORY;
    }
    *s = (struct adam){.count = count,
                       .rate = rate,
                       .weight = decay / count,
                       .mean = block,
                       .square = block + count,
                       .power_mean = 1.0,
                       .power_square = 1.0};
    return ST_OK;
}

void adam_done(struct adam *s)
{
    free(s->mean);
    *s = (struct adam){0};
}

void adam_step(struct adam *s, const double *g, double *p)
{
    s->power_mean *= memory_mean;
    s->power_square *= memory_square;
    for (int i = 0; i < s->count; i++) {
        const double slope = g[i] + 2.0 * s->weight * p[i];
        s->mean[i] = memory_mean * s->mean[i] + (1.0 - memory_mean) * slope;
        s->square[i] = memory_square * s->square[i] + (1.0 - memory_square) * slope * slope;
        const double mean = s->mean[i] / (1.0 - s->power_mean);
        const double square = s->square[i] / (1.0 - s->power_square);
        p[i] -= s->rate * mean / (sqrt(square) + guard);
    }
}
