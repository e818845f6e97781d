#include "api/case_fields.h"

#include "api/beam_fields.h"
#include "api/case_refs.h"
#include "api/channel.h"
#include "api/drive_fields.h"
#include "core/num.h"

#include <assert.h>
#include <string.h>

#define ANY INFINITY
static const struct field_range version = {.min = 1, .max = 1};
static const struct field_range positive = {.min = 0.0, .max = ANY, .above_min = true};
static const struct field_range not_negative = {.min = 0.0, .max = ANY};
static const struct field_range incidence = {.min = -90.0, .max = 90.0};
static const struct field_range modes = {.min = 1, .max = LIMIT_MODES};
static const struct field_range iterations = {.min = 1, .max = 1000};
static const struct field_range load_order = {.min = 0, .max = LIMIT_LOAD_ORDER};
static const struct field_range damping = {.min = 0.0, .max = 1.0, .below_max = true};
static const struct field_range tolerance = {
    .min = 0.0, .max = 1.0, .above_min = true, .below_max = true};
static const struct field_range step_tolerance = {.min = 1e-15, .max = 1.0, .below_max = true};
static const struct field_range twist = {.min = 0.0, .max = 180.0, .above_min = true};
static const struct field_range share = {.min = 0.0, .max = 1.0};
static const struct field_range speeds = {.min = 2, .max = LIMIT_SPEEDS};
static const struct field_range speed_tolerance = {.min = 1e-12, .max = 0.1};
static const struct field_range sampling = {.min = 1, .max = LIMIT_STEPS};

/* By the enums of core. */
const char *const case_kind_names[] = {[CASE_SIMULATION] = "simulation", [CASE_MODES] = "modes",
                                       [CASE_SECTION] = "section",       [CASE_STATIC] = "static",
                                       [CASE_STABILITY] = "stability",   [CASE_LOOP] = "loop",
                                       [CASE_TRAINING] = "training",     NULL};
const char *const dynamic_names[] = {[DYNAMIC_NONE] = "none",
                                     [DYNAMIC_NETWORK] = "network",
                                     [DYNAMIC_ATTACHED] = "attached",
                                     [DYNAMIC_STALL] = "dynamic_stall",
                                     NULL};
static const char *const wall_names[] = {
    [WALLS_NONE] = "none", [WALLS_ROOT] = "root", [WALLS_ROOT_AND_FAR] = "root_and_far", NULL};
static const char *const tip_names[] = {[TIP_INSET] = "inset", [TIP_NONE] = "none", NULL};
static const char *const integrator_names[] = {
    [INTEGRATOR_EXPONENTIAL] = "exponential", [INTEGRATOR_RK4_ADAPTIVE] = "rk4_adaptive", NULL};
static const char *const start_names[] = {[START_REST] = "rest",
                                          [START_EQUILIBRIUM] = "equilibrium",
                                          [START_AMPLITUDES] = "amplitudes",
                                          NULL};

#define AT(member_) offsetof(struct api_case, member_)
#define NUMBER(key_, member_, kinds_, range_, ...)                                                 \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .offset = AT(member_), .kinds = (kinds_),             \
        .range = &(range_), __VA_ARGS__                                                            \
    }
#define INTEGER(key_, member_, kinds_, range_)                                                     \
    {                                                                                              \
        .key = (key_), .kind = FIELD_INTEGER, .offset = AT(member_), .kinds = (kinds_),            \
        .range = &(range_)                                                                         \
    }
#define CHOICE(key_, member_, names_, ...)                                                         \
    {                                                                                              \
        .key = (key_), .kind = FIELD_ENUM, .offset = AT(member_), .names = (names_), __VA_ARGS__   \
    }
#define OBJECT(key_, fields_, ...)                                                                 \
    {                                                                                              \
        .key = (key_), .kind = FIELD_OBJECT, .fields = (fields_), __VA_ARGS__                      \
    }

enum {
    ALL = 0,
    SIMULATION = CASE_IN_SIMULATION,
    FLOWS = CASE_IN_SIMULATION | CASE_IN_STABILITY | CASE_IN_STATIC,
    AT_A_SPEED = CASE_IN_SIMULATION | CASE_IN_STATIC,
    MOVING = CASE_IN_SIMULATION | CASE_IN_STABILITY,
    MODAL = CASE_IN_SIMULATION | CASE_IN_MODES | CASE_IN_STABILITY,
    STATIC = CASE_IN_STATIC,
    STABILITY = CASE_IN_STABILITY,
    LOOP = CASE_IN_LOOP,
    TRAINING = CASE_IN_TRAINING,
    WITH_POLAR = FLOWS | LOOP,
    WITH_DYNAMIC = MOVING | LOOP,
    BEAM = CASE_WITH_BEAM | CASE_IN_SECTION
};

