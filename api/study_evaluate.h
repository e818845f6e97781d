/* api/study_evaluate.h
 * Runs of the case of a study with the values that stand in its tree, one after the other on one
 * thread. Sections, beam and modes are kept from run to run until the caller says that they
 * change. Inside api only. */
#ifndef AEROM_API_STUDY_EVALUATE_H
#define AEROM_API_STUDY_EVALUATE_H

#include "api/study_fields.h"
#include "api/study_run.h"
#include "core/control.h"
#include "core/sim.h"

/* Zeroed but for the first members; study_evaluator_done frees what it keeps. */
struct study_evaluator {
    struct study *study; /* borrowed */
    const struct sim_control *control;
    const struct study_memory *memory; /* may be NULL */
    double (*cpu_seconds)(void);
    int runs;
    double cpu_s;
    struct sim *structure; /* whose sections, beam and modes are taken over; owned */
};
/* Sections, beam or modes are no longer those of the last run. */
void study_evaluator_change(struct study_evaluator *e);
void study_evaluator_done(struct study_evaluator *e);

/* Where a march ends and another one may begin: modes 0: nowhere. */
struct study_state {
    int modes;
    double amplitude[LIMIT_MODES], velocity[LIMIT_MODES];
};

/* Owns the summary: study_answer_done. */
struct study_answer {
    enum status status;    /* other than ST_OK: the case is not admissible, or its run failed */
    char code[40];         /* then why */
    char hash[LIMIT_HASH]; /* identity of the case, "" when it is not a plain case */
    char verdict[24];      /* "" when the kind has none */
    struct cJSON *summary;
};
void study_answer_done(struct study_answer *a);

/* `from` (NULL: as the case says) is where the march begins, `end` (may be NULL) receives where it
 * ends. The failure of the run is an answer; ST_CANCELLED and ST_NO_MEMORY leave *out unchanged. */
MUST_CHECK enum status study_evaluate(struct study_evaluator *e, const struct study_state *from,
                                      struct study_state *end, struct study_answer *out);

#endif
