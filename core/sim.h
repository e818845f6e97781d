/* core/sim.h
 * The facade of the core: one case in, one result out.
 *
 * A struct sim belongs to one thread. sim_create builds the model (section, modes, aerodynamics)
 * and the workspace; sim_run computes; the result is owned by the sim and valid until sim_destroy.
 * Nothing here reads files, clocks or the environment. */
#ifndef AEROM_CORE_SIM_H
#define AEROM_CORE_SIM_H

#include "core/analysis/damping.h"
#include "core/analysis/loop.h"
#include "core/analysis/span_loads.h"
#include "core/analysis/stability.h"
#include "core/analysis/statics.h"
#include "core/analysis/verdict.h"
#include "core/coupling/march.h"
#include "core/structure/warping_line.h"

struct sim;

enum mode_label { MODE_BENDING, MODE_LAG, MODE_TORSION, MODE_AXIAL, MODE_MIXED, MODE_LABEL_COUNT };
const char *mode_label_name(enum mode_label label); /* "bending" "lag" "torsion" "axial" "mixed" */

const char *stop_reason_name(enum stop_reason r); /* "duration" "amplitude" ... */

enum wash { WASH_NONE, WASH_OUT, WASH_IN };
const char *wash_name(enum wash w); /* "none" "wash_out" "wash_in" */

enum {
    SECTION_STRAINS = 7,   /* w' psi' phi' theta' theta'' gamma_xz gamma_yz */
    SECTION_CLASSICAL = 5, /* w' psi' phi' theta' theta'' with the shears condensed */
    SECTION_MASS = 7,      /* u v w v' u' theta theta' (A.35) */
    MODE_SAMPLES = 33
}; /* equidistant points of a reported mode shape, root and tip included */

struct section_result {
    double stiffness[SECTION_STRAINS * SECTION_STRAINS]; /* column-major, SI */
    double stiffness_condensed[SECTION_CLASSICAL * SECTION_CLASSICAL];
    double mass[SECTION_MASS * SECTION_MASS];
    double mass_per_length; /* [kg/m] */
    double thickness;       /* overall: of the wall of a strip, else the height [m]; may be NaN */
    struct centres centres;
    int cells; /* closed ones */
    int n_warping;
    struct warping_point warping[WARPING_POINTS]; /* along the walls, of classic torsion */
    /* With axial force and the other curvatures free: [N m^2] */
    double ei_flap, ei_lag, gj;
    double bend_twist; /* flap curvature - twist rate coupling, axial force free [N m^2] */
    enum wash wash;    /* sense of the bend-twist coupling under upward load */
};

struct mode_result {
    double frequency_hz;
    enum mode_label label;
    double modal_mass;           /* of the shape scaled to a largest tip component of one [kg], */
                                 /* twist counted as theta times the chord */
    double share[4];             /* kinetic energy in bending, lag, torsion, axial; sums to 1 */
    double plunge[MODE_SAMPLES]; /* v of the mass-normalised mode */
    double chordwise[MODE_SAMPLES]; /* u */
    double twist[MODE_SAMPLES];     /* theta */
};

struct sim_counters {
    long outside_polar;     /* station-steps whose angle or plunge left the polar */
    long outside_hull;      /* station-steps outside the training hull of the network */
    long load_alternations; /* steps at which the load turned back: core/analysis/doubt.h */
    long not_converged;     /* steps whose lifting line missed its tolerance */
    long lifting_line_iterations;
    long inner_steps;              /* of rk4_adaptive */
    double lifting_line_residual;  /* largest, in c_l */
    long lifting_line_regularised; /* steps with a viscosity, since lift fell with the angle */
    double lifting_line_smoothing; /* largest change of a c_l by it */
};

struct sim_result {
    enum verdict verdict;
    char verdict_reason[VERDICT_REASON]; /* the numbers that decided, in one sentence */
    enum stop_reason stop;
    double stop_time; /* [s] */
    double e_star;    /* E_l (h/c)^3 / (rho V^2 / 2), E_l of the stiffest ply; NaN without */
    double reynolds;
    struct section_result section;
    struct static_result statics;      /* CASE_STATIC */
    struct stability_result stability; /* CASE_STABILITY */
    struct loop_result loop;           /* CASE_LOOP; its record has time in c/V */
    int n_mode;
    struct mode_result mode[LIMIT_MODES];
    struct {
        double window_from, window_to;
        double tip_plunge, tip_twist, cl, cm, cd, lift, drag, moment; /* SI, rad */
        double plunge_rms, twist_rms; /* of the tip about its means: how much it swings */
        double efficiency; /* lift over drag; NaN, as c_d and drag, if the polar has no drag */
    } means;
    struct span_loads loads; /* over the same window; a little longer after an early stop */
    /* Largest and least of the whole run, and when [s]. */
    struct extreme {
        double max, min, max_time, min_time;
    } peak_plunge, peak_twist, peak_bending; /* tip [m], tip [rad], clamp [N m] */
    struct damping_result tip_twist, tip_plunge;
    double contribution_position[LIMIT_MODES]; /* squared mean share, sums to 1 (Fig. 14) */
    double contribution_velocity[LIMIT_MODES];
    struct sim_counters counters;
    long steps;
    double time_step;
    /* The record: column j of the case's channels, in order; n_sample values each; SI, radians. */
    int n_column;
    int n_sample;
    double sample_step; /* [s]; sample i is at time i * sample_step */
};

/* Builds everything the case asks for. On failure *out is unchanged and *fail says why. */
MUST_CHECK enum status sim_create(const struct case_def *def, struct sim **out,
                                  struct failure *fail);

/* The same for a case that differs from that of `like` only in stream, air, stepping, loads or
 * output: sections, beam and modes are taken over from there. `like` must outlive the new one; the
 * case it was made from need not. */
MUST_CHECK enum status sim_create_like(const struct case_def *def, const struct sim *like,
                                       struct sim **out, struct failure *fail);

/* Computes. ST_CANCELLED when the flag was raised; a blow-up is a verdict, not a failure. */
MUST_CHECK enum status sim_run(struct sim *sim, const struct sim_control *control,
                               struct failure *fail);

const struct sim_result *sim_result(const struct sim *sim);
/* Recorded column, n_sample values. Of a loop: angle of the chord, plunge, c_l, c_m and, if the
 * polar has drag, c_d. */
const double *sim_column(const struct sim *sim, int column);
void sim_destroy(struct sim *sim);

/* Once per process, before the first sim and before any thread: one BLAS thread. */
void sim_process_init(void);
/* BLAS build and kernel in use, for the log. */
const char *sim_blas_description(void);

#endif
