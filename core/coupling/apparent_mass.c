#include "core/coupling/apparent_mass.h"

#include "core/aero/attached.h"
#include "core/la.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

/* I + M_a in the modes in vacuo (n x n). */
static void modal_mass(const struct model *m, double *mass)
{
    const int n = m->n_mode;
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) {
            double sum = j == k ? 1.0 : 0.0;
            for (int i = 0; i < m->n_station; i++) {
                const ptrdiff_t a = num_at(i, j, m->n_station), b = num_at(i, k, m->n_station);
                const double density = m->def.flow.density, chord = m->chord[i];
                sum +=
                    m->station_length *
                    (attached_mass(density, chord) * m->station_v[a] * m->station_v[b] +
                     attached_inertia(density, chord) * m->station_theta[a] * m->station_theta[b]);
            }
            mass[num_at(j, k, n)] = sum;
        }
    }
}

/* x (rows x n) := x t, row by row. */
static void turn_columns(int rows, int n, const double *t, double *x)
{
    double row[LIMIT_MODES];
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < n; j++) {
            row[j] = 0.0;
            for (int k = 0; k < n; k++) {
                row[j] += x[num_at(i, k, rows)] * t[num_at(k, j, n)];
            }
        }
        for (int j = 0; j < n; j++) {
            x[num_at(i, j, rows)] = row[j];
        }
    }
}

static void turn_tip(int n, const double *t, struct beam_motion *tip)
{
    enum { PARTS = sizeof(struct beam_motion) / sizeof(double) };
    double part[PARTS * LIMIT_MODES];
    for (int j = 0; j < n; j++) {
        const double value[PARTS] = {tip[j].u,   tip[j].v,     tip[j].w,         tip[j].psi,
                                     tip[j].phi, tip[j].theta, tip[j].theta_rate};
        for (int p = 0; p < PARTS; p++) {
            part[num_at(p, j, PARTS)] = value[p];
        }
    }
    turn_columns(PARTS, n, t, part);
    for (int j = 0; j < n; j++) {
        const double *value = part + num_at(0, j, PARTS);
        tip[j] = (struct beam_motion){.u = value[0],
                                      .v = value[1],
                                      .w = value[2],
                                      .psi = value[3],
                                      .phi = value[4],
                                      .theta = value[5],
                                      .theta_rate = value[6]};
    }
}

/* t' D t of the structural damping; what is off the diagonal becomes a load of the velocities. */
static void turn_damping(struct model *m)
{
    const int n = m->n_mode;
    double own[LIMIT_MODES];
    bool any = false;
    for (int j = 0; j < n; j++) {
        own[j] = m->damping[j];
        any |= own[j] > 0.0;
    }
    if (!any) {
        m->damping_coupling = NULL;
        return;
    }
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) {
            double sum = 0.0;
            for (int l = 0; l < n; l++) {
                sum += m->to_vacuo[num_at(l, j, n)] * own[l] * m->to_vacuo[num_at(l, k, n)];
            }
            m->damping_coupling[num_at(j, k, n)] = j == k ? 0.0 : sum;
            if (j == k) {
                m->damping[j] = sum;
            }
        }
    }
}

/* Mode j of the new ones is mostly mode j of the old ones, with the same sign. */
static void fix_signs(int n, double *t)
{
    for (int j = 0; j < n; j++) {
        int largest = 0;
        for (int k = 1; k < n; k++) {
            largest = fabs(t[num_at(k, j, n)]) > fabs(t[num_at(largest, j, n)]) ? k : largest;
        }
        const double sign = t[num_at(largest, j, n)] < 0.0 ? -1.0 : 1.0;
        for (int k = 0; k < n; k++) {
            t[num_at(k, j, n)] *= sign;
        }
    }
}

enum status apparent_mass_apply(struct model *m)
{
    const int n = m->n_mode;
    const size_t square = (size_t)n * (size_t)n;
    double *block = malloc(2 * square * sizeof *block);
    m->to_vacuo = malloc(2 * square * sizeof *m->to_vacuo);
    if (block == NULL || m->to_vacuo == NULL) {
        free(block);
        return ST_NO_MEMORY;
    }
    m->damping_coupling = m->to_vacuo + square;
    double *mass = block, *stiffness = block + square;
    modal_mass(m, mass);
    memset(stiffness, 0, square * sizeof *stiffness);
    for (int j = 0; j < n; j++) {
        stiffness[num_at(j, j, n)] = m->omega2[j];
    }
    const enum status st = la_smallest_modes(n, stiffness, mass, n, m->omega2, m->to_vacuo);
    free(block);
    if (st != ST_OK) {
        return st;
    }
    fix_signs(n, m->to_vacuo);
    turn_columns(m->n_station, n, m->to_vacuo, m->station_u);
    turn_columns(m->n_station, n, m->to_vacuo, m->station_v);
    turn_columns(m->n_station, n, m->to_vacuo, m->station_theta);
    turn_columns(1, n, m->to_vacuo, m->gravity);
    turn_tip(n, m->to_vacuo, m->tip);
    turn_damping(m);
    return ST_OK;
}

void apparent_mass_to_vacuo(const struct model *m, const double *q, double *vacuo)
{
    const int n = m->n_mode;
    if (m->to_vacuo == NULL) {
        memcpy(vacuo, q, (size_t)n * sizeof *q);
        return;
    }
    for (int j = 0; j < n; j++) {
        vacuo[j] = 0.0;
        for (int k = 0; k < n; k++) {
            vacuo[j] += m->to_vacuo[num_at(j, k, n)] * q[k];
        }
    }
}

/* t' (I + M_a) t = I, so the inverse of t is t' (I + M_a); the stiffness says the same without the
 * mass: t' Omega^2 t = Omega_air^2, hence q = Omega_air^-2 t' Omega^2 vacuo. */
void apparent_mass_from_vacuo(const struct model *m, const double *vacuo, double *q)
{
    const int n = m->n_mode;
    if (m->to_vacuo == NULL) {
        memcpy(q, vacuo, (size_t)n * sizeof *q);
        return;
    }
    for (int j = 0; j < n; j++) {
        double sum = 0.0;
        for (int k = 0; k < n; k++) {
            sum += m->to_vacuo[num_at(k, j, n)] * num_sq(m->modes.omega[k]) * vacuo[k];
        }
        q[j] = sum / m->omega2[j];
    }
}
