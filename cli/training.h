/* cli/training.h
 * Everything one `aerom train` reads and makes. One thread. */
#ifndef AEROM_CLI_TRAINING_H
#define AEROM_CLI_TRAINING_H

#include "cli/options.h"
#include "cli/records.h"
#include "cli/source.h"

#include "core/network/assess.h"
#include "core/network/ensemble.h"

struct training {
    struct sources sources;
    struct records records;
    struct failure_list *problems;
    struct dataset_def dataset_def;
    struct train_def def;
    int members;       /* trainings whose mean is the network */
    int folds;         /* parts of the records for cross-validation, 0: none */
    int member_hidden; /* neurons of one member */
    struct ensemble_member member[ENSEMBLE_MEMBERS_MAX];
    struct network_entry entry;
    struct assessment *assessment; /* of the network (records.n) */
    struct assessment *fold; /* of networks that have not seen the record (records.n), or NULL */
};

/* Reads the options. False after lines on stderr. */
bool training_set(const struct options *o, struct training *t);

/* Curves of all members, then a line for each record, twice with folds. */
bool training_print(const struct training *t);
/* Writes the network with what it was made from. */
bool training_write(const struct options *o, struct training *t);

#endif
