#include "core/coupling/loads.h"

#include "core/coupling/network_increment.h"
#include "core/num.h"

#include <assert.h>
#include <string.h>

/* alpha_s = alpha_0 + theta - v_dot/V, plunge v/c and v_dot/V; a gust acts at once where no wake
 * lags. */
static void kinematics(const struct model *m, struct workspace *w)
{
    const int n = w->n_station;
    const double speed = m->def.flow.speed;
    const double sudden = m->attached.n == 0 ? w->gust / speed : 0.0;
    memcpy(w->plunge, w->imposed_plunge, (size_t)n * sizeof *w->plunge);
    memcpy(w->twist, w->imposed_twist, (size_t)n * sizeof *w->twist);
    for (int i = 0; i < n; i++) {
        w->plunge_rate[i] = w->imposed_plunge_rate[i] / speed;
    }
    stations_add(m, m->station_v, w->q, 1.0, w->plunge);
    stations_add(m, m->station_v, w->qd, 1.0 / speed, w->plunge_rate);
    stations_add(m, m->station_theta, w->q, 1.0, w->twist);
    for (int i = 0; i < n; i++) {
        w->alpha_geometric[i] = m->def.flow.incidence + w->twist[i] - w->plunge_rate[i] + sudden;
        w->plunge[i] /= m->chord[i];
    }
}

/* theta_dot c/V. */
static void pitch_rates(const struct model *m, struct workspace *w)
{
    const double speed = m->def.flow.speed;
    stations_fill(w->n_station, w->root_pitch.rate / speed, w->pitch_rate);
    stations_add(m, m->station_theta, w->qd, 1.0 / speed, w->pitch_rate);
    for (int i = 0; i < w->n_station; i++) {
        w->pitch_rate[i] *= m->chord[i];
    }
}

/* What of the gust acts on sections that it meets from the leading edge on. */
static void gust_lag(const struct model *m, struct workspace *w, bool steady)
{
    const struct kuessner *k = &m->excitation.kuessner;
    const double speed = m->def.flow.speed;
    if (k->n == 0) {
        return;
    }
    if (steady) {
        kuessner_steady(k, w->gust / speed, w->gust_lag);
    } else {
        kuessner_step(k, w->gust_previous / speed, w->gust / speed, w->gust_lag);
    }
    kuessner_add(k, w->gust_lag, w->alpha_wake);
}

/* alpha_34 = alpha_s + c theta_dot/(4 V) and what the wake lets act of it. */
static void wake_lag(const struct model *m, struct workspace *w, bool steady)
{
    const int n = w->n_station;
    if (m->attached.n == 0) {
        return;
    }
    memcpy(w->alpha_34_previous, w->alpha_34, (size_t)n * sizeof *w->alpha_34);
    for (int i = 0; i < n; i++) {
        w->alpha_34[i] = w->alpha_geometric[i] + 0.25 * w->pitch_rate[i];
    }
    if (steady) {
        attached_steady(n, w->alpha_34, w->wake);
    } else {
        attached_step(&m->attached, w->alpha_34_previous, w->alpha_34, w->wake);
    }
    attached_angle(n, w->alpha_34, w->wake, w->alpha_wake);
    gust_lag(m, w, steady);
}

static void solve_induced(const struct model *m, struct workspace *w)
{
    const size_t bytes = (size_t)w->n_station * sizeof *w->alpha;
    const double *angle = m->attached.n > 0 ? w->alpha_wake : w->alpha_geometric;
    if (m->lifting_line.n == 0) {
        memcpy(w->alpha, angle, bytes);
        return; /* w->induced stays zero */
    }
    const struct lifting_line_report r =
        lifting_line_solve(&m->lifting_line, m->polar, angle, w->plunge, &w->lifting_line);
    memcpy(w->alpha, w->lifting_line.alpha, bytes);
    memcpy(w->induced, w->lifting_line.induced, bytes);
    w->counters.not_converged += !r.converged;
    w->counters.lifting_line_iterations += r.iterations;
    w->counters.lifting_line_residual = fmax(w->counters.lifting_line_residual, r.residual);
    w->counters.lifting_line_regularised += r.smoothing > 0.0;
    w->counters.lifting_line_smoothing = fmax(w->counters.lifting_line_smoothing, r.smoothing);
}

static void steady_coefficients(const struct model *m, struct workspace *w)
{
    w->any_outside = false;
    w->any_stalled = false;
    for (int i = 0; i < w->n_station; i++) {
        const struct polar_value v = polar_at(m->polar, w->alpha[i], w->plunge[i]);
        w->cl[i] = v.cl;
        w->cd[i] = v.cd;
        w->cm[i] = v.cm;
        w->counters.outside_polar += v.outside;
        w->any_outside |= v.outside_alpha;
        w->any_stalled |= polar_is_stalled(m->polar, w->alpha[i]);
    }
}

