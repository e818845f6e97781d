/* core/network/train_lstm.h
 * Training of a network with memory on whole records: back-propagation through time, truncated to
 * 128 steps with the state carried on, and Adam; early stopping on the records held out.
 *
 * Made for comparison with the feed-forward network on records of prescribed motion (App. B,
 * Torregrosa et al.); a march cannot use it. One thread a training; the same records and definition
 * give the same bits. */
#ifndef AEROM_CORE_NETWORK_TRAIN_LSTM_H
#define AEROM_CORE_NETWORK_TRAIN_LSTM_H

#include "core/network/lstm_model.h"
#include "core/network/train.h"

/* At most 400 epochs with a patience of 60, rate 3e-3 that falls to a tenth, decay 1e-4, seed 1. */
void train_lstm_defaults(struct train_def *def);

/* `data` is the dataset of these records: it says which are held out and what scales. `out` has
 * inputs, outputs, n_hidden (1..LSTM_HIDDEN_MAX) and step; receives scaling, hull and p. A step of
 * the optimiser sees four records and their mirror images; samples before the start of a record
 * only warm up the state, and records count alike. def->batch and def->optimiser mean nothing here.
 * ST_INVALID with *problems filled; ST_CANCELLED; ST_NOT_FINITE; ST_NO_MEMORY. On failure *curve is
 * unchanged. */
MUST_CHECK enum status train_lstm(const struct dataset_def *data_def, const struct dataset *data,
                                  const struct flow_record *record, const struct train_def *def,
                                  const struct sim_control *control, struct lstm_def *out,
                                  struct train_curve *curve, struct failure_list *problems);

#endif
