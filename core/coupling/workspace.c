#include "core/coupling/workspace.h"

#include "core/num.h"

#include <stdlib.h>
#include <string.h>

enum { ALIGN_DOUBLES = 8 }; /* 64 bytes */

static size_t padded(size_t n)
{
    return (n + ALIGN_DOUBLES - 1) / ALIGN_DOUBLES * ALIGN_DOUBLES;
}

void stations_add(const struct model *m, const double *shape, const double *modal, double factor,
                  double *restrict out)
{
    for (int j = 0; j < m->n_mode; j++) {
        const double *restrict column = shape + num_at(0, j, m->n_station);
        const double a = factor * modal[j];
        for (int i = 0; i < m->n_station; i++) {
            out[i] += a * column[i];
        }
    }
}

void stations_fill(int n, double value, double *x)
{
    for (int i = 0; i < n; i++) {
        x[i] = value;
    }
}

/* Time steps of the sliding mean: one period of the first mode, and no more than the run has. */
static enum status size_window(const struct model *m, int *window)
{
    const struct network_def *net = m->def.aero.network;
    if (m->network == NULL ||
        !(network_def_uses(net, NET_IN_MEAN_ALPHA) || network_def_uses(net, NET_IN_DELTA_ALPHA))) {
        return ST_OK;
    }
    const double period = 2.0 * NUM_PI / m->modes.omega[0];
    const double steps = period / m->def.solver.time_step;
    const int run = case_def_steps(&m->def) + 1;
    *window = steps < run ? (int)fmax(1.0, floor(steps + 0.5)) : run;
    return (size_t)m->n_station * (size_t)*window > LIMIT_SERIES_VALUES ? ST_LIMIT : ST_OK;
}

/* One aligned, zeroed block for all arrays. */
static enum status allocate(const struct model *m, struct workspace *w)
{
    const size_t nm = (size_t)m->n_mode, ns = (size_t)m->n_station;
    struct {
        double **array;
        size_t size;
    } const part[] = {
        {&w->q, nm},
        {&w->qd, nm},
        {&w->qdd, nm},
        {&w->qdd_previous, nm},
        {&w->plunge, ns},
        {&w->plunge_rate, ns},
        {&w->twist, ns},
        {&w->imposed_twist, ns},
        {&w->imposed_plunge, ns},
        {&w->imposed_plunge_rate, ns},
        {&w->imposed_acceleration, ns},
        {&w->gust_lag, m->excitation.kuessner.n > 0 ? ns * KUESSNER_LAGS : 0},
        {&w->alpha_geometric, ns},
        {&w->pitch_rate, ns},
        {&w->alpha_34, ns},
        {&w->alpha_34_previous, ns},
        {&w->wake, ns * ATTACHED_LAGS},
        {&w->alpha_wake, ns},
        {&w->alpha, ns},
        {&w->induced, ns},
        {&w->stall, m->stall.n > 0 ? ns * STALL_ARRAYS : 0},
        {&w->net_in, m->network != NULL ? ns * NET_IN_COUNT : 0},
        {&w->net_out, m->network != NULL ? ns * NET_OUT_COUNT : 0},
        {&w->cl, ns},
        {&w->cd, ns},
        {&w->cm, ns},
        {&w->force_x, ns},
        {&w->force_y, ns},
        {&w->moment, ns},
        {&w->ring, ns * (size_t)w->window},
        {&w->ring_sum, ns},
        {&w->load, nm},
        {&w->imposed_load, nm},
    };
    size_t total = 0;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        total += padded(part[i].size);
    }
    w->block = aligned_alloc(64, total * sizeof *w->block);
    if (w->block == NULL) {
        return ST_NO_MEMORY;
    }
    memset(w->block, 0, total * sizeof *w->block);
    double *next = w->block;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i].array = next;
        next += padded(part[i].size);
    }
    return ST_OK;
}

enum status workspace_init(const struct model *m, struct workspace *out)
{
    struct workspace w = {.n_mode = m->n_mode,
                          .n_station = m->n_station,
                          .axes_cos = cos(m->def.flow.incidence),
                          .axes_sin = sin(m->def.flow.incidence)};
    enum status st = size_window(m, &w.window);
    if (st != ST_OK) {
        return st;
    }
    st = allocate(m, &w);
    if (st == ST_OK && m->lifting_line.n > 0) {
        st = lifting_line_state_init(m->n_station, &w.lifting_line);
    }
    if (st != ST_OK) {
        workspace_done(&w);
        return st;
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
