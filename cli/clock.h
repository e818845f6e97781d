/* cli/clock.h
 * Processor time, for what a run reports of itself. */
#ifndef AEROM_CLI_CLOCK_H
#define AEROM_CLI_CLOCK_H

#include <time.h>

/* Of the running thread [s]. */
static inline double clock_thread_cpu(void)
{
    struct timespec t = {0};
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
