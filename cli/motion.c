#include "cli/motion.h"

#include "cli/columns.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>

enum { TIME = MOTION_ROWS, COLUMNS };

static const struct column columns[COLUMNS] = {
    [MOTION_THETA] = {"alpha_deg", true},
    [MOTION_THETA_RATE] = {"alpha_dot", true},
    [MOTION_THETA_ACCELERATION] = {"alpha_ddot", true},
    [MOTION_W] = {"w", false},
    [MOTION_W_RATE] = {"w_dot", false},
    [MOTION_W_ACCELERATION] = {"w_ddot", false},
    [TIME] = {"t", true},
};

static bool in_equal_steps(const char *file, int n, const double *time)
{
    for (int i = 2; i < n; i++) {
        if (fabs((time[i] - time[i - 1]) - (time[1] - time[0])) > 1e-3 * (time[1] - time[0])) {
            (void)fprintf(stderr, "aerom: %s: line %d: t does not run in equal steps\n", file,
                          i + 2);
            return false;
        }
    }
    return true;
}

bool motion_read(const char *file, struct loop_motion *out, double *start)
{
    int n = 0;
    double *value = NULL;
    if (!columns_read(file, COLUMNS, columns, &n, &value)) {
        return false;
    }
    const double *time = value + num_at(0, TIME, n);
    if (!in_equal_steps(file, n, time)) {
        free(value);
        return false;
    }
    for (int i = 0; i < n; i++) {
        value[num_at(i, MOTION_THETA, n)] = num_rad(value[num_at(i, MOTION_THETA, n)]);
    }
    *start = time[0];
    *out = (struct loop_motion){
        .n = n, .step = n > 1 ? (time[n - 1] - time[0]) / (n - 1) : 0.0, .value = value};
    return true;
}
