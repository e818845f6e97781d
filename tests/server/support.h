/* tests/server/support.h
 * A temporary directory with a store in it, and sample jobs. Include after <cmocka.h>. */
#ifndef AEROM_TESTS_SERVER_SUPPORT_H
#define AEROM_TESTS_SERVER_SUPPORT_H

#include "server/store.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct fixture {
    char dir[64];
    char url[160]; /* of the store in dir */
    char path[128];
    struct store *store;
};

static inline void fixture_open(struct fixture *f)
{
    char why[STORE_MESSAGE] = "";
    if (store_open(f->url, &f->store, why) != STORE_OK) {
        print_error("%s\n", why);
        fail();
    }
}

static inline int fixture_setup(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    assert_non_null(f);
    (void)snprintf(f->dir, sizeof f->dir, "/tmp/aerom-test-XXXXXX");
    assert_non_null(mkdtemp(f->dir));
    (void)snprintf(f->path, sizeof f->path, "%s/new/a.db", f->dir);
    (void)snprintf(f->url, sizeof f->url, "sqlite:%s", f->path);
    fixture_open(f);
    *state = f;
    return 0;
}

static inline int fixture_teardown(void **state)
{
    static const char *const name[] = {"new/a.db", "new/a.db-wal", "new/a.db-shm", "new/a.db.lock"};
    struct fixture *f = *state;
    store_close(f->store);
    char path[160];
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        (void)snprintf(path, sizeof path, "%s/%s", f->dir, name[i]);
        (void)unlink(path);
    }
    (void)snprintf(path, sizeof path, "%s/new", f->dir);
    (void)rmdir(path);
    (void)rmdir(f->dir);
    free(f);
    return 0;
}

static inline struct service_submit sample(const char *hash)
{
    return (struct service_submit){.kind = CASE_SIMULATION,
                                   .name = "sample",
                                   .case_json = "{\"schema_version\":1}",
                                   .content_hash = hash};
}

#endif
