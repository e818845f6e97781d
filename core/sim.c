#include "core/sim.h"

#include "core/analysis/doubt.h"
#include "core/analysis/equilibrium.h"
#include "core/coupling/apparent_mass.h"
#include "core/coupling/excitation.h"
#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

struct sim {
    struct model model;
    struct workspace workspace; /* simulation only, as is the record */
    struct record record;
    struct sim_result result;
};

void sim_process_init(void)
{
    la_process_init();
}

const char *sim_blas_description(void)
{
    return la_description();
}

const char *mode_label_name(enum mode_label label)
{
    static const char *const name[MODE_LABEL_COUNT] = {"bending", "lag", "torsion", "axial",
                                                       "mixed"};
    assert((unsigned)label < MODE_LABEL_COUNT);
    return name[label];
}

const char *stop_reason_name(enum stop_reason r)
{
    static const char *const name[STOP_REASON_COUNT] = {"duration", "amplitude", "outside_polar",
                                                        "not_finite"};
    assert((unsigned)r < STOP_REASON_COUNT);
    return name[r];
}

const char *wash_name(enum wash w)
{
    static const char *const name[] = {"none", "wash_out", "wash_in"};
    assert((unsigned)w < sizeof name / sizeof name[0]);
    return name[w];
}

enum status sim_create_like(const struct case_def *def, const struct sim *like, struct sim **out,
                            struct failure *fail)
{
    struct sim *s = calloc(1, sizeof *s);
    if (s == NULL) {
        failure_set(fail, ST_NO_MEMORY, "", "no_memory", NULL, NULL, "no memory for the run");
        return ST_NO_MEMORY;
    }
    if (def->kind == CASE_TRAINING) {
        failure_set(fail, ST_INVALID, "/kind", "not_computed", "another kind", "training",
                    "a training is a job of the daemon, or `aerom train`");
        sim_destroy(s);
        return ST_INVALID;
    }
    if (!case_kind_has_beam(def->kind)) {
        s->model.def = *def;
        *out = s;
        return ST_OK;
    }
    const bool built = like != NULL && case_kind_has_beam(like->model.def.kind);
    enum status st = model_build_like(def, built ? &like->model : NULL, &s->model, fail);
    if (st == ST_OK && def->kind == CASE_SIMULATION) {
        st = workspace_init(&s->model, &s->workspace);
        if (st == ST_OK) {
            st = record_init(&s->model, &s->record);
        }
        if (st != ST_OK) {
            failure_set(fail, st, "/solver", status_name(st), NULL, NULL,
                        "the workspace and the record of the run: %s", status_text(st));
        }
    }
    if (st != ST_OK) {
        sim_destroy(s);
        return st;
    }
    *out = s;
    return ST_OK;
}

enum status sim_create(const struct case_def *def, struct sim **out, struct failure *fail)
{
    return sim_create_like(def, NULL, out, fail);
}

static enum status report_section(const struct model *m, struct section_result *out)
{
    const struct section_summary *s = &m->section_summary;
    _Static_assert((int)SECTION_STRAINS == (int)SECTION_STRAIN_COUNT, "same strains");
    _Static_assert((int)SECTION_CLASSICAL == (int)SECTION_CLASSIC, "same strains");
    memcpy(out->stiffness, m->section.stiffness, sizeof out->stiffness);
    memcpy(out->stiffness_condensed, m->section.classic, sizeof out->stiffness_condensed);
    memcpy(out->mass, m->section.mass, sizeof out->mass);
    out->mass_per_length = m->section.mass[num_at(M_U, M_U, SECTION_MASS)];
    out->thickness = m->thickness;
    out->centres = m->centres;
    out->ei_flap = s->ei_flap;
    out->ei_lag = s->ei_lag;
    out->gj = s->gj;
    out->bend_twist = s->bend_twist;
    /* Upward load bends up (v'' > 0, phi' < 0); with no torque theta' = bend_twist v''/GJ. */
    const double relative = s->bend_twist / sqrt(s->ei_flap * s->gj);
    out->wash = fabs(relative) < 1e-9 ? WASH_NONE : (relative > 0.0 ? WASH_IN : WASH_OUT);
    const struct shape *shape = &beam_def_root(&m->def.beam)->shape;
    if (shape->type == SECTION_PROPERTIES) {
        return ST_OK; /* no walls */
    }
    out->cells = shape_cells(shape);
    return warping_line(shape, out->warping, &out->n_warping);
}

static enum mode_label label_of(const double share[MODE_SHARES])
{
    static const double clear_majority = 0.8;
    static const enum mode_label label[MODE_SHARES] = {MODE_BENDING, MODE_LAG, MODE_TORSION,
                                                       MODE_AXIAL};
    for (int f = 0; f < MODE_SHARES; f++) {
        if (share[f] >= clear_majority) {
            return label[f];
        }
    }
    return MODE_MIXED;
}

