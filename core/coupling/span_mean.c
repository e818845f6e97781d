#include "core/coupling/span_mean.h"

#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum status span_mean_init(int n_station, int window, int n_sample, struct span_mean *out)
{
    assert(window >= 1);
    assert(n_sample >= 1);
    struct span_mean s = {.n_station = n_station,
                          .window = window,
                          .block = (window - 1) / SPAN_WINDOW_BLOCKS + 1,
                          .anchor = n_sample > window ? n_sample - window : 0};
    s.sum = calloc((size_t)n_station * SPAN_VALUES * SPAN_BLOCKS, sizeof *s.sum);
    if (s.sum == NULL) {
        return ST_NO_MEMORY;
    }
    *out = s;
    return ST_OK;
}

void span_mean_done(struct span_mean *s)
{
    free(s->sum);
    *s = (struct span_mean){0};
}

/* Number of the block a sample is in, counted from some block before the first sample. */
static int block_of(const struct span_mean *s, int sample)
{
    const int before = s->anchor / s->block + 1;
    return (sample - s->anchor + before * s->block) / s->block;
}

static int first_of(const struct span_mean *s, int block)
{
    const int before = s->anchor / s->block + 1;
    const int first = s->anchor + (block - before) * s->block;
    return first > 0 ? first : 0;
}

static double *slot(const struct span_mean *s, int block)
{
    return s->sum + (ptrdiff_t)(block % SPAN_BLOCKS) * s->n_station * SPAN_VALUES;
}

void span_mean_push(struct span_mean *s, const double *const value[SPAN_VALUES])
{
    const int block = block_of(s, s->n);
    double *sum = slot(s, block);
    if (s->n == first_of(s, block)) {
        memset(sum, 0, (size_t)s->n_station * SPAN_VALUES * sizeof *sum);
    }
    for (int k = 0; k < SPAN_VALUES; k++) {
        double *restrict to = sum + num_at(0, k, s->n_station);
        for (int i = 0; i < s->n_station; i++) {
            to[i] += value[k][i];
        }
    }
    s->n++;
}

int span_mean_get(const struct span_mean *s, double *out)
{
    assert(s->n >= 1);
    const int wanted = s->n > s->window ? s->n - s->window : 0;
    const int first = block_of(s, wanted), last = block_of(s, s->n - 1);
    const int from = first_of(s, first), values = s->n_station * SPAN_VALUES;
    for (int k = 0; k < values; k++) {
        double sum = 0.0;
        for (int b = first; b <= last; b++) {
            sum += slot(s, b)[k];
        }
        out[k] = sum / (s->n - from);
    }
    return from;
}
