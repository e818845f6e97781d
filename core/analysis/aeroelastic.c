#include "core/analysis/aeroelastic.h"

#include "core/analysis/linear.h"
#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NEWTON_MAX = 40, HALVINGS = 10, REST_MAX = 30, STEPS = 8 };
static const double newton_tolerance = 1e-11; /* residual over load, in the energy norm */
static const double rest_tolerance = 1e-11;   /* change of the twist the modes leave out [rad] */
static const double step_min = 1.0 / 1024.0;  /* of the dynamic pressure */

static const char *const names[AEROELASTIC_STATE_COUNT] = {
#define ROW(code, name) [code] = name,
    AEROELASTIC_LIST(ROW)
#undef ROW
};

const char *aeroelastic_state_name(enum aeroelastic_state s)
{
    assert((unsigned)s < AEROELASTIC_STATE_COUNT);
    return names[s];
}

struct solver {
    const struct model *m;
    struct model scaled; /* a view of *m with a share of its dynamic pressure and without gravity,
                            which is among the given loads */
    struct workspace w;
    struct linear linear;
    double *factor; /* Cholesky factor of the stiffness (n_dof x n_dof), owned, as are the next */
    double *given, *load, *x; /* (n_dof); given is borrowed */
    double *zero;             /* gravity of `scaled` (n_mode) */
    double *keep;             /* state to go back to: q, imposed twist and plunge */
    int iterations;
    double residual;
};

static void solver_done(struct solver *s)
{
    workspace_done(&s->w);
    linear_done(&s->linear);
    free(s->factor);
}

static enum status solver_init(const struct model *m, const double *given, struct solver *out)
{
    const size_t n = (size_t)m->beam.n_dof, nm = (size_t)m->n_mode, ns = (size_t)m->n_station;
    struct solver s = {.m = m, .scaled = *m};
    s.factor = calloc(n * n + 3 * n + 2 * nm + 2 * ns, sizeof *s.factor);
    enum status st = s.factor != NULL ? ST_OK : ST_NO_MEMORY;
    if (st == ST_OK) {
        s.given = s.factor + n * n;
        s.load = s.given + n;
        s.x = s.load + n;
        s.zero = s.x + n;
        s.keep = s.zero + nm;
        memcpy(s.factor, m->beam.k, n * n * sizeof *s.factor);
        memcpy(s.given, given, n * sizeof *given);
        s.scaled.gravity = s.zero;
        st = la_cholesky(m->beam.n_dof, s.factor);
    }
    if (st == ST_OK) {
        st = workspace_init(m, &s.w);
    }
    if (st == ST_OK) {
        st = linear_init(m, &s.linear);
    }
    if (st != ST_OK) {
        solver_done(&s);
        return st;
    }
    *out = s;
    return ST_OK;
}

static void read_station(const struct solver *s, int i, struct aeroelastic_station *out)
{
    const struct workspace *w = &s->w;
    const double force = s->scaled.dynamic_pressure * s->m->chord[i];
    *out = (struct aeroelastic_station){.z = (i + 0.5) * s->m->station_length,
                                        .chord = s->m->chord[i],
                                        .twist = w->twist[i],
                                        .plunge = w->plunge[i] * s->m->chord[i],
                                        .alpha = w->alpha[i],
                                        .induced = w->induced[i],
                                        .cl = w->cl[i],
                                        .cd = w->cd[i],
                                        .cm = w->cm[i],
                                        .lift = force * w->cl[i],
                                        .drag = force * w->cd[i],
                                        .moment = force * s->m->chord[i] * w->cm[i]};
}

struct beam_load aeroelastic_load(const struct model *m, const struct aeroelastic_station *s)
{
    const double c = cos(m->def.flow.incidence), a = sin(m->def.flow.incidence);
    const double x = s->lift * a - s->drag * c, y = s->lift * c + s->drag * a;
    const struct shape_point mid = beam_def_mid_chord_at(&m->def.beam, s->z);
    return (struct beam_load){.force = {x, y, 0.0},
                              .moment = {0.0, 0.0, s->moment + mid.x * y - mid.y * x}};
}

