/* core/aero/moving_section.h
 * One section in a motion that is given, step by step: the coefficients of the steady polar, of
 * attached flow or of dynamic stall, and what a network on top of one of them sees.
 *
 * Two-dimensional and without dimensions: chord, speed and density are one, time is in c/V. The
 * aerodynamics are those of a station of the coupled march (core/coupling/loads.c) without a
 * lifting line. A struct moving_section belongs to one thread and borrows the polar; only the init
 * allocates. */
#ifndef AEROM_CORE_AERO_MOVING_SECTION_H
#define AEROM_CORE_AERO_MOVING_SECTION_H

#include "core/aero/attached.h"
#include "core/aero/dynamic_stall.h"
#include "core/aero/network_memory.h"

struct moving_state {
    double theta, theta_rate, theta_acceleration; /* of the chord [rad], nose-up */
    double w, w_rate, w_acceleration;             /* of mid-chord in chords, up */
};

struct moving_section {
    const struct polar *polar;
    struct attached attached;   /* n = 0 on the polar */
    struct dynamic_stall stall; /* n = 0 without */
    struct network_memory memory;
    double wake[ATTACHED_LAGS], stall_state[STALL_ARRAYS];
    double alpha_34;            /* of the step before */
    double input[NET_IN_COUNT]; /* of these, from NET_IN_ALPHA on */
};

/* dt [c/V]. On failure the caller still has to call moving_section_done. */
MUST_CHECK enum status moving_section_init(const struct network_frame *frame,
                                           const struct polar *polar, double dt,
                                           struct moving_section *out);
/* Accepts a zeroed struct. */
void moving_section_done(struct moving_section *s);

struct moving_value {
    double cl, cd, cm;
    bool outside; /* the angle or the plunge was outside the polar */
};
/* The next state of the motion; with `first` the flow has been steady in it for long. */
struct moving_value moving_section_step(struct moving_section *s, const struct moving_state *m,
                                        bool first);

#endif
