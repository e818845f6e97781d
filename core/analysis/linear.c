#include "core/analysis/linear.h"

#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static bool constant_chord(const struct model *m)
{
    for (int i = 1; i < m->n_station; i++) {
        if (fabs(m->chord[i] - m->chord[0]) > 1e-12 * m->chord[0]) {
            return false;
        }
    }
    return true;
}

enum status linear_init(const struct model *m, struct linear *out)
{
    struct linear l = {.n_mode = m->n_mode, .n_station = m->n_station};
    l.modal_wake = constant_chord(m) && m->n_mode < m->n_station;
    l.n_wake = m->attached.n == 0 ? 0 : (l.modal_wake ? m->n_mode : m->n_station);
    l.n_stall = m->stall.n;
    l.n_state = 2 * l.n_mode + ATTACHED_LAGS * l.n_wake + STALL_STATES * l.n_stall;
    const size_t ns = (size_t)l.n_station, nm = (size_t)l.n_mode, ny = (size_t)l.n_state;
    struct {
        double **array;
        size_t size;
    } const part[] = {
        {&l.a, ny * ny},     {&l.static_stiffness, nm * nm}, {&l.angle, ns * ny},
        {&l.given, ns * ny}, {&l.plunge, ns * ny},           {&l.pitch, ns * ny},
        {&l.force, nm * ny}, {&l.relief, ns * ns},           {&l.dense, ns * ns},
    };
    size_t total = 0;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        total += part[i].size;
    }
    l.block = malloc(total * sizeof *l.block);
    l.slope = malloc(ns * sizeof *l.slope);
    l.pivot = malloc(ns * sizeof *l.pivot);
    if (l.block == NULL || l.slope == NULL || l.pivot == NULL) {
        linear_done(&l);
        return ST_NO_MEMORY;
    }
    double *next = l.block;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i].array = next;
        next += part[i].size;
    }
    *out = l;
    return ST_OK;
}

void linear_done(struct linear *l)
{
    free(l->block);
    free(l->slope);
    free(l->pivot);
    *l = (struct linear){0};
}

static const double step = 1e-6; /* of central differences */

/* Difference quotient over `width`. */
static struct linear_gain gain(const struct stall_value *up, const struct stall_value *down,
                               double width)
{
    return (struct linear_gain){.cl = (up->cl - down->cl) / width,
                                .cd = (up->cd - down->cd) / width,
                                .cm = (up->cm - down->cm) / width};
}

static struct stall_value steady_at(const struct model *m, double alpha, double plunge)
{
    const struct polar_value v = polar_at(m->polar, alpha, plunge);
    return (struct stall_value){.cl = v.cl, .cd = v.cd, .cm = v.cm};
}

/* Coefficients and rates of station i at x: angle, plunge, states of stall. */
enum { STALL_INPUTS = 2 + STALL_STATES };
static struct stall_value moving_at(const struct model *m, int i, const double *x, double *rate)
{
    /* The model may stand at another speed than its stall was prepared for. */
    const double faster = 2.0 * m->def.flow.speed / m->chord[i] / m->stall.rate[i];
    dynamic_stall_derivative(&m->stall, i, x[0], x[1], x + 2, rate);
    for (int k = 0; k < STALL_STATES; k++) {
        rate[k] *= faster;
    }
    return dynamic_stall_output(&m->stall, x[0], x[1], x + 2);
}

static void find_stall_slopes(const struct model *m, const struct workspace *w, int i,
                              struct linear_slope *out)
{
    double x[STALL_INPUTS] = {w->alpha[i], w->plunge[i]};
    struct linear_gain *const target[2] = {&out->alpha, &out->plunge};
    for (int k = 0; k < STALL_STATES; k++) {
        x[2 + k] = w->stall[num_at(i, k, m->n_station)];
    }
    for (int k = 0; k < STALL_INPUTS; k++) {
        double high[STALL_STATES], low[STALL_STATES];
        const double keep = x[k];
        x[k] = keep + step;
        const struct stall_value up = moving_at(m, i, x, high);
        /* Flow that has left at the leading edge cannot leave before it. */
        x[k] = k - 2 == STALL_SEPARATION ? fmax(keep - step, 0.0) : keep - step;
        const double width = keep + step - x[k];
        const struct stall_value down = moving_at(m, i, x, low);
        x[k] = keep;
        *(k < 2 ? target[k] : &out->stall[k - 2]) = gain(&up, &down, width);
        for (int r = 0; r < STALL_STATES; r++) {
            out->stall_rate[r][k] = (high[r] - low[r]) / width;
        }
    }
}