static void report_modes(const struct model *m, struct sim_result *out)
{
    out->n_mode = m->modes.n_mode;
    for (int j = 0; j < out->n_mode; j++) {
        struct mode_result *r = &out->mode[j];
        const double *shape = m->modes.shape + (size_t)j * (size_t)m->modes.n_dof;
        const struct beam_motion tip = model_motion_at(m, shape, m->beam.length);
        const double chord = section_def_chord(beam_def_root(&m->def.beam));
        const double largest = fmax(fmax(fabs(tip.u), fabs(tip.v)), fabs(tip.theta) * chord);
        r->frequency_hz = m->modes.omega[j] / (2.0 * NUM_PI);
        memcpy(r->share, m->modes.share + (size_t)j * MODE_SHARES, sizeof r->share);
        r->label = label_of(r->share);
        r->modal_mass = 1.0 / num_sq(largest);
        for (int i = 0; i < MODE_SAMPLES; i++) {
            const struct beam_motion at =
                model_motion_at(m, shape, m->beam.length * i / (MODE_SAMPLES - 1));
            r->plunge[i] = at.v;
            r->chordwise[i] = at.u;
            r->twist[i] = at.theta;
        }
    }
}

/* Mean of a history column over the last `window` seconds. */
static double history_mean(const struct record *r, int column, int from)
{
    const double *y = record_history(r, column);
    double sum = 0.0;
    for (int i = from; i < r->n; i++) {
        sum += y[i];
    }
    return sum / (r->n - from);
}

static int window_start(const struct record *r, double window, double dt)
{
    const int samples = record_window(window, dt);
    return samples < r->n ? r->n - samples : 0;
}

static void report_means(const struct sim *s, struct sim_result *out)
{
    const struct record *r = &s->record;
    const struct case_def *def = &s->model.def;
    const double dt = def->solver.time_step;
    const int from = window_start(r, def->output.mean_window, dt);
    const double force = s->model.dynamic_pressure * s->model.area;
    const double mean_chord = s->model.area / def->beam.length;
    out->means.window_from = from * dt;
    out->means.window_to = (r->n - 1) * dt;
    out->means.tip_plunge = history_mean(r, HISTORY_PLUNGE, from);
    out->means.tip_twist = history_mean(r, HISTORY_TWIST, from);
    out->means.plunge_rms = damping_fluctuation(record_history(r, HISTORY_PLUNGE), from, r->n);
    out->means.twist_rms = damping_fluctuation(record_history(r, HISTORY_TWIST), from, r->n);
    out->means.cl = history_mean(r, HISTORY_CL, from);
    out->means.cd =
        polar_def_has_drag(def->aero.polar) ? history_mean(r, HISTORY_CD, from) : (double)NAN;
    out->means.cm = history_mean(r, HISTORY_CM, from);
    out->means.lift = force * out->means.cl;
    out->means.drag = force * out->means.cd;
    out->means.moment = force * mean_chord * out->means.cm;
    out->means.efficiency = out->means.lift / out->means.drag;
}

static struct extreme extremes(const struct record *r, int column, double dt)
{
    const double *y = record_history(r, column);
    struct extreme e = {.max = y[0], .min = y[0]};
    for (int i = 1; i < r->n; i++) {
        if (y[i] > e.max) {
            e.max = y[i];
            e.max_time = i * dt;
        }
        if (y[i] < e.min) {
            e.min = y[i];
            e.min_time = i * dt;
        }
    }
    return e;
}

static void report_peaks(const struct sim *s, struct sim_result *out)
{
    const double dt = s->model.def.solver.time_step;
    out->peak_plunge = extremes(&s->record, HISTORY_PLUNGE, dt);
    out->peak_twist = extremes(&s->record, HISTORY_TWIST, dt);
    out->peak_bending = extremes(&s->record, HISTORY_BENDING, dt);
}

/* Squared mean modal contribution over the last modal_window seconds (Fig. 14). */
static void report_contribution(const struct sim *s, int first_column, double *out)
{
    const struct record *r = &s->record;
    const int from =
        window_start(r, s->model.def.output.modal_window, s->model.def.solver.time_step);
    double total = 0.0;
    for (int j = 0; j < r->n_mode; j++) {
        const double *y = record_history(r, first_column + j);
        out[j] = 0.0;
        for (int i = from; i < r->n; i++) {
            out[j] += num_sq(y[i]);
        }
        total += out[j];
    }
    for (int j = 0; j < r->n_mode && total > 0.0; j++) {
        out[j] /= total;
    }
}

