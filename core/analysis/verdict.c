#include "core/analysis/verdict.h"

#include "core/analysis/damping.h"
#include "core/analysis/doubt.h"
#include "core/num.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static const double growth_tolerance = 0.05; /* ln of the ratio of fluctuations, third to third */
static const double twist_floor = 3.5e-4;    /* rms twist that counts as rest: 0.02 degrees [rad] */
static const double plunge_floor = 1e-4;     /* rms plunge that counts as rest, share of length */
static const double repetition_limit =
    0.02;                                 /* rms change from period to period, of the fluctuation */
static const double stalled_share = 0.05; /* of the steps of the last third */

static const char *const names[VERDICT_COUNT] = {
#define ROW(code, name) [code] = name,
    VERDICT_LIST(ROW)
#undef ROW
};

const char *verdict_name(enum verdict v)
{
    assert((unsigned)v < VERDICT_COUNT);
    return names[v];
}

/* Fluctuation of one signal over the thirds of the record from `first` on. */
struct thirds {
    double rms[3];
    double growth; /* ln(rms[2]/rms[1]); 0 when at rest */
    bool at_rest;  /* the last third is below the floor */
};

static struct thirds thirds_of(const struct record *r, int first, int column, double floor)
{
    const double *y = record_history(r, column);
    struct thirds t;
    for (int k = 0; k < 3; k++) {
        const int n = r->n - first;
        t.rms[k] = damping_fluctuation(y, first + n * k / 3, first + n * (k + 1) / 3);
    }
    t.at_rest = t.rms[2] <= floor;
    t.growth = t.rms[1] > 0.0 && t.rms[2] > 0.0 ? log(t.rms[2] / t.rms[1]) : 0.0;
    return t;
}

/* Has the fluctuation grown from each third to the next? */
static bool grows_throughout(const struct thirds *t)
{
    const double factor = exp(growth_tolerance);
    return t->rms[0] > 0.0 && t->rms[1] > factor * t->rms[0] && t->rms[2] > factor * t->rms[1];
}

static double stalled_in_last_third(const struct record *r, int first)
{
    const int from = first + (r->n - first) * 2 / 3;
    int count = 0;
    for (int i = from; i < r->n; i++) {
        count += r->stalled[i];
    }
    return (double)count / (r->n - from);
}

/* Path over net way of the twist in the last period of the first mode: 1 for a monotone run-away.
 */
static double to_and_fro(const struct march *march)
{
    const struct record *r = march->record;
    const double *y = record_history(r, HISTORY_TWIST);
    const double period = 2.0 * NUM_PI / march->model->modes.omega[0];
    /* A time step may be longer than the period: two states are needed to see a way at all. */
    const double steps = fmax(2.0, period / march->model->def.solver.time_step);
    const int from = steps < r->n ? r->n - (int)steps : 0;
    double path = 0.0;
    for (int i = from + 1; i < r->n; i++) {
        path += fabs(y[i] - y[i - 1]);
    }
    return path / fmax(fabs(y[r->n - 1] - y[from]), 1e-12);
}

/* Time steps in a period of the first mode. */
static double steps_per_period(const struct march *march)
{
    const struct model *m = march->model;
    return 2.0 * NUM_PI / (m->modes.omega[0] * m->def.solver.time_step);
}

/* Has a march that passed the amplitude limit only been bent there, on its way to an equilibrium?
 * It is so when it has lost energy about one, and the equilibrium itself lies beyond the limit or
 * the first swings of the start passed it. */
static bool is_only_bent(const struct march *march)
{
    const struct march_rest *rest = &march->rest;
    const struct solver_def *s = &march->model->def.solver;
    const bool beyond = fabs(rest->tip_twist) > s->twist_max ||
                        fabs(rest->tip_plunge) > s->plunge_max * march->model->def.beam.length;
    return rest->found && rest->energy_ratio <= 1.0 &&
           (beyond || march->steps < VERDICT_PERIODS * steps_per_period(march));
}

static enum verdict of_large_deflection(const struct march *march, char *reason)
{
    (void)snprintf(reason, VERDICT_REASON,
                   "the amplitude limit was passed at %.4g s without growth: the energy about the "
                   "static equilibrium (tip plunge %.3g m, twist %.3g deg) was %.2g of that at the "
                   "start; so large a deflection is beyond the linear beam",
                   march->steps * march->model->def.solver.time_step, march->rest.tip_plunge,
                   num_deg(march->rest.tip_twist), march->rest.energy_ratio);
    return VERDICT_LARGE_DEFLECTION;
}