/* Central differences: at a knot of the plunge, or a bend, the mean of both sides is the fair
 * answer. */
static void find_slopes(const struct model *m, const struct workspace *w, struct linear *l)
{
    for (int i = 0; i < l->n_station; i++) {
        struct linear_slope *s = &l->slope[i];
        const double a = w->alpha[i], h = w->plunge[i];
        const struct stall_value up = steady_at(m, a + step, h), down = steady_at(m, a - step, h);
        const struct stall_value high = steady_at(m, a, h + step), low = steady_at(m, a, h - step);
        s->steady_alpha = s->alpha = gain(&up, &down, 2.0 * step);
        s->steady_plunge = s->plunge = gain(&high, &low, 2.0 * step);
        s->cl = steady_at(m, a, h).cl;
        if (l->n_stall > 0) {
            find_stall_slopes(m, w, i, s);
        }
    }
}

/* Entry (i, j) of B (diag(C_l') + epsilon (B - diag(row sums of B))): what an angle at j takes away
 * at i through the circulation, with the viscosity the solution has. */
static double downwash(const struct lifting_line *ll, double epsilon, const struct linear *l, int i,
                       int j)
{
    const double *induced = ll->induced;
    const double slope = l->slope[j].steady_alpha.cl - epsilon * ll->row_sum[j];
    double sum = induced[num_at(i, j, ll->rows)] * slope;
    for (int k = 0; k < l->n_station && epsilon > 0.0; k++) {
        sum += epsilon * induced[num_at(i, k, ll->rows)] * induced[num_at(k, j, ll->rows)];
    }
    return sum;
}

/* relief: the lifting line gives alpha = given - B c_l(alpha), so it is (I + downwash)^-1. */
static enum status find_relief(const struct model *m, const struct workspace *w, struct linear *l)
{
    const int n = l->n_station;
    if (m->lifting_line.n == 0) {
        return ST_OK;
    }
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            l->relief[num_at(i, j, n)] =
                (i == j ? 1.0 : 0.0) + downwash(&m->lifting_line, w->lifting_line.epsilon, l, i, j);
        }
    }
    return la_inverse_work(n, l->relief, l->pivot, l->dense);
}

/* First state of a lag of the wake. */
static int wake_at(const struct linear *l, int lag)
{
    return 2 * l->n_mode + lag * l->n_wake;
}

/* State k of stall at a station. */
static int stall_at(const struct linear *l, int k, int station)
{
    return wake_at(l, ATTACHED_LAGS) + k * l->n_stall + station;
}

/* Rate of a lag at a station [1/s]. */
static double wake_rate(const struct model *m, int lag, int station)
{
    return attached_rate(lag) * 2.0 * m->def.flow.speed / m->chord[station];
}

/* d alpha_34 / d q' of a mode at a station: -v/V + c theta/(4 V). */
static double rate_angle(const struct model *m, int station, int mode)
{
    const ptrdiff_t k = num_at(station, mode, m->n_station);
    return (0.25 * m->chord[station] * m->station_theta[k] - m->station_v[k]) / m->def.flow.speed;
}

/* Angle the wake lets act: half of alpha_34, the rest through the lags. A lag of the modes holds
 * X = filter(q); that of q' is X' = beta (q - X), so that x = (theta - beta W) X + beta W q. */
static void wake_angle(const struct model *m, struct linear *l)
{
    const int ns = l->n_station, n = l->n_mode;
    for (int s = 0; s < ns; s++) {
        for (int j = 0; j < n; j++) {
            const double theta = m->station_theta[num_at(s, j, ns)], rate = rate_angle(m, s, j);
            l->given[num_at(s, j, ns)] = 0.5 * theta;
            l->given[num_at(s, n + j, ns)] = 0.5 * rate;
            for (int lag = 0; lag < ATTACHED_LAGS && l->modal_wake; lag++) {
                const double beta = wake_rate(m, lag, s), share = attached_share(lag);
                l->given[num_at(s, j, ns)] += share * beta * rate;
                l->given[num_at(s, wake_at(l, lag) + j, ns)] = share * (theta - beta * rate);
            }
        }
        for (int lag = 0; lag < ATTACHED_LAGS && !l->modal_wake; lag++) {
            l->given[num_at(s, wake_at(l, lag) + s, ns)] = attached_share(lag);
        }
    }
}

