/* cli/training.h
 * Everything one `aerom train` reads and makes. One thread. */
#ifndef AEROM_CLI_TRAINING_H
#define AEROM_CLI_TRAINING_H

#include "cli/options.h"
#include "cli/records.h"
#include "cli/source.h"

#include "core/network/training.h"

struct training {
    struct sources sources;
    struct records records;
    struct failure_list *problems;
    struct training_def def;
    struct training_result result; /* its network is in the entry */
    struct network_entry entry;
};

/* Reads the options. False after lines on stderr. */
bool training_set(const struct options *o, struct training *t);

/* Curves of all members, then a line for each record, twice with folds. */
bool training_print(const struct training *t);
/* Writes the network with what it was made from. */
bool training_write(const struct options *o, struct training *t);

#endif
