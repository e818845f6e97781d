/* server/study_work.h
 * What a worker does with a claimed unit of a study: computes its cells in order, stores them
 * together at least every half second, and gives way when others wait.
 *
 * A struct study_work belongs to one worker's thread; it keeps the study it saw last, so that
 * sections, beams and modes are shared between its units. */
#ifndef AEROM_SERVER_STUDY_WORK_H
#define AEROM_SERVER_STUDY_WORK_H

#include "server/worker.h"

struct study_work;

/* NULL when out of memory. */
struct study_work *study_work_create(void);
void study_work_destroy(struct study_work *w);

/* Computes what is left of the unit until it is done, others wait, the slot's cancel flag is raised
 * or the lease is lost. True when the study has come to its end with this unit. */
bool study_work_unit(struct study_work *w, const struct worker_env *env, int slot,
                     const struct store_claim *claim);

#endif
