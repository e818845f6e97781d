/* core/network/lstm_model.h
 * A trained network with memory: increments along a record of prescribed motion, and how good they
 * are.
 *
 * Owns its parameters; immutable once trained, so that threads may share it. */
#ifndef AEROM_CORE_NETWORK_LSTM_MODEL_H
#define AEROM_CORE_NETWORK_LSTM_MODEL_H

#include "core/network/assess.h"
#include "core/network/lstm.h"

struct lstm_def {
    struct network_def net; /* inputs, outputs, n_hidden, scaling and hull; no weights */
    double step;            /* of its memory [c/V] */
    double *p;              /* in the order of lstm.h, owned */
};
/* Accepts a zeroed struct. */
void lstm_def_done(struct lstm_def *def);
struct lstm lstm_shape(const struct lstm_def *def);

/* Increments at every sample of a record, from its first on: y (NET_OUT_COUNT x n), zero where the
 * network has no such output. `in` are the inputs of flow_record_inputs. ST_INVALID where the
 * samples do not fit the step. */
MUST_CHECK enum status lstm_predict(const struct lstm_def *def, const struct flow_record *r,
                                    const double *in, double *y);

/* As assess_record. */
MUST_CHECK enum status lstm_assess(const struct flow_record *r, double window,
                                   const struct polar *polar, const struct lstm_def *net,
                                   struct assessment *out);

#endif
