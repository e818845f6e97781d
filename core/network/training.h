/* core/network/training.h
 * One whole training: from records to a network, its learning curve and its errors on every record.
 *
 * One thread a training. */
#ifndef AEROM_CORE_NETWORK_TRAINING_H
#define AEROM_CORE_NETWORK_TRAINING_H

#include "core/network/assess.h"
#include "core/network/train.h"

struct training_def {
    struct dataset_def data;
    struct train_def train;
    struct network_def network; /* name, inputs, outputs and n_hidden; the rest empty */
};

struct training_result {
    struct network_def network; /* owned, as is all below */
    struct train_curve curve;
    int samples_trained, samples_held; /* without the mirrored ones */
    int outside_polar;
    int n_record, n_held;
    bool *is_held;                 /* (n_record) */
    struct assessment *assessment; /* (n_record) */
};

/* Polar without a network, defaults of Levenberg-Marquardt, the four inputs of App. B, c_l and c_m,
 * 50 neurons. */
void training_def_defaults(struct training_def *def);

/* Records must have passed their check. ST_CANCELLED; ST_INVALID with *problems filled. On failure
 * *out is empty. */
MUST_CHECK enum status training_run(const struct training_def *def, int n_record,
                                    const struct flow_record *record,
                                    const struct sim_control *control, struct training_result *out,
                                    struct failure_list *problems);
/* Accepts a zeroed struct. */
void training_result_done(struct training_result *r);

#endif
