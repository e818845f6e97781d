#include "core/case_def.h"

#include "core/aero/attached.h"
#include "core/aero/dynamic_stall.h"
#include "core/num.h"
#include "core/range.h"

#include <stdio.h>
#include <string.h>

void case_def_defaults(struct case_def *def)
{
    *def = (struct case_def){
        .kind = CASE_SIMULATION,
        .beam = {.elements = 16, .root_warping = ROOT_WARPING_RESTRAINED},
        .flow = {.density = 1.225, .kinematic_viscosity = 1.5e-5},
        .aero = {.dynamic = DYNAMIC_NONE,
                 .lifting_line = true,
                 .walls = WALLS_ROOT,
                 .tolerance = 1e-9,
                 .iterations_max = 50},
        .solver = {.modes = 4,
                   .time_step = 2e-4,
                   .integrator = INTEGRATOR_EXPONENTIAL,
                   .tolerance = 1e-9,
                   .load_order = 1,
                   .start = START_REST,
                   .twist_max = num_rad(60.0),
                   .plunge_max = 1.0,
                   .outside_max = 1.0},
        .stability = {.count = 40, .tolerance = 1e-6},
        .output = {.n_channel = 5,
                   .channel = {CHANNEL_TIP_PLUNGE, CHANNEL_TIP_TWIST, CHANNEL_CL, CHANNEL_CM,
                               CHANNEL_CD},
                   .sample_every = 1,
                   .mean_window = 1.0,
                   .modal_window = 0.2},
    };
    section_def_defaults(SECTION_STRIP, &def->beam.section);
    loop_def_defaults(&def->loop);
}

double case_def_driven_until(const struct case_def *def)
{
    const double root = fmax(drive_end(&def->beam.root_pitch), drive_end(&def->beam.root_plunge));
    return fmax(root, gust_end(&def->flow.gust, def->flow.speed));
}

bool case_def_flows(const struct case_def *def)
{
    return case_kind_flows(def->kind) || (def->kind == CASE_STATIC && def->aero.polar != NULL);
}

struct loop_def case_def_loop(const struct case_def *def)
{
    struct loop_def d = def->loop;
    d.polar = def->aero.polar;
    d.dynamic = def->aero.dynamic;
    d.network = def->aero.network;
    return d;
}

int case_def_channel_columns(const struct case_def *def, enum channel channel)
{
    if (channel == CHANNEL_MODAL_AMPLITUDE || channel == CHANNEL_MODAL_VELOCITY) {
        return def->solver.modes;
    }
    return channel >= CHANNEL_STATION_PLUNGE ? def->beam.elements : 1;
}

/* Steps as a double: the case may ask for more than an int holds. */
static double wanted_steps(const struct case_def *def)
{
    return fmax(1.0, ceil(def->solver.duration / def->solver.time_step - 1e-6));
}

int case_def_steps(const struct case_def *def)
{
    return (int)fmin(wanted_steps(def), LIMIT_STEPS);
}

int case_def_samples(const struct case_def *def)
{
    return case_def_steps(def) / def->output.sample_every + 1;
}

static void check_masses(const struct beam_def *b, struct failure_list *out)
{
    for (int i = 0; i < b->n_mass; i++) {
        const struct beam_mass *m = &b->mass[i];
        char z[80], mass[80], inertia[3][80];
        static const char axis[3] = {'x', 'y', 'z'};
        (void)snprintf(z, sizeof z, "/beam/masses/%d/z_m", i);
        (void)snprintf(mass, sizeof mass, "/beam/masses/%d/mass_kg", i);
        const struct range rule[] = {{z, m->z, 0.0, b->length, false, false},
                                     {mass, m->mass, 0.0, INFINITY, false, false}};
        RANGE_CHECK(rule, out);
        for (int k = 0; k < 3; k++) {
            (void)snprintf(inertia[k], sizeof inertia[k], "/beam/masses/%d/inertia_%c_kg_m2", i,
                           axis[k]);
            const struct range r = {inertia[k], m->inertia[k], 0.0, INFINITY, false, false};
            range_check(1, &r, out);
        }
    }
}

