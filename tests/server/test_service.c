/* The port over a real store and writer, without workers: what handlers rely on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "server/service_impl.h"
#include "tests/server/support.h"

#include <math.h>
#include <pthread.h>

static const struct log quiet = {.fd = -1, .level = LOG_LEVEL_ERROR};

struct parts {
    struct writer *writer;
    struct dispatch *dispatch;
    struct service_impl *impl;
    const struct service *service;
};

static struct parts start(const struct fixture *f, int64_t limit)
{
    struct parts p = {.dispatch = dispatch_create(1, 0)};
    assert_non_null(p.dispatch);
    assert_int_equal(writer_create(f->store, &quiet, &p.writer), STORE_OK);
    p.impl = service_impl_create(f->store, p.writer, p.dispatch, &quiet, limit);
    assert_non_null(p.impl);
    p.service = service_impl_port(p.impl);
    return p;
}

static void stop(struct parts *p)
{
    writer_stop(p->writer);
    service_impl_destroy(p->impl);
    writer_destroy(p->writer);
    dispatch_destroy(p->dispatch);
}

/* Where an answer is waited for. */
struct answer {
    pthread_mutex_t mutex;
    pthread_cond_t cond;
    bool come;
    enum service_status status;
    int n;
    struct service_submitted result[8];
    struct job_record job;
};

static void wake(struct answer *a)
{
    a->come = true;
    (void)pthread_cond_signal(&a->cond);
    (void)pthread_mutex_unlock(&a->mutex);
}

static void on_submit(void *arg, enum service_status status, int n,
                      const struct service_submitted *result)
{
    struct answer *a = arg;
    (void)pthread_mutex_lock(&a->mutex);
    a->status = status;
    a->n = n;
    for (int i = 0; i < n; i++) {
        a->result[i] = result[i];
    }
    wake(a);
}

static void on_cancel(void *arg, enum service_status status, const struct job_record *job)
{
    struct answer *a = arg;
    (void)pthread_mutex_lock(&a->mutex);
    a->status = status;
    if (job != NULL) {
        a->job = *job;
    }
    wake(a);
}

static void await(struct answer *a)
{
    (void)pthread_mutex_lock(&a->mutex);
    while (!a->come) {
        (void)pthread_cond_wait(&a->cond, &a->mutex);
    }
    (void)pthread_mutex_unlock(&a->mutex);
}

static struct answer new_answer(void)
{
    return (struct answer){.mutex = PTHREAD_MUTEX_INITIALIZER, .cond = PTHREAD_COND_INITIALIZER};
}

static struct answer submit(const struct parts *p, int n, const struct service_submit *item)
{
    struct answer a = new_answer();
    p->service->submit(p->service->ctx, n, item, on_submit, &a);
    await(&a);
    return a;
}

static struct answer cancel(const struct parts *p, const char *id)
{
    struct answer a = new_answer();
    p->service->cancel(p->service->ctx, id, on_cancel, &a);
    await(&a);
    return a;
}

static void test_batch_with_repeats(void **state)
{
    struct parts p = start(*state, 100);
    const struct service_submit item[] = {sample("a"), sample("b"), sample("a")};
    const struct answer a = submit(&p, 3, item);
    assert_int_equal(a.status, SERVICE_OK);
    assert_int_equal(a.n, 3);
    assert_false(a.result[0].reused);
    assert_false(a.result[1].reused);
    assert_true(a.result[2].reused);
    assert_string_equal(a.result[2].id, a.result[0].id);
    assert_true(strcmp(a.result[1].id, a.result[0].id) > 0);
    assert_int_equal(dispatch_depth(p.dispatch), 2);
    stop(&p);
}

