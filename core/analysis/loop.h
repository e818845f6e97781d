/* core/analysis/loop.h
 * A section in prescribed pitch about mid-chord and plunge, and the loops its coefficients run
 * through: what a dynamic model says where a flow computation or a wind tunnel can answer too.
 *
 * Two-dimensional and without dimensions: chord, speed and density are one, time is in c/V. The
 * aerodynamics are those of a station of the coupled march, without a lifting line. */
#ifndef AEROM_CORE_ANALYSIS_LOOP_H
#define AEROM_CORE_ANALYSIS_LOOP_H

#include "core/loop_def.h"
#include "core/status.h"

enum loop_quantity {
    LOOP_TIME,   /* c/V */
    LOOP_ALPHA,  /* angle of the chord, theta [rad] */
    LOOP_PLUNGE, /* w/c */
    LOOP_CL,     /* normal to the undisturbed stream */
    LOOP_CM,     /* about mid-chord, nose-up */
    LOOP_CD,     /* NaN if the polar has no drag */
    LOOP_QUANTITIES
};

struct loop_result {
    int n;         /* cycles x steps + 1, or the samples of the table */
    double *value; /* (n x LOOP_QUANTITIES), owned */
    /* What the flow feeds into the motion over the last cycle, or all of a table, by rho V^2 c^2/2:
     * the integrals of c_m d(theta) and c_l d(w/c). Positive feeds, negative damps. */
    double work_pitch, work_plunge;
    long outside_polar; /* steps outside the table */
    long outside_hull;  /* steps outside the training hull of the network */
};

/* Runs a checked motion. On failure *out is unchanged. */
MUST_CHECK enum status loop_run(const struct loop_def *def, struct loop_result *out);
/* Accepts a zeroed struct. */
void loop_done(struct loop_result *r);

#endif
