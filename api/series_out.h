/* api/series_out.h
 * Recorded series as JSON and CSV, whole or thinned for a plot. No state. */
#ifndef AEROM_API_SERIES_OUT_H
#define AEROM_API_SERIES_OUT_H

#include "api/json_out.h"
#include "api/service.h"

/* Min-max thinning: the samples are cut into points/2 buckets, and of each bucket the smallest and
 * the largest sample are kept, in the order of time: peaks survive, whatever the number of points.
 * (The first and the last when all are equal, so that every column keeps as many.) Needs points >=
 * 2 and n > points. Returns the kept count, 2 * (points / 2); index (points) receives ascending
 * sample numbers. */
int series_minmax(int n, const double *value, int points, int *index);

/* {"t0_s", "step_s", "samples", "thinned", "channels": {name: {"value": [...]}}}; a thinned column
 * also has "time_s": [...]. points 0 keeps every sample. */
void series_out_json(struct json_out *out, const struct series_data *data, int points);

/* Header line and rows: time_s and the columns; thinned, each column has its own time in a column
 * "<name>.time_s" before it. A value that is not finite is empty. */
void series_out_csv(struct json_out *out, const struct series_data *data, int points);

#endif
