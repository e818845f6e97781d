#include "core/coupling/workspace.h"

#include "core/num.h"

#include <stdlib.h>
#include <string.h>

enum { ALIGN_DOUBLES = 8 }; /* 64 bytes */

static size_t padded(size_t n)
{
    return (n + ALIGN_DOUBLES - 1) / ALIGN_DOUBLES * ALIGN_DOUBLES;
}

enum status workspace_init(const struct model *m, struct workspace *out)
{
    struct workspace w = {.n_mode = m->n_mode, .n_station = m->n_station};
    const size_t nm = (size_t)m->n_mode, ns = (size_t)m->n_station;
    if (m->network != NULL) {
        const double period = 2.0 * NUM_PI / m->modes.omega[0];
        const double steps = period / m->def.solver.time_step;
        const int run = case_def_steps(&m->def) + 1;
        /* A window longer than the run is never filled. */
        w.window = steps < run ? (int)fmax(1.0, floor(steps + 0.5)) : run;
        if (ns * (size_t)w.window > LIMIT_SERIES_VALUES) {
            return ST_LIMIT;
        }
    }
    struct {
        double **array;
        size_t size;
    } const part[] = {
        {&w.q, nm},
        {&w.qd, nm},
        {&w.qdd, nm},
        {&w.qdd_previous, nm},
        {&w.plunge, ns},
        {&w.plunge_rate, ns},
        {&w.alpha_geometric, ns},
        {&w.alpha, ns},
        {&w.induced, ns},
        {&w.net_in, ns * NET_IN_COUNT},
        {&w.net_out, ns * NET_OUT_COUNT},
        {&w.cl, ns},
        {&w.cd, ns},
        {&w.cm, ns},
        {&w.force_x, ns},
        {&w.force_y, ns},
        {&w.moment, ns},
        {&w.ring, ns * (size_t)w.window},
        {&w.ring_sum, ns},
        {&w.load, nm},
    };
    size_t total = 0;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        total += padded(part[i].size);
    }
    w.block = aligned_alloc(64, total * sizeof *w.block);
    if (w.block == NULL) {
        return ST_NO_MEMORY;
    }
    memset(w.block, 0, total * sizeof *w.block);
    double *next = w.block;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i].array = next;
        next += padded(part[i].size);
    }
    if (m->lifting_line.n > 0) {
        const enum status st = lifting_line_state_init(m->n_station, &w.lifting_line);
        if (st != ST_OK) {
            free(w.block);
            return st;
        }
    }
    *out = w;
    return ST_OK;
}

void workspace_done(struct workspace *w)
{
    free(w->block);
    lifting_line_state_done(&w->lifting_line);
    *w = (struct workspace){0};
}
