/* cli/records.h
 * The records of a folder: FOLDER/index.csv names them, FOLDER/records/NAME.csv holds them, in the
 * columns of data/cfd. */
#ifndef AEROM_CLI_RECORDS_H
#define AEROM_CLI_RECORDS_H

#include "core/network/dataset.h"

struct records {
    int n;
    struct flow_record *record; /* owned */
};

/* Reads the records the index lists and checks each. Needs the column name; with a column status
 * only what is done counts, with a column block only the blocks of motions (sine_, broadband_).
 * Columns pitch and plunge with one term amplitude@frequency+phase, of equal frequency, make a
 * sine: it counts from cycles_skipped periods after the motion starts, another record from 12 c/V
 * on. On failure lines have gone to stderr and *out is empty. */
bool records_read(const char *folder, struct failure_list *problems, struct records *out);
/* Accepts a zeroed struct. */
void records_done(struct records *r);

#endif
