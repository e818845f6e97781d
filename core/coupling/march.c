#include "core/coupling/march.h"

#include "core/coupling/excitation.h"
#include "core/num.h"

#include <assert.h>
#include <string.h>

enum { POLL_EVERY = 64 }; /* steps between looks at the cancel flag: well below a millisecond */

void march_init(const struct model *m, struct workspace *w, struct record *record,
                struct march *out)
{
    const struct solver_def *s = &m->def.solver;
    *out = (struct march){.model = m, .w = w, .record = record};
    exponential_init(m->n_mode, m->omega2, m->damping, s->time_step, &out->exponential);
    out->rk4 = (struct rk4){.n_mode = m->n_mode,
                            .omega2 = m->omega2,
                            .damping = m->damping,
                            .dt = s->time_step,
                            .tolerance = s->tolerance};
    load_polynomial_init(m->n_mode, s->load_order, &out->load);
}

/* q'' = load - 2 zeta omega q' - omega^2 q, with the load extrapolated to the state's time. */
static void accelerations(struct march *march, double tau)
{
    const struct model *m = march->model;
    struct workspace *w = march->w;
    for (int j = 0; j < m->n_mode; j++) {
        w->qdd[j] = load_polynomial_at(&march->load, j, tau) - m->damping[j] * w->qd[j] -
                    m->omega2[j] * w->q[j];
    }
}

/* Loads of the initial state: twice, since the accelerations they depend on follow from them. */
static void evaluate_start(struct march *march)
{
    struct workspace *w = march->w;
    excitation_set(march->model, 0.0, w);
    for (int pass = 0; pass < 2; pass++) {
        loads_evaluate(march->model, w, true);
        march->load.n_known = 0;
        load_polynomial_push(&march->load, w->load);
        accelerations(march, 0.0);
        memcpy(w->qdd_previous, w->qdd, (size_t)w->n_mode * sizeof *w->qdd);
    }
}

static enum status advance(struct march *march)
{
    const struct model *m = march->model;
    struct workspace *w = march->w;
    if (m->def.solver.integrator == INTEGRATOR_RK4_ADAPTIVE) {
        return rk4_advance(&march->rk4, &march->load, w->q, w->qd);
    }
    exponential_step(&march->exponential, &march->load, w->q, w->qd);
    return ST_OK;
}

/* Stop rules on the state just recorded. True when the march must end. */
static bool must_stop(struct march *march)
{
    const struct solver_def *s = &march->model->def.solver;
    const struct record *r = march->record;
    const double twist = record_history(r, HISTORY_TWIST)[r->n - 1];
    const double plunge = record_history(r, HISTORY_PLUNGE)[r->n - 1];
    march->outside_steps += march->w->any_outside;
    if (fabs(twist) > s->twist_max ||
        fabs(plunge) > s->plunge_max * march->model->def.beam.length) {
        march->stop = STOP_AMPLITUDE;
        return true;
    }
    /* Of all states of the run, the initial one included. */
    if ((double)march->outside_steps > s->outside_max * r->capacity) {
        march->stop = STOP_OUTSIDE_POLAR;
        return true;
    }
    return false;
}

enum status march_run(struct march *march, const struct sim_control *control)
{
    struct workspace *w = march->w;
    const int steps = case_def_steps(&march->model->def);
    march->stop = STOP_DURATION;
    evaluate_start(march);
    record_push(march->model, w, march->record);
    while (!must_stop(march) && march->steps < steps) {
        if (march->steps % POLL_EVERY == 0) {
            if (sim_control_cancelled(control)) {
                return ST_CANCELLED;
            }
            sim_control_tell(control, (double)march->steps / steps);
        }
        memcpy(w->qdd_previous, w->qdd, (size_t)w->n_mode * sizeof *w->qdd);
        const enum status st = advance(march);
        if (st == ST_NOT_FINITE || (st == ST_OK && !(num_all_finite(w->n_mode, w->q) &&
                                                     num_all_finite(w->n_mode, w->qd)))) {
            march->stop = STOP_NOT_FINITE;
            return ST_OK;
        }
        if (st != ST_OK) {
            return st;
        }
        accelerations(march, 1.0);
        excitation_set(march->model, (march->steps + 1) * march->model->def.solver.time_step, w);
        loads_evaluate(march->model, w, false);
        if (!num_all_finite(w->n_mode, w->load)) {
            march->stop = STOP_NOT_FINITE;
            return ST_OK;
        }
        load_polynomial_push(&march->load, w->load);
        march->steps++;
        record_push(march->model, w, march->record);
    }
    return ST_OK;
}