static enum status report_damping(const struct sim *s, struct sim_result *out)
{
    const struct record *r = &s->record;
    const double dt = s->model.def.solver.time_step;
    struct damping_system system = {.n_mode = out->n_mode,
                                    .frequency_low = out->mode[0].frequency_hz,
                                    .frequency_high = out->mode[out->n_mode - 1].frequency_hz};
    double share = 0.5; /* of the kinetic energy: the first mode that is mostly torsion */
    for (int j = out->n_mode - 1; j >= 0; j--) {
        system.frequency_torsion =
            out->mode[j].share[2] > share ? out->mode[j].frequency_hz : system.frequency_torsion;
    }
    enum status st =
        damping_identify(r->n, record_history(r, HISTORY_TWIST), dt, &system, &out->tip_twist);
    if (st == ST_OK) {
        st = damping_identify(r->n, record_history(r, HISTORY_PLUNGE), dt, &system,
                              &out->tip_plunge);
    }
    return st;
}

/* E* = E_l (h/c)^3 / (rho V^2/2) with the stiffest ply, and V c/nu, both of the root section.
 * Without plies there is no E*: its thickness is NaN. */
static void report_similarity(const struct model *m, struct sim_result *out)
{
    const struct section_def *s = beam_def_root(&m->def.beam);
    const double chord = section_def_chord(s), ratio = m->thickness / chord;
    double e_l = 0.0;
    for (int l = 0; l < s->shape.n_layup; l++) {
        for (int i = 0; i < s->shape.layup[l].n_ply; i++) {
            e_l = fmax(e_l, s->shape.layup[l].ply[i].material.e_l);
        }
    }
    out->e_star = e_l * ratio * ratio * ratio / m->dynamic_pressure;
    out->reynolds = m->def.flow.speed * chord / m->def.flow.kinematic_viscosity;
}

static enum status set_start(struct sim *s, struct failure *fail)
{
    const struct solver_def *solver = &s->model.def.solver;
    struct workspace *w = &s->workspace;
    if (solver->start == START_AMPLITUDES) {
        /* Those that are not given are zero. */
        apparent_mass_from_vacuo(&s->model, solver->amplitude, w->q);
        apparent_mass_from_vacuo(&s->model, solver->velocity, w->qd);
    }
    if (solver->start != START_EQUILIBRIUM) {
        return ST_OK;
    }
    double residual = 0.0;
    excitation_set(&s->model, 0.0, w);
    const enum status st = equilibrium_solve(&s->model, w, &residual);
    if (st != ST_OK) {
        failure_set(fail, st, "/solver/start", "no_equilibrium", NULL, NULL,
                    "no static equilibrium was found from the undeformed beam (relative residual "
                    "%.2g): beyond divergence, or on a stalled slope; start from rest instead",
                    residual);
    }
    return st;
}

static void report_march(const struct sim *s, const struct march *march, struct sim_result *out)
{
    const struct workspace *w = &s->workspace;
    out->verdict = verdict_of(march, out->verdict_reason);
    out->stop = march->stop;
    out->steps = march->steps;
    out->time_step = s->model.def.solver.time_step;
    out->stop_time = march->steps * out->time_step;
    out->n_column = s->record.n_column;
    out->n_sample = s->record.n_sample;
    out->sample_step = out->time_step * s->model.def.output.sample_every;
    out->counters = (struct sim_counters){
        .outside_polar = w->counters.outside_polar,
        .outside_hull = w->counters.outside_hull,
        .load_alternations = doubt_alternations(&s->record, 0),
        .not_converged = w->counters.not_converged,
        .lifting_line_iterations = w->counters.lifting_line_iterations,
        .inner_steps = march->rk4.inner_steps,
        .lifting_line_residual = w->counters.lifting_line_residual,
        .lifting_line_regularised = w->counters.lifting_line_regularised,
        .lifting_line_smoothing = w->counters.lifting_line_smoothing,
    };
}

/* Where and when a march ended that could not go on. */
static void explain(enum status st, const struct march *march, struct failure *fail)
{
    const double time = march->steps * march->model->def.solver.time_step;
    failure_set(fail, st, "/solver", status_name(st), NULL, NULL, "at %.6g s, step %d: %s", time,
                march->steps, status_text(st));
}

