#include "core/analysis/equilibrium.h"

#include "core/la.h"
#include "core/num.h"

#include <string.h>

enum { ITERATIONS_MAX = 60, HALVINGS = 12 };
static const double tolerance = 1e-11; /* residual over load, in the energy norm */

/* Load of c_l = 1e-9 everywhere, in the energy norm: less than that is rounding. A beam that is in
 * equilibrium undeformed has nothing else to measure its residual by. */
static double smallest_load(const struct model *m)
{
    double sum = 0.0;
    for (int j = 0; j < m->n_mode; j++) {
        double load = 0.0;
        for (int i = 0; i < m->n_station; i++) {
            load += m->chord[i] * m->station_v[num_at(i, j, m->n_station)];
        }
        sum += num_sq(1e-9 * m->dynamic_pressure * m->station_length * load) / m->omega2[j];
    }
    return sum;
}

/* r = omega^2 q - load(q); returns its size relative to the load. */
static double residual_of(const struct model *m, struct workspace *w, double *r)
{
    loads_evaluate(m, w, true);
    double left = 0.0, size = 1e-300 + smallest_load(m);
    for (int j = 0; j < m->n_mode; j++) {
        r[j] = m->omega2[j] * w->q[j] - w->load[j];
        left += r[j] * r[j] / m->omega2[j];
        size += w->load[j] * w->load[j] / m->omega2[j];
    }
    return sqrt(left / size);
}

/* Jacobian by forward differences: n_mode more evaluations. */
static void jacobian(const struct model *m, struct workspace *w, const double *r, double *jac)
{
    const int n = m->n_mode;
    double shifted[LIMIT_MODES];
    for (int j = 0; j < n; j++) {
        const double keep = w->q[j];
        /* A step that turns or moves the tip by a millionth of what matters there. */
        const double reach = fmax(fabs(m->tip[j].theta), fabs(m->tip[j].v) / m->def.beam.length);
        const double h = 1e-6 / fmax(reach, 1e-12);
        w->q[j] = keep + h;
        (void)residual_of(m, w, shifted);
        w->q[j] = keep;
        for (int i = 0; i < n; i++) {
            jac[num_at(i, j, n)] = (shifted[i] - r[i]) / h;
        }
    }
}

enum status equilibrium_solve(const struct model *m, struct workspace *w, double *residual)
{
    const int n = m->n_mode;
    const size_t bytes = (size_t)n * sizeof(double);
    double r[LIMIT_MODES], step[LIMIT_MODES], start[LIMIT_MODES];
    double jac[LIMIT_MODES * LIMIT_MODES];
    memset(w->qd, 0, bytes);
    memset(w->qdd, 0, bytes);
    memset(w->qdd_previous, 0, bytes);
    *residual = residual_of(m, w, r);
    for (int i = 0; i<ITERATIONS_MAX && * residual> tolerance; i++) {
        jacobian(m, w, r, jac);
        memcpy(step, r, bytes);
        if (la_solve(n, jac, 1, step) != ST_OK) {
            return ST_NOT_CONVERGED;
        }
        memcpy(start, w->q, bytes);
        const double before = *residual;
        double scale = 1.0;
        for (int k = 0; k <= HALVINGS; k++, scale *= 0.5) {
            for (int j = 0; j < n; j++) {
                w->q[j] = start[j] - scale * step[j];
            }
            *residual = residual_of(m, w, r);
            if (*residual < before) {
                break;
            }
        }
        if (!(*residual < before)) {
            break;
        }
    }
    /* The lifting line is solved to its own tolerance; what is left of it here is good enough. */
    return *residual <= 1e-7 ? ST_OK : ST_NOT_CONVERGED;
}

/* Twice the energy of the modes about an equilibrium. */
static double energy_about(const struct model *m, const double *rest, const double *q,
                           const double *qd)
{
    double sum = 0.0;
    for (int j = 0; j < m->n_mode; j++) {
        sum += num_sq(qd[j]) + m->omega2[j] * num_sq(q[j] - rest[j]);
    }
    return sum;
}

struct march_rest equilibrium_near(const struct model *m, struct workspace *w, const double *q0,
                                   const double *qd0)
{
    const size_t bytes = (size_t)m->n_mode * sizeof(double);
    const struct workspace_counters counters = w->counters;
    struct march_rest rest = {.found = false};
    double q[LIMIT_MODES], qd[LIMIT_MODES], residual = 0.0;
    memcpy(q, w->q, bytes);
    memcpy(qd, w->qd, bytes);
    if (equilibrium_solve(m, w, &residual) == ST_OK) {
        rest.found = true;
        rest.energy_ratio = energy_about(m, w->q, q, qd) / energy_about(m, w->q, q0, qd0);
        for (int j = 0; j < m->n_mode; j++) {
            rest.tip_plunge += m->tip[j].v * w->q[j];
            rest.tip_twist += m->tip[j].theta * w->q[j];
        }
    }
    w->counters = counters;
    return rest;
}
