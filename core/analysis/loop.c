#include "core/analysis/loop.h"

#include "core/aero/moving_section.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>

/* The motion at one time. */
struct state {
    struct moving_state motion;
    double w_jerk;
};

static struct state state_of_table(const struct loop_motion *m, int i)
{
    return (struct state){
        .motion = {.theta = m->value[num_at(i, MOTION_THETA, m->n)],
                   .theta_rate = m->value[num_at(i, MOTION_THETA_RATE, m->n)],
                   .theta_acceleration = m->value[num_at(i, MOTION_THETA_ACCELERATION, m->n)],
                   .w = m->value[num_at(i, MOTION_W, m->n)],
                   .w_rate = m->value[num_at(i, MOTION_W_RATE, m->n)],
                   .w_acceleration = m->value[num_at(i, MOTION_W_ACCELERATION, m->n)]}};
}

static struct state state_at(const struct loop_def *d, int step)
{
    if (d->motion != NULL) {
        return state_of_table(d->motion, step);
    }
    const double omega = 2.0 * NUM_PI * d->frequency;
    /* Within the cycle, so that cycles are equal to the last bit. */
    const double x = 2.0 * NUM_PI * (step % d->steps) / d->steps, y = x + d->phase;
    return (struct state){.motion = {.theta = d->mean + d->amplitude * sin(x),
                                     .theta_rate = d->amplitude * omega * cos(x),
                                     .theta_acceleration = -d->amplitude * omega * omega * sin(x),
                                     .w = d->plunge * sin(y),
                                     .w_rate = d->plunge * omega * cos(y),
                                     .w_acceleration = -d->plunge * omega * omega * sin(y)},
                          .w_jerk = -d->plunge * omega * omega * omega * cos(y)};
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
    struct moving_section section;
};

static void station_done(struct station *s)
{
    moving_section_done(&s->section);
    network_destroy(s->network);
    polar_destroy(s->polar);
}

/* The caller clears up what a failure leaves half built. */
static enum status station_init(const struct loop_def *d, struct station *s)
{
    const struct network_frame frame = network_frame_under(d->dynamic, d->network);
    enum status st = polar_create(d->polar, &s->polar);
    if (st == ST_OK && d->dynamic == DYNAMIC_NETWORK) {
        st = network_create(d->network, &s->network);
    }
    return st == ST_OK ? moving_section_init(&frame, s->polar, time_step(d), &s->section) : st;
}

/* The sliding mean over a cycle that the network sees is the mean of the motion. */
static bool add_network(struct station *s, const struct loop_def *d, const struct state *at,
                        struct moving_value *v)
{
    double out[NET_OUT_COUNT], *in = s->section.input;
    const struct moving_state *m = &at->motion;
    if (s->network == NULL) {
        return false;
    }
    in[NET_IN_MEAN_ALPHA] = d->mean;
    in[NET_IN_DELTA_ALPHA] = in[NET_IN_ALPHA] - d->mean;
    in[NET_IN_ALPHA_RATE] = m->theta_rate - m->w_acceleration;
    in[NET_IN_ALPHA_ACCELERATION] = m->theta_acceleration - at->w_jerk;
    in[NET_IN_PLUNGE_RATE] = m->w_rate;
    const bool outside = network_eval(s->network, 1, in, out) > 0;
    v->cl += out[NET_OUT_CL];
    v->cd += out[NET_OUT_CD];
    v->cm += out[NET_OUT_CM];
    return outside;
}

static void march(const struct loop_def *d, struct station *s, struct loop_result *r)
{
    const double dt = time_step(d);
    for (int i = 0; i < r->n; i++) {
        const struct state at = state_at(d, i);
        const struct moving_state *m = &at.motion;
        struct moving_value v = moving_section_step(&s->section, m, i == 0);
        r->outside_polar += v.outside;
        r->outside_hull += add_network(s, d, &at, &v);
        const double c[LOOP_QUANTITIES] = {
            [LOOP_TIME] = i * dt, [LOOP_ALPHA] = m->theta,
            [LOOP_PLUNGE] = m->w, [LOOP_CL] = v.cl,
            [LOOP_CM] = v.cm,     [LOOP_CD] = polar_def_has_drag(d->polar) ? v.cd : (double)NAN,
        };
        for (int k = 0; k < LOOP_QUANTITIES; k++) {
            r->value[num_at(i, k, r->n)] = c[k];
        }
        r->work_pitch += weight(d, r->n, i) * v.cm * m->theta_rate * dt;
        r->work_plunge += weight(d, r->n, i) * v.cl * m->w_rate * dt;
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
