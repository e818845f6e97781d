/* core/analysis/stability.h
 * Kind `stability`: eigenvalues of the linearised system over a range of speeds, divergence and
 * flutter by root finding, each about the static aeroelastic equilibrium at its speed. */
#ifndef AEROM_CORE_ANALYSIS_STABILITY_H
#define AEROM_CORE_ANALYSIS_STABILITY_H

#include "core/analysis/verdict.h"

enum { STABILITY_SAMPLES = 33 }; /* equidistant points of a shape, root and tip included */

/* How an instability was met. */
enum onset {
    ONSET_NONE,        /* not in the range */
    ONSET_CROSSING,    /* at the speed given, to the tolerance of the case */
    ONSET_LIMIT_POINT, /* divergence only: the equilibrium ends there */
    ONSET_BELOW        /* below the range: at the speed given or, if that is the lowest, before */
};

struct divergence_point {
    enum onset onset;
    double speed; /* [m/s] */
};

/* Complex amplitudes along the span of the mode that flutters, scaled to a largest of |plunge| and
 * |twist| times the chord of one. */
struct flutter_shape {
    double plunge_re[STABILITY_SAMPLES], plunge_im[STABILITY_SAMPLES]; /* v/c at mid-chord */
    double twist_re[STABILITY_SAMPLES], twist_im[STABILITY_SAMPLES];   /* [rad] */
};

struct flutter_point {
    enum onset onset;
    double speed;              /* [m/s] */
    double frequency;          /* [Hz] */
    double reduced_frequency;  /* omega c/(2 V), chord of the root */
    double damping;            /* ratio: zero at a crossing, negative where it began below */
    int mode;                  /* branch: index of the natural mode it comes from */
    double share[LIMIT_MODES]; /* of the natural modes in its energy, sums to 1 */
    bool coupled;              /* a second mode has a tenth of the energy or more */
    bool stalled;              /* a station stands outside the linear range of the polar */
    struct flutter_shape shape;
};

struct stability_result {
    int n_speed; /* those reached: fewer than asked when the equilibrium ends */
    int n_mode;
    double *speed;      /* [m/s] (n_speed), owned with the next ones */
    double *frequency;  /* imaginary part over 2 pi [Hz] (n_speed x n_mode), speed fastest */
    double *damping;    /* ratio -re/|lambda| (n_speed x n_mode) */
    double *tip_plunge; /* of the equilibrium [m] (n_speed) */
    double *tip_twist;  /* [rad] (n_speed) */
    struct divergence_point divergence;
    struct flutter_point flutter;
    /* The least damped oscillation in the range. */
    struct {
        int mode;
        double speed, damping, frequency;
    } least;
    int solves; /* eigenvalue problems solved */
};

/* Runs over the speeds of the case of a model built for CASE_STABILITY. *out owns memory:
 * stability_done, also on a zeroed struct. ST_CANCELLED when the flag was raised; on
 * ST_NOT_CONVERGED there is no equilibrium even next to still air. */
MUST_CHECK enum status stability_run(const struct model *m, const struct sim_control *control,
                                     struct stability_result *out);

/* The instability that comes first, as a verdict, and one sentence with its numbers. */
enum verdict stability_verdict(const struct stability_result *r, char reason[VERDICT_REASON]);
void stability_done(struct stability_result *r);

#endif
