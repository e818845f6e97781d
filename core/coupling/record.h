/* core/coupling/record.h
 * What a march keeps: the history the analysis needs, every step, and the channels the case asks
 * for, every n-th step. The struct owns its memory; it belongs to one thread. */
#ifndef AEROM_CORE_COUPLING_RECORD_H
#define AEROM_CORE_COUPLING_RECORD_H

#include "core/coupling/loads.h"
#include "core/coupling/span_mean.h"

/* Columns of the history; after the fixed ones come n_mode amplitudes and n_mode velocities. */
enum history_column {
    HISTORY_PLUNGE,
    HISTORY_TWIST,
    HISTORY_CL,
    HISTORY_CD,
    HISTORY_CM,
    HISTORY_BENDING, /* in the clamp [N m] */
    HISTORY_MODAL
};

struct record {
    int n_mode;
    int capacity;           /* time steps + 1 */
    int n;                  /* states kept, the initial one included */
    double *history;        /* (capacity x (HISTORY_MODAL + 2 n_mode)) */
    unsigned char *stalled; /* was any station outside the linear range? (capacity) */
    int n_column;
    int sample_capacity;
    int n_sample;
    double *sample;        /* (sample_capacity x n_column) */
    struct span_mean span; /* station values over the window of the means */
};

/* Samples in the last `window` seconds of a march, both ends counted. */
int record_window(double window, double time_step);

MUST_CHECK enum status record_init(const struct model *m, struct record *out);
void record_done(struct record *r);

/* Appends the state in the workspace as time step r->n. */
void record_push(const struct model *m, const struct workspace *w, struct record *r);

/* History column: r->n values, tip plunge [m] and twist [rad], coefficients, modal state. */
static inline const double *record_history(const struct record *r, int column)
{
    return r->history + (ptrdiff_t)r->capacity * column;
}

#endif
