/* Opening and closing the SQLite back end: lock file, connections, schema, pool of readers. */
#include "server/store_sqlite.h"
#include "server/clock.h"
#include "server/migrate.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

enum { APPLICATION_ID = 0x41455231, PROGRESS_OPS = 10000 }; /* "AER1" */

/* page_size comes first: it must be set before the first table exists. */
static const char writer_pragmas[] =
    "PRAGMA page_size=16384; PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;"
    "PRAGMA wal_autocheckpoint=0; PRAGMA journal_size_limit=67108864; PRAGMA foreign_keys=ON;"
    "PRAGMA temp_store=MEMORY; PRAGMA cache_size=-32768; PRAGMA trusted_schema=OFF;"
    "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0; PRAGMA busy_timeout=5000;";
static const char reader_pragmas[] =
    "PRAGMA query_only=ON; PRAGMA wal_autocheckpoint=0; PRAGMA temp_store=MEMORY;"
    "PRAGMA cache_size=-8192; PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;"
    "PRAGMA mmap_size=0; PRAGMA busy_timeout=5000;";

static enum store_status pragma_int(sqlite3 *db, const char *text, int *out)
{
    sqlite3_stmt *stmt = NULL;
    int rc = sqlite3_prepare_v2(db, text, -1, &stmt, NULL);
    if (rc == SQLITE_OK) {
        rc = sqlite3_step(stmt);
        *out = rc == SQLITE_ROW ? sqlite3_column_int(stmt, 0) : *out;
    }
    (void)sqlite3_finalize(stmt);
    return rc == SQLITE_ROW ? STORE_OK : sqlite_status(rc == SQLITE_OK ? SQLITE_ERROR : rc);
}

/* Ours, or empty. */
static enum store_status check_owner(sqlite3 *db, const char *path, char why[STORE_MESSAGE])
{
    int id = 0, objects = 0;
    enum store_status st = pragma_int(db, "PRAGMA application_id", &id);
    if (st == STORE_OK) {
        st = pragma_int(db, "SELECT count(*) FROM sqlite_schema", &objects);
    }
    if (st != STORE_OK) {
        (void)snprintf(why, STORE_MESSAGE, "%s: %s", path, sqlite3_errmsg(db));
        return st;
    }
    if (id == APPLICATION_ID || (id == 0 && objects == 0)) {
        return STORE_OK;
    }
    (void)snprintf(why, STORE_MESSAGE, "%s is a database of another program", path);
    return STORE_REFUSED;
}

enum store_status sqlite_connect(const char *path, bool writer, sqlite3 **out,
                                 char why[STORE_MESSAGE])
{
    sqlite3 *db = NULL;
    const int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE |
                      (writer ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY);
    int rc = sqlite3_open_v2(path, &db, flags, NULL);
    if (rc == SQLITE_OK) {
        rc = sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    }
    if (rc == SQLITE_OK && !writer) {
        rc = sqlite3_db_config(db, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, NULL);
    }
    if (rc == SQLITE_OK && writer) {
        const enum store_status st = check_owner(db, path, why); /* before anything is written */
        if (st != STORE_OK) {
            (void)sqlite3_close(db);
            return st;
        }
    }
    if (rc == SQLITE_OK) {
        rc = sqlite3_exec(db, writer ? writer_pragmas : reader_pragmas, NULL, NULL, NULL);
    }
    if (rc != SQLITE_OK) {
        (void)snprintf(why, STORE_MESSAGE, "%s: %s", path,
                       db != NULL ? sqlite3_errmsg(db) : "out of memory");
        (void)sqlite3_close(db);
        return sqlite_status(rc);
    }
    *out = db;
    return STORE_OK;
}

static void session_close(struct sqlite_session *s)
{
    for (int i = 0; i < s->n_cache; i++) {
        (void)sqlite3_finalize(s->cache[i].stmt);
    }
    s->n_cache = 0;
    (void)sqlite3_close(s->db);
    s->db = NULL;
}

/* -- schema: the SQLite side of migrate.h ----------------------------------------------- */

