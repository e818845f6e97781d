/* api/study_run.h
 * Computes cells of a study one after the other on one thread. What neighbours share is kept:
 * sections, beam and modes are solved once for cells that differ only in the rest. */
#ifndef AEROM_API_STUDY_RUN_H
#define AEROM_API_STUDY_RUN_H

#include "api/study.h"
#include "core/control.h"

struct study_runner;

/* What a cell leaves behind. */
struct study_cell_result {
    enum study_cell_state state; /* done or failed */
    char hash[LIMIT_HASH];       /* identity of its case, "" when it is not admissible */
    char verdict[24];            /* "" when the kind has none */
    char code[40], detail[512];  /* failed: why */
    double cpu_s;
    char *summary; /* done: the summary document; owned, NULL otherwise */
};
void study_cell_result_done(struct study_cell_result *r);

/* Answers to plain cases that a search may use and leaves behind; called on the runner's thread. */
struct study_memory {
    void *context;
    /* The summary (malloc'ed) of a case with this identity; NULL when it is not known. */
    char *(*find)(void *context, const char *hash);
    /* A new one; the texts are borrowed for the call. */
    void (*keep)(void *context, const char *hash, const char *verdict, const char *summary,
                 double cpu_s);
};

/* Borrows the study, whose values it sets. `cpu_seconds` is the processor time of the running
 * thread. NULL when out of memory. */
struct study_runner *study_runner_create(struct study *s, double (*cpu_seconds)(void));
void study_runner_destroy(struct study_runner *r);
/* Borrows the memory; without one searches know nothing. */
void study_runner_remember(struct study_runner *r, const struct study_memory *memory);

/* Makes a cell the current one and tells the identity of its case, "" when it is not admissible.
 * ST_NO_MEMORY or ST_OK. */
MUST_CHECK enum status study_runner_begin(struct study_runner *r, int cell, char hash[LIMIT_HASH]);

/* Computes the current cell. Its failures are a result; ST_CANCELLED when the flag was raised, and
 * ST_NO_MEMORY, leave *out unchanged. */
MUST_CHECK enum status study_runner_compute(struct study_runner *r,
                                            const struct sim_control *control,
                                            struct study_cell_result *out);

#endif
