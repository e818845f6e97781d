/* server/service_impl.h
 * The port of the contract (api/service.h) over store, writer and dispatch.
 *
 * Reads run on the caller's thread with a borrowed reader; writes go to the writer and answer from
 * its thread. Safe from any thread between create and destroy. */
#ifndef AEROM_SERVER_SERVICE_IMPL_H
#define AEROM_SERVER_SERVICE_IMPL_H

#include "server/dispatch.h"
#include "server/log.h"
#include "server/writer.h"

struct service_impl;

/* Borrows everything. queue_limit: most open jobs. NULL when out of memory. */
struct service_impl *service_impl_create(struct store *st, struct writer *writer,
                                         struct dispatch *dispatch, const struct log *log,
                                         int64_t queue_limit);
/* Accepts NULL. The writer must have been stopped before, so that no answer is outstanding. */
void service_impl_destroy(struct service_impl *s);

const struct service *service_impl_port(const struct service_impl *s);
/* While the disk is nearly full new jobs are refused. */
void service_impl_disk_low(struct service_impl *s, bool low);
/* From now on new jobs are refused as busy. */
void service_impl_stop(struct service_impl *s);

#endif