static void check_beam(const struct case_def *def, struct failure_list *out)
{
    const struct range rule[] = {
        {"/beam/length_m", def->beam.length, 0.0, INFINITY, true, false},
        {"/beam/elements", def->beam.elements, 1, LIMIT_ELEMENTS, false, false},
        {"/solver/modes", def->solver.modes, 1, LIMIT_MODES, false, false},
    };
    RANGE_CHECK(rule, out);
    check_masses(&def->beam, out);
    const int freedoms = BEAM_NODE_FREEDOMS * def->beam.elements;
    if (def->kind != CASE_STATIC && def->solver.modes > freedoms && def->beam.elements >= 1 &&
        def->solver.modes <= LIMIT_MODES) {
        char expected[64], got[32];
        (void)snprintf(expected, sizeof expected, "at most %d", freedoms);
        (void)snprintf(got, sizeof got, "%d", def->solver.modes);
        failure_set(failure_add(out), ST_INVALID, "/solver/modes", "too_many_modes", expected, got,
                    "%d elements have %d degrees of freedom", def->beam.elements, freedoms);
    }
}

static void check_flow(const struct case_def *def, struct failure_list *out)
{
    const struct flow_def *f = &def->flow;
    const struct range rule[] = {
        {"/flow/density_kg_m3", f->density, 0.0, INFINITY, false, false},
        {"/flow/kinematic_viscosity_m2_s", f->kinematic_viscosity, 0.0, INFINITY, true, false},
        {"/flow/incidence_deg", num_deg(f->incidence), -90.0, 90.0, false, false},
    };
    RANGE_CHECK(rule, out);
    if (def->kind != CASE_STABILITY) {
        const struct range speed = {"/flow/speed_m_s", f->speed, 0.0, INFINITY, true, false};
        range_check(1, &speed, out);
    }
}

/* A network adds to the polar it was trained on, and to no other. */
static void check_network(const struct aero_def *a, struct failure_list *out)
{
    if (a->network != NULL && a->polar != NULL && !a->network_forced &&
        network_def_is_of_other_polar(a->network, a->polar->hash)) {
        failure_set(failure_add(out), ST_INVALID, "/aerodynamics/dynamic/name", "other_polar",
                    "a network trained on this polar, or \"force\": true", a->network->name,
                    "the network %s adds to another polar than %s", a->network->name,
                    a->polar->name);
    }
}

static void check_models(const struct aero_def *a, struct failure_list *out)
{
    if (a->polar == NULL) {
        failure_set(failure_add(out), ST_INVALID, "/aerodynamics/polar", "missing",
                    "the name of a polar", NULL, "a section in a stream needs a polar");
    }
    if (a->dynamic == DYNAMIC_NETWORK && a->network == NULL) {
        failure_set(failure_add(out), ST_INVALID, "/aerodynamics/dynamic/name", "missing",
                    "the name of a network", NULL, "the dynamic part asks for a network");
    }
    check_network(a, out);
}

static void check_aero(const struct case_def *def, struct failure_list *out)
{
    const struct aero_def *a = &def->aero;
    const struct range rule[] = {
        {"/aerodynamics/lifting_line/tolerance", a->tolerance, 0.0, 1.0, true, true},
        {"/aerodynamics/lifting_line/iterations_max", a->iterations_max, 1, 1000, false, false},
    };
    if (a->lifting_line) {
        RANGE_CHECK(rule, out);
    }
    if (a->lifting_line && a->walls == WALLS_ROOT_AND_FAR && !(a->width > def->beam.length)) {
        char got[32];
        (void)snprintf(got, sizeof got, "%.10g", a->width);
        failure_set(failure_add(out), ST_INVALID, "/aerodynamics/lifting_line/width_m",
                    "out_of_range", "more than beam.length_m", got,
                    "the far wall must stand beyond the tip");
    }
    check_models(a, out);
}

/* Drag and efficiency can only be recorded if the polar has drag. */
static void check_drag(const struct case_def *def, struct failure_list *out)
{
    static const struct {
        enum channel channel;
        const char *name;
    } needs[] = {{CHANNEL_DRAG, "drag_n"},
                 {CHANNEL_CD, "cd"},
                 {CHANNEL_EFFICIENCY, "efficiency"},
                 {CHANNEL_STATION_CD, "station_cd"}};
    const struct polar_def *polar = def->aero.polar;
    if (polar == NULL || polar_def_has_drag(polar)) {
        return;
    }
    for (int i = 0; i < def->output.n_channel; i++) {
        for (size_t k = 0; k < sizeof needs / sizeof needs[0]; k++) {
            if (def->output.channel[i] == needs[k].channel) {
                char pointer[64];
                (void)snprintf(pointer, sizeof pointer, "/output/channels/%d", i);
                failure_set(failure_add(out), ST_INVALID, pointer, "no_drag", "a polar with \"cd\"",
                            needs[k].name, "the polar \"%s\" has no drag", polar->name);
            }
        }
    }
}

