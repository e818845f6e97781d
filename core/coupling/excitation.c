#include "core/coupling/excitation.h"

#include "core/aero/attached.h"
#include "core/num.h"

#include <stdlib.h>

/* Participation of mode j in an inertial load: r' m phi_j, with the mass of the air that moves with
 * the stations. r of a station: `lift` up, `turn` nose-up. */
static double air_participation(const struct model *m, int j, enum beam_rigid motion)
{
    double sum = 0.0;
    for (int i = 0; i < m->n_station && m->attached.n > 0; i++) {
        const ptrdiff_t k = num_at(i, j, m->n_station);
        const double density = m->def.flow.density, chord = m->chord[i];
        const double z = (i + 0.5) * m->station_length;
        const double arm = m->excitation.mid_chord[i];
        const double up = motion == RIGID_FLAP ? z : (motion == RIGID_TWIST ? arm : 1.0);
        const double turn = motion == RIGID_TWIST ? 1.0 : 0.0;
        sum += m->station_length * (attached_mass(density, chord) * up * m->station_v[k] +
                                    attached_inertia(density, chord) * turn * m->station_theta[k]);
    }
    return sum;
}

/* Of the structure, in the modes that are marched in. */
static void beam_participation(const struct model *m, enum beam_rigid motion, double *out)
{
    double vacuo[LIMIT_MODES];
    for (int j = 0; j < m->n_mode; j++) {
        const double *shape = m->modes.shape + (size_t)j * (size_t)m->modes.n_dof;
        vacuo[j] = 0.0;
        for (int i = 0; i < m->beam.n_dof; i++) {
            vacuo[j] += m->beam.inertia[num_at(i, (int)motion, m->beam.n_dof)] * shape[i];
        }
    }
    for (int j = 0; j < m->n_mode; j++) {
        out[j] = m->to_vacuo == NULL ? vacuo[j] : 0.0;
        for (int k = 0; k < m->n_mode && m->to_vacuo != NULL; k++) {
            out[j] += vacuo[k] * m->to_vacuo[num_at(k, j, m->n_mode)];
        }
    }
}

/* Bending moment in the clamp per unit acceleration of a rigid motion, the air included. */
static double rigid_bending(const struct model *m, enum beam_rigid motion)
{
    double sum = beam_rigid_inertia(&m->beam, RIGID_FLAP, motion);
    for (int i = 0; i < m->n_station && m->attached.n > 0; i++) {
        const double up = motion == RIGID_TWIST ? m->excitation.mid_chord[i] : 1.0;
        sum += m->station_length * attached_mass(m->def.flow.density, m->chord[i]) * (i + 0.5) *
               m->station_length * up;
    }
    return sum;
}

enum status excitation_allocate(struct model *m)
{
    struct excitation *e = &m->excitation;
    const size_t nm = (size_t)m->n_mode, ns = (size_t)m->n_station;
    e->mid_chord = calloc(ns + 3 * nm, sizeof *e->mid_chord);
    if (e->mid_chord == NULL) {
        return ST_NO_MEMORY;
    }
    e->plunge = e->mid_chord + ns;
    e->pitch = e->plunge + nm;
    e->bending = e->pitch + nm;
    return ST_OK;
}

enum status excitation_build(struct model *m)
{
    struct excitation *e = &m->excitation;
    const enum status st = excitation_allocate(m);
    if (st != ST_OK) {
        return st;
    }
    for (int i = 0; i < m->n_station; i++) {
        e->mid_chord[i] = beam_def_mid_chord_at(&m->def.beam, (i + 0.5) * m->station_length).x;
    }
    static const enum beam_rigid motion[3] = {RIGID_V, RIGID_TWIST, RIGID_FLAP};
    double *const part[3] = {e->plunge, e->pitch, e->bending};
    for (int k = 0; k < 3; k++) {
        beam_participation(m, motion[k], part[k]);
        for (int j = 0; j < m->n_mode; j++) {
            part[k][j] += air_participation(m, j, motion[k]);
        }
    }
    e->bending_plunge = rigid_bending(m, RIGID_V);
    e->bending_pitch = rigid_bending(m, RIGID_TWIST);
    e->bending_weight = m->def.beam.gravity[1] * beam_rigid_inertia(&m->beam, RIGID_FLAP, RIGID_V);
    drive_init(&m->def.beam.root_pitch, &e->root_pitch);
    drive_init(&m->def.beam.root_plunge, &e->root_plunge);
    if (m->def.flow.gust.given && m->attached.n > 0) {
        return kuessner_init(m->n_station, m->chord, m->def.flow.speed, m->def.solver.time_step,
                             &e->kuessner);
    }
    return ST_OK;
}

static void set_root(const struct model *m, double t, struct workspace *w)
{
    const struct excitation *e = &m->excitation;
    const struct drive_state pitch = drive_at(&e->root_pitch, t);
    const struct drive_state plunge = drive_at(&e->root_plunge, t);
    w->root_pitch = pitch;
    w->axes_cos = cos(m->def.flow.incidence + pitch.value);
    w->axes_sin = sin(m->def.flow.incidence + pitch.value);
    w->root_plunge = plunge;
    for (int i = 0; i < w->n_station; i++) {
        const double arm = e->mid_chord[i];
        w->imposed_twist[i] = pitch.value;
        w->imposed_plunge[i] = plunge.value + arm * pitch.value;
        w->imposed_plunge_rate[i] = plunge.rate + arm * pitch.rate;
        w->imposed_acceleration[i] = plunge.acceleration + arm * pitch.acceleration;
    }
    for (int j = 0; j < w->n_mode; j++) {
        w->imposed_load[j] = -e->plunge[j] * plunge.acceleration - e->pitch[j] * pitch.acceleration;
    }
}

void excitation_set(const struct model *m, double t, struct workspace *w)
{
    if (m->def.flow.gust.given) {
        w->gust_previous = w->gust;
        w->gust = gust_at(&m->def.flow.gust, m->def.flow.speed, t);
    }
    if (m->def.beam.root_pitch.given || m->def.beam.root_plunge.given) {
        set_root(m, t, w);
    }
}

double excitation_root_bending(const struct model *m, const struct workspace *w)
{
    const struct excitation *e = &m->excitation;
    double sum = e->bending_weight - e->bending_plunge * w->root_plunge.acceleration -
                 e->bending_pitch * w->root_pitch.acceleration;
    for (int i = 0; i < w->n_station; i++) {
        sum += (i + 0.5) * num_sq(m->station_length) * w->force_y[i];
    }
    for (int j = 0; j < w->n_mode; j++) {
        sum -= e->bending[j] * w->qdd[j];
    }
    return sum;
}