/* The coefficients of a section whose boundary layer lags. */
static void stall_increment(const struct model *m, struct workspace *w, bool steady)
{
    if (m->stall.n == 0) {
        return;
    }
    if (steady) {
        dynamic_stall_steady(&m->stall, w->alpha, w->plunge, w->stall);
    } else {
        dynamic_stall_step(&m->stall, w->alpha, w->plunge, w->stall);
    }
    dynamic_stall_coefficients(&m->stall, w->alpha, w->stall, w->cl, w->cd, w->cm);
}

/* The lift is normal to the local stream, which the induced angle tilts. */
static void induced_drag(struct workspace *w)
{
    for (int i = 0; i < w->n_station; i++) {
        w->cd[i] += w->cl[i] * w->induced[i];
    }
}

/* Apparent mass in phase with the pitch rate. */
static void pitch_rate_increment(const struct model *m, struct workspace *w)
{
    if (m->attached.n == 0) {
        return;
    }
    for (int i = 0; i < w->n_station; i++) {
        w->cl[i] += attached_cl_rate() * w->pitch_rate[i];
        w->cm[i] += attached_cm_rate() * w->pitch_rate[i];
    }
}

/* Apparent mass in phase with the accelerations: part of the coefficients that are reported, but of
 * the mass, not the loads, of the modal equations. */
static void report_apparent_mass(const struct model *m, struct workspace *w)
{
    if (m->attached.n == 0) {
        return;
    }
    const int n = w->n_station;
    double plunge[LIMIT_ELEMENTS], pitch[LIMIT_ELEMENTS];
    memcpy(plunge, w->imposed_acceleration, (size_t)n * sizeof *plunge);
    stations_fill(n, w->root_pitch.acceleration, pitch);
    stations_add(m, m->station_v, w->qdd, 1.0, plunge);
    stations_add(m, m->station_theta, w->qdd, 1.0, pitch);
    for (int i = 0; i < n; i++) {
        const double density = m->def.flow.density, chord = m->chord[i];
        const double force = m->dynamic_pressure * chord;
        w->cl[i] -= attached_mass(density, chord) * plunge[i] / force;
        w->cm[i] -= attached_inertia(density, chord) * pitch[i] / (force * chord);
    }
}

/* Lift normal to the undisturbed stream and drag along it, turned into the beam frame;
 * then the modal loads, Eq. (C.5). */
static void modal_loads(const struct model *m, struct workspace *w)
{
    const double q = m->dynamic_pressure;
    const double c = w->axes_cos, s = w->axes_sin;
    for (int i = 0; i < w->n_station; i++) {
        const double chord = m->chord[i];
        const double lift = q * chord * w->cl[i], drag = q * chord * w->cd[i];
        w->force_x[i] = lift * s - drag * c;
        w->force_y[i] = lift * c + drag * s;
        w->moment[i] = q * chord * chord * w->cm[i];
    }
    for (int j = 0; j < m->n_mode; j++) {
        const double *restrict u = m->station_u + num_at(0, j, w->n_station);
        const double *restrict v = m->station_v + num_at(0, j, w->n_station);
        const double *restrict theta = m->station_theta + num_at(0, j, w->n_station);
        double sum = 0.0;
        for (int i = 0; i < w->n_station; i++) {
            sum += u[i] * w->force_x[i] + v[i] * w->force_y[i] + theta[i] * w->moment[i];
        }
        w->load[j] = sum * m->station_length + m->gravity[j] + w->imposed_load[j];
        for (int k = 0; k < m->n_mode && m->damping_coupling != NULL; k++) {
            w->load[j] -= m->damping_coupling[num_at(j, k, m->n_mode)] * w->qd[k];
        }
    }
}

void loads_evaluate(const struct model *m, struct workspace *w, bool steady)
{
    assert(w->n_mode == m->n_mode);
    kinematics(m, w);
    if (m->attached.n > 0 || m->network != NULL) {
        pitch_rates(m, w);
    }
    wake_lag(m, w, steady);
    solve_induced(m, w);
    steady_coefficients(m, w);
    stall_increment(m, w, steady);
    induced_drag(w);
    network_increment(m, w, steady);
    pitch_rate_increment(m, w);
    modal_loads(m, w);
    report_apparent_mass(m, w);
}

struct load_totals loads_total(const struct model *m, const struct workspace *w)
{
    /* Sums of c c_l, c c_d and c^2 c_m over the span; the mean chord is area over length. */
    double cl = 0.0, cd = 0.0, cm = 0.0;
    for (int i = 0; i < w->n_station; i++) {
        const double chord = m->chord[i];
        cl += chord * w->cl[i];
        cd += chord * w->cd[i];
        cm += chord * chord * w->cm[i];
    }
    const double q = m->dynamic_pressure, mean_chord = m->area / m->def.beam.length;
    const double lift = q * m->station_length * cl, drag = q * m->station_length * cd;
    const double moment = q * m->station_length * cm;
    return (struct load_totals){.lift = lift,
                                .drag = drag,
                                .moment = moment,
                                .cl = lift / (q * m->area),
                                .cd = drag / (q * m->area),
                                .cm = moment / (q * m->area * mean_chord)};
}
