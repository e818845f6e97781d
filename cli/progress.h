/* cli/progress.h
 * How far a long computation is, in per cent on stderr while that is a terminal: nothing goes into
 * files and pipes. A thread of its own prints it; start and stop belong to one thread. */
#ifndef AEROM_CLI_PROGRESS_H
#define AEROM_CLI_PROGRESS_H

#include <pthread.h>
#include <stdbool.h>

struct progress {
    _Atomic double share; /* 0..1, set by the computation */
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t ended;
    bool is_shown, has_ended;
};

/* *p stays where it is until the stop. */
void progress_start(struct progress *p);
/* Wipes the line. */
void progress_stop(struct progress *p);

#endif
