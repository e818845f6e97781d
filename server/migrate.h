/* server/migrate.h
 * Brings a schema up to date from the embedded migrations (migrations/README.md).
 *
 * Knows numbers, order and checksums; the back end knows how to read and apply. Runs once at start
 * on the thread that opens the store. */
#ifndef AEROM_SERVER_MIGRATE_H
#define AEROM_SERVER_MIGRATE_H

#include "api/embedded.h"
#include "server/store.h"

enum { MIGRATION_CHECKSUM = 32 }; /* BLAKE2b-256 */

struct migration {
    int number; /* from 1 without gaps */
    const char *path;
    const char *sql; /* zero-terminated */
    unsigned char checksum[MIGRATION_CHECKSUM];
};

/* The back end's side. */
struct migrate_db {
    void *ctx;
    /* Number of the last applied migration, 0 for an empty database. */
    enum store_status (*version)(void *ctx, int *out);
    enum store_status (*checksum)(void *ctx, int number, unsigned char out[MIGRATION_CHECKSUM]);
    /* Runs the migration and records number and checksum in one transaction. */
    enum store_status (*apply)(void *ctx, const struct migration *m);
};

/* Verifies what is applied and applies the rest of files "<dialect>/NNNN_name.sql".
 * STORE_REFUSED with the reason in `why`: a gap in the numbers, an applied file that has changed, a
 * schema newer than the files. */
enum store_status migrate_run(const struct embedded_file *file, int n_file, const char *dialect,
                              const struct migrate_db *db, char why[STORE_MESSAGE]);

#endif