static void test_limits(void **state)
{
    struct parts p = start(*state, 2);
    const struct service_submit item[] = {sample("a"), sample("b"), sample("c")};
    const char *why = NULL;
    assert_int_equal(submit(&p, 3, item).status, SERVICE_BUSY);
    assert_true(p.service->ready(p.service->ctx, &why));
    assert_int_equal(submit(&p, 2, item).status, SERVICE_OK);
    assert_false(p.service->ready(p.service->ctx, &why));
    assert_string_equal(why, "the queue is full");
    assert_int_equal(submit(&p, 1, &item[2]).status, SERVICE_BUSY);
    const struct answer a = cancel(&p, "nobody");
    assert_int_equal(a.status, SERVICE_NOT_FOUND);
    stop(&p);
}

static void test_cancel_frees_a_place(void **state)
{
    struct parts p = start(*state, 1);
    const struct service_submit item[] = {sample("a"), sample("b")};
    const struct answer a = submit(&p, 1, item);
    for (int i = 0; i < 2; i++) { /* idempotent, and counted once */
        const struct answer c = cancel(&p, a.result[0].id);
        assert_int_equal(c.status, SERVICE_OK);
        assert_int_equal(c.job.state, JOB_CANCELLED);
        assert_int_equal(dispatch_depth(p.dispatch), 0);
    }
    assert_int_equal(submit(&p, 1, &item[1]).status, SERVICE_OK);
    stop(&p);
}

static void test_disk_and_stop(void **state)
{
    struct parts p = start(*state, 10);
    const struct service_submit item = sample("a");
    const char *why = NULL;
    service_impl_disk_low(p.impl, true);
    assert_int_equal(submit(&p, 1, &item).status, SERVICE_DISK_FULL);
    assert_false(p.service->ready(p.service->ctx, &why));
    service_impl_disk_low(p.impl, false);
    assert_int_equal(submit(&p, 1, &item).status, SERVICE_OK);
    service_impl_stop(p.impl);
    const struct service_submit other = sample("b");
    assert_int_equal(submit(&p, 1, &other).status, SERVICE_BUSY);
    writer_stop(p.writer);
    assert_int_equal(cancel(&p, "x").status, SERVICE_BUSY); /* answered even without a writer */
    stop(&p);
}

/* A job with two recorded columns, put into the store directly. */
static void publish_series(const struct fixture *f, char id[JOB_ID_SIZE])
{
    struct store_session *s = f->store->ops->writer(f->store);
    const struct service_submit item = sample("series");
    struct service_submitted sub;
    struct store_claim claim = {.attempt = 0};
    double value[101];
    char *buffer = malloc(series_bound());
    assert_non_null(buffer);
    for (int i = 0; i < 101; i++) {
        value[i] = i;
    }
    struct series_chunk chunk;
    series_encode(value, 101, buffer, &chunk);
    const struct store_column column[] = {
        {"cl", &chunk}, {"modal_amplitude[1]", &chunk}, {"modal_amplitude[2]", &chunk}};
    const struct store_series series = {
        .t0 = 0.0, .step = 0.01, .n = 101, .n_column = 3, .column = column};
    const struct store_result result = {.verdict = "", .series = &series};
    assert_int_equal(s->ops->begin(s), STORE_OK);
    assert_int_equal(s->ops->submit(s, &item, "00000000-0000-7000-8000-000000000009", 1, &sub),
                     STORE_OK);
    assert_int_equal(s->ops->claim(s, "p", 2, 3, &claim), STORE_OK);
    assert_int_equal(s->ops->publish(s, &claim.ticket, &result, 4), STORE_OK);
    assert_int_equal(s->ops->commit(s), STORE_OK);
    (void)snprintf(id, JOB_ID_SIZE, "%s", sub.id);
    free(claim.case_json);
    free(buffer);
}

