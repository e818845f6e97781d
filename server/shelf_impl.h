/* server/shelf_impl.h
 * The library's shelf over the store: reads by reader sessions, writes by the writer's thread.
 *
 * Safe from any thread. Borrows store, writer and log, which must outlive it. */
#ifndef AEROM_SERVER_SHELF_IMPL_H
#define AEROM_SERVER_SHELF_IMPL_H

#include "api/shelf.h"
#include "server/writer.h"

struct shelf_impl;

/* NULL when out of memory. */
struct shelf_impl *shelf_impl_create(struct store *st, struct writer *writer,
                                     const struct log *log);
/* Accepts NULL. No write may be outstanding. */
void shelf_impl_destroy(struct shelf_impl *s);
const struct shelf *shelf_impl_port(const struct shelf_impl *s);

#endif
