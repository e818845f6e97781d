/* server/dispatch.h
 * What this process is doing right now: the running jobs with their cancel flags and progress, the
 * number of open jobs, and the bell that wakes idle workers. The truth is in the store; this is the
 * part of it that changes too fast to be stored.
 *
 * Safe from any thread. One slot belongs to one worker. */
#ifndef AEROM_SERVER_DISPATCH_H
#define AEROM_SERVER_DISPATCH_H

#include "core/sim.h"
#include "server/store.h"

struct dispatch;

/* depth: open jobs in the store at start. NULL when out of memory. */
struct dispatch *dispatch_create(int n_slot, int64_t depth);
/* Accepts NULL. No worker may be left. */
void dispatch_destroy(struct dispatch *d);

/* The job of a slot begins (called by the writer, in the order of commits, so that a later cancel
 * finds it) and ends. */
void dispatch_enter(struct dispatch *d, int slot, const struct store_ticket *ticket);
void dispatch_leave(struct dispatch *d, int slot);
/* How the core watches the job of a slot; valid as long as the dispatch. */
struct sim_control dispatch_control(struct dispatch *d, int slot);

/* Asks the running job, or all running units of a study, to stop; false when no slot runs any. A
 * fence other than 0 means this claim only. */
bool dispatch_cancel(struct dispatch *d, const char *id, int64_t fence);
/* Progress 0..1 of a running job; false when no slot runs it as a whole. */
bool dispatch_progress(struct dispatch *d, const char *id, double *out);
/* Tickets of all running jobs; `out` has room for n_slot. Returns their number. */
int dispatch_tickets(struct dispatch *d, struct store_ticket *out);
int dispatch_slots(const struct dispatch *d);

/* Open jobs: accepted and without a final state. */
void dispatch_depth_add(struct dispatch *d, int64_t n);
int64_t dispatch_depth(const struct dispatch *d);

/* The bell: read the count, look for work, then wait for the count to change. dispatch_wait
 * returns after `seconds` at the latest. */
void dispatch_ring(struct dispatch *d);
uint64_t dispatch_rings(struct dispatch *d);
void dispatch_wait(struct dispatch *d, uint64_t seen, int seconds);

/* Stops: raises every cancel flag and wakes every worker; jobs that begin later stop at once. */
void dispatch_stop(struct dispatch *d);
bool dispatch_stopping(struct dispatch *d);

#endif