/* Deflection of the whole beam under the given loads and the present ones of the air. */
static void deflect(struct solver *s)
{
    const struct beam *b = &s->m->beam;
    memcpy(s->load, s->given, (size_t)b->n_dof * sizeof *s->load);
    for (int i = 0; i < s->m->n_station; i++) {
        struct aeroelastic_station station;
        read_station(s, i, &station);
        const struct beam_load load = aeroelastic_load(s->m, &station);
        beam_add_line_load(b, i * s->m->station_length, (i + 1) * s->m->station_length, &load,
                           s->load);
    }
    memcpy(s->x, s->load, (size_t)b->n_dof * sizeof *s->x);
    la_cholesky_solve(b->n_dof, s->factor, 1, s->x);
}

/* Imposes on the stations what the modes do not hold of the beam's deflection; returns how far the
 * twist has changed by that. */
static double impose_rest(struct solver *s)
{
    const struct model *m = s->m;
    double change = 0.0;
    deflect(s);
    for (int i = 0; i < m->n_station; i++) {
        const struct beam_motion whole = model_motion_at(m, s->x, (i + 0.5) * m->station_length);
        double twist = whole.theta, plunge = whole.v;
        for (int j = 0; j < m->n_mode; j++) {
            twist -= m->station_theta[num_at(i, j, m->n_station)] * s->w.q[j];
            plunge -= m->station_v[num_at(i, j, m->n_station)] * s->w.q[j];
        }
        change = fmax(change, fabs(twist - s->w.imposed_twist[i]));
        s->w.imposed_twist[i] = twist;
        s->w.imposed_plunge[i] = plunge;
    }
    return change;
}

/* r = omega^2 q - load(q); returns its size relative to the load. */
static double residual_of(struct solver *s, double *r)
{
    struct workspace *w = &s->w;
    loads_evaluate(&s->scaled, w, true);
    double left = 0.0, size = 1e-300;
    for (int j = 0; j < w->n_mode; j++) {
        r[j] = s->m->omega2[j] * w->q[j] - w->load[j];
        left += r[j] * r[j] / s->m->omega2[j];
        size += w->load[j] * w->load[j] / s->m->omega2[j];
    }
    return sqrt(left / size);
}

/* Newton's method in the modes with the linearised system as its matrix, at the imposed rest. */
static enum status newton(struct solver *s)
{
    const int n = s->w.n_mode;
    double r[LIMIT_MODES], step[LIMIT_MODES], start[LIMIT_MODES];
    s->residual = residual_of(s, r);
    for (int i = 0; i < NEWTON_MAX && s->residual > newton_tolerance; i++, s->iterations++) {
        const double before = s->residual;
        memcpy(step, r, (size_t)n * sizeof *step);
        memcpy(start, s->w.q, (size_t)n * sizeof *start);
        enum status st = linear_fill(&s->scaled, &s->w, &s->linear);
        if (st == ST_OK) {
            st = la_solve(n, s->linear.static_stiffness, 1, step);
        }
        if (st != ST_OK) {
            return ST_NOT_CONVERGED;
        }
        double scale = 1.0;
        for (int k = 0; k <= HALVINGS && !(s->residual < before && k > 0); k++, scale *= 0.5) {
            for (int j = 0; j < n; j++) {
                s->w.q[j] = start[j] - scale * step[j];
            }
            s->residual = residual_of(s, r);
        }
        if (!(s->residual < before)) {
            break;
        }
    }
    /* The lifting line is solved to its own tolerance; what is left of it here is good enough. */
    return s->residual <= 1e-7 ? ST_OK : ST_NOT_CONVERGED;
}

