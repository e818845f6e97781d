#include "core/analysis/loop.h"

#include "core/aero/attached.h"
#include "core/aero/dynamic_stall.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>

/* The units of this room. */
static const double chord = 1.0, speed = 1.0, density = 1.0, dynamic_pressure = 0.5;

/* The motion at one time and what follows from it. */
struct state {
    double theta, theta_rate, theta_acceleration;
    double w, w_rate, w_acceleration, w_jerk;
};

static struct state state_of_table(const struct loop_motion *m, int i)
{
    return (struct state){
        .theta = m->value[num_at(i, MOTION_THETA, m->n)],
        .theta_rate = m->value[num_at(i, MOTION_THETA_RATE, m->n)],
        .theta_acceleration = m->value[num_at(i, MOTION_THETA_ACCELERATION, m->n)],
        .w = m->value[num_at(i, MOTION_W, m->n)],
        .w_rate = m->value[num_at(i, MOTION_W_RATE, m->n)],
        .w_acceleration = m->value[num_at(i, MOTION_W_ACCELERATION, m->n)],
    };
}

static struct state state_at(const struct loop_def *d, int step)
{
    if (d->motion != NULL) {
        return state_of_table(d->motion, step);
    }
    const double omega = 2.0 * NUM_PI * d->frequency;
    /* Within the cycle, so that cycles are equal to the last bit. */
    const double x = 2.0 * NUM_PI * (step % d->steps) / d->steps, y = x + d->phase;
    return (struct state){
        .theta = d->mean + d->amplitude * sin(x),
        .theta_rate = d->amplitude * omega * cos(x),
        .theta_acceleration = -d->amplitude * omega * omega * sin(x),
        .w = d->plunge * sin(y),
        .w_rate = d->plunge * omega * cos(y),
        .w_acceleration = -d->plunge * omega * omega * sin(y),
        .w_jerk = -d->plunge * omega * omega * omega * cos(y),
    };
}

static double time_step(const struct loop_def *d)
{
    return d->motion != NULL ? d->motion->step : 1.0 / (d->frequency * d->steps);
}

/* Weight of sample i in the integrals over the last cycle, which closes on itself, or the table. */
static double weight(const struct loop_def *d, int n, int i)
{
    if (d->motion != NULL) {
        return i == 0 || i == n - 1 ? 0.5 : 1.0;
    }
    return i >= n - d->steps ? 1.0 : 0.0;
}

/* Everything the models keep while they march one station. */
struct station {
    struct polar *polar;
    struct network *network;
    struct attached attached;
    struct dynamic_stall stall;
    double wake[ATTACHED_LAGS], stall_state[STALL_ARRAYS];
    double alpha_34; /* of the step before */
};

static void station_done(struct station *s)
{
    dynamic_stall_done(&s->stall);
    attached_done(&s->attached);
    network_destroy(s->network);
    polar_destroy(s->polar);
}

/* The caller clears up what a failure leaves half built. */
static enum status station_init(const struct loop_def *d, struct station *s)
{
    const double dt = time_step(d);
    enum status st = polar_create(d->polar, &s->polar);
    if (st == ST_OK && d->dynamic == DYNAMIC_NETWORK) {
        st = network_create(d->network, &s->network);
    }
    if (st == ST_OK && (d->dynamic == DYNAMIC_ATTACHED || d->dynamic == DYNAMIC_STALL)) {
        st = attached_init(1, &chord, speed, dt, &s->attached);
    }
    if (st == ST_OK && d->dynamic == DYNAMIC_STALL) {
        st = dynamic_stall_init(1, &chord, speed, dt, s->polar, &d->polar->stall, &s->stall);
    }
    return st;
}

/* The angle that acts: of the chord in the relative stream, or what the wake lets act of the one at
 * three quarters of the chord. */
static double effective_angle(struct station *s, const struct state *m, bool first)
{
    double alpha = m->theta - m->w_rate;
    if (s->attached.n == 0) {
        return alpha;
    }
    const double alpha_34 = alpha + 0.25 * m->theta_rate;
    if (first) {
        attached_steady(1, &alpha_34, s->wake);
    } else {
        attached_step(&s->attached, &s->alpha_34, &alpha_34, s->wake);
    }
    s->alpha_34 = alpha_34;
    attached_angle(1, &alpha_34, s->wake, &alpha);
    return alpha;
}

