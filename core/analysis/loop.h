/* core/analysis/loop.h
 * A section in prescribed pitch about mid-chord and plunge, and the loops its coefficients run
 * through: what a dynamic model says where a flow computation or a wind tunnel can answer too.
 *
 * Two-dimensional and without dimensions: chord, speed and density are one, time is in c/V. The
 * aerodynamics are those of a station of the coupled march, without a lifting line. */
#ifndef AEROM_CORE_ANALYSIS_LOOP_H
#define AEROM_CORE_ANALYSIS_LOOP_H

#include "core/case_def.h"

/* A motion given as a table at equal steps. The section stands still before. */
enum loop_motion_row {
    MOTION_THETA, /* [rad] */
    MOTION_THETA_RATE,
    MOTION_THETA_ACCELERATION, /* by c/V */
    MOTION_W,                  /* w/c */
    MOTION_W_RATE,
    MOTION_W_ACCELERATION,
    MOTION_ROWS
};
struct loop_motion {
    int n;         /* 2..LOOP_SAMPLES_MAX */
    double step;   /* c/V, > 0 */
    double *value; /* (n x MOTION_ROWS), time fastest; whose it is, the caller says */
};

/* theta = mean + amplitude sin(2 pi f t), w = plunge sin(2 pi f t + phase), or a table. */
struct loop_def {
    const struct polar_def *polar; /* borrowed */
    enum dynamic_type dynamic;
    const struct network_def *network; /* borrowed, NULL unless DYNAMIC_NETWORK */
    double mean, amplitude;            /* of the angle of the chord [rad], nose-up */
    double plunge;                     /* amplitude of mid-chord in chords, up */
    double phase;                      /* of the plunge ahead of the pitch [rad] */
    double frequency;                  /* f c/V, > 0 */
    int cycles;                        /* 1..LOOP_CYCLES_MAX; steady flow at t = 0 before */
    int steps;                         /* a cycle, LOOP_STEPS_MIN..LOOP_STEPS_MAX */
    /* Instead of all six above, borrowed, NULL for none. Not with DYNAMIC_NETWORK, whose mean angle
     * is that of a cycle. */
    const struct loop_motion *motion;
};
enum {
    LOOP_CYCLES_MAX = 1000,
    LOOP_STEPS_MIN = 16,
    LOOP_STEPS_MAX = 10000,
    LOOP_SAMPLES_MAX = 1000000
};

/* Polar NULL, no network; 10 cycles of 400 steps; the rest zero. */
void loop_def_defaults(struct loop_def *def);
/* Appends what is wrong with the motion; pointers are those of the command line's options. */
void loop_def_check(const struct loop_def *def, struct failure_list *out);

enum loop_quantity {
    LOOP_TIME,   /* c/V */
    LOOP_ALPHA,  /* angle of the chord, theta [rad] */
    LOOP_PLUNGE, /* w/c */
    LOOP_CL,     /* normal to the undisturbed stream */
    LOOP_CD,     /* NaN if the polar has no drag */
    LOOP_CM,     /* about mid-chord, nose-up */
    LOOP_QUANTITIES
};

struct loop_result {
    int n;         /* cycles x steps + 1, or the samples of the table */
    double *value; /* (n x LOOP_QUANTITIES), owned */
    /* What the flow feeds into the motion over the last cycle, or all of a table, by rho V^2 c^2/2:
     * the integrals of c_m d(theta) and c_l d(w/c). Positive feeds, negative damps. */
    double work_pitch, work_plunge;
    long outside_polar; /* steps outside the table */
};

/* Runs a checked motion. On failure *out is unchanged. */
MUST_CHECK enum status loop_run(const struct loop_def *def, struct loop_result *out);
/* Accepts a zeroed struct. */
void loop_done(struct loop_result *r);

#endif
