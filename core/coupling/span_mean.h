/* core/coupling/span_mean.h
 * Means of the station values over the last stretch of a march whose end is not known while it
 * runs: sums of blocks of samples in a ring, so that a step costs one addition a value and the
 * memory does not grow with the march.
 *
 * The struct owns its memory; it belongs to one thread. Pushing allocates nothing. */
#ifndef AEROM_CORE_COUPLING_SPAN_MEAN_H
#define AEROM_CORE_COUPLING_SPAN_MEAN_H

#include "core/status.h"

/* What is averaged at each station. */
enum span_value { SPAN_CL, SPAN_CD, SPAN_CM, SPAN_INDUCED, SPAN_ALPHA, SPAN_VALUES };

struct span_mean {
    int n_station;
    int window;  /* samples the mean is wanted over */
    int block;   /* samples in a block */
    int anchor;  /* a sample some block begins with */
    int n;       /* samples pushed */
    double *sum; /* ring of blocks (n_station x SPAN_VALUES x SPAN_BLOCKS), owned */
};

/* A window at the end of a march of n_sample samples is met exactly; one that ends earlier is
 * longer by less than a sixty-fourth of itself. */
enum { SPAN_WINDOW_BLOCKS = 64, SPAN_BLOCKS = SPAN_WINDOW_BLOCKS + 2 };

/* window and n_sample >= 1. */
MUST_CHECK enum status span_mean_init(int n_station, int window, int n_sample,
                                      struct span_mean *out);
void span_mean_done(struct span_mean *s);

/* Adds one sample: n_station values of each kind. */
void span_mean_push(struct span_mean *s, const double *const value[SPAN_VALUES]);

/* First sample of the mean over the window that ends with the last sample pushed; out
 * (n_station x SPAN_VALUES) receives the means. At least one sample has been pushed. */
int span_mean_get(const struct span_mean *s, double *out);

#endif
