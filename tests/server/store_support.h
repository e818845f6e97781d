/* tests/server/store_support.h
 * Steps of the store suites. Include after <cmocka.h>. */
#ifndef AEROM_TESTS_SERVER_STORE_SUPPORT_H
#define AEROM_TESTS_SERVER_STORE_SUPPORT_H

#include "server/job.h"
#include "tests/server/support.h"

static const char *const id_of[] = {
    "00000000-0000-7000-8000-000000000000", "00000000-0000-7000-8000-000000000001",
    "00000000-0000-7000-8000-000000000002", "00000000-0000-7000-8000-000000000003",
    "00000000-0000-7000-8000-000000000004"};

static inline struct store_session *writer(const struct fixture *f)
{
    return f->store->ops->writer(f->store);
}

static inline void begin(const struct fixture *f)
{
    assert_int_equal(writer(f)->ops->begin(writer(f)), STORE_OK);
}

static inline void commit(const struct fixture *f)
{
    assert_int_equal(writer(f)->ops->commit(writer(f)), STORE_OK);
}

static inline struct service_submitted submit(const struct fixture *f, int i, const char *hash)
{
    const struct service_submit item = sample(hash);
    struct service_submitted out = {.reused = false};
    begin(f);
    assert_int_equal(writer(f)->ops->submit(writer(f), &item, id_of[i], 100 + i, &out), STORE_OK);
    commit(f);
    return out;
}

static inline enum store_status claim(const struct fixture *f, const char *owner,
                                      struct store_ticket *t)
{
    struct store_claim c = {.attempt = 0};
    begin(f);
    const enum store_status st = writer(f)->ops->claim(writer(f), owner, 1000, 2000, &c);
    commit(f);
    if (st == STORE_OK) {
        assert_int_equal(c.kind, CASE_SIMULATION);
        assert_string_equal(c.case_json, "{\"schema_version\":1}");
        *t = c.ticket;
    }
    free(c.case_json);
    return st;
}

static inline struct job_record get(const struct fixture *f, const char *id)
{
    struct job_record job = {.attempt = -1};
    struct store_session *r = f->store->ops->reader_take(f->store);
    assert_non_null(r);
    assert_int_equal(r->ops->get(r, id, &job), STORE_OK);
    f->store->ops->reader_give(f->store, r);
    assert_true(job_invariant(&job, !job_is_final(job.state)));
    return job;
}

static inline int64_t depth(const struct fixture *f)
{
    int64_t n = -1;
    assert_int_equal(writer(f)->ops->depth(writer(f), &n), STORE_OK);
    return n;
}

static inline enum store_status publish(const struct fixture *f, const struct store_ticket *t,
                                        const struct store_series *series)
{
    const struct store_document document[] = {{"summary", "{\"a\":1}"}, {"modes", "[]"}};
    const struct store_result result = {
        .verdict = "stable", .cpu_s = 0.5, .n_document = 2, .document = document, .series = series};
    begin(f);
    const enum store_status st = writer(f)->ops->publish(writer(f), t, &result, 3000);
    if (st == STORE_OK) {
        commit(f);
    } else {
        writer(f)->ops->rollback(writer(f));
    }
    return st;
}

#endif
