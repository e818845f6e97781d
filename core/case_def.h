/* core/case_def.h
 * The complete input of one run as a checked struct: SI units and radians.
 *
 * A plain value. Polar and network are borrowed: they must outlive the case_def and every sim made
 * from it. The border (api) fills it from JSON, with every default, and calls case_def_check. */
#ifndef AEROM_CORE_CASE_DEF_H
#define AEROM_CORE_CASE_DEF_H

#include "core/aero/dynamic.h"
#include "core/aero/gust.h"
#include "core/aero/lifting_line.h"
#include "core/aero/network.h"
#include "core/aero/polar.h"
#include "core/loop_def.h"
#include "core/section_def.h"

#include <stdbool.h>

enum case_kind {
    CASE_SIMULATION,
    CASE_MODES,
    CASE_SECTION,
    CASE_STATIC,
    CASE_STABILITY,
    CASE_LOOP,
    CASE_TRAINING, /* of a network: computed by api/training_out.c, not by a sim */
    CASE_KIND_COUNT
};
enum integrator { INTEGRATOR_EXPONENTIAL, INTEGRATOR_RK4_ADAPTIVE };
enum start_type { START_REST, START_EQUILIBRIUM, START_AMPLITUDES };

/* Quantities that can be recorded; a channel has one or several columns (api/channel.c names
 * them and gives their unit). */
enum channel {
    CHANNEL_TIP_PLUNGE,    /* v at the free end [m] */
    CHANNEL_TIP_TWIST,     /* theta at the free end [rad] */
    CHANNEL_TIP_CHORDWISE, /* u at the free end [m] */
    CHANNEL_LIFT,          /* total, normal to the stream [N] */
    CHANNEL_DRAG,          /* total, along the stream [N] */
    CHANNEL_MOMENT,        /* total about mid-chord, nose-up [N m] */
    CHANNEL_CL,            /* lift coefficient on the beam's area */
    CHANNEL_CD,
    CHANNEL_CM,
    CHANNEL_EFFICIENCY,      /* total lift over total drag */
    CHANNEL_ROOT_BENDING,    /* flap bending moment in the clamp, of an upward load [N m] */
    CHANNEL_GUST,            /* vertical velocity of the gust, up [m/s] */
    CHANNEL_ROOT_PITCH,      /* of the clamp [rad] */
    CHANNEL_ROOT_PLUNGE,     /* of the clamp [m] */
    CHANNEL_MODAL_AMPLITUDE, /* one column per mode [kg^0.5 m] */
    CHANNEL_MODAL_VELOCITY,  /* one column per mode */
    CHANNEL_STATION_PLUNGE,  /* one column per station [m] */
    CHANNEL_STATION_TWIST,   /* one column per station [rad] */
    CHANNEL_STATION_ALPHA,   /* effective angle of attack, one column per station [rad] */
    CHANNEL_STATION_INDUCED, /* induced angle w_i/V, one column per station [rad] */
    CHANNEL_STATION_CL,
    CHANNEL_STATION_CD,
    CHANNEL_STATION_CM,
    CHANNEL_COUNT
};

struct point_load_def {
    double z; /* [m] */
    struct beam_load load;
};
struct line_load_def {
    double from, to;       /* [m] */
    struct beam_load load; /* per length */
};
struct loads_def {
    int n_point;
    struct point_load_def point[LIMIT_LOADS];
    int n_line;
    struct line_load_def line[LIMIT_LOADS];
};

struct flow_def {
    double speed;               /* V [m/s], > 0 */
    double density;             /* [kg/m^3], default 1.225 */
    double kinematic_viscosity; /* [m^2/s], default 1.5e-5; only for the Reynolds number */
    double incidence;           /* alpha_0 [rad] */
    struct gust_def gust;       /* default none */
};

struct aero_def {
    const struct polar_def *polar; /* borrowed */
    enum dynamic_type dynamic;
    const struct network_def *network; /* borrowed, NULL unless DYNAMIC_NETWORK */
    bool network_forced; /* take a network that was trained on another polar, default false */
    bool lifting_line;
    enum wall_images walls;
    enum tip_correction tip; /* default TIP_INSET */
    double width;            /* distance between the root wall and the far wall [m] */
    double tolerance;        /* of the lifting line: largest |residual| in c_l, default 1e-9 */
    int iterations_max;      /* default 50 */
};