static enum store_status schema_version(void *ctx, int *out)
{
    return pragma_int(ctx, "PRAGMA user_version", out);
}

static enum store_status schema_checksum(void *ctx, int number,
                                         unsigned char out[MIGRATION_CHECKSUM])
{
    sqlite3_stmt *stmt = NULL;
    enum store_status st = STORE_NONE;
    if (sqlite3_prepare_v2(ctx, "SELECT checksum FROM schema_migration WHERE number = ?1", -1,
                           &stmt, NULL) != SQLITE_OK) {
        return STORE_NONE;
    }
    (void)sqlite3_bind_int(stmt, 1, number);
    if (sqlite3_step(stmt) == SQLITE_ROW && sqlite3_column_bytes(stmt, 0) == MIGRATION_CHECKSUM) {
        memcpy(out, sqlite3_column_blob(stmt, 0), MIGRATION_CHECKSUM);
        st = STORE_OK;
    }
    (void)sqlite3_finalize(stmt);
    return st;
}

static int record_migration(sqlite3 *db, const struct migration *m)
{
    sqlite3_stmt *stmt = NULL;
    int rc = sqlite3_prepare_v2(db,
                                "INSERT INTO schema_migration (number, path, checksum, applied_us) "
                                "VALUES (?1, ?2, ?3, ?4)",
                                -1, &stmt, NULL);
    if (rc == SQLITE_OK) {
        (void)sqlite3_bind_int(stmt, 1, m->number);
        (void)sqlite3_bind_text(stmt, 2, m->path, -1, SQLITE_STATIC);
        (void)sqlite3_bind_blob(stmt, 3, m->checksum, MIGRATION_CHECKSUM, SQLITE_STATIC);
        (void)sqlite3_bind_int64(stmt, 4, clock_wall_us());
        rc = sqlite3_step(stmt);
    }
    (void)sqlite3_finalize(stmt);
    return rc == SQLITE_DONE ? SQLITE_OK : rc;
}

static enum store_status schema_apply(void *ctx, const struct migration *m)
{
    sqlite3 *db = ctx;
    char ids[96];
    (void)snprintf(ids, sizeof ids, "PRAGMA application_id=%d; PRAGMA user_version=%d;",
                   APPLICATION_ID, m->number);
    int rc = sqlite3_exec(db,
                          "BEGIN IMMEDIATE;"
                          "CREATE TABLE IF NOT EXISTS schema_migration (number INTEGER PRIMARY KEY,"
                          " path TEXT NOT NULL, checksum BLOB NOT NULL,"
                          " applied_us INTEGER NOT NULL) STRICT;",
                          NULL, NULL, NULL);
    if (rc == SQLITE_OK) {
        rc = sqlite3_exec(db, m->sql, NULL, NULL, NULL);
    }
    if (rc == SQLITE_OK) {
        rc = record_migration(db, m);
    }
    if (rc == SQLITE_OK) {
        rc = sqlite3_exec(db, ids, NULL, NULL, NULL);
    }
    if (rc == SQLITE_OK) {
        rc = sqlite3_exec(db, "COMMIT", NULL, NULL, NULL);
    }
    if (rc != SQLITE_OK) {
        (void)sqlite3_exec(db, "ROLLBACK", NULL, NULL, NULL);
    }
    return sqlite_status(rc);
}

/* -- the lock file ---------------------------------------------------------------------- */

static void refuse(char why[STORE_MESSAGE], const char *path, int error)
{
    char reason[128] = "";
    (void)strerror_r(error, reason, sizeof reason);
    (void)snprintf(why, STORE_MESSAGE, "%.300s: %s", path, reason);
}