static bool is_calm(const void *base)
{
    return !((const struct api_case *)base)->def.flow.gust.given;
}

static const struct field flow_fields[] = {
    NUMBER("speed_m_s", def.flow.speed, AT_A_SPEED, positive, .required = true),
    NUMBER("density_kg_m3", def.flow.density, FLOWS, not_negative, .unit = 1.0),
    NUMBER("kinematic_viscosity_m2_s", def.flow.kinematic_viscosity, FLOWS, positive, .unit = 1.0),
    NUMBER("incidence_deg", def.flow.incidence, FLOWS, incidence, .unit = FIELD_DEGREE),
    {.key = "gust",
     .kind = FIELD_VARIANT,
     .kinds = SIMULATION,
     .offset = AT(def.flow.gust),
     .names = gust_type_names,
     .variants = gust_variants,
     .choose = gust_choose,
     .finish = gust_finish,
     .omit = is_calm},
    {0},
};

static bool has_network(const void *base)
{
    return ((const struct api_case *)base)->def.aero.dynamic == DYNAMIC_NETWORK;
}

static bool is_not_forced(const void *base)
{
    return !((const struct api_case *)base)->def.aero.network_forced;
}

static const struct field dynamic_fields[] = {
    CHOICE("type", def.aero.dynamic, dynamic_names, .required = true),
    {.key = "name",
     .kind = FIELD_CUSTOM,
     .required = true,
     .applies = has_network,
     .read = case_read_network,
     .write = case_write_network},
    {.key = "force",
     .kind = FIELD_BOOLEAN,
     .offset = offsetof(struct api_case, def.aero.network_forced),
     .applies = has_network,
     .omit = is_not_forced},
    {0},
};

static bool has_far_wall(const void *base)
{
    return ((const struct api_case *)base)->def.aero.walls == WALLS_ROOT_AND_FAR;
}

static const struct field lifting_line_fields[] = {
    CHOICE("walls", def.aero.walls, wall_names, .kinds = ALL),
    CHOICE("tip_correction", def.aero.tip, tip_names, .kinds = ALL),
    NUMBER("width_m", def.aero.width, ALL, positive, .required = true, .applies = has_far_wall),
    NUMBER("tolerance", def.aero.tolerance, ALL, tolerance, .unit = 1.0),
    INTEGER("iterations_max", def.aero.iterations_max, ALL, iterations),
    {0},
};

static const struct field aerodynamics_fields[] = {
    {.key = "polar",
     .kind = FIELD_CUSTOM,
     .required = true,
     .kinds = WITH_POLAR,
     .read = case_read_polar,
     .write = case_write_polar},
    OBJECT("dynamic", dynamic_fields, .kinds = WITH_DYNAMIC),
    OBJECT("lifting_line", lifting_line_fields, .kinds = FLOWS, .nullable = true,
           .offset = AT(def.aero.lifting_line)),
    {0},
};

/* What is recorded unless asked otherwise: no drag where the polar has none. */
static void aerodynamics_finish(struct reader *r, const struct cJSON *json, void *base)
{
    (void)r;
    (void)json;
    struct case_def *def = &((struct api_case *)base)->def;
    struct output_def *o = &def->output;
    if (def->aero.polar == NULL || polar_def_has_drag(def->aero.polar)) {
        return;
    }
    int n = 0;
    for (int i = 0; i < o->n_channel; i++) {
        if (o->channel[i] != CHANNEL_CD) {
            o->channel[n++] = o->channel[i];
        }
    }
    o->n_channel = n;
}

static bool has_amplitudes(const void *base)
{
    return ((const struct api_case *)base)->def.solver.start == START_AMPLITUDES;
}

static const struct field start_fields[] = {
    CHOICE("type", def.solver.start, start_names, .required = true),
    {.key = "amplitudes",
     .kind = FIELD_ARRAY,
     .required = true,
     .offset = AT(def.solver.amplitude),
     .count = AT(def.solver.n_amplitude),
     .min = 1,
     .max = LIMIT_MODES,
     .applies = has_amplitudes},
    {.key = "velocities",
     .kind = FIELD_ARRAY,
     .offset = AT(def.solver.velocity),
     .count = AT(def.solver.n_amplitude),
     .sized = true,
     .or_empty = true,
     .applies = has_amplitudes},
    {0},
};

static const struct field stop_fields[] = {
    NUMBER("twist_max_deg", def.solver.twist_max, SIMULATION, twist, .unit = FIELD_DEGREE),
    NUMBER("plunge_max_lengths", def.solver.plunge_max, SIMULATION, positive, .unit = 1.0),
    NUMBER("outside_polar_max", def.solver.outside_max, SIMULATION, share, .unit = 1.0),
    {0},
};

