/* core/aero/gust.h
 * A vertical gust, uniform over the span: its velocity in time, and what of it acts on a section.
 *
 * A section with a wake that lags enters the gust from its leading edge on: the lift follows
 * Kuessner's function, here 1 - sum_i a_i exp(-b_i s), s = 2 V t/c, sum a_i = 1, a minimax fit that
 * is within 0.002 of it at all s. Each station carries KUESSNER_LAGS states x_i, x_i' =
 * b_i (2V/c) (w/V - x_i); sum a_i x_i is the angle that counts, and it acts at the quarter point.
 * The time of a gust is that at which it meets the leading edge.
 *
 * A struct kuessner is immutable; nothing allocates but kuessner_init. */
#ifndef AEROM_CORE_AERO_GUST_H
#define AEROM_CORE_AERO_GUST_H

#include "core/limits.h"
#include "core/status.h"

#include <stdbool.h>

enum gust_type { GUST_ONE_MINUS_COSINE, GUST_STEP, GUST_TABLE };

struct gust_def {
    bool given; /* else the air is calm and the rest does not count */
    enum gust_type type;
    double amplitude;             /* one_minus_cosine, step: largest velocity, up positive [m/s] */
    double start;                 /* [s] */
    double length, duration;      /* one_minus_cosine: from calm to calm [m] or [s], the other 0 */
    int n;                        /* table */
    double time[LIMIT_TABLE];     /* ascending [s]; the end values hold before and after */
    double velocity[LIMIT_TABLE]; /* linear in between [m/s] */
};

/* Appends what is wrong; `pointer` is the JSON pointer of the gust. */
void gust_check(const struct gust_def *g, const char *pointer, struct failure_list *out);

/* Velocity [m/s] at time t in a stream of speed V. */
double gust_at(const struct gust_def *g, double speed, double t);
/* Time after which it does not change any more; 0 when the air is calm. */
double gust_end(const struct gust_def *g, double speed);

enum { KUESSNER_LAGS = 6 };

struct kuessner {
    int n;        /* stations, 0 without */
    double *step; /* factors of x, of the old and of the new angle (n x 3 x KUESSNER_LAGS), owned */
};

/* chord [m] (n), speed V [m/s], dt [s]. */
MUST_CHECK enum status kuessner_init(int n, const double *chord, double speed, double dt,
                                     struct kuessner *out);
/* Accepts a zeroed struct. */
void kuessner_done(struct kuessner *k);

/* Advances the states x (n x KUESSNER_LAGS) over a step in which the angle w/V goes linearly from
 * its old to its new value: exact. */
void kuessner_step(const struct kuessner *k, double angle_old, double angle_new, double *x);
/* The states of a gust that has always blown. */
void kuessner_steady(const struct kuessner *k, double angle, double *x);
/* Adds the angle that acts [rad] to `angle` (n). */
void kuessner_add(const struct kuessner *k, const double *x, double *angle);

#endif
