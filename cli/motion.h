/* cli/motion.h
 * A prescribed motion read from CSV, in the columns of the records in data/cfd. */
#ifndef AEROM_CLI_MOTION_H
#define AEROM_CLI_MOTION_H

#include "core/analysis/loop.h"

#include <stdbool.h>

/* Reads t, alpha_deg, alpha_dot, alpha_ddot (rad, c/V) and, when there, w, w_dot, w_ddot (chords,
 * c/V) by the names in the first line; other columns are passed over. t must run in equal steps.
 * On failure a line has gone to stderr and *out is unchanged; otherwise out->value is malloc'ed and
 * *start the first time. */
bool motion_read(const char *file, struct loop_motion *out, double *start);

#endif