/* How the states move angle, plunge and pitch rate of the stations. */
static void kinematics(const struct model *m, struct linear *l)
{
    const int ns = l->n_station, n = l->n_mode;
    const size_t bytes = (size_t)ns * (size_t)l->n_state * sizeof *l->given;
    memset(l->given, 0, bytes);
    memset(l->plunge, 0, bytes);
    memset(l->pitch, 0, bytes);
    for (int s = 0; s < ns; s++) {
        for (int j = 0; j < n; j++) {
            const ptrdiff_t k = num_at(s, j, ns);
            l->plunge[k] = m->station_v[k] / m->chord[s];
            if (m->attached.n > 0) {
                l->pitch[num_at(s, n + j, ns)] =
                    m->station_theta[k] * m->chord[s] / m->def.flow.speed;
            } else {
                l->given[k] = m->station_theta[k];
                l->given[num_at(s, n + j, ns)] = -m->station_v[k] / m->def.flow.speed;
            }
        }
    }
    if (m->attached.n > 0) {
        wake_angle(m, l);
    }
}

/* angle = relief (given - B diag(C_l plunge) plunge) for the first n_column states. */
static void effective_angle(const struct model *m, int n_column, struct linear *l)
{
    const int n = l->n_station;
    for (int c = 0; c < n_column; c++) {
        double start[LIMIT_ELEMENTS];
        for (int i = 0; i < n; i++) {
            start[i] = l->given[num_at(i, c, n)];
            for (int j = 0; j < n && m->lifting_line.n > 0; j++) {
                start[i] -= m->lifting_line.induced[num_at(i, j, m->lifting_line.rows)] *
                            l->slope[j].steady_plunge.cl * l->plunge[num_at(j, c, n)];
            }
        }
        if (m->lifting_line.n == 0) {
            memcpy(l->angle + num_at(0, c, n), start, (size_t)n * sizeof *start);
            continue;
        }
        for (int i = 0; i < n; i++) {
            double sum = 0.0;
            for (int j = 0; j < n; j++) {
                sum += l->relief[num_at(i, j, n)] * start[j];
            }
            l->angle[num_at(i, c, n)] = sum;
        }
    }
}

/* Coefficients of station i by column k, as in steady flow or with the states of stall. The drag
 * that the induced angle makes is of the steady lift in both. */
static struct linear_gain coefficients(const struct workspace *w, const struct linear *l, int i,
                                       int column, bool steady)
{
    const struct linear_slope *p = &l->slope[i];
    const struct linear_gain *by_alpha = steady ? &p->steady_alpha : &p->alpha;
    const struct linear_gain *by_plunge = steady ? &p->steady_plunge : &p->plunge;
    const ptrdiff_t k = num_at(i, column, l->n_station);
    const double alpha = l->angle[k], plunge = l->plunge[k], pitch = l->pitch[k];
    const double steady_lift = p->steady_alpha.cl * alpha + p->steady_plunge.cl * plunge;
    struct linear_gain g = {
        .cl = by_alpha->cl * alpha + by_plunge->cl * plunge + attached_cl_rate() * pitch,
        .cd = by_alpha->cd * alpha + by_plunge->cd * plunge + steady_lift * w->induced[i] +
              p->cl * (l->given[k] - alpha),
        .cm = by_alpha->cm * alpha + by_plunge->cm * plunge + attached_cm_rate() * pitch};
    const int state = column - stall_at(l, 0, 0);
    if (l->n_stall > 0 && state >= 0 && state % l->n_stall == i) {
        const struct linear_gain *own = &p->stall[state / l->n_stall];
        g.cl += own->cl;
        g.cd += own->cd;
        g.cm += own->cm;
    }
    return g;
}

/* force = d modal load / d y (n_mode x n_column), linearised modal_loads of loads.c. */
static void modal_forces(const struct model *m, const struct workspace *w, int n_column,
                         bool steady, struct linear *l)
{
    const int ns = l->n_station, n = l->n_mode;
    const double c = cos(m->def.flow.incidence), s = sin(m->def.flow.incidence);
    memset(l->force, 0, (size_t)n * (size_t)n_column * sizeof *l->force);
    for (int column = 0; column < n_column; column++) {
        for (int i = 0; i < ns; i++) {
            const struct linear_gain g = coefficients(w, l, i, column, steady);
            const double size = m->dynamic_pressure * m->chord[i] * m->station_length;
            const double x = size * (g.cl * s - g.cd * c), y = size * (g.cl * c + g.cd * s);
            const double moment = size * m->chord[i] * g.cm;
            for (int j = 0; j < n; j++) {
                const ptrdiff_t at = num_at(i, j, ns);
                l->force[num_at(j, column, n)] +=
                    m->station_u[at] * x + m->station_v[at] * y + m->station_theta[at] * moment;
            }
        }
    }
}

