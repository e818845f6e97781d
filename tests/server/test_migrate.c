#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/migrate.h"
#include "tests/server/support.h"

#include <sqlite3.h>

/* -- the logic, on a database in memory ------------------------------------------------- */

struct fake {
    int version;
    unsigned char checksum[8][MIGRATION_CHECKSUM];
    int fail_at; /* applying this number fails */
};

static enum store_status fake_version(void *ctx, int *out)
{
    *out = ((struct fake *)ctx)->version;
    return STORE_OK;
}

static enum store_status fake_checksum(void *ctx, int number, unsigned char *out)
{
    const struct fake *f = ctx;
    memcpy(out, f->checksum[number], MIGRATION_CHECKSUM);
    return number <= f->version ? STORE_OK : STORE_NONE;
}

static enum store_status fake_apply(void *ctx, const struct migration *m)
{
    struct fake *f = ctx;
    if (m->number == f->fail_at) {
        return STORE_ERROR;
    }
    assert_int_equal(m->number, f->version + 1);
    f->version = m->number;
    memcpy(f->checksum[m->number], m->checksum, MIGRATION_CHECKSUM);
    return STORE_OK;
}

#define FILE_OF(path, text)                                                                        \
    {                                                                                              \
        path, text, &(text)[sizeof(text) - 1]                                                      \
    }
static const char one[] = "CREATE 1", two[] = "CREATE 2", three[] = "CREATE 3", other[] = "OTHER";

static enum store_status run(struct fake *f, const struct embedded_file *file, int n, char *why)
{
    const struct migrate_db db = {
        .ctx = f, .version = fake_version, .checksum = fake_checksum, .apply = fake_apply};
    why[0] = '\0';
    return migrate_run(file, n, "sqlite", &db, why);
}

static void test_applies_in_order_once(void **state)
{
    (void)state;
    const struct embedded_file file[] = {
        FILE_OF("sqlite/0003_c.sql", three), FILE_OF("postgres/0001_a.sql", other),
        FILE_OF("sqlite/0001_a.sql", one), FILE_OF("sqlite/0002_b.sql", two)};
    struct fake f = {.version = 0};
    char why[STORE_MESSAGE];
    f.fail_at = 3;
    assert_int_equal(run(&f, file, 4, why), STORE_ERROR);
    assert_int_equal(f.version, 2);
    f.fail_at = 0;
    assert_int_equal(run(&f, file, 4, why), STORE_OK);
    assert_int_equal(f.version, 3);
    assert_int_equal(run(&f, file, 4, why), STORE_OK);
}

static void test_refusals(void **state)
{
    (void)state;
    const struct embedded_file good[] = {FILE_OF("sqlite/0001_a.sql", one),
                                         FILE_OF("sqlite/0002_b.sql", two)};
    const struct embedded_file changed[] = {FILE_OF("sqlite/0001_a.sql", other),
                                            FILE_OF("sqlite/0002_b.sql", two)};
    const struct embedded_file gap[] = {FILE_OF("sqlite/0001_a.sql", one),
                                        FILE_OF("sqlite/0003_c.sql", three)};
    struct fake f = {.version = 0};
    char why[STORE_MESSAGE];
    assert_int_equal(run(&f, gap, 2, why), STORE_REFUSED);
    assert_non_null(strstr(why, "0002"));
    f = (struct fake){.version = 0};
    assert_int_equal(run(&f, good, 2, why), STORE_OK);
    assert_int_equal(run(&f, changed, 2, why), STORE_REFUSED);
    assert_non_null(strstr(why, "0001_a.sql"));
    assert_int_equal(run(&f, good, 1, why), STORE_REFUSED); /* the program is older */
    assert_non_null(strstr(why, "version 2"));
}

/* -- the SQLite side -------------------------------------------------------------------- */

/* Closes the store, changes the database behind its back, opens it again. */
static enum store_status reopen_after(struct fixture *f, const char *sql, char *why)
{
    store_close(f->store);
    f->store = NULL;
    sqlite3 *db = NULL;
    assert_int_equal(sqlite3_open(f->path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_close(db), SQLITE_OK);
    why[0] = '\0';
    return store_open(f->url, &f->store, why);
}

static void test_tampered_checksum(void **state)
{
    struct fixture *f = *state;
    char why[STORE_MESSAGE];
    assert_int_equal(reopen_after(f, "UPDATE schema_migration SET checksum = zeroblob(32)", why),
                     STORE_REFUSED);
    assert_non_null(strstr(why, "0001_init.sql was applied with other contents"));
    assert_null(f->store);
}

static void test_missing_record(void **state)
{
    struct fixture *f = *state;
    char why[STORE_MESSAGE];
    assert_int_equal(reopen_after(f, "DELETE FROM schema_migration", why), STORE_REFUSED);
}

static void test_newer_schema(void **state)
{
    struct fixture *f = *state;
    char why[STORE_MESSAGE];
    assert_int_equal(reopen_after(f, "PRAGMA user_version = 99", why), STORE_REFUSED);
    assert_non_null(strstr(why, "schema version 99"));
    char ours[64];
    (void)snprintf(ours, sizeof ours, "PRAGMA user_version = %d", migrations_file_count);
    assert_int_equal(reopen_after(f, ours, why), STORE_OK);
}

static void test_foreign_database(void **state)
{
    struct fixture *f = *state;
    char why[STORE_MESSAGE];
    assert_int_equal(reopen_after(f, "PRAGMA application_id = 7", why), STORE_REFUSED);
    assert_non_null(strstr(why, "another program"));
}

static void test_not_a_database(void **state)
{
    struct fixture *f = *state;
    store_close(f->store);
    f->store = NULL;
    FILE *file = fopen(f->path, "w");
    assert_non_null(file);
    for (int i = 0; i < 5000; i++) {
        (void)fputs("this is no database\n", file);
    }
    (void)fclose(file);
    char why[STORE_MESSAGE] = "";
    assert_int_equal(store_open(f->url, &f->store, why), STORE_CORRUPT);
    assert_non_null(strstr(why, "not a database"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_applies_in_order_once),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test_setup_teardown(test_tampered_checksum, fixture_setup, fixture_teardown),
        cmocka_unit_test_setup_teardown(test_missing_record, fixture_setup, fixture_teardown),
        cmocka_unit_test_setup_teardown(test_newer_schema, fixture_setup, fixture_teardown),
        cmocka_unit_test_setup_teardown(test_foreign_database, fixture_setup, fixture_teardown),
        cmocka_unit_test_setup_teardown(test_not_a_database, fixture_setup, fixture_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
