#include "core/analysis/free_section.h"

#include "core/coupling/apparent_mass.h"
#include "core/coupling/excitation.h"
#include "core/la.h"
#include "core/num.h"
#include "core/range.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { FREEDOMS = 2, PLUNGE = 0, PITCH = 1 };
enum { STEPS_MAX = 1000000 };

/* The units of this room. */
static const double chord = 1.0, speed = 1.0, density = 1.0;
/* Stop rules: where the section would stand across the stream, and near the walls of a channel. */
static const double twist_max = 0.5 * NUM_PI, plunge_max = 2.0;

void free_section_def_defaults(struct free_section_def *def)
{
    *def = (struct free_section_def){
        .dynamic = DYNAMIC_NONE, .mass = 50.0, .inertia = 4.0, .duration = 200.0, .step = 0.02};
}

#define FIELD(name_, member, degrees_, low_, high_, open_, expected_)                              \
    {                                                                                              \
        .name = (name_), .offset = offsetof(struct free_section_def, member),                      \
        .degrees = (degrees_), .low = (low_), .high = (high_), .open = (open_),                    \
        .expected = (expected_)                                                                    \
    }
const struct free_section_field free_section_fields[FREE_SECTION_FIELDS] = {
    FIELD("mass", mass, false, 0.0, 1e6, true, "above 0 and at most 1e6 rho c^2"),
    FIELD("inertia", inertia, false, 0.0, 1e6, true, "above 0 and at most 1e6 rho c^4"),
    FIELD("axis", axis, false, -1.0, 1.0, false, "-1..1 chords behind mid-chord"),
    FIELD("imbalance", imbalance, false, -1.0, 1.0, false, "-1..1 chords behind the axis"),
    FIELD("plunge_frequency", plunge_frequency, false, 0.0, 10.0, true, "f c/V, above 0, <= 10"),
    FIELD("pitch_frequency", pitch_frequency, false, 0.0, 10.0, true, "f c/V, above 0, <= 10"),
    FIELD("plunge_damping", plunge_damping, false, 0.0, 0.9, false, "0..0.9"),
    FIELD("pitch_damping", pitch_damping, false, 0.0, 0.9, false, "0..0.9"),
    FIELD("rest_deg", rest, true, -90.0, 90.0, false, "-90..90"),
    FIELD("pitch_deg", pitch, true, -90.0, 90.0, false, "-90..90"),
    FIELD("pitch_rate_deg", pitch_rate, true, -90.0, 90.0, false, "-90..90 a c/V"),
    FIELD("plunge", plunge, false, -2.0, 2.0, false, "-2..2 chords"),
    FIELD("plunge_rate", plunge_rate, false, -1.0, 1.0, false, "-1..1 V"),
    FIELD("duration", duration, false, 0.0, 1e5, true, "c/V, above 0 and at most 1e5"),
    FIELD("step", step, false, 0.0, 0.5, true, "c/V, above 0 and at most 0.5"),
};

void free_section_def_check(const struct free_section_def *def, struct failure_list *out)
{
    const char *base = (const char *)def;
    for (int i = 0; i < FREE_SECTION_FIELDS; i++) {
        const struct free_section_field *f = &free_section_fields[i];
        double v;
        memcpy(&v, base + f->offset, sizeof v);
        v = f->degrees ? num_deg(v) : v;
        if (!(v <= f->high && (f->open ? v > f->low : v >= f->low))) {
            range_refuse(out, f->name, f->expected, v);
        }
    }
    if (!(def->inertia > def->mass * num_sq(def->imbalance))) {
        range_refuse(out, "inertia", "more than mass times imbalance squared", def->inertia);
    }
    if (!(def->duration >= def->step && def->duration <= def->step * STEPS_MAX)) {
        range_refuse(out, "duration", "1..1e6 steps", def->duration);
    }
}

/* The case behind the model: nothing of the beam in it is read but its length. */
static void fill_case(const struct free_section_def *d, struct case_def *out)
{
    case_def_defaults(out);
    out->beam.length = 1.0;
    out->beam.elements = 1;
    out->flow.speed = speed;
    out->flow.density = density;
    out->flow.incidence = d->rest;
    out->aero.polar = d->polar;
    out->aero.dynamic = d->dynamic;
    out->aero.network = d->network;
    out->aero.lifting_line = false;
    out->solver.modes = FREEDOMS;
    out->solver.time_step = d->step;
    out->solver.duration = d->duration;
    out->solver.twist_max = twist_max;
    out->solver.plunge_max = plunge_max;
    out->output.n_channel = 0;
    out->output.mean_window = d->step;
}

/* Modes in a vacuum: of plunge at the elastic axis and pitch, with x towards the leading edge, so
 * that a mass centre behind the axis goes down when the nose goes up. */
static enum status solve_modes(const struct free_section_def *d, double *lambda, double *shape)
{
    const double off = -d->mass * d->imbalance;
    const double stiff[FREEDOMS] = {
        [PLUNGE] = d->mass * num_sq(2.0 * NUM_PI * d->plunge_frequency),
        [PITCH] = d->inertia * num_sq(2.0 * NUM_PI * d->pitch_frequency),
    };
    double mass[FREEDOMS * FREEDOMS] = {d->mass, off, off, d->inertia};
    double stiffness[FREEDOMS * FREEDOMS] = {stiff[PLUNGE], 0.0, 0.0, stiff[PITCH]};
    return la_smallest_modes(FREEDOMS, stiffness, mass, FREEDOMS, lambda, shape);
}

