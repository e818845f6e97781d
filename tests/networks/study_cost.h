/* tests/networks/study_cost.h
 * Processor time of one evaluation of a network, with and without memory. */
#ifndef AEROM_TESTS_NETWORKS_STUDY_COST_H
#define AEROM_TESTS_NETWORKS_STUDY_COST_H

#include "core/network/lstm_model.h"

/* Processor time of this process [s]. */
double study_seconds(void);

/* One step of so many sections side by side, by section [ns]. */
double study_cost_feed_forward(const struct network *net, int sections);
/* Eight sections, a lane each. */
double study_cost_lstm(const struct lstm_def *net);

#endif