/* Stresses are those of walls. */
static void check_has_walls(const struct case_def *def, int i, const char *pointer,
                            struct failure_list *out)
{
    if (beam_def_given_at(&def->beam, def->output.stress[i])->shape.type == SECTION_PROPERTIES) {
        failure_set(failure_add(out), ST_INVALID, pointer, "no_walls",
                    "a place whose section is a strip, box or contour", NULL,
                    "a section given by properties has no walls and no plies to be stressed");
    }
}

/* Loads and stress positions lie on the beam, and there is something to carry. */
static void check_static(const struct case_def *def, struct failure_list *out)
{
    const struct loads_def *l = &def->loads;
    const double length = def->beam.length;
    char a[64], b[64];
    for (int i = 0; i < l->n_point; i++) {
        (void)snprintf(a, sizeof a, "/loads/points/%d/z_m", i);
        const struct range r = {a, l->point[i].z, 0.0, length, false, false};
        range_check(1, &r, out);
    }
    for (int i = 0; i < l->n_line; i++) {
        (void)snprintf(a, sizeof a, "/loads/lines/%d/from_m", i);
        (void)snprintf(b, sizeof b, "/loads/lines/%d/to_m", i);
        const struct range r[] = {{a, l->line[i].from, 0.0, length, false, false},
                                  {b, l->line[i].to, l->line[i].from, length, true, false}};
        RANGE_CHECK(r, out);
    }
    for (int i = 0; i < def->output.n_stress; i++) {
        (void)snprintf(a, sizeof a, "/output/stress_at_m/%d", i);
        const struct range r = {a, def->output.stress[i], 0.0, length, false, false};
        range_check(1, &r, out);
        check_has_walls(def, i, a, out);
    }
    const double *g = def->beam.gravity;
    if (case_def_flows(def)) {
        check_flow(def, out);
        check_aero(def, out);
    } else if (def->flow.speed > 0.0) {
        failure_set(failure_add(out), ST_INVALID, "/aerodynamics", "missing",
                    "aerodynamics beside the flow, or neither", NULL,
                    "a static case in a flow needs aerodynamics");
    } else if (l->n_point + l->n_line == 0 && g[0] == 0.0 && g[1] == 0.0 && g[2] == 0.0) {
        failure_set(failure_add(out), ST_INVALID, "/loads", "missing",
                    "points, lines, beam.gravity_m_s2, or flow and aerodynamics", NULL,
                    "nothing loads the beam");
    }
}

/* The record and the history must fit: said before the work is queued. */
static void check_size(const struct case_def *def, struct failure_list *out)
{
    const double steps = wanted_steps(def);
    const double kept = (steps + 1.0) * (6.0 + 2.0 * def->solver.modes);
    if (steps > LIMIT_STEPS || kept > LIMIT_SERIES_VALUES) {
        char got[64];
        (void)snprintf(got, sizeof got, "%.0f steps", steps);
        failure_set(failure_add(out), ST_LIMIT, "/solver/duration_s", "too_long",
                    "fewer steps: shorter duration_s, longer time_step_s or fewer modes", got,
                    "the run would keep %.0f values, the limit is %d", kept, LIMIT_SERIES_VALUES);
        return;
    }
    double columns = 0.0;
    for (int i = 0; i < def->output.n_channel; i++) {
        columns += case_def_channel_columns(def, def->output.channel[i]);
    }
    const double values = columns * (steps / def->output.sample_every + 1.0);
    if (columns > LIMIT_CHANNEL_COLUMNS || values > LIMIT_SERIES_VALUES) {
        char got[96];
        (void)snprintf(got, sizeof got, "%.0f columns, %.0f values", columns, values);
        failure_set(failure_add(out), ST_LIMIT, "/output/sample_every", "record_too_large",
                    "a larger sample_every or fewer channels", got,
                    "the record may hold %d columns and %d values", LIMIT_CHANNEL_COLUMNS,
                    LIMIT_SERIES_VALUES);
    }
}

static void check_damping(const struct solver_def *s, struct failure_list *out)
{
    const struct range all = {
        "/solver/modal_damping_ratio", s->modal_damping, 0.0, 1.0, false, true};
    range_check(1, &all, out);
    for (int i = 0; i < s->n_mode_damping && i < LIMIT_MODES; i++) {
        char pointer[64];
        (void)snprintf(pointer, sizeof pointer, "/solver/modal_damping_ratios/%d", i);
        const struct range r = {pointer, s->mode_damping[i], 0.0, 1.0, false, true};
        range_check(1, &r, out);
    }
}