static enum verdict of_blow_up(const struct march *march, double stalled, char *reason)
{
    const double ratio = to_and_fro(march);
    const double time = march->steps * march->model->def.solver.time_step;
    const bool swings = ratio > 2.0;
    (void)snprintf(reason, VERDICT_REASON,
                   "%s at %.4g s; in the last period of the first mode the tip twist moved %.2g "
                   "times its net way; stalled in %.0f %% of the last third",
                   march->stop == STOP_AMPLITUDE ? "the amplitude limit was passed"
                                                 : "the state was no longer finite",
                   time, ratio, 100.0 * stalled);
    if (steps_per_period(march) < VERDICT_STEPS) {
        (void)snprintf(
            reason, VERDICT_REASON,
            "the run left its bounds at %.4g s, but the fastest mode kept has only %.2g "
            "time steps a period (%d are wanted): take a shorter time step or fewer modes",
            time, steps_per_period(march), VERDICT_STEPS);
        return VERDICT_INDETERMINATE;
    }
    if (is_only_bent(march)) {
        return of_large_deflection(march, reason);
    }
    if (!swings) {
        return VERDICT_DIVERGENCE;
    }
    return stalled > stalled_share ? VERDICT_STALL_FLUTTER : VERDICT_FLUTTER;
}

/* Lower frequency of the sines that move the clamp [Hz], 0 without; *settled is when they have
 * faded in. */
static double drive_frequency(const struct model *m, double *settled)
{
    const struct drive_def *const drive[2] = {&m->def.beam.root_pitch, &m->def.beam.root_plunge};
    double frequency = 0.0;
    *settled = gust_end(&m->def.flow.gust, m->def.flow.speed);
    for (int i = 0; i < 2; i++) {
        if (!drive[i]->given || drive[i]->type != DRIVE_SINE) {
            *settled = fmax(*settled, drive_end(drive[i]));
            continue;
        }
        const double f = drive[i]->frequency;
        frequency = frequency > 0.0 ? fmin(frequency, f) : f;
        *settled = fmax(*settled, drive[i]->start + drive[i]->ramp);
    }
    return frequency;
}

/* Rms change of a signal from one period (in time steps) to the next, over its fluctuation, at the
 * end of the record; 0 for a signal at rest. */
static double repetition(const struct record *r, int column, double period, double floor)
{
    const double *y = record_history(r, column);
    const int n = (int)period;
    const double size = damping_fluctuation(y, r->n - n, r->n);
    double sum = 0.0;
    for (int i = r->n - n; i < r->n; i++) {
        const double at = i - period;
        const int k = (int)at;
        const double then = y[k] + (at - k) * (y[k + 1] - y[k]);
        sum += num_sq(y[i] - then);
    }
    return size > floor ? sqrt(sum / n) / size : 0.0;
}

/* A clamp that swings for ever: does the beam follow? */
static enum verdict of_drive(const struct march *march, double frequency, int first,
                             const struct thirds *lead, double stalled, char *reason)
{
    const struct model *m = march->model;
    const struct record *r = march->record;
    const double period = 1.0 / (frequency * m->def.solver.time_step);
    if (grows_throughout(lead)) {
        (void)snprintf(reason, VERDICT_REASON,
                       "beside the drive the motion of the tip grows all along: its rms rises by "
                       "%+.3f (ln) in the last third; stalled in %.0f %% of it",
                       lead->growth, 100.0 * stalled);
        return stalled > stalled_share ? VERDICT_STALL_FLUTTER : VERDICT_FLUTTER;
    }
    if (period < 2.0 || r->n - first < 2.0 * period + 2.0) {
        (void)snprintf(reason, VERDICT_REASON,
                       "fewer than two periods of the drive (%.3g Hz) after it has faded in",
                       frequency);
        return VERDICT_INDETERMINATE;
    }
    const double change =
        fmax(repetition(r, HISTORY_TWIST, period, 1e-3 * twist_floor),
             repetition(r, HISTORY_PLUNGE, period, 1e-3 * plunge_floor * m->def.beam.length));
    (void)snprintf(reason, VERDICT_REASON,
                   "the motion of the tip changes by %.2g %% rms from one period of the drive "
                   "(%.3g Hz) to the next, limit %.0f %%; stalled in %.0f %% of the last third",
                   100.0 * change, frequency, 100.0 * repetition_limit, 100.0 * stalled);
    return change <= repetition_limit ? VERDICT_FORCED : VERDICT_INDETERMINATE;
}

/* A run that stayed in its bounds: does the tip's fluctuation grow, stay or decay? `drive` is the
 * frequency of what swings the clamp [Hz], 0 without. */
