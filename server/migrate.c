#include "server/migrate.h"

#include <ctype.h>
#include <sodium.h>
#include <stdio.h>
#include <string.h>

/* Number of "<dialect>/NNNN_name.sql", 0 for any other path. */
static int migration_number(const char *path, const char *dialect)
{
    const size_t n = strlen(dialect);
    if (strncmp(path, dialect, n) != 0 || path[n] != '/') {
        return 0;
    }
    int number = 0;
    for (const char *p = path + n + 1; *p != '_'; p++) {
        if (!isdigit((unsigned char)*p) || number > 9999) {
            return 0;
        }
        number = 10 * number + (*p - '0');
    }
    return number;
}

static bool find(const struct embedded_file *file, int n_file, const char *dialect, int number,
                 struct migration *out)
{
    for (int i = 0; i < n_file; i++) {
        if (migration_number(file[i].path, dialect) != number) {
            continue;
        }
        *out = (struct migration){.number = number, .path = file[i].path, .sql = file[i].data};
        (void)crypto_generichash(out->checksum, sizeof out->checksum,
                                 (const unsigned char *)file[i].data, embedded_size(&file[i]), NULL,
                                 0);
        return true;
    }
    return false;
}

static int count(const struct embedded_file *file, int n_file, const char *dialect)
{
    int n = 0;
    for (int i = 0; i < n_file; i++) {
        n += migration_number(file[i].path, dialect) > 0;
    }
    return n;
}

static enum store_status verify(const struct migrate_db *db, const struct migration *m, char *why)
{
    unsigned char stored[MIGRATION_CHECKSUM];
    const enum store_status st = db->checksum(db->ctx, m->number, stored);
    if (st == STORE_OK && memcmp(stored, m->checksum, sizeof stored) == 0) {
        return STORE_OK;
    }
    (void)snprintf(why, STORE_MESSAGE,
                   st == STORE_OK ? "migration %s was applied with other contents"
                                  : "the record of migration %s is missing or unreadable",
                   m->path);
    return STORE_REFUSED;
}

enum store_status migrate_run(const struct embedded_file *file, int n_file, const char *dialect,
                              const struct migrate_db *db, char why[STORE_MESSAGE])
{
    int version = 0;
    const int newest = count(file, n_file, dialect);
    enum store_status st = db->version(db->ctx, &version);
    if (st != STORE_OK) {
        (void)snprintf(why, STORE_MESSAGE, "the schema version cannot be read");
        return st;
    }
    if (version > newest) {
        (void)snprintf(why, STORE_MESSAGE,
                       "the database has schema version %d, this program knows up to %d", version,
                       newest);
        return STORE_REFUSED;
    }
    for (int number = 1; number <= newest; number++) {
        struct migration m;
        if (!find(file, n_file, dialect, number, &m)) {
            (void)snprintf(why, STORE_MESSAGE, "migration %04d of %s is missing", number, dialect);
            return STORE_REFUSED;
        }
        if (number <= version) {
            st = verify(db, &m, why);
        } else {
            st = db->apply(db->ctx, &m);
            if (st != STORE_OK) {
                (void)snprintf(why, STORE_MESSAGE, "migration %s failed", m.path);
            }
        }
        if (st != STORE_OK) {
            return st;
        }
    }
    return STORE_OK;
}
