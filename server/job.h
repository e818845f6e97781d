/* server/job.h
 * The life of a job as a table of allowed moves.
 *
 *   queued --claim--> running --publish--> done
 *     |  ^------lost/hand back--'  |  '-----fail--> failed
 *     |                            '--cancel--> cancelling --stopped--> cancelled
 *     '--cancel--> cancelled       (queued also fails when its attempts are used up)
 *
 * Pure functions, safe from any thread. */
#ifndef AEROM_SERVER_JOB_H
#define AEROM_SERVER_JOB_H

#include "api/service.h"

/* Whether a job may go from one state to the other. Staying is no move. */
bool job_move_allowed(enum job_state from, enum job_state to);
/* No move leads out: done, failed, cancelled. */
bool job_is_final(enum job_state state);
/* An equal case is answered by a job in this state. */
bool job_is_reusable(enum job_state state);

/* What must hold for a stored job of this record: started iff claimed, finished iff final, an error
 * iff failed, a queue row (units, for a study) iff not final. */
bool job_invariant(const struct job_record *job, bool has_queue_row);

#endif
