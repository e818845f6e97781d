/* server/port.h
 * What the ports of the contract (service_impl, shelf_impl) share: reading the store, and what its
 * statuses mean to a handler. No state; from any thread. */
#ifndef AEROM_SERVER_PORT_H
#define AEROM_SERVER_PORT_H

#include "server/log.h"
#include "server/store.h"

enum service_status port_status(enum store_status st);

/* Borrows a reader; NULL, logged, when none can be opened. */
struct store_session *port_take(struct store *store, const struct log *log);
/* Returns the reader and turns the status into the port's, logging what is nobody's fault. */
enum service_status port_give(struct store *store, const struct log *log, struct store_session *r,
                              enum store_status st);

#endif
