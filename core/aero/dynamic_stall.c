#include "core/aero/dynamic_stall.h"

#include "core/aero/lag.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>

enum { LAG_PRESSURE, LAG_BOUNDARY_LAYER, LAG_VORTEX };
enum { SAMPLES = 200, BISECTIONS = 60 };

/* Shares of Kirchhoff's flow: separated at the leading edge, and attached. */
static const double share_min = 0.25, share_max = 1.0;
/* Lift coefficient that is none. */
static const double zero_linear = 1e-12;

static const int lag_of[STALL_STATES] = {
    [STALL_PRESSURE] = LAG_PRESSURE,         [STALL_BUBBLE] = LAG_BOUNDARY_LAYER,
    [STALL_SEPARATION] = LAG_BOUNDARY_LAYER, [STALL_RESIDUE] = LAG_BOUNDARY_LAYER,
    [STALL_MOMENT] = LAG_BOUNDARY_LAYER,     [STALL_LOST] = LAG_VORTEX,
};

static double lag(const struct stall_def *def, int which)
{
    const double time[STALL_LAGS] = {def->pressure_lag, def->boundary_layer_lag, def->vortex_lag};
    return time[which];
}

double dynamic_stall_lift_share(double separation)
{
    return num_sq(0.5 * (1.0 + sqrt(separation)));
}

double dynamic_stall_separation(double lift_share)
{
    return num_sq(2.0 * sqrt(num_clamp(lift_share, share_min, share_max)) - 1.0);
}

static double lift(const struct polar *p, double alpha)
{
    return polar_at(p, alpha, 0.0).cl;
}

/* Angle in the linear range where the lift rises through zero; of several, the one nearest to the
 * middle. False when there is none. */
static bool find_zero_lift(const struct polar *p, double from, double to, double *out)
{
    const double middle = 0.5 * (from + to);
    bool found = false;
    for (int i = 0; i < SAMPLES; i++) {
        double below = from + (to - from) * i / SAMPLES;
        double above = from + (to - from) * (i + 1) / SAMPLES;
        if (lift(p, below) > 0.0 || lift(p, above) <= 0.0) {
            continue;
        }
        for (int k = 0; k < BISECTIONS; k++) {
            const double half = 0.5 * (below + above);
            *(lift(p, half) > 0.0 ? &above : &below) = half;
        }
        if (!found || fabs(below - middle) < fabs(*out - middle)) {
            *out = below;
        }
        found = true;
    }
    return found;
}

/* Slope and angle of zero lift of the polar in its linear range. The slope is the largest of
 * c_l/(alpha - alpha_0), so that no linear lift lies above Kirchhoff's (Hansen et al. 2004).
 */
static void linear_lift(struct dynamic_stall *ds, double from, double to)
{
    const struct polar *p = ds->polar;
    const double near_zero = 0.01 * (to - from);
    double slope = 0.0;
    if (!find_zero_lift(p, from, to, &ds->zero_lift)) {
        const double middle = 0.5 * (from + to);
        ds->polar_slope = ds->def.lift_slope;
        ds->zero_lift = middle - lift(p, middle) / ds->polar_slope;
        return;
    }
    for (int i = 0; i <= SAMPLES; i++) {
        const double a = from + (to - from) * i / SAMPLES - ds->zero_lift;
        if (fabs(a) > near_zero) {
            slope = fmax(slope, lift(p, ds->zero_lift + a) / a);
        }
    }
    ds->polar_slope = slope;
}

enum status dynamic_stall_init(int n, const double *chord, double speed, double dt,
                               const struct polar *polar, const struct stall_def *def,
                               struct dynamic_stall *out)
{
    struct dynamic_stall ds = {.n = n, .polar = polar, .def = *def};
    ds.rate = malloc((size_t)n * (1 + LAG_FACTORS * STALL_LAGS) * sizeof *ds.rate);
    if (ds.rate == NULL) {
        return ST_NO_MEMORY;
    }
    ds.step = ds.rate + n;
    for (int i = 0; i < n; i++) {
        ds.rate[i] = 2.0 * speed / chord[i];
    }
    for (int which = 0; which < STALL_LAGS; which++) {
        assert(lag(def, which) > 0.0);
        for (int i = 0; i < n; i++) {
            lag_fill(lag_factors(ds.step, n, which), n, i, ds.rate[i] * dt / lag(def, which));
        }
    }
    const struct polar_range range = polar_linear_range(polar);
    linear_lift(&ds, range.from, range.to);
    *out = ds;
    return ST_OK;
}

void dynamic_stall_done(struct dynamic_stall *ds)
{
    free(ds->rate);
    *ds = (struct dynamic_stall){0};
}

/* What the four states behind the boundary layer are driven to. */
struct targets {
    double bubble, separation, residue, moment;
};

static struct targets targets_at(const struct dynamic_stall *ds, double pressure, double plunge)
{
    const struct polar_value v = polar_at(ds->polar, pressure, plunge);
    const double a = pressure - ds->zero_lift;
    const double linear = ds->polar_slope * a;
    /* Towards zero angle the ratio goes to that of the slopes. The residue makes up for any f. */
    const double share = fabs(linear) > zero_linear ? v.cl / linear : share_max;
    const double f = dynamic_stall_separation(share);
    return (struct targets){
        .bubble = (ds->polar_slope - ds->def.lift_slope) * a,
        .separation = f,
        .residue = linear * dynamic_stall_lift_share(f) - v.cl,
        .moment = v.cm - ds->def.lift_centre * ds->def.lift_slope * a,
    };
}