/* The kernel drops the lock with the process, however it ends. */
static enum store_status lock_take(const char *path, int *fd_out, char why[STORE_MESSAGE])
{
    char name[1100];
    (void)snprintf(name, sizeof name, "%s.lock", path);
    const int fd = open(name, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (fd < 0) {
        refuse(why, name, errno);
        return STORE_REFUSED;
    }
    if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
        char pid[32] = "";
        const ssize_t n = read(fd, pid, sizeof pid - 1);
        pid[n > 0 ? n : 0] = '\0';
        pid[strcspn(pid, "\n")] = '\0';
        (void)snprintf(why, STORE_MESSAGE, "%.300s is in use by another daemon (process %s)", path,
                       pid);
        (void)close(fd);
        return STORE_LOCKED;
    }
    char pid[32];
    const int n = snprintf(pid, sizeof pid, "%ld\n", (long)getpid());
    if (ftruncate(fd, 0) != 0 || write(fd, pid, (size_t)n) != n) {
        refuse(why, name, errno);
        (void)close(fd);
        return STORE_FULL;
    }
    *fd_out = fd;
    return STORE_OK;
}

/* Creates the directories above `path`. */
static enum store_status make_directory(const char *path, char why[STORE_MESSAGE])
{
    char part[1024];
    (void)snprintf(part, sizeof part, "%s", path);
    for (char *p = strchr(part + 1, '/'); p != NULL; p = strchr(p + 1, '/')) {
        *p = '\0';
        if (mkdir(part, 0700) != 0 && errno != EEXIST) {
            refuse(why, part, errno);
            return STORE_REFUSED;
        }
        *p = '/';
    }
    return STORE_OK;
}

/* -- sessions --------------------------------------------------------------------------- */

static struct sqlite_store *store_of(struct store *st)
{
    return (struct sqlite_store *)st; /* base is the first member */
}

static struct store_session *store_writer(struct store *st)
{
    return &store_of(st)->writer.base;
}

static int reader_progress(void *arg)
{
    const struct sqlite_session *s = arg;
    return s->deadline_us != 0 && clock_mono_us() > s->deadline_us;
}

static struct sqlite_session *reader_open(struct sqlite_store *st)
{
    char why[STORE_MESSAGE];
    struct sqlite_session *s = calloc(1, sizeof *s);
    if (s != NULL && sqlite_connect(st->path, false, &s->db, why) != STORE_OK) {
        free(s);
        s = NULL;
    }
    if (s != NULL) {
        s->base.ops = st->base.ops;
        sqlite3_progress_handler(s->db, PROGRESS_OPS, reader_progress, s);
    }
    return s;
}

static struct store_session *store_reader_take(struct store *base)
{
    struct sqlite_store *st = store_of(base);
    struct sqlite_session *s = NULL;
    bool open_one = false;
    (void)pthread_mutex_lock(&st->mutex);
    while (st->free_reader == NULL && st->n_reader == SQLITE_READERS) {
        (void)pthread_cond_wait(&st->returned, &st->mutex);
    }
    if (st->free_reader != NULL) {
        s = st->free_reader;
        st->free_reader = s->next_free;
    } else {
        st->n_reader++;
        open_one = true;
    }
    (void)pthread_mutex_unlock(&st->mutex);

    if (open_one) {
        s = reader_open(st);
        if (s == NULL) {
            (void)pthread_mutex_lock(&st->mutex);
            st->n_reader--;
            (void)pthread_cond_signal(&st->returned);
            (void)pthread_mutex_unlock(&st->mutex);
            return NULL;
        }
    }
    s->deadline_us = clock_mono_us() + SQL_TIME_LIMIT_S * INT64_C(1000000);
    return &s->base;
}

static void store_reader_give(struct store *base, struct store_session *session)
{
    struct sqlite_store *st = store_of(base);
    struct sqlite_session *s = sqlite_session_of(session);
    (void)pthread_mutex_lock(&st->mutex);
    s->next_free = st->free_reader;
    st->free_reader = s;
    (void)pthread_cond_signal(&st->returned);
    (void)pthread_mutex_unlock(&st->mutex);
}

static const char *session_message(const struct store_session *s)
{
    return sqlite3_errmsg(((const struct sqlite_session *)s)->db);
}