/* Equilibrium of the whole beam at the pressure of `scaled`, from the present state. */
static enum status equilibrium(struct solver *s)
{
    enum status st = ST_NOT_CONVERGED;
    double change = HUGE_VAL;
    for (int i = 0; i < REST_MAX && change > rest_tolerance; i++) {
        st = newton(s);
        if (st != ST_OK) {
            return st;
        }
        change = impose_rest(s);
    }
    return change <= 1e-8 ? newton(s) : ST_NOT_CONVERGED;
}

/* Dynamic pressure over that at which the system linearised at the present state diverges: the
 * largest real eigenvalue of Omega^-1 (Omega^2 - S) Omega^-1, zero when none is positive. */
static enum status pressure_ratio(struct solver *s, double *out)
{
    const int n = s->w.n_mode;
    double a[LIMIT_MODES * LIMIT_MODES], re[LIMIT_MODES], im[LIMIT_MODES];
    enum status st = linear_fill(&s->scaled, &s->w, &s->linear);
    for (int j = 0; j < n && st == ST_OK; j++) {
        for (int i = 0; i < n; i++) {
            a[num_at(i, j, n)] =
                (i == j ? 1.0 : 0.0) - s->linear.static_stiffness[num_at(i, j, n)] /
                                           sqrt(s->m->omega2[i] * s->m->omega2[j]);
        }
    }
    if (st == ST_OK) {
        st = la_eigenvalues(n, a, re, im);
    }
    double largest = 0.0;
    for (int i = 0; i < n && st == ST_OK; i++) {
        largest = fabs(im[i]) <= 1e-9 * fabs(re[i]) ? fmax(largest, re[i]) : largest;
    }
    *out = largest > 1e-12 ? largest : 0.0;
    return st;
}

static void keep_state(struct solver *s, bool back)
{
    const size_t nm = (size_t)s->m->n_mode, ns = (size_t)s->m->n_station;
    double *const from[3] = {s->w.q, s->w.imposed_twist, s->w.imposed_plunge};
    double *const to[3] = {s->keep, s->keep + nm, s->keep + nm + ns};
    const size_t n[3] = {nm, ns, ns};
    for (int i = 0; i < 3; i++) {
        memcpy(back ? from[i] : to[i], back ? to[i] : from[i], n[i] * sizeof(double));
    }
}

/* Raises the dynamic pressure to that of the case, or as far as the branch goes. `lowest` becomes
 * the lowest limit of divergence met on the way. */
static enum status follow(struct solver *s, struct aeroelastic_result *r, double *lowest)
{
    double step = 1.0 / STEPS;
    *lowest = HUGE_VAL;
    while (r->share < 1.0 && step >= step_min) {
        const double next = fmin(1.0, r->share + step);
        double ratio = 0.0;
        keep_state(s, false);
        s->scaled.dynamic_pressure = next * s->m->dynamic_pressure;
        enum status st = equilibrium(s);
        if (st == ST_OK) {
            st = pressure_ratio(s, &ratio);
        }
        if (st == ST_NO_MEMORY) {
            return st;
        }
        const double limit = ratio > 0.0 ? s->scaled.dynamic_pressure / ratio : HUGE_VAL;
        /* Also of an equilibrium past divergence: with linear loads its limit is exact. */
        *lowest = st == ST_OK ? fmin(*lowest, limit) : *lowest;
        if (st == ST_OK && ratio < 1.0) {
            r->share = next;
            r->residual = s->residual;
            r->divergence_pressure = limit;
        } else {
            keep_state(s, true);
            step *= 0.5;
        }
    }
    return ST_OK;
}