static enum status allocate(struct model *m)
{
    enum status st = model_allocate(m);
    if (st == ST_OK) {
        st = excitation_allocate(m); /* nothing drives */
    }
    m->modes = (struct modes){.n_mode = FREEDOMS, .omega = calloc(FREEDOMS, sizeof(double))};
    return st == ST_OK && m->modes.omega == NULL ? ST_NO_MEMORY : st;
}

static enum status fill_modes(const struct free_section_def *d, struct model *m)
{
    double lambda[FREEDOMS], shape[FREEDOMS * FREEDOMS];
    const enum status st = solve_modes(d, lambda, shape);
    for (int j = 0; j < FREEDOMS && st == ST_OK; j++) {
        const double theta = shape[num_at(PITCH, j, FREEDOMS)];
        /* Shares of the unit modal mass: the pitch has more than half in one of the two. */
        const bool pitches = d->inertia * num_sq(theta) > 0.5;
        m->modes.omega[j] = sqrt(lambda[j]);
        m->omega2[j] = lambda[j];
        m->damping[j] = 2.0 * (pitches ? d->pitch_damping : d->plunge_damping) * m->modes.omega[j];
        m->station_theta[j] = theta;
        m->station_v[j] = shape[num_at(PLUNGE, j, FREEDOMS)] + d->axis * chord * theta;
        m->tip[j] = (struct beam_motion){.v = m->station_v[j], .theta = theta};
    }
    return st;
}

enum status free_section_model(const struct free_section_def *def, struct model *out)
{
    assert(def->polar != NULL);
    assert(def->dynamic != DYNAMIC_NETWORK || def->network != NULL);
    struct model m = {.n_mode = FREEDOMS, .n_station = 1, .station_length = 1.0, .area = chord};
    fill_case(def, &m.def);
    enum status st = allocate(&m);
    if (st == ST_OK) {
        m.chord[0] = chord;
        st = fill_modes(def, &m);
    }
    if (st == ST_OK) {
        st = model_build_aero(&m);
    }
    if (st != ST_OK) {
        model_done(&m);
        return st;
    }
    *out = m;
    return ST_OK;
}

/* Amplitudes in vacuo of a state of the two freedoms: x = X q, q = X' M x. */
static void project(const struct free_section_def *d, const double *shape, double plunge,
                    double pitch, double *vacuo)
{
    const double off = -d->mass * d->imbalance;
    for (int j = 0; j < FREEDOMS; j++) {
        vacuo[j] = shape[num_at(PLUNGE, j, FREEDOMS)] * (d->mass * plunge + off * pitch) +
                   shape[num_at(PITCH, j, FREEDOMS)] * (off * plunge + d->inertia * pitch);
    }
}

static enum status set_start(const struct free_section_def *d, const struct model *m,
                             struct workspace *w)
{
    double lambda[FREEDOMS], shape[FREEDOMS * FREEDOMS], vacuo[FREEDOMS];
    const enum status st = solve_modes(d, lambda, shape);
    if (st == ST_OK) {
        project(d, shape, d->plunge, d->pitch, vacuo);
        apparent_mass_from_vacuo(m, vacuo, w->q);
        project(d, shape, d->plunge_rate, d->pitch_rate, vacuo);
        apparent_mass_from_vacuo(m, vacuo, w->qd);
    }
    return st;
}

static void collect(const struct free_section_def *d, const struct record *record,
                    struct free_section_result *r)
{
    static const enum history_column column[FREE_QUANTITIES] = {
        [FREE_ALPHA] = HISTORY_TWIST, [FREE_PLUNGE] = HISTORY_PLUNGE, [FREE_CL] = HISTORY_CL,
        [FREE_CD] = HISTORY_CD,       [FREE_CM] = HISTORY_CM,
    };
    const bool drag = polar_def_has_drag(d->polar);
    for (int k = 0; k < FREE_QUANTITIES; k++) {
        const double *from = record_history(record, (int)column[k]);
        for (int i = 0; i < r->n; i++) {
            r->value[num_at(i, k, r->n)] = k == FREE_CD && !drag ? (double)NAN : from[i];
        }
    }
    for (int i = 0; i < r->n; i++) {
        r->value[num_at(i, FREE_TIME, r->n)] = i * d->step;
        r->value[num_at(i, FREE_ALPHA, r->n)] += d->rest;
    }
}

static enum status march(const struct free_section_def *d, struct model *m, struct workspace *w,
                         struct record *record, struct free_section_result *out)
{
    struct march march;
    enum status st = set_start(d, m, w);
    if (st == ST_OK) {
        march_init(m, w, record, &march);
        st = march_run(&march, NULL);
    }
    if (st != ST_OK) {
        return st;
    }
    struct free_section_result r = {.n = record->n,
                                    .stop = march.stop,
                                    .outside_polar = w->counters.outside_polar,
                                    .outside_hull = w->counters.outside_hull};
    r.value = malloc((size_t)r.n * FREE_QUANTITIES * sizeof *r.value);
    if (r.value == NULL) {
        return ST_NO_MEMORY;
    }
    collect(d, record, &r);
    *out = r;
    return ST_OK;
}

enum status free_section_run(const struct free_section_def *def, struct free_section_result *out)
{
    struct model *m = calloc(1, sizeof *m);
    struct workspace w = {0};
    struct record record = {0};
    if (m == NULL) {
        return ST_NO_MEMORY;
    }
    enum status st = free_section_model(def, m);
    if (st == ST_OK) {
        st = workspace_init(m, &w);
    }
    if (st == ST_OK) {
        st = record_init(m, &record);
    }
    if (st == ST_OK) {
        st = march(def, m, &w, &record, out);
    }
    record_done(&record);
    workspace_done(&w);
    model_done(m);
    free(m);
    return st;
}

void free_section_done(struct free_section_result *r)
{
    free(r->value);
    *r = (struct free_section_result){0};
}
