/* api/shelf.h
 * The port between the contract and whoever keeps what users add to the library: materials, polars,
 * networks and datasets, each immutable and named by name, version and hash.
 *
 * The server implements it over its store; tests implement it in memory. Reads are synchronous and
 * safe from any thread; writes answer through a callback once they are on stable storage (or have
 * failed), from any thread, exactly once. */
#ifndef AEROM_API_SHELF_H
#define AEROM_API_SHELF_H

#include "api/service.h"

enum shelf_kind { SHELF_MATERIAL, SHELF_POLAR, SHELF_NETWORK, SHELF_DATASET, SHELF_KINDS };

/* "material" "polar" "network" "dataset". */
const char *shelf_kind_name(enum shelf_kind kind);

/* An entry on its way in; borrowed until the callback has been called. */
struct shelf_item {
    enum shelf_kind kind;
    const char *name;
    const char *hash; /* of its content, hexadecimal */
    const char *head; /* what a list shows: members of a JSON object, without its brackets */
    const char *job;  /* id of the training that made it, "" for an upload */
    const void *data;
    size_t size;
};

/* One version of an entry as it is kept. */
struct shelf_entry {
    char name[LIMIT_NAME];
    char hash[LIMIT_HASH];
    char job[JOB_ID_SIZE];
    int version; /* 1, 2, ... of its name */
    int64_t created_us;
    char *head; /* owned */
    void *data; /* owned, NULL in a list */
    size_t size;
};

/* version: that of the new entry, or of the one of the same name and hash, which then is `reused`.
 */
typedef void (*shelf_put_done)(void *arg, enum service_status status, int version, bool reused);
/* SERVICE_NOT_READY: a job that waits or runs needs it. */
typedef void (*shelf_drop_done)(void *arg, enum service_status status);

struct shelf {
    void *ctx;
    void (*put)(void *ctx, const struct shelf_item *item, shelf_put_done done, void *arg);
    /* One version, 0 all of the name. */
    void (*drop)(void *ctx, enum shelf_kind kind, const char *name, int version,
                 shelf_drop_done done, void *arg);
    /* All of a kind by name and version, without data. Freed with shelf_entries_done. */
    enum service_status (*list)(void *ctx, enum shelf_kind kind, struct shelf_entry **out, int *n);
    /* One version, 0 the newest. Freed with shelf_entry_done. */
    enum service_status (*get)(void *ctx, enum shelf_kind kind, const char *name, int version,
                               struct shelf_entry *out);
};

void shelf_entry_done(struct shelf_entry *e);
void shelf_entries_done(struct shelf_entry *list, int n);

/* "name" or "name@version" into its parts; version 0 when there is none. False when it is neither.
 */
bool shelf_reference(const char *text, char name[LIMIT_NAME], int *version);
/* Whether a name may be given to an entry: 1..63 letters, digits, and any of ._+/- */
bool shelf_name_is_allowed(const char *name);

#endif