static enum status run_simulation(struct sim *s, const struct sim_control *control,
                                  struct failure *fail)
{
    enum status st = set_start(s, fail);
    if (st != ST_OK) {
        return st;
    }
    /* Counters are those of the march, not of the search for its start. */
    memset(&s->workspace.counters, 0, sizeof s->workspace.counters);
    struct march march;
    double q0[LIMIT_MODES], qd0[LIMIT_MODES];
    const size_t bytes = (size_t)s->model.n_mode * sizeof(double);
    memcpy(q0, s->workspace.q, bytes);
    memcpy(qd0, s->workspace.qd, bytes);
    march_init(&s->model, &s->workspace, &s->record, &march);
    st = march_run(&march, control);
    if (st != ST_OK) {
        explain(st, &march, fail);
        return st;
    }
    if (march.stop == STOP_AMPLITUDE) {
        march.rest = equilibrium_near(&s->model, &s->workspace, q0, qd0);
    }
    struct sim_result *out = &s->result;
    report_march(s, &march, out);
    report_similarity(&s->model, out);
    report_means(s, out);
    span_loads_report(&s->model, &s->record, &out->loads);
    report_peaks(s, out);
    report_contribution(s, HISTORY_MODAL, out->contribution_position);
    report_contribution(s, HISTORY_MODAL + s->record.n_mode, out->contribution_velocity);
    st = report_damping(s, out);
    if (st != ST_OK) {
        failure_set(fail, st, "", status_name(st), NULL, NULL,
                    "the damping could not be identified: %s", status_text(st));
    }
    return st;
}

static enum status run_static(struct sim *s, struct failure *fail)
{
    const enum status st = statics_run(&s->model, &s->result.statics);
    if (st != ST_OK) {
        failure_set(fail, st, "/beam", status_name(st), NULL, NULL,
                    "the static deflection could not be computed: %s", status_text(st));
    }
    return st;
}

static enum status run_stability(struct sim *s, const struct sim_control *control,
                                 struct failure *fail)
{
    const enum status st = stability_run(&s->model, control, &s->result.stability);
    if (st == ST_NOT_CONVERGED) {
        failure_set(fail, st, "/stability/from_m_s", "no_equilibrium", "a lower speed", NULL,
                    "no static equilibrium was found at a twentieth of the lowest speed: on a "
                    "stalled slope, or far beyond divergence");
    } else if (st != ST_OK) {
        failure_set(fail, st, "/stability", status_name(st), NULL, NULL,
                    "the stability could not be computed: %s", status_text(st));
    } else {
        s->result.verdict = stability_verdict(&s->result.stability, s->result.verdict_reason);
    }
    return st;
}

static enum status run_loop(struct sim *s, struct failure *fail)
{
    const struct loop_def d = case_def_loop(&s->model.def);
    struct sim_result *out = &s->result;
    const enum status st = loop_run(&d, &out->loop);
    if (st != ST_OK) {
        failure_set(fail, st, "/motion", status_name(st), NULL, NULL,
                    "the loop could not be computed: %s", status_text(st));
        return st;
    }
    out->n_column =
        polar_def_has_drag(d.polar) ? LOOP_QUANTITIES - LOOP_ALPHA : LOOP_CD - LOOP_ALPHA;
    out->n_sample = out->loop.n;
    out->sample_step = out->loop.value[1] - out->loop.value[0];
    return ST_OK;
}

static enum status run_beam(struct sim *sim, const struct sim_control *control,
                            struct failure *fail)
{
    const enum case_kind kind = sim->model.def.kind;
    enum status st = report_section(&sim->model, &sim->result.section);
    if (st != ST_OK) {
        failure_set(fail, st, "/beam", status_name(st), NULL, NULL,
                    "the warping function could not be computed: %s", status_text(st));
        return st;
    }
    if (kind == CASE_MODES || case_kind_flows(kind)) {
        report_modes(&sim->model, &sim->result);
    }
    if (kind == CASE_SIMULATION) {
        st = run_simulation(sim, control, fail);
    } else if (kind == CASE_STATIC) {
        st = run_static(sim, fail);
    } else if (kind == CASE_STABILITY) {
        st = run_stability(sim, control, fail);
    }
    return st;
}

enum status sim_run(struct sim *sim, const struct sim_control *control, struct failure *fail)
{
    const enum status st = case_kind_has_beam(sim->model.def.kind) ? run_beam(sim, control, fail)
                                                                   : run_loop(sim, fail);
    if (st == ST_OK) {
        sim_control_tell(control, 1.0);
    }
    return st;
}

const struct sim_result *sim_result(const struct sim *sim)
{
    return &sim->result;
}

const double *sim_column(const struct sim *sim, int column)
{
    assert(column >= 0);
    assert(column < sim->result.n_column);
    if (sim->model.def.kind == CASE_LOOP) {
        return sim->result.loop.value + num_at(0, LOOP_ALPHA + column, sim->result.n_sample);
    }
    return sim->record.sample + (ptrdiff_t)sim->record.sample_capacity * column;
}

void sim_destroy(struct sim *sim)
{
    if (sim != NULL) {
        loop_done(&sim->result.loop);
        statics_done(&sim->result.statics);
        stability_done(&sim->result.stability);
        record_done(&sim->record);
        workspace_done(&sim->workspace);
        model_done(&sim->model);
        free(sim);
    }
}