static const struct field solver_fields[] = {
    INTEGER("modes", def.solver.modes, MODAL, modes),
    NUMBER("time_step_s", def.solver.time_step, SIMULATION, positive, .unit = 1.0),
    NUMBER("duration_s", def.solver.duration, SIMULATION, positive, .required = true),
    CHOICE("integrator", def.solver.integrator, integrator_names, .kinds = SIMULATION),
    NUMBER("tolerance", def.solver.tolerance, SIMULATION, step_tolerance, .unit = 1.0),
    INTEGER("load_order", def.solver.load_order, SIMULATION, load_order),
    OBJECT("start", start_fields, .kinds = SIMULATION),
    NUMBER("modal_damping_ratio", def.solver.modal_damping, MOVING, damping, .unit = 1.0),
    {.key = "modal_damping_ratios",
     .kind = FIELD_ARRAY,
     .kinds = MOVING,
     .offset = AT(def.solver.mode_damping),
     .count = AT(def.solver.n_mode_damping),
     .max = LIMIT_MODES,
     .range = &damping},
    OBJECT("stop", stop_fields, .kinds = SIMULATION),
    {0},
};

static const struct field stability_fields[] = {
    NUMBER("from_m_s", def.stability.from, STABILITY, positive, .required = true),
    NUMBER("to_m_s", def.stability.to, STABILITY, positive, .required = true),
    INTEGER("count", def.stability.count, STABILITY, speeds),
    NUMBER("tolerance", def.stability.tolerance, STABILITY, speed_tolerance, .unit = 1.0),
    {0},
};

static const struct field output_fields[] = {
    {.key = "channels",
     .kind = FIELD_NAMES,
     .kinds = SIMULATION,
     .offset = AT(def.output.channel),
     .names = channel_names,
     .count = AT(def.output.n_channel),
     .min = 1,
     .max = CHANNEL_COUNT},
    INTEGER("sample_every", def.output.sample_every, SIMULATION, sampling),
    NUMBER("mean_window_s", def.output.mean_window, SIMULATION, positive, .unit = 1.0),
    NUMBER("modal_window_s", def.output.modal_window, SIMULATION, positive, .unit = 1.0),
    {.key = "stress_at_m",
     .kind = FIELD_ARRAY,
     .kinds = STATIC,
     .offset = AT(def.output.stress),
     .count = AT(def.output.n_stress),
     .max = LIMIT_STRESS_POSITIONS,
     .range = &not_negative},
    {0},
};

/* A static case may be without. */
static bool has_no_stream(const void *base)
{
    return !case_def_flows(&((const struct api_case *)base)->def);
}

static bool has_no_polar(const void *base)
{
    return !case_def_has_polar(&((const struct api_case *)base)->def);
}

/* Definitions before what refers to them. */
const struct field case_fields[] = {
    {.key = "schema_version",
     .kind = FIELD_INTEGER,
     .required = true,
     .offset = AT(schema_version),
     .range = &version},
    CHOICE("kind", def.kind, case_kind_names, .required = true),
    {.key = "name",
     .kind = FIELD_TEXT,
     .kinds = CASE_LABEL,
     .offset = AT(def.name),
     .size = sizeof((struct case_def *)0)->name},
    {.key = "materials",
     .kind = FIELD_CUSTOM,
     .kinds = BEAM,
     .omit = case_has_no_own_material,
     .read = case_read_materials,
     .write = case_write_materials},
    {.key = "polars",
     .kind = FIELD_CUSTOM,
     .kinds = WITH_POLAR | TRAINING,
     .omit = case_has_no_own_polar,
     .read = case_read_polars,
     .write = case_write_polars},
    {.key = "networks",
     .kind = FIELD_CUSTOM,
     .kinds = WITH_DYNAMIC,
     .omit = case_has_no_own_network,
     .read = case_read_networks,
     .write = case_write_networks},
    OBJECT("beam", beam_fields, .required = true, .kinds = BEAM, .finish = beam_finish),
    OBJECT("loads", loads_fields, .kinds = STATIC),
    OBJECT("flow", flow_fields, .required = true, .optional = STATIC, .kinds = FLOWS,
           .omit = has_no_stream),
    OBJECT("aerodynamics", aerodynamics_fields, .required = true, .optional = STATIC,
           .kinds = WITH_POLAR, .finish = aerodynamics_finish, .omit = has_no_polar),
    {.key = "motion",
     .kind = FIELD_VARIANT,
     .required = true,
     .kinds = LOOP,
     .offset = AT(motion),
     .names = motion_type_names,
     .variants = motion_variants,
     .choose = motion_choose,
     .finish = motion_finish},
    OBJECT("training", training_fields, .required = true, .kinds = TRAINING,
           .finish = training_finish),
    OBJECT("solver", solver_fields, .required = true, .kinds = MODAL),
    OBJECT("stability", stability_fields, .required = true, .kinds = STABILITY),
    OBJECT("output", output_fields, .kinds = SIMULATION | STATIC),
    {0},
};
