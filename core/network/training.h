/* core/network/training.h
 * One whole training: from records to a network, its learning curves and its errors on every
 * record.
 *
 * The caller's thread, and the one that the control lends (core/network/train.h). */
#ifndef AEROM_CORE_NETWORK_TRAINING_H
#define AEROM_CORE_NETWORK_TRAINING_H

#include "core/network/assess.h"
#include "core/network/ensemble.h"

enum { TRAINING_FOLDS_MAX = 100 };

struct training_def {
    struct dataset_def data; /* its frame is that of the network */
    struct train_def train;
    struct network_def network; /* name, frame, inputs, outputs, n_hidden of a member; else empty */
    int members;                /* trainings whose mean is the network, 1..ENSEMBLE_MEMBERS_MAX */
    int folds;                  /* of the cross-validation, 2..TRAINING_FOLDS_MAX; 0: none */
};

struct training_result {
    struct network_def network; /* owned, as is all below */
    int n_member, n_record;
    struct ensemble_member *member; /* (n_member) */
    bool *is_held;                  /* by every member: none was trained on it (n_record) */
    struct assessment *assessment;  /* (n_record) */
    /* Of networks that have not seen the record (n_record), ranges zero where it is at rest; NULL
     * without folds. */
    struct assessment *fold;
};

/* Polar without a network, defaults of Levenberg-Marquardt, the four inputs of App. B, c_l and c_m,
 * one member of 50 neurons. */
void training_def_defaults(struct training_def *def);

/* Appends what symmetry, neurons and outputs say together; pointers are those of the members
 * of `training` behind `pointer`. */
void training_def_check_parts(const struct training_def *def, const char *pointer,
                              struct failure_list *out);

/* Deals the records that move out to the folds of a cross-validation, in an order drawn from the
 * seed: fold (n_record), 0..folds - 1, or -1 for a record at rest. */
void training_deal(uint64_t seed, int folds, int n_record, const struct flow_record *record,
                   int *fold);

/* Records must have passed their check. ST_CANCELLED; ST_INVALID with *problems filled. On failure
 * *out is empty. */
MUST_CHECK enum status training_run(const struct training_def *def, int n_record,
                                    const struct flow_record *record,
                                    const struct sim_control *control, struct training_result *out,
                                    struct failure_list *problems);
/* Accepts a zeroed struct. */
void training_result_done(struct training_result *r);

#endif