static enum status read_result(struct solver *s, double *x, struct aeroelastic_result *r)
{
    r->station = malloc((size_t)s->m->n_station * sizeof *r->station);
    if (r->station == NULL) {
        return ST_NO_MEMORY;
    }
    memset(&s->w.counters, 0, sizeof s->w.counters);
    loads_evaluate(&s->scaled, &s->w, true);
    deflect(s);
    memcpy(x, s->x, (size_t)s->m->beam.n_dof * sizeof *x);
    r->n_station = s->m->n_station;
    for (int i = 0; i < r->n_station; i++) {
        read_station(s, i, &r->station[i]);
    }
    r->total = loads_total(&s->scaled, &s->w);
    r->outside_polar = (int)s->w.counters.outside_polar;
    r->lifting_line_converged = s->w.counters.not_converged == 0;
    r->lifting_line_residual = s->w.counters.lifting_line_residual;
    return ST_OK;
}

/* State and reason of what follow() has found. */
static void judge(const struct model *m, double lowest, struct aeroelastic_result *r)
{
    const double q = m->dynamic_pressure;
    const double speed = sqrt(2.0 * lowest / m->def.flow.density);
    if (r->share < 1.0 && lowest <= q) {
        r->state = AEROELASTIC_DIVERGENCE;
        (void)snprintf(r->reason, sizeof r->reason,
                       "the linearised problem diverges at %.6g m/s; the branch from rest was "
                       "followed to %.3g of the dynamic pressure",
                       speed, r->share);
    } else if (r->share < 1.0) {
        r->state = AEROELASTIC_NOT_CONVERGED;
        (void)snprintf(r->reason, sizeof r->reason,
                       "the branch from rest was lost at %.3g of the dynamic pressure, below "
                       "divergence: a stalled slope, or a lifting line that does not converge",
                       r->share);
    } else if (r->outside_polar > 0 && lowest <= q) {
        r->state = AEROELASTIC_DIVERGENCE;
        (void)snprintf(
            r->reason, sizeof r->reason,
            "beyond divergence of the linearised problem at %.6g m/s the beam only comes "
            "to rest outside the polar, at %d of %d stations",
            speed, r->outside_polar, m->n_station);
    } else if (!r->lifting_line_converged) {
        r->state = AEROELASTIC_NOT_CONVERGED;
        (void)snprintf(r->reason, sizeof r->reason,
                       "the lifting line does not converge, residual %.3g in c_l",
                       r->lifting_line_residual);
    } else {
        r->state = AEROELASTIC_EQUILIBRIUM;
        (void)snprintf(r->reason, sizeof r->reason, "relative residual %.2g after %d iterations",
                       r->residual, r->iterations);
    }
}

enum status aeroelastic_solve(const struct model *m, const double *given, double *x,
                              struct aeroelastic_result *out)
{
    struct solver s;
    struct aeroelastic_result r = {.share = 0.0};
    enum status st = solver_init(m, given, &s);
    if (st != ST_OK) {
        return st;
    }
    s.scaled.dynamic_pressure = 0.0;
    (void)impose_rest(&s); /* of the given loads alone */
    double lowest = HUGE_VAL;
    st = follow(&s, &r, &lowest);
    if (st == ST_OK && r.share >= 1.0) {
        st = read_result(&s, x, &r);
    }
    if (st == ST_OK) {
        r.iterations = s.iterations;
        judge(m, lowest, &r);
        r.divergence_pressure = r.state == AEROELASTIC_EQUILIBRIUM ? r.divergence_pressure : lowest;
        r.divergence_speed = sqrt(2.0 * r.divergence_pressure / m->def.flow.density);
    }
    if (st == ST_OK && r.state != AEROELASTIC_EQUILIBRIUM) {
        const double none = (double)NAN;
        for (int i = 0; i < m->beam.n_dof; i++) {
            x[i] = none;
        }
        r.total = (struct load_totals){none, none, none, none, none, none};
        r.n_station = 0;
    }
    solver_done(&s);
    if (st != ST_OK) {
        aeroelastic_done(&r);
        return st;
    }
    *out = r;
    return ST_OK;
}

void aeroelastic_done(struct aeroelastic_result *r)
{
    free(r->station);
    *r = (struct aeroelastic_result){0};
}