/* Rows of the states of stall: by the effective angle and plunge of their station, and each other.
 */
static void assemble_stall(struct linear *l)
{
    const int ny = l->n_state, ns = l->n_station;
    for (int i = 0; i < l->n_stall; i++) {
        for (int k = 0; k < STALL_STATES; k++) {
            const double *rate = l->slope[i].stall_rate[k];
            const int row = stall_at(l, k, i);
            for (int c = 0; c < stall_at(l, 0, 0); c++) {
                l->a[num_at(row, c, ny)] =
                    rate[0] * l->angle[num_at(i, c, ns)] + rate[1] * l->plunge[num_at(i, c, ns)];
            }
            for (int other = 0; other < STALL_STATES; other++) {
                l->a[num_at(row, stall_at(l, other, i), ny)] = rate[2 + other];
            }
        }
    }
}

/* q'' and the states of the wake. */
static void assemble(const struct model *m, struct linear *l)
{
    const int n = l->n_mode, ny = l->n_state;
    memset(l->a, 0, (size_t)ny * (size_t)ny * sizeof *l->a);
    for (int j = 0; j < n; j++) {
        l->a[num_at(j, n + j, ny)] = 1.0;
        for (int c = 0; c < ny; c++) {
            l->a[num_at(n + j, c, ny)] = l->force[num_at(j, c, n)];
        }
        l->a[num_at(n + j, j, ny)] -= m->omega2[j];
        l->a[num_at(n + j, n + j, ny)] -= m->damping[j];
        for (int k = 0; k < n && m->damping_coupling != NULL; k++) {
            l->a[num_at(n + j, n + k, ny)] -= m->damping_coupling[num_at(j, k, n)];
        }
    }
    for (int lag = 0; lag < ATTACHED_LAGS && l->n_wake > 0; lag++) {
        for (int i = 0; i < l->n_wake; i++) {
            const double beta = wake_rate(m, lag, l->modal_wake ? 0 : i);
            const int row = wake_at(l, lag) + i;
            l->a[num_at(row, row, ny)] = -beta;
            if (l->modal_wake) {
                l->a[num_at(row, i, ny)] = beta;
                continue;
            }
            for (int j = 0; j < n; j++) {
                l->a[num_at(row, j, ny)] = beta * m->station_theta[num_at(i, j, l->n_station)];
                l->a[num_at(row, n + j, ny)] = beta * rate_angle(m, i, j);
            }
        }
    }
}

/* Steady flow: the whole twist acts, nothing moves. Overwrites given, angle and force. */
static void find_static_stiffness(const struct model *m, const struct workspace *w,
                                  struct linear *l)
{
    const int n = l->n_mode;
    memcpy(l->given, m->station_theta, (size_t)l->n_station * (size_t)n * sizeof *l->given);
    effective_angle(m, n, l);
    modal_forces(m, w, n, true, l);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) {
            const ptrdiff_t at = num_at(j, k, n);
            l->static_stiffness[at] = (j == k ? m->omega2[j] : 0.0) - l->force[at];
        }
    }
}

enum status linear_fill(const struct model *m, struct workspace *w, struct linear *l)
{
    assert(m->network == NULL);
    memset(w->qd, 0, (size_t)m->n_mode * sizeof *w->qd);
    memset(w->qdd, 0, (size_t)m->n_mode * sizeof *w->qdd);
    loads_evaluate(m, w, true);
    find_slopes(m, w, l);
    const enum status st = find_relief(m, w, l);
    if (st != ST_OK) {
        return st;
    }
    kinematics(m, l);
    find_static_stiffness(m, w, l);
    kinematics(m, l);
    effective_angle(m, l->n_state, l);
    modal_forces(m, w, l->n_state, false, l);
    assemble(m, l);
    assemble_stall(l);
    if (!num_all_finite(l->n_state * l->n_state, l->a)) {
        return ST_NOT_FINITE;
    }
    return ST_OK;
}