static void test_series_window(void **state)
{
    const struct fixture *f = *state;
    char id[JOB_ID_SIZE];
    publish_series(f, id);
    struct parts p = start(f, 10);
    const struct service *s = p.service;
    static const struct {
        double from, to;
        int first, n;
    } window[] = {
        {-INFINITY, INFINITY, 0, 101},
        {0.1, 0.3, 10, 21},
        {0.295, 0.305, 30, 1},
        {0.291, 0.299, 0, 0},
        {2.0, 3.0, 0, 0},
        {1.0, 1.0, 100, 1},
        {0.5, 0.4, 0, 0},
    };
    for (size_t i = 0; i < sizeof window / sizeof window[0]; i++) {
        static const char *const ask[] = {"modal_amplitude"};
        struct series_data d;
        int bad = 0;
        assert_int_equal(s->get_series(s->ctx, id, 1, ask, window[i].from, window[i].to, &d, &bad),
                         SERVICE_OK);
        assert_int_equal(bad, -1);
        assert_int_equal(d.n_column, 2);
        assert_int_equal(d.n, window[i].n);
        assert_string_equal(d.column[1].name, "modal_amplitude[2]");
        if (d.n > 0) {
            assert_true(d.column[1].value[0] == (double)window[i].first);
            assert_true(d.column[0].value[d.n - 1] == (double)(window[i].first + d.n - 1));
            assert_true(fabs(d.t0 - 0.01 * window[i].first) < 1e-12);
        }
        series_data_done(&d);
    }
    stop(&p);
}

static void test_series_channels(void **state)
{
    const struct fixture *f = *state;
    char id[JOB_ID_SIZE];
    publish_series(f, id);
    struct parts p = start(f, 10);
    const struct service *s = p.service;
    struct series_data d;
    int bad = 0, n = 0;
    static const char *const unknown[] = {"cl", "modal"};
    assert_int_equal(s->get_series(s->ctx, id, 2, unknown, 0, 1, &d, &bad), SERVICE_NOT_FOUND);
    assert_int_equal(bad, 1);
    assert_int_equal(s->get_series(s->ctx, "nobody", 0, NULL, 0, 1, &d, &bad), SERVICE_NOT_FOUND);
    assert_int_equal(bad, -1);
    static const char *const one[] = {"modal_amplitude[2]"};
    assert_int_equal(s->get_series(s->ctx, id, 1, one, 0, 1, &d, &bad), SERVICE_OK);
    assert_int_equal(d.n_column, 1);
    series_data_done(&d);
    char(*names)[64] = NULL;
    assert_int_equal(s->get_columns(s->ctx, id, &names, &n), SERVICE_OK);
    assert_int_equal(n, 3);
    assert_string_equal(names[0], "cl");
    free(names);
    stop(&p);
}

static void test_progress_of_a_running_job(void **state)
{
    const struct fixture *f = *state;
    struct parts p = start(f, 10);
    const struct service_submit item = sample("a");
    const struct answer a = submit(&p, 1, &item);
    writer_stop(p.writer); /* the session is ours now */
    struct store_session *s = f->store->ops->writer(f->store);
    struct store_claim claim = {.attempt = 0};
    assert_int_equal(s->ops->begin(s), STORE_OK);
    assert_int_equal(s->ops->claim(s, "p", INT64_MAX / 2, INT64_MAX, &claim), STORE_OK);
    assert_int_equal(s->ops->commit(s), STORE_OK);
    free(claim.case_json);
    dispatch_enter(p.dispatch, 0, &claim.ticket);
    atomic_store(dispatch_control(p.dispatch, 0).progress, 0.5);
    struct job_record job;
    assert_int_equal(p.service->get(p.service->ctx, a.result[0].id, &job), SERVICE_OK);
    assert_int_equal(job.state, JOB_RUNNING);
    assert_true(job.progress == 0.5);
    stop(&p);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, fixture_setup, fixture_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_batch_with_repeats),
        TEST(test_limits),
        TEST(test_cancel_frees_a_place),
        TEST(test_disk_and_stop),
        TEST(test_series_window),
        TEST(test_series_channels),
        TEST(test_progress_of_a_running_job),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