/* Speeds in order; what remembers without states cannot be linearised. */
static void check_stability(const struct case_def *def, struct failure_list *out)
{
    const struct stability_def *s = &def->stability;
    const struct range rule[] = {
        {"/stability/from_m_s", s->from, 0.0, INFINITY, true, false},
        {"/stability/to_m_s", s->to, s->from, INFINITY, true, false},
        {"/stability/count", s->count, 2, LIMIT_SPEEDS, false, false},
        {"/stability/tolerance", s->tolerance, 1e-12, 0.1, false, false},
    };
    RANGE_CHECK(rule, out);
    if (def->aero.dynamic == DYNAMIC_NETWORK) {
        failure_set(failure_add(out), ST_INVALID, "/aerodynamics/dynamic/type", "no_states",
                    "none, attached or dynamic_stall", "network",
                    "a network is not linearised: march it with kind simulation");
    }
    const int a_station = (def->aero.dynamic == DYNAMIC_STALL ? STALL_STATES : 0) +
                          (def->aero.dynamic == DYNAMIC_NONE ? 0 : ATTACHED_LAGS);
    const int states = 2 * def->solver.modes + a_station * def->beam.elements;
    if (def->beam.elements <= LIMIT_ELEMENTS && states > LIMIT_STATES) {
        char expected[64], got[64];
        (void)snprintf(expected, sizeof expected, "at most %d states", LIMIT_STATES);
        (void)snprintf(got, sizeof got, "%d states", states);
        failure_set(failure_add(out), ST_LIMIT, "/beam/elements", "too_many_states", expected, got,
                    "%d states a station and two a mode are too many for eigenvalues", a_station);
    }
}

static void check_solver(const struct case_def *def, struct failure_list *out)
{
    const struct solver_def *s = &def->solver;
    const struct output_def *o = &def->output;
    const struct range rule[] = {
        {"/solver/time_step_s", s->time_step, 0.0, INFINITY, true, false},
        {"/solver/duration_s", s->duration, 0.0, INFINITY, true, false},
        {"/solver/tolerance", s->tolerance, 1e-15, 1.0, false, true},
        {"/solver/load_order", s->load_order, 0, LIMIT_LOAD_ORDER, false, false},
        {"/solver/stop/twist_max_deg", num_deg(s->twist_max), 0.0, 180.0 + 1e-9, true, false},
        {"/solver/stop/plunge_max_lengths", s->plunge_max, 0.0, INFINITY, true, false},
        {"/solver/stop/outside_polar_max", s->outside_max, 0.0, 1.0, false, false},
        {"/output/sample_every", o->sample_every, 1, LIMIT_STEPS, false, false},
        {"/output/mean_window_s", o->mean_window, 0.0, INFINITY, true, false},
        {"/output/modal_window_s", o->modal_window, 0.0, INFINITY, true, false},
        {"/output/channels", o->n_channel, 0, CHANNEL_COUNT, false, false},
    };
    const int before = out->total;
    RANGE_CHECK(rule, out);
    if (s->start == START_AMPLITUDES && s->n_amplitude > s->modes) {
        char got[32];
        (void)snprintf(got, sizeof got, "%d values", s->n_amplitude);
        failure_set(failure_add(out), ST_INVALID, "/solver/start/amplitudes", "too_many",
                    "at most one per mode", got, "more amplitudes than modes");
    }
    for (int i = 0; i < s->n_amplitude && i < LIMIT_MODES; i++) {
        if (!isfinite(s->amplitude[i]) || !isfinite(s->velocity[i])) {
            failure_set(failure_add(out), ST_INVALID, "/solver/start", "not_finite",
                        "finite numbers", NULL, "start value %d is not finite", i);
        }
    }
    if (out->total == before) {
        check_size(def, out);
    }
}

void case_def_check(const struct case_def *def, struct failure_list *out)
{
    if (def->kind == CASE_TRAINING) {
        return; /* a document without physics: whoever reads it checks it */
    }
    if (def->kind == CASE_LOOP) {
        const struct loop_def d = case_def_loop(def);
        check_models(&def->aero, out);
        loop_def_check(&d, out);
        return;
    }
    beam_def_check_sections(&def->beam, out);
    if (def->kind != CASE_SECTION) {
        check_beam(def, out);
    }
    if (def->kind == CASE_STATIC) {
        check_static(def, out);
    }
    if (case_kind_flows(def->kind)) {
        check_flow(def, out);
        check_aero(def, out);
        check_damping(&def->solver, out);
    }
    if (def->kind == CASE_SIMULATION) {
        check_drag(def, out);
        gust_check(&def->flow.gust, "/flow/gust", out);
        drive_check(&def->beam.root_pitch, "/beam/root_motion/pitch", "angle_deg", out);
        drive_check(&def->beam.root_plunge, "/beam/root_motion/plunge", "displacement_m", out);
        check_solver(def, out);
    }
    if (def->kind == CASE_STABILITY) {
        check_stability(def, out);
    }
}
