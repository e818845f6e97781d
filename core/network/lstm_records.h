/* core/network/lstm_records.h
 * Records as sequences for a network with memory: equal steps of time, eight side by side.
 *
 * The memory is one of steps, so that all sequences need the same: a record sampled twice as often
 * gives every other sample. A group owns its arrays. Free of state. */
#ifndef AEROM_CORE_NETWORK_LSTM_RECORDS_H
#define AEROM_CORE_NETWORK_LSTM_RECORDS_H

#include "core/network/dataset.h"
#include "core/simd.h"

/* Sequences of one pass; shorter ones are filled up with samples that do not count. */
struct lstm_group {
    int n;         /* steps of the longest */
    lanes *x;      /* scaled inputs (n_in x n) */
    lanes *t;      /* scaled increments (n_out x n) */
    lanes *weight; /* (n): zero before the start of a record; of each sequence they sum to one */
    int sequences; /* lanes in use */
};
struct lstm_set {
    int n;
    struct lstm_group *group; /* (n), owned */
};

/* Every how many samples of the record one step is; 0 where the step is no multiple of theirs
 * within 1 %. */
int lstm_stride(const struct flow_record *r, double step);

/* Sequences of the records on one side of the draw, each as it is and mirrored, in the order of
 * their length. `net` has inputs, outputs and scaling. ST_NO_MEMORY; ST_INVALID with a problem for
 * each record whose samples do not fit the step. On failure *out is unchanged. */
MUST_CHECK enum status lstm_set_build(const struct dataset_def *def, const struct dataset *data,
                                      const struct flow_record *record, bool held, double step,
                                      const struct network_def *net, struct failure_list *problems,
                                      struct lstm_set *out);
/* Accepts a zeroed struct. */
void lstm_set_done(struct lstm_set *s);

/* Scaled inputs of a record at steps first, first + stride, ...: into one lane of x (n_in x n), n
 * at most. Fills up with the last. `in` are the inputs of flow_record_inputs. */
void lstm_pack_inputs(const struct flow_record *r, const struct network_def *net, const double *in,
                      int first, int stride, double sign, int n, int lane, lanes *x);

#endif