static int64_t store_space(struct store *st)
{
    struct statvfs fs;
    if (statvfs(store_of(st)->path, &fs) != 0) {
        return -1;
    }
    return (int64_t)fs.f_bavail * (int64_t)fs.f_frsize;
}

static int log_grew(void *arg, sqlite3 *db, const char *name, int pages)
{
    (void)db;
    (void)name;
    struct sqlite_session *s = arg;
    s->log_pages = pages;
    return SQLITE_OK;
}

static void store_sqlite_close(struct store *base)
{
    struct sqlite_store *st = store_of(base);
    while (st->free_reader != NULL) {
        struct sqlite_session *s = st->free_reader;
        st->free_reader = s->next_free;
        session_close(s);
        free(s);
    }
    session_close(&st->writer);
    if (st->lock_fd >= 0) {
        (void)close(st->lock_fd);
    }
    (void)pthread_cond_destroy(&st->returned);
    (void)pthread_mutex_destroy(&st->mutex);
    free(st);
}

static const struct store_ops sqlite_ops = {
    .writer = store_writer,
    .reader_take = store_reader_take,
    .reader_give = store_reader_give,
    .message = session_message,
    .space = store_space,
    .close = store_sqlite_close,
    .begin = sqlite_begin,
    .mark = sqlite_mark,
    .release = sqlite_release,
    .undo = sqlite_undo,
    .commit = sqlite_commit,
    .rollback = sqlite_rollback,
    .in_transaction = sqlite_in_transaction,
    .checkpoint = sqlite_checkpoint,
    .submit = sqlite_submit,
    .claim = sqlite_claim,
    .claim_unit = sqlite_claim_unit,
    .heartbeat = sqlite_heartbeat,
    .publish = sqlite_publish,
    .fail = sqlite_fail,
    .hand_back = sqlite_hand_back,
    .stopped = sqlite_stopped,
    .publish_cells = sqlite_publish_cells,
    .cancel = sqlite_cancel,
    .recover = sqlite_recover,
    .get = sqlite_get,
    .list = sqlite_list,
    .get_case = sqlite_get_case,
    .get_document = sqlite_get_document,
    .get_series = sqlite_get_series,
    .get_samples = sqlite_get_samples,
    .get_study = sqlite_get_study,
    .get_cells = sqlite_get_cells,
    .find_known = sqlite_find_known,
    .read_known = sqlite_read_known,
    .depth = sqlite_depth,
    .newest_id = sqlite_newest_id,
    .shelf_put = sqlite_shelf_put,
    .shelf_drop = sqlite_shelf_drop,
    .shelf_list = sqlite_shelf_list,
    .shelf_get = sqlite_shelf_get,
};

enum store_status sqlite_store_open(const char *path, struct store **out, char why[STORE_MESSAGE])
{
    struct sqlite_store *st = calloc(1, sizeof *st);
    if (st == NULL) {
        (void)snprintf(why, STORE_MESSAGE, "out of memory");
        return STORE_ERROR;
    }
    st->base.ops = &sqlite_ops;
    st->writer.base.ops = &sqlite_ops;
    st->lock_fd = -1;
    (void)pthread_mutex_init(&st->mutex, NULL);
    (void)pthread_cond_init(&st->returned, NULL);
    (void)snprintf(st->path, sizeof st->path, "%s", path);

    enum store_status status = make_directory(path, why);
    if (status == STORE_OK) {
        status = lock_take(path, &st->lock_fd, why);
    }
    if (status == STORE_OK) {
        status = sqlite_connect(path, true, &st->writer.db, why);
    }
    if (status == STORE_OK) {
        const struct migrate_db db = {.ctx = st->writer.db,
                                      .version = schema_version,
                                      .checksum = schema_checksum,
                                      .apply = schema_apply};
        status = migrate_run(migrations_files, migrations_file_count, "sqlite", &db, why);
    }
    if (status != STORE_OK) {
        store_sqlite_close(&st->base);
        return status;
    }
    (void)sqlite3_wal_hook(st->writer.db, log_grew, &st->writer);
    *out = &st->base;
    return STORE_OK;
}
