/* core/network/ensemble.h
 * The mean of several trainings as one network: members differ in their random start and in the
 * records each holds out to know when to stop, so that together they have been trained on all.
 *
 * A mean of networks with one hidden layer is one, with the neurons of all of them side by side.
 * One thread; memory of one training at a time. */
#ifndef AEROM_CORE_NETWORK_ENSEMBLE_H
#define AEROM_CORE_NETWORK_ENSEMBLE_H

#include "core/network/train.h"

enum { ENSEMBLE_MEMBERS_MAX = 64 };

/* One training of the ensemble. */
struct ensemble_member {
    struct train_curve curve;
    int outside_polar;     /* samples outside the table */
    int n_trained, n_held; /* samples, mirrored */
    int n_held_record;     /* records held out */
    bool *is_held;         /* (n_record), owned */
};
/* Frees what `n` members own (not the array). */
void ensemble_members_done(int n, struct ensemble_member *member);

/* Trains `members` networks with the seeds data_def->seed, + 1, ... and def->seed, + 1, ...;
 * n_hidden of `net` is that of one member and becomes that of all. member (members) receives how
 * each went; on failure it is empty. Else as dataset_build and train_network. */
MUST_CHECK enum status ensemble_train(const struct dataset_def *data_def,
                                      const struct train_def *def, int members, int n_record,
                                      const struct flow_record *record,
                                      const struct sim_control *control, struct network_def *net,
                                      struct ensemble_member *member,
                                      struct failure_list *problems);

/* The mean of n networks of equal inputs, outputs and frame, in the scaling of the first, inside
 * the hull of all; the caller frees its arrays with network_def_done. ST_NO_MEMORY, or ST_LIMIT for
 * more than LIMIT_NET_HIDDEN neurons. */
MUST_CHECK enum status ensemble_merge(int n, const struct network_def *member,
                                      struct network_def *out);

#endif
