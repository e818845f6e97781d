/* server/runner.h
 * Runs one stored case through the core and gathers everything that is to be stored.
 *
 * Called on a worker's thread; knows neither store nor queue. */
#ifndef AEROM_SERVER_RUNNER_H
#define AEROM_SERVER_RUNNER_H

#include "api/library.h"
#include "api/training_out.h"
#include "core/sim.h"
#include "server/store.h"

enum run_end {
    RUN_DONE,    /* `result` is to be published */
    RUN_FAILED,  /* `code` and `detail` say why */
    RUN_STOPPED, /* the cancel flag was raised */
};

enum { RUN_DOCUMENTS_MAX = 8 };

struct run_outcome {
    enum run_end end;
    char code[40];
    char detail[512];
    char verdict[24];
    /* What RUN_DONE publishes; its pointers lead to the members below. */
    struct store_result result;
    struct store_document document[RUN_DOCUMENTS_MAX];
    char *text[RUN_DOCUMENTS_MAX]; /* owned: the JSON of each document */
    struct training_out *training; /* owned, kind training; entry lies in it */
    struct shelf_item entry;
    struct store_series series;
    struct store_column *column; /* owned, as are the next two */
    struct series_chunk *chunk;  /* all columns, column by column */
    void **block;                /* data of each chunk */
};

/* Computes the case. Never fails as a call: every failure is an outcome. */
void runner_run(const struct library *lib, const char *case_json, const struct sim_control *control,
                struct run_outcome *out);
/* Frees what the outcome owns. */
void run_outcome_done(struct run_outcome *out);

#endif
