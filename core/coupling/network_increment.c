#include "core/coupling/network_increment.h"

#include "core/num.h"

#include <string.h>

static double *input(struct workspace *w, enum network_input in)
{
    return w->net_in + num_at(0, (int)in, w->n_station);
}

/* The angle of attack a section sees without the lag of its own wake: of the chord in the stream,
 * less the induced angle. A gust counts at once, as a plunge of the section would. */
static void angles(const struct model *m, const struct workspace *w, double *alpha)
{
    const double gust = m->attached.n > 0 ? w->gust / m->def.flow.speed : 0.0;
    for (int i = 0; i < w->n_station; i++) {
        alpha[i] = w->alpha_geometric[i] + gust - w->induced[i];
    }
}

/* Sliding mean over the ring; the sum is made anew each time the ring comes round, so that rounding
 * does not pile up. */
static void advance_mean(struct workspace *w, const double *alpha, bool steady)
{
    const int n = w->n_station;
    double *mean = input(w, NET_IN_MEAN_ALPHA), *delta = input(w, NET_IN_DELTA_ALPHA);
    if (w->window == 0) {
        return; /* the network does not see it */
    }
    if (steady) {
        w->ring_count = 0;
        w->ring_next = 0;
        stations_fill(n, 0.0, w->ring_sum);
    }
    double *slot = w->ring + num_at(0, w->ring_next, n);
    if (w->ring_count == w->window) {
        for (int i = 0; i < n; i++) {
            w->ring_sum[i] -= slot[i];
        }
    } else {
        w->ring_count++;
    }
    for (int i = 0; i < n; i++) {
        slot[i] = alpha[i];
        w->ring_sum[i] += slot[i];
    }
    w->ring_next++;
    if (w->ring_next == w->window) {
        w->ring_next = 0;
        stations_fill(n, 0.0, w->ring_sum);
        for (int k = 0; k < w->window; k++) {
            const double *row = w->ring + num_at(0, k, n);
            for (int i = 0; i < n; i++) {
                w->ring_sum[i] += row[i];
            }
        }
    }
    for (int i = 0; i < n; i++) {
        mean[i] = w->ring_sum[i] / w->ring_count;
        delta[i] = alpha[i] - mean[i];
    }
}

/* alpha_dot c/V and alpha_ddot c^2/V^2 from the modal velocities and accelerations; only the jerk
 * of the plunge is differenced. The slow change of the induced angle is not part of the rates. */
static void rates(const struct model *m, struct workspace *w)
{
    const int n = w->n_station;
    const double speed = m->def.flow.speed, step = m->def.solver.time_step;
    double *rate = input(w, NET_IN_ALPHA_RATE);
    double *acceleration = input(w, NET_IN_ALPHA_ACCELERATION);
    double jerk[LIMIT_MODES];
    for (int j = 0; j < m->n_mode; j++) {
        jerk[j] = (w->qdd[j] - w->qdd_previous[j]) / step;
    }
    for (int i = 0; i < n; i++) {
        rate[i] = w->root_pitch.rate - w->imposed_acceleration[i] / speed +
                  (w->gust - w->gust_previous) / (speed * step);
        acceleration[i] = w->root_pitch.acceleration;
    }
    stations_add(m, m->station_theta, w->qd, 1.0, rate);
    stations_add(m, m->station_v, w->qdd, -1.0 / speed, rate);
    stations_add(m, m->station_theta, w->qdd, 1.0, acceleration);
    stations_add(m, m->station_v, jerk, -1.0 / speed, acceleration);
    for (int i = 0; i < n; i++) {
        const double time = m->chord[i] / speed;
        rate[i] *= time;
        acceleration[i] *= time * time;
    }
    memcpy(input(w, NET_IN_PLUNGE_RATE), w->plunge_rate, (size_t)n * sizeof *rate);
}

void network_increment(const struct model *m, struct workspace *w, bool steady)
{
    const int n = w->n_station;
    double alpha[LIMIT_ELEMENTS];
    if (m->network == NULL) {
        return;
    }
    angles(m, w, alpha);
    advance_mean(w, alpha, steady);
    rates(m, w);
    if (steady) {
        network_memory_steady(&m->network_memory, alpha, w->pitch_rate, w->net_in);
    } else {
        network_memory_step(&m->network_memory, alpha, w->pitch_rate, w->net_in);
    }
    if (m->stall.n > 0) {
        network_stall_inputs(n, w->stall, w->net_in);
    }
    w->counters.outside_hull += network_eval(m->network, n, w->net_in, w->net_out);
    for (int i = 0; i < n; i++) {
        w->cl[i] += w->net_out[num_at(i, NET_OUT_CL, n)];
        w->cd[i] += w->net_out[num_at(i, NET_OUT_CD, n)];
        w->cm[i] += w->net_out[num_at(i, NET_OUT_CM, n)];
    }
}
