/* server/app.h
 * The composition root: creates every part in order, keeps time while they work, stops them in
 * reverse order.
 *
 * Threads: the caller's (start, tick, stop), the HTTP pool, the writer, the workers. No lock is
 * taken while another one of the server is held, except that a request's mutex (http.c) is held
 * while the HTTP library resumes its connection. */
#ifndef AEROM_SERVER_APP_H
#define AEROM_SERVER_APP_H

#include "server/config.h"
#include "server/log.h"

struct app;

enum app_exit { APP_OK = 0, APP_FAILURE = 1, APP_BAD_CONFIG = 2, APP_STORE_IN_USE = 3 };

/* Starts everything. On failure the reason is logged and what had been started is stopped.
 * sim_process_init must have been called. Borrows config and log. */
enum app_exit app_start(const struct config *config, const struct log *log, struct app **out);
/* Periodic duties: leases, slow connections, free disk. To be called about once a second. */
void app_tick(struct app *a);
/* Drains: no new work, running jobs go back to the queue, outstanding answers are sent. */
void app_stop(struct app *a);

#endif
