/* api/both_threads.h
 * A second thread for a computation of the core (core/control.h), which starts none itself. */
#ifndef AEROM_API_BOTH_THREADS_H
#define AEROM_API_BOTH_THREADS_H

/* work(first) on a thread of its own, work(second) on this one; one after the other when no thread
 * can be had. Returns when both are done. */
void both_threads(void (*work)(void *), void *first, void *second);

#endif