static void add_stall(struct station *s, double alpha, const struct state *m, bool first, double *c)
{
    if (s->stall.n == 0) {
        return;
    }
    if (first) {
        dynamic_stall_steady(&s->stall, &alpha, &m->w, s->stall_state);
    } else {
        dynamic_stall_step(&s->stall, &alpha, &m->w, s->stall_state);
    }
    dynamic_stall_coefficients(&s->stall, &alpha, s->stall_state, &c[LOOP_CL], &c[LOOP_CD],
                               &c[LOOP_CM]);
}

/* The sliding mean over a cycle that the network sees is the mean of the motion. One when that is
 * outside its hull, else zero. */
static int add_network(const struct station *s, const struct loop_def *d, double alpha,
                       const struct state *m, double *c)
{
    double out[NET_OUT_COUNT];
    if (s->network == NULL) {
        return 0;
    }
    const double in[NET_IN_COUNT] = {
        [NET_IN_MEAN_ALPHA] = d->mean,
        [NET_IN_DELTA_ALPHA] = alpha - d->mean,
        [NET_IN_ALPHA_RATE] = m->theta_rate - m->w_acceleration,
        [NET_IN_ALPHA_ACCELERATION] = m->theta_acceleration - m->w_jerk,
        [NET_IN_PLUNGE_RATE] = m->w_rate,
    };
    const int outside = network_eval(s->network, 1, in, out);
    c[LOOP_CL] += out[NET_OUT_CL];
    c[LOOP_CD] += out[NET_OUT_CD];
    c[LOOP_CM] += out[NET_OUT_CM];
    return outside;
}

static void add_apparent_mass(const struct station *s, const struct state *m, double *c)
{
    if (s->attached.n == 0) {
        return;
    }
    c[LOOP_CL] += attached_cl_rate() * m->theta_rate -
                  attached_mass(density, chord) * m->w_acceleration / dynamic_pressure;
    c[LOOP_CM] += attached_cm_rate() * m->theta_rate -
                  attached_inertia(density, chord) * m->theta_acceleration / dynamic_pressure;
}

static void march(const struct loop_def *d, struct station *s, struct loop_result *r)
{
    const double dt = time_step(d);
    for (int i = 0; i < r->n; i++) {
        const struct state m = state_at(d, i);
        const double alpha = effective_angle(s, &m, i == 0);
        const struct polar_value v = polar_at(s->polar, alpha, m.w);
        double c[LOOP_QUANTITIES] = {
            [LOOP_TIME] = i * dt, [LOOP_ALPHA] = m.theta, [LOOP_PLUNGE] = m.w,
            [LOOP_CL] = v.cl,     [LOOP_CD] = v.cd,       [LOOP_CM] = v.cm,
        };
        r->outside_polar += v.outside;
        add_stall(s, alpha, &m, i == 0, c);
        r->outside_hull += add_network(s, d, alpha, &m, c);
        add_apparent_mass(s, &m, c);
        c[LOOP_CD] = polar_def_has_drag(d->polar) ? c[LOOP_CD] : (double)NAN;
        for (int k = 0; k < LOOP_QUANTITIES; k++) {
            r->value[num_at(i, k, r->n)] = c[k];
        }
        r->work_pitch += weight(d, r->n, i) * c[LOOP_CM] * m.theta_rate * dt;
        r->work_plunge += weight(d, r->n, i) * c[LOOP_CL] * m.w_rate * dt;
    }
}

enum status loop_run(const struct loop_def *def, struct loop_result *out)
{
    assert(def->polar != NULL);
    assert(def->dynamic != DYNAMIC_NETWORK || def->network != NULL);
    struct station station = {0};
    struct loop_result r = {.n = def->motion != NULL ? def->motion->n
                                                     : def->cycles * def->steps + 1};
    enum status st = station_init(def, &station);
    if (st == ST_OK) {
        r.value = malloc((size_t)r.n * LOOP_QUANTITIES * sizeof *r.value);
        st = r.value != NULL ? ST_OK : ST_NO_MEMORY;
    }
    if (st == ST_OK) {
        march(def, &station, &r);
        *out = r;
    }
    station_done(&station);
    return st;
}

void loop_done(struct loop_result *r)
{
    free(r->value);
    *r = (struct loop_result){0};
}