static double lost(const struct dynamic_stall *ds, double alpha, double bubble, double separation,
                   double residue)
{
    const double linear = ds->def.lift_slope * (alpha - ds->zero_lift) + bubble;
    return linear * (1.0 - dynamic_stall_lift_share(separation)) + residue;
}

static double *row(const struct dynamic_stall *ds, double *x, int k)
{
    return x + (ptrdiff_t)ds->n * k;
}

/* One state of one station to the end of a step in which its target goes to `target`. */
static inline void follow(const struct dynamic_stall *ds, double *x, int state, int i,
                          double target)
{
    const double *factor = lag_factors(ds->step, ds->n, lag_of[state]);
    double *value = row(ds, x, state) + i, *old = row(ds, x, STALL_STATES + state) + i;
    *value = lag_next(factor, ds->n, i, *value, *old, target);
    *old = target;
}

void dynamic_stall_step(const struct dynamic_stall *ds, const double *alpha, const double *plunge,
                        double *x)
{
    const int n = ds->n;
    const double *p = row(ds, x, STALL_PRESSURE), *b = row(ds, x, STALL_BUBBLE);
    const double *f = row(ds, x, STALL_SEPARATION), *q = row(ds, x, STALL_RESIDUE);
    for (int i = 0; i < n; i++) {
        follow(ds, x, STALL_PRESSURE, i, alpha[i]);
    }
    for (int i = 0; i < n; i++) {
        const struct targets t = targets_at(ds, p[i], plunge[i]);
        follow(ds, x, STALL_BUBBLE, i, t.bubble);
        follow(ds, x, STALL_SEPARATION, i, t.separation);
        follow(ds, x, STALL_RESIDUE, i, t.residue);
        follow(ds, x, STALL_MOMENT, i, t.moment);
    }
    for (int i = 0; i < n; i++) {
        follow(ds, x, STALL_LOST, i, lost(ds, alpha[i], b[i], f[i], q[i]));
    }
}

void dynamic_stall_steady(const struct dynamic_stall *ds, const double *alpha, const double *plunge,
                          double *x)
{
    for (int i = 0; i < ds->n; i++) {
        const struct targets t = targets_at(ds, alpha[i], plunge[i]);
        const double value[STALL_STATES] = {
            [STALL_PRESSURE] = alpha[i],
            [STALL_BUBBLE] = t.bubble,
            [STALL_SEPARATION] = t.separation,
            [STALL_RESIDUE] = t.residue,
            [STALL_MOMENT] = t.moment,
            [STALL_LOST] = lost(ds, alpha[i], t.bubble, t.separation, t.residue),
        };
        for (int k = 0; k < STALL_STATES; k++) {
            row(ds, x, k)[i] = row(ds, x, STALL_STATES + k)[i] = value[k];
        }
    }
}

/* Coefficients from the steady ones and the three states that count. */
static inline struct stall_value output(const struct dynamic_stall *ds, double alpha,
                                        double cl_steady, double cd_steady, double bubble,
                                        double lost_lift, double moment)
{
    const double potential = ds->def.lift_slope * (alpha - ds->zero_lift);
    const double cl = potential + bubble - lost_lift;
    return (struct stall_value){
        .cl = cl,
        .cd = cd_steady + (cl - cl_steady) * sin(alpha),
        .cm = ds->def.lift_centre * potential + moment,
    };
}

void dynamic_stall_coefficients(const struct dynamic_stall *ds, const double *alpha,
                                const double *x, double *cl, double *cd, double *cm)
{
    const double *b = x + num_at(0, STALL_BUBBLE, ds->n), *z = x + num_at(0, STALL_LOST, ds->n);
    const double *m = x + num_at(0, STALL_MOMENT, ds->n);
    for (int i = 0; i < ds->n; i++) {
        const struct stall_value v = output(ds, alpha[i], cl[i], cd[i], b[i], z[i], m[i]);
        cl[i] = v.cl;
        cd[i] = v.cd;
        cm[i] = v.cm;
    }
}

void dynamic_stall_derivative(const struct dynamic_stall *ds, int station, double alpha,
                              double plunge, const double *x, double *out)
{
    const struct targets t = targets_at(ds, x[STALL_PRESSURE], plunge);
    const double target[STALL_STATES] = {
        [STALL_PRESSURE] = alpha,
        [STALL_BUBBLE] = t.bubble,
        [STALL_SEPARATION] = t.separation,
        [STALL_RESIDUE] = t.residue,
        [STALL_MOMENT] = t.moment,
        [STALL_LOST] = lost(ds, alpha, x[STALL_BUBBLE], x[STALL_SEPARATION], x[STALL_RESIDUE]),
    };
    for (int k = 0; k < STALL_STATES; k++) {
        out[k] = ds->rate[station] * (target[k] - x[k]) / lag(&ds->def, lag_of[k]);
    }
}

struct stall_value dynamic_stall_output(const struct dynamic_stall *ds, double alpha, double plunge,
                                        const double *x)
{
    const struct polar_value v = polar_at(ds->polar, alpha, plunge);
    return output(ds, alpha, v.cl, v.cd, x[STALL_BUBBLE], x[STALL_LOST], x[STALL_MOMENT]);
}
