/* core/network/dataset.h
 * From records of the flow about a moving section to samples of the dynamic increment: what the
 * coefficients have beyond the steady polar at the same instant (section 2.3 and App. B), or
 * beyond another model in the same motion.
 *
 * Without dimensions: chord and speed are one, time is in c/V. A dataset owns its arrays; a record
 * belongs to whoever read it. Free of state; one thread a dataset. */
#ifndef AEROM_CORE_NETWORK_DATASET_H
#define AEROM_CORE_NETWORK_DATASET_H

#include "core/aero/network.h"
#include "core/aero/polar.h"

#include <stdbool.h>
#include <stdint.h>

/* X(code, name in files, name of the quantity) */
#define FLOW_ROW_LIST(X)                                                                           \
    X(FLOW_TIME, "t")                                                                              \
    X(FLOW_THETA, "alpha_deg") /* angle of the chord [rad], nose-up */                             \
    X(FLOW_THETA_RATE, "alpha_dot")                                                                \
    X(FLOW_THETA_ACCELERATION, "alpha_ddot")                                                       \
    X(FLOW_W, "w") /* plunge of mid-chord in chords, up */                                         \
    X(FLOW_W_RATE, "w_dot")                                                                        \
    X(FLOW_W_ACCELERATION, "w_ddot")                                                               \
    X(FLOW_CL, "cl") /* normal to the undisturbed stream */                                        \
    X(FLOW_CD, "cd")                                                                               \
    X(FLOW_CM, "cm") /* about mid-chord, nose-up */

#define FLOW_ENUM(code, name) code,
enum flow_row { FLOW_ROW_LIST(FLOW_ENUM) FLOW_ROWS };
#undef FLOW_ENUM

/* One record at equal steps of time. */
struct flow_record {
    char name[LIMIT_NAME];
    int n;         /* FLOW_SAMPLES_MIN.. */
    double *value; /* (n x FLOW_ROWS), time fastest */
    double period; /* of a sine [c/V]; 0: no motion, or one without a period */
    double start;  /* samples before this time are the start of the computation [c/V] */
};
enum { FLOW_SAMPLES_MIN = 16, FLOW_RECORDS_MAX = 4096, FLOW_SAMPLES_MAX = 1000000 };

/* Appends what is wrong: too few samples, repeated times and gaps, values that are not finite,
 * angles and plunges beyond plausible (other units), rates that are not those of the motion.
 * Pointers are /NAME/COLUMN. */
void flow_record_check(const struct flow_record *r, struct failure_list *out);
/* Does the section move at all? */
bool flow_record_moves(const struct flow_record *r);
/* Distance of the samples [c/V]. */
double flow_record_step(const struct flow_record *r);
/* First sample at or behind the start; n when there is none. */
int flow_record_first(const struct flow_record *r);
/* Largest less smallest of a row from sample `from` on. */
double flow_record_range(const struct flow_record *r, enum flow_row row, int from);

/* What a network sees, all inputs in the order of the enum: x (NET_IN_COUNT x n), input fastest,
 * with the definitions of the march (core/coupling/loads.c). The mean of the angle slides over the
 * whole number of periods that comes next to `window` [c/V], or over the window where there is no
 * period; before the record the section stood still. The jerk of the plunge is differenced. */
void flow_record_inputs(const struct flow_record *r, double window, double *x);
/* The rows behind lags of the same x, which flow_record_inputs leaves at zero, and the coefficients
 * y (NET_OUT_COUNT x n) of what the network stands on, in steady flow before the record.
 * ST_NO_MEMORY. */
MUST_CHECK enum status flow_record_march(const struct flow_record *r,
                                         const struct network_frame *frame,
                                         const struct polar *polar, double *x, double *y);
/* Coefficients of the polar at the instantaneous angle and plunge: y (NET_OUT_COUNT x n). */
void flow_record_steady(const struct flow_record *r, const struct polar *polar, double *y);
/* Increment of sample i: y (NET_OUT_COUNT), the coefficients of a model, becomes what the record
 * has beyond them. Of a sine that is, from sample `first` on (flow_record_first), the mean over its
 * cycles at the same phase: where vortices are shed at a frequency of their own cycles differ, and
 * no motion tells how. Time goes with the number of cycles. */
void flow_record_subtract(const struct flow_record *r, int first, int i, double *y);

struct dataset_def {
    const struct polar_def *polar; /* borrowed, checked */
    struct network_frame frame;    /* what the increments are beyond, and the lags */
    double window;                 /* of the mean angle [c/V], > 0 */
    int samples_max;               /* of one record, equally spaced, so that records count alike */
    int anchors;                   /* samples of steady flow, see below */
    double held_share;             /* of the moving records, 0 < share < 1 */
    /* With r the range of a record's c_l and c_m by those of all (rms), its samples weigh as
     * 1/(r^2 + balance^2): errors count by the range of their record, but for records smaller than
     * that. 0: all alike. */
    double balance;
    uint64_t seed; /* of the draw */
};
/* On the polar, no lags, no balance, window 12.5 (the first bending of the paper's beam), 500
 * samples and anchors, a tenth held out, seed 1. */
void dataset_def_defaults(struct dataset_def *def);

/* Samples of one part of the records. Each stands twice, as it is and mirrored: angles, rates,
 * c_l and c_m change sign together, c_d does not. */
struct sample_set {
    int n;
    double *x;      /* (NET_IN_COUNT x n), input fastest */
    double *y;      /* dynamic increments (NET_OUT_COUNT x n) */
    double *weight; /* (n), one in the mean */
    int n_group;    /* records, and behind those that are trained the anchors */
    int *end;       /* first sample behind each group (n_group) */
};
struct dataset {
    struct sample_set trained, held;
    int n_record;
    bool *is_held; /* (n_record) */
    int n_held;
    int outside_polar; /* samples outside the table, mirrored ones not counted */
    /* What an error by the whole range of its record is before it is squared and weighed: the
     * ranges of the moving records (rms) and the root of the factor that makes the mean weight of
     * the trained samples one. */
    double unit[NET_OUT_COUNT];
};

/* Draws `n` records of those that move for validation, by whole record, and makes the samples of
 * all. A record at rest says what steady flow is and is always trained. Every record must have
 * passed its check. Anchors, angles at rest up to the largest one trained, have no increment: that
 * is what makes the steady polar steady. With fewer than two that move, or samples only before the
 * start, *out_problems says so and the status is ST_INVALID. On failure *out is unchanged. */
MUST_CHECK enum status dataset_build(const struct dataset_def *def, int n_record,
                                     const struct flow_record *record,
                                     struct failure_list *problems, struct dataset *out);
/* Accepts a zeroed struct. */
void dataset_done(struct dataset *d);

/* Scaling by mean and standard deviation and the box of the samples, into the fields of a network
 * whose inputs and outputs are set. Appends a problem for each input or output that is constant. */
void dataset_scaling(const struct sample_set *s, struct network_def *net,
                     struct failure_list *problems);

#endif