static enum verdict of_fluctuation(const struct march *march, double drive, int first,
                                   double stalled, char *reason)
{
    const struct model *m = march->model;
    const struct record *r = march->record;
    const struct thirds twist = thirds_of(r, first, HISTORY_TWIST, twist_floor);
    const struct thirds plunge =
        thirds_of(r, first, HISTORY_PLUNGE, plunge_floor * m->def.beam.length);
    /* The worse of the two: what still moves and grows faster. */
    const bool twist_leads = plunge.at_rest || (!twist.at_rest && twist.growth >= plunge.growth);
    const struct thirds *lead = twist_leads ? &twist : &plunge;
    if (drive > 0.0) {
        return of_drive(march, drive, first, lead, stalled, reason);
    }
    const double unit = twist_leads ? num_deg(1.0) : 1e3;
    (void)snprintf(reason, VERDICT_REASON,
                   "rms fluctuation of tip %s by thirds of the record: %.3g, %.3g, %.3g %s "
                   "(growth %+.3f, limit %.2f); stalled in %.0f %% of the last third",
                   twist_leads ? "twist" : "plunge", unit * lead->rms[0], unit * lead->rms[1],
                   unit * lead->rms[2], twist_leads ? "deg" : "mm", lead->growth, growth_tolerance,
                   100.0 * stalled);
    const bool driven = case_def_driven_until(&m->def) > 0.0;
    if (!driven && twist.at_rest && plunge.at_rest &&
        (grows_throughout(&twist) || grows_throughout(&plunge))) {
        (void)snprintf(
            reason, VERDICT_REASON,
            "the motion never left the noise (rms twist %.2g deg in the last third) but "
            "has grown all along: an equilibrium that was not disturbed does not show its "
            "stability; start from rest or give it amplitudes",
            num_deg(twist.rms[2]));
        return VERDICT_INDETERMINATE;
    }
    const bool outside =
        march->stop == STOP_OUTSIDE_POLAR || (double)march->outside_steps > 0.5 * march->steps;
    if (lead->at_rest || lead->growth < -growth_tolerance) {
        return outside ? VERDICT_DIVERGENCE : VERDICT_STABLE;
    }
    if (stalled > stalled_share) {
        return VERDICT_STALL_FLUTTER;
    }
    if (lead->growth > growth_tolerance) {
        return VERDICT_FLUTTER;
    }
    const bool changed = fabs(log(lead->rms[2] / fmax(lead->rms[0], 1e-300))) > 0.2;
    return changed ? VERDICT_LIMIT_CYCLE : VERDICT_INDETERMINATE;
}

/* What the histories say, whoever made them. */
static enum verdict of_histories(const struct march *march, char reason[VERDICT_REASON])
{
    const struct model *m = march->model;
    const struct record *r = march->record;
    double settled = 0.0;
    const double drive = drive_frequency(m, &settled), dt = m->def.solver.time_step;
    const int first = (int)fmin(ceil(settled / dt - 1e-9), r->n - 1);
    const double stalled = stalled_in_last_third(r, first);
    if (march->stop == STOP_AMPLITUDE || march->stop == STOP_NOT_FINITE) {
        return of_blow_up(march, stalled, reason);
    }
    const double periods = (march->steps - first) * dt * m->modes.omega[0] / (2.0 * NUM_PI);
    if (periods < VERDICT_PERIODS) {
        (void)snprintf(reason, VERDICT_REASON,
                       "the run covers %.2g periods of the first mode%s, a verdict needs %d",
                       periods, first > 0 ? " after what drives it has ended or faded in" : "",
                       VERDICT_PERIODS);
        return VERDICT_INDETERMINATE;
    }
    return of_fluctuation(march, drive, first, stalled, reason);
}

enum verdict verdict_of(const struct march *march, char reason[VERDICT_REASON])
{
    const struct doubt d = doubt_of(march);
    const enum verdict v = of_histories(march, reason);
    if (d.alternations > doubt_alternations_max) {
        (void)snprintf(reason, VERDICT_REASON,
                       "the load turned back at %.0f %% of the steps of the last third: the march "
                       "follows its time step, not the flow%s; its histories alone would say %s",
                       100.0 * d.alternations,
                       march->model->network != NULL ? " (a network that sees an acceleration?)"
                                                     : "",
                       verdict_name(v));
        return VERDICT_INDETERMINATE;
    }
    if (d.outside_hull > doubt_outside_hull_max) {
        (void)snprintf(reason, VERDICT_REASON,
                       "%.3g %% of the evaluations of the network are outside its training hull; "
                       "the histories alone would say %s",
                       100.0 * d.outside_hull, verdict_name(v));
        return VERDICT_INDETERMINATE;
    }
    if (d.outside_hull > doubt_outside_hull_told) {
        const size_t used = strlen(reason);
        (void)snprintf(reason + used, VERDICT_REASON - used,
                       "; %.3g %% of the evaluations of the network outside its training hull",
                       100.0 * d.outside_hull);
    }
    return v;
}