struct solver_def {
    int modes;        /* default 4 */
    double time_step; /* [s], default 2e-4 */
    double duration;  /* [s] */
    enum integrator integrator;
    double tolerance; /* rk4_adaptive: largest error per time step, relative, default 1e-9 */
    int load_order;   /* 0..4, default 1 */
    enum start_type start;
    int n_amplitude;                  /* given entries of the next two */
    double amplitude[LIMIT_MODES];    /* START_AMPLITUDES: modal amplitudes [kg^0.5 m] */
    double velocity[LIMIT_MODES];     /* and velocities */
    double modal_damping;             /* structural damping ratio of every mode, default 0, < 1 */
    int n_mode_damping;               /* given entries of the next one */
    double mode_damping[LIMIT_MODES]; /* damping ratio of the first modes, instead of the above */
    double twist_max;                 /* stop rule: |tip twist| [rad], default 60 deg */
    double plunge_max;                /* stop rule: |tip plunge| / length, default 1 */
    double outside_max;               /* stop rule: share of the run outside the polar, default 1 */
};

struct stability_def {
    double from, to;  /* speeds [m/s], 0 < from < to */
    int count;        /* of equidistant speeds, both ends included, default 40 */
    double tolerance; /* of the speeds found, relative, default 1e-6 */
};

struct output_def {
    int n_channel;
    enum channel channel[CHANNEL_COUNT];
    int sample_every;   /* record every n-th time step, default 1 */
    double mean_window; /* the means are over the last so many seconds, default 1 */
    int n_stress;       /* static: positions at which ply stresses are asked for */
    double stress[LIMIT_STRESS_POSITIONS]; /* [m] */
    double modal_window; /* same for the modal contribution, default 0.2 (Fig. 14) */
};

struct case_def {
    enum case_kind kind;
    char name[128];
    struct beam_def beam;
    struct loads_def loads; /* static */
    struct flow_def flow;
    struct aero_def aero;
    struct solver_def solver;
    struct stability_def stability;
    struct loop_def loop; /* the motion; what answers it stands in aero, see case_def_loop */
    struct output_def output;
};

/* Does a case of this kind have a flow and aerodynamics in the modes of the beam? */
static inline bool case_kind_flows(enum case_kind kind)
{
    return kind == CASE_SIMULATION || kind == CASE_STABILITY;
}

/* Has a case of this kind a beam? All but a section in prescribed motion and a training. */
static inline bool case_kind_has_beam(enum case_kind kind)
{
    return kind != CASE_LOOP && kind != CASE_TRAINING;
}

/* Can a case of this kind have a dynamic part beside the polar? */
static inline bool case_kind_is_dynamic(enum case_kind kind)
{
    return case_kind_flows(kind) || kind == CASE_LOOP;
}

/* Does a run of this kind leave a series? */
static inline bool case_kind_records(enum case_kind kind)
{
    return kind == CASE_SIMULATION || kind == CASE_LOOP;
}

/* Time after which neither gust nor root move any more: 0 without, INFINITY for a sine [s]. */
double case_def_driven_until(const struct case_def *def);

/* Does the case have a flow and aerodynamics? One of kind static may. */
bool case_def_flows(const struct case_def *def);
/* Does it have a polar, and perhaps a network? */
static inline bool case_def_has_polar(const struct case_def *def)
{
    return case_def_flows(def) || !case_kind_has_beam(def->kind);
}

/* The whole definition of a case of kind loop. */
struct loop_def case_def_loop(const struct case_def *def);

/* Fills every default. */
void case_def_defaults(struct case_def *def);

/* Appends everything that is physically wrong with the case (ranges, cross-field rules such as more
 * modes than degrees of freedom, size of the record). Pointers are those of the contract. */
void case_def_check(const struct case_def *def, struct failure_list *out);

/* Columns of a channel for this case: 1, modes or elements. */
int case_def_channel_columns(const struct case_def *def, enum channel channel);
/* Time steps of the run, >= 1. */
int case_def_steps(const struct case_def *def);
/* Recorded samples, the initial state included. */
int case_def_samples(const struct case_def *def);

#endif
