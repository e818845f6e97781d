/* Entries of the library in every back end: versions, equal contents, deletion, what a training
 * leaves and what it needs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/server/store_support.h"

static struct shelf_item item_of(enum shelf_kind kind, const char *hash, const char *data)
{
    return (struct shelf_item){.kind = kind,
                               .name = "own",
                               .hash = hash,
                               .head = "\"name\":\"own\"",
                               .job = "",
                               .data = data,
                               .size = strlen(data)};
}

static int put(const struct fixture *f, enum shelf_kind kind, const char *hash, bool *reused)
{
    const struct shelf_item item = item_of(kind, hash, hash);
    int version = 0;
    begin(f);
    assert_int_equal(writer(f)->ops->shelf_put(writer(f), &item, 77, &version, reused), STORE_OK);
    commit(f);
    return version;
}

static enum store_status drop(const struct fixture *f, enum shelf_kind kind, int version)
{
    begin(f);
    const enum store_status st = writer(f)->ops->shelf_drop(writer(f), kind, "own", version);
    commit(f);
    return st;
}

static enum store_status get_entry(const struct fixture *f, enum shelf_kind kind, int version,
                                   struct shelf_entry *out)
{
    struct store_session *r = f->store->ops->reader_take(f->store);
    const enum store_status st = r->ops->shelf_get(r, kind, "own", version, out);
    f->store->ops->reader_give(f->store, r);
    return st;
}

static int count(const struct fixture *f, enum shelf_kind kind)
{
    struct store_session *r = f->store->ops->reader_take(f->store);
    struct shelf_entry *list = NULL;
    int n = -1;
    assert_int_equal(r->ops->shelf_list(r, kind, &list, &n), STORE_OK);
    f->store->ops->reader_give(f->store, r);
    for (int i = 0; i < n; i++) {
        assert_string_equal(list[i].head, "\"name\":\"own\"");
        assert_null(list[i].data);
    }
    shelf_entries_done(list, n);
    return n;
}

static void test_versions(void **state)
{
    const struct fixture *f = *state;
    bool reused = true;
    assert_int_equal(put(f, SHELF_POLAR, "aa", &reused), 1);
    assert_false(reused);
    assert_int_equal(put(f, SHELF_POLAR, "bb", &reused), 2);
    assert_int_equal(put(f, SHELF_POLAR, "aa", &reused), 1);
    assert_true(reused);
    assert_int_equal(put(f, SHELF_NETWORK, "aa", &reused), 1); /* kinds do not mix */
    assert_int_equal(count(f, SHELF_POLAR), 2);
    struct shelf_entry e;
    assert_int_equal(get_entry(f, SHELF_POLAR, 0, &e), STORE_OK);
    assert_int_equal(e.version, 2);
    assert_int_equal((int)e.created_us, 77);
    assert_string_equal(e.hash, "bb");
    assert_string_equal(e.data, "bb");
    shelf_entry_done(&e);
    assert_int_equal(drop(f, SHELF_POLAR, 2), STORE_OK);
    assert_int_equal(drop(f, SHELF_POLAR, 2), STORE_NONE);
    assert_int_equal(get_entry(f, SHELF_POLAR, 2, &e), STORE_NONE);
    assert_int_equal(put(f, SHELF_POLAR, "cc", &reused), 3); /* 2 never comes back */
    assert_int_equal(drop(f, SHELF_POLAR, 0), STORE_OK);
    assert_int_equal(count(f, SHELF_POLAR), 0);
    assert_int_equal(count(f, SHELF_NETWORK), 1);
}

/* The network comes with the result or not at all, and names its job. */
static void test_training(void **state)
{
    const struct fixture *f = *state;
    const struct service_submit training = {.kind = CASE_TRAINING,
                                            .name = "",
                                            .case_json = "{\"training\":{\"dataset\":\"own@1\"}}",
                                            .content_hash = "hash"};
    const struct shelf_item item = item_of(SHELF_NETWORK, "nn", "{}");
    const struct store_result result = {.verdict = "", .entry = &item};
    struct service_submitted submitted;
    struct store_claim c = {.attempt = 0};
    struct shelf_entry e;
    bool reused = false;
    assert_int_equal(put(f, SHELF_DATASET, "dd", &reused), 1);
    assert_int_equal(put(f, SHELF_DATASET, "ee", &reused), 2);
    begin(f);
    assert_int_equal(writer(f)->ops->submit(writer(f), &training, id_of[0], 1, &submitted),
                     STORE_OK);
    commit(f);
    assert_int_equal(drop(f, SHELF_DATASET, 1), STORE_NOT_READY);
    assert_int_equal(drop(f, SHELF_DATASET, 0), STORE_NOT_READY);
    assert_int_equal(drop(f, SHELF_DATASET, 2), STORE_OK);
    begin(f);
    assert_int_equal(writer(f)->ops->claim(writer(f), "me", 10, 20, &c), STORE_OK);
    commit(f);
    free(c.case_json);
    struct store_ticket stale = c.ticket;
    stale.fence--;
    begin(f);
    assert_int_equal(writer(f)->ops->publish(writer(f), &stale, &result, 30), STORE_CONFLICT);
    writer(f)->ops->rollback(writer(f));
    assert_int_equal(get_entry(f, SHELF_NETWORK, 0, &e), STORE_NONE);
    begin(f);
    assert_int_equal(writer(f)->ops->publish(writer(f), &c.ticket, &result, 30), STORE_OK);
    commit(f);
    assert_int_equal(get_entry(f, SHELF_NETWORK, 0, &e), STORE_OK);
    assert_string_equal(e.job, id_of[0]);
    shelf_entry_done(&e);
    assert_int_equal(drop(f, SHELF_DATASET, 1), STORE_OK);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, fixture_setup, fixture_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(test_versions), TEST(test_training)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
