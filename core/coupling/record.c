#include "core/coupling/record.h"

#include "core/coupling/apparent_mass.h"
#include "core/coupling/excitation.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>

int record_window(double window, double time_step)
{
    return (int)fmin(floor(window / time_step + 0.5), LIMIT_STEPS) + 1;
}

enum status record_init(const struct model *m, struct record *out)
{
    struct record r = {.n_mode = m->n_mode,
                       .capacity = case_def_steps(&m->def) + 1,
                       .sample_capacity = case_def_samples(&m->def)};
    for (int i = 0; i < m->def.output.n_channel; i++) {
        r.n_column += case_def_channel_columns(&m->def, m->def.output.channel[i]);
    }
    const size_t rows = (size_t)r.capacity;
    r.history = malloc(rows * (size_t)(HISTORY_MODAL + 2 * r.n_mode) * sizeof *r.history);
    r.stalled = malloc(rows);
    r.sample = malloc((size_t)r.sample_capacity * (size_t)(r.n_column + 1) * sizeof *r.sample);
    const int window = record_window(m->def.output.mean_window, m->def.solver.time_step);
    const enum status st = span_mean_init(m->n_station, window, r.capacity, &r.span);
    if (r.history == NULL || r.stalled == NULL || r.sample == NULL || st != ST_OK) {
        record_done(&r);
        return ST_NO_MEMORY;
    }
    *out = r;
    return ST_OK;
}

void record_done(struct record *r)
{
    free(r->history);
    free(r->stalled);
    free(r->sample);
    span_mean_done(&r->span);
    *r = (struct record){0};
}

struct tip_state {
    double plunge, twist, chordwise;
    double bending; /* in the clamp */
};

static struct tip_state tip_of(const struct model *m, const struct workspace *w)
{
    const double arm = beam_def_mid_chord_at(&m->def.beam, m->def.beam.length).x;
    struct tip_state tip = {.plunge = w->root_plunge.value + arm * w->root_pitch.value,
                            .twist = w->root_pitch.value,
                            .bending = excitation_root_bending(m, w)};
    for (int j = 0; j < m->n_mode; j++) {
        tip.plunge += m->tip[j].v * w->q[j];
        tip.twist += m->tip[j].theta * w->q[j];
        tip.chordwise += m->tip[j].u * w->q[j];
    }
    return tip;
}

/* Writes the columns of a channel into row `row` of the sample table; returns how many. */
static int put_vector(struct record *r, int row, int column, int n, const double *x, double factor)
{
    for (int i = 0; i < n; i++) {
        r->sample[num_at(row, column + i, r->sample_capacity)] = factor * x[i];
    }
    return n;
}

static int put_channel(const struct model *m, const struct workspace *w, enum channel channel,
                       const struct tip_state *tip, const struct load_totals *total,
                       const double *modal, struct record *r, int column)
{
    const int row = r->n_sample, nm = m->n_mode, ns = m->n_station;
    switch (channel) {
    case CHANNEL_TIP_PLUNGE:
        return put_vector(r, row, column, 1, &tip->plunge, 1.0);
    case CHANNEL_TIP_TWIST:
        return put_vector(r, row, column, 1, &tip->twist, 1.0);
    case CHANNEL_TIP_CHORDWISE:
        return put_vector(r, row, column, 1, &tip->chordwise, 1.0);
    case CHANNEL_LIFT:
        return put_vector(r, row, column, 1, &total->lift, 1.0);
    case CHANNEL_DRAG:
        return put_vector(r, row, column, 1, &total->drag, 1.0);
    case CHANNEL_MOMENT:
        return put_vector(r, row, column, 1, &total->moment, 1.0);
    case CHANNEL_CL:
        return put_vector(r, row, column, 1, &total->cl, 1.0);
    case CHANNEL_CD:
        return put_vector(r, row, column, 1, &total->cd, 1.0);
    case CHANNEL_CM:
        return put_vector(r, row, column, 1, &total->cm, 1.0);
    case CHANNEL_EFFICIENCY: {
        const double efficiency = total->lift / total->drag;
        return put_vector(r, row, column, 1, &efficiency, 1.0);
    }
    case CHANNEL_ROOT_BENDING:
        return put_vector(r, row, column, 1, &tip->bending, 1.0);
    case CHANNEL_GUST:
        return put_vector(r, row, column, 1, &w->gust, 1.0);
    case CHANNEL_ROOT_PITCH:
        return put_vector(r, row, column, 1, &w->root_pitch.value, 1.0);
    case CHANNEL_ROOT_PLUNGE:
        return put_vector(r, row, column, 1, &w->root_plunge.value, 1.0);
    case CHANNEL_MODAL_AMPLITUDE:
        return put_vector(r, row, column, nm, modal, 1.0);
    case CHANNEL_MODAL_VELOCITY:
        return put_vector(r, row, column, nm, modal + nm, 1.0);
    case CHANNEL_STATION_PLUNGE: {
        double plunge[LIMIT_ELEMENTS];
        for (int i = 0; i < ns; i++) {
            plunge[i] = w->plunge[i] * m->chord[i];
        }
        return put_vector(r, row, column, ns, plunge, 1.0);
    }
    case CHANNEL_STATION_TWIST:
        return put_vector(r, row, column, ns, w->twist, 1.0);
    case CHANNEL_STATION_ALPHA:
        return put_vector(r, row, column, ns, w->alpha, 1.0);
    case CHANNEL_STATION_INDUCED:
        return put_vector(r, row, column, ns, w->induced, 1.0);
    case CHANNEL_STATION_CL:
        return put_vector(r, row, column, ns, w->cl, 1.0);
    case CHANNEL_STATION_CD:
        return put_vector(r, row, column, ns, w->cd, 1.0);
    case CHANNEL_STATION_CM:
        return put_vector(r, row, column, ns, w->cm, 1.0);
    case CHANNEL_COUNT:
        break;
    }
    assert(false);
    return 0;
}

void record_push(const struct model *m, const struct workspace *w, struct record *r)
{
    assert(r->n < r->capacity);
    const struct tip_state tip = tip_of(m, w);
    const struct load_totals total = loads_total(m, w);
    const double fixed[HISTORY_MODAL] = {tip.plunge, tip.twist, total.cl,
                                         total.cd,   total.cm,  tip.bending};
    for (int k = 0; k < HISTORY_MODAL; k++) {
        r->history[num_at(r->n, k, r->capacity)] = fixed[k];
    }
    double modal[2 * LIMIT_MODES]; /* amplitudes, velocities */
    apparent_mass_to_vacuo(m, w->q, modal);
    apparent_mass_to_vacuo(m, w->qd, modal + r->n_mode);
    for (int j = 0; j < 2 * r->n_mode; j++) {
        r->history[num_at(r->n, HISTORY_MODAL + j, r->capacity)] = modal[j];
    }
    r->stalled[r->n] = w->any_stalled;
    const double *const span[SPAN_VALUES] = {[SPAN_CL] = w->cl,
                                             [SPAN_CD] = w->cd,
                                             [SPAN_CM] = w->cm,
                                             [SPAN_INDUCED] = w->induced,
                                             [SPAN_ALPHA] = w->alpha};
    span_mean_push(&r->span, span);
    if (r->n % m->def.output.sample_every == 0) {
        int column = 0;
        for (int i = 0; i < m->def.output.n_channel; i++) {
            column += put_channel(m, w, m->def.output.channel[i], &tip, &total, modal, r, column);
        }
        r->n_sample++;
    }
    r->n++;
}
