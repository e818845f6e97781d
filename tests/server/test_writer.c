#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/writer.h"
#include "tests/server/support.h"

#include <pthread.h>
#include <stdatomic.h>

static const struct log quiet = {.fd = -1, .level = LOG_LEVEL_ERROR};

/* A submit that can be told to fail; the gate keeps the writer busy so that a group builds up. */
struct probe {
    struct write_request base;
    int number;
    enum store_status result; /* of apply */
    bool wreck;               /* ends the whole transaction, as a full disk may */
    int applied;
    atomic_int *order; /* counts answers */
    int answered_as;   /* position among the answers, from 1 */
    enum store_status status;
    pthread_mutex_t *gate;
};

static enum store_status probe_apply(struct write_request *r, struct store_session *s)
{
    struct probe *p = (struct probe *)r;
    p->applied++;
    if (p->gate != NULL) {
        (void)pthread_mutex_lock(p->gate);
        (void)pthread_mutex_unlock(p->gate);
    }
    char id[JOB_ID_SIZE], hash[16];
    (void)snprintf(id, sizeof id, "00000000-0000-7000-8000-%012d", p->number);
    (void)snprintf(hash, sizeof hash, "%d", p->number);
    const struct service_submit item = sample(hash);
    struct service_submitted out;
    const enum store_status st = s->ops->submit(s, &item, id, 1, &out);
    if (p->wreck) {
        s->ops->rollback(s);
        return STORE_FULL;
    }
    return st == STORE_OK ? p->result : st;
}

static void probe_done(struct write_request *r, enum store_status st)
{
    struct probe *p = (struct probe *)r;
    p->status = st;
    p->answered_as = atomic_fetch_add(p->order, 1) + 1;
}

static bool stored(const struct fixture *f, int number)
{
    char id[JOB_ID_SIZE];
    (void)snprintf(id, sizeof id, "00000000-0000-7000-8000-%012d", number);
    struct job_record job;
    struct store_session *r = f->store->ops->reader_take(f->store);
    assert_non_null(r);
    const enum store_status st = r->ops->get(r, id, &job);
    f->store->ops->reader_give(f->store, r);
    return st == STORE_OK;
}

enum { N = 50 };

/* Posts N probes behind a closed gate, so that they form one group, and waits for all. */
static void run_group(const struct fixture *f, struct probe *p, struct writer_stats *stats)
{
    struct writer *w = NULL;
    atomic_int order = 0;
    pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;
    assert_int_equal(writer_create(f->store, &quiet, &w), STORE_OK);
    (void)pthread_mutex_lock(&gate);
    p[0].gate = &gate;
    for (int i = 0; i < N; i++) {
        p[i].base = (struct write_request){.apply = probe_apply, .done = probe_done};
        p[i].number = i;
        p[i].order = &order;
        assert_true(writer_post(w, &p[i].base));
        if (i == 0) { /* wait until the writer hangs in the first one */
            struct writer_stats now = {0};
            while (now.requests == 0) {
                writer_stats(w, &now);
            }
        }
    }
    (void)pthread_mutex_unlock(&gate);
    writer_stop(w);
    assert_int_equal(atomic_load(&order), N);
    struct probe late = {.base = {.apply = probe_apply}};
    assert_false(writer_post(w, &late.base));
    writer_stats(w, stats);
    writer_destroy(w);
}

static void test_groups_and_order(void **state)
{
    const struct fixture *f = *state;
    struct probe p[N] = {{.number = 0}};
    struct writer_stats stats;
    run_group(f, p, &stats);
    assert_int_equal(stats.requests, N);
    assert_int_equal(stats.commits, 2); /* the first alone, then all the others at once */
    for (int i = 0; i < N; i++) {
        assert_int_equal(p[i].status, STORE_OK);
        assert_int_equal(p[i].answered_as, i + 1);
        assert_true(stored(f, i));
    }
}

static void test_a_refused_request_harms_nobody(void **state)
{
    const struct fixture *f = *state;
    struct probe p[N] = {{.number = 0}};
    p[20].result = STORE_CONFLICT; /* after it has written */
    struct writer_stats stats;
    run_group(f, p, &stats);
    assert_int_equal(stats.commits, 2);
    for (int i = 0; i < N; i++) {
        assert_int_equal(p[i].status, i == 20 ? STORE_CONFLICT : STORE_OK);
        assert_int_equal(stored(f, i), i != 20);
        assert_int_equal(p[i].applied, 1);
    }
}

static void test_a_wrecked_group_is_taken_apart(void **state)
{
    const struct fixture *f = *state;
    struct probe p[N] = {{.number = 0}};
    p[20].wreck = true;
    struct writer_stats stats;
    run_group(f, p, &stats);
    assert_int_equal(stats.retries, 1);
    for (int i = 0; i < N; i++) {
        assert_int_equal(p[i].status, i == 20 ? STORE_FULL : STORE_OK);
        assert_int_equal(stored(f, i), i != 20);
        assert_int_equal(p[i].answered_as, i + 1);
    }
}

/* Several threads, each waiting for its own requests. */
struct caller {
    struct writer *writer;
    int first;
};

static void *caller_main(void *arg)
{
    const struct caller *c = arg;
    atomic_int order = 0;
    for (int i = 0; i < 100; i++) {
        struct probe p = {.base = {.apply = probe_apply, .done = probe_done},
                          .number = c->first + i,
                          .order = &order};
        assert_int_equal(writer_call(c->writer, &p.base), STORE_OK);
        assert_int_equal(p.status, STORE_OK);
    }
    return NULL;
}

static void test_many_callers(void **state)
{
    const struct fixture *f = *state;
    struct writer *w = NULL;
    assert_int_equal(writer_create(f->store, &quiet, &w), STORE_OK);
    pthread_t thread[8];
    struct caller c[8];
    for (int i = 0; i < 8; i++) {
        c[i] = (struct caller){.writer = w, .first = 1000 * i};
        assert_int_equal(pthread_create(&thread[i], NULL, caller_main, &c[i]), 0);
    }
    for (int i = 0; i < 8; i++) {
        (void)pthread_join(thread[i], NULL);
    }
    writer_destroy(w);
    int64_t depth = 0;
    struct store_session *s = f->store->ops->writer(f->store);
    assert_int_equal(s->ops->depth(s, &depth), STORE_OK);
    assert_int_equal(depth, 800);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, fixture_setup, fixture_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_groups_and_order),
        TEST(test_a_refused_request_harms_nobody),
        TEST(test_a_wrecked_group_is_taken_apart),
        TEST(test_many_callers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
