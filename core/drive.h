/* core/drive.h
 * A prescribed motion in time: a sine that is faded in, or a table joined by a smooth curve.
 *
 * Plain values; thread-safe. The unit of a drive is that of its owner (m, rad). */
#ifndef AEROM_CORE_DRIVE_H
#define AEROM_CORE_DRIVE_H

#include "core/limits.h"
#include "core/status.h"

#include <stdbool.h>

enum drive_type { DRIVE_SINE, DRIVE_TABLE };

struct drive_def {
    bool given; /* else nothing moves and the rest does not count */
    enum drive_type type;
    /* sine: amplitude r(t) sin(2 pi frequency (t - start) + phase), r rising from 0 to 1 over ramp
     */
    double amplitude;
    double frequency;         /* [Hz] */
    double phase;             /* [rad] */
    double start;             /* [s] */
    double ramp;              /* [s], NaN: one period */
    int n;                    /* table */
    double time[LIMIT_TABLE]; /* ascending [s]; the end values hold before and after */
    double value[LIMIT_TABLE];
};

void drive_defaults(enum drive_type type, struct drive_def *out);
/* Replaces what may be left open. */
void drive_complete(struct drive_def *d);
/* Appends what is wrong; `pointer` is the JSON pointer of the drive, `value_key` the key of the
 * values of its table. */
void drive_check(const struct drive_def *d, const char *pointer, const char *value_key,
                 struct failure_list *out);

/* Time after which nothing changes any more: INFINITY for a sine, 0 when nothing is given. */
double drive_end(const struct drive_def *d);

struct drive {
    struct drive_def def;
    double bend[LIMIT_TABLE]; /* second derivative of the curve through the table at its rows */
};

/* Of a checked definition. The curve through a table is the cubic spline that is at rest at both
 * ends. */
void drive_init(const struct drive_def *def, struct drive *out);

struct drive_state {
    double value, rate, acceleration;
};
struct drive_state drive_at(const struct drive *d, double t);

#endif
