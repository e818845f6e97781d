/* core/loop_def.h
 * A prescribed motion of a section and what is to answer it, as a checked struct: without
 * dimensions, chord and speed are one, time is in c/V; radians.
 *
 * A plain value; what it points to is borrowed. */
#ifndef AEROM_CORE_LOOP_DEF_H
#define AEROM_CORE_LOOP_DEF_H

#include "core/aero/dynamic.h"
#include "core/aero/network.h"
#include "core/aero/polar.h"

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
    /* Instead of the six above, borrowed, NULL for none. Not with a network that sees the mean
     * angle, which is that of a cycle, or the jerk. */
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
/* Appends what is wrong with the motion; pointers are those of the contract's
 * "motion". */
void loop_def_check(const struct loop_def *def, struct failure_list *out);

#endif
