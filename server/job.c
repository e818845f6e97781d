#include "server/job.h"

#include <assert.h>

#define TO(state) (1U << (state))

/* Row = from; bits = the states it may go to. */
static const unsigned moves[JOB_STATE_COUNT] = {
    [JOB_QUEUED] = TO(JOB_RUNNING) | TO(JOB_CANCELLED) | TO(JOB_FAILED),
    [JOB_RUNNING] = TO(JOB_QUEUED) | TO(JOB_CANCELLING) | TO(JOB_DONE) | TO(JOB_FAILED),
    [JOB_CANCELLING] = TO(JOB_CANCELLED),
    [JOB_DONE] = 0,
    [JOB_FAILED] = 0,
    [JOB_CANCELLED] = 0,
};

bool job_move_allowed(enum job_state from, enum job_state to)
{
    assert(from < JOB_STATE_COUNT);
    assert(to < JOB_STATE_COUNT);
    return (moves[from] & TO(to)) != 0;
}

bool job_is_final(enum job_state state)
{
    assert(state < JOB_STATE_COUNT);
    return moves[state] == 0;
}

bool job_is_reusable(enum job_state state)
{
    return state == JOB_QUEUED || state == JOB_RUNNING || state == JOB_DONE;
}

bool job_invariant(const struct job_record *job, bool has_queue_row)
{
    const bool claimed = job->attempt > 0;
    const bool failed = job->state == JOB_FAILED;
    return has_queue_row == !job_is_final(job->state) &&
           (job->finished_us != 0) == job_is_final(job->state) &&
           (job->started_us != 0) == claimed && (job->error_code[0] != '\0') == failed &&
           (claimed || (job->state != JOB_RUNNING && job->state != JOB_DONE)) &&
           (job->verdict[0] == '\0' || job->state == JOB_DONE);
}
