/* server/id.h
 * Identifiers of jobs: UUID version 7 (RFC 9562), strictly increasing within one generator.
 *
 * A generator belongs to one thread. */
#ifndef AEROM_SERVER_ID_H
#define AEROM_SERVER_ID_H

#include "api/service.h"

struct id_generator {
    uint64_t last; /* 48 bits of milliseconds, then the 12-bit counter */
};

/* Next identifier for the wall time now_us. Time standing still or running back is bridged by the
 * counter, so that identifiers sort in the order they were made. */
void id_next(struct id_generator *g, int64_t now_us, char out[JOB_ID_SIZE]);

/* Continues after an identifier made earlier (by a previous process). False when it is not one. */
bool id_continue(struct id_generator *g, const char *id);

#endif
