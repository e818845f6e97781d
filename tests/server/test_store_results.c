/* The suites every storage back end must pass: results, lists, the file. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/server/store_support.h"

#include <math.h>

/* -- results ---------------------------------------------------------------------------- */

enum { SAMPLES = 2 * SERIES_CHUNK + 100 };

struct recorded {
    double value[2][SAMPLES];
    struct series_chunk chunk[2][3];
    struct store_column column[2];
    struct store_series series;
    char *buffer[6];
};

static struct recorded *make_series(void)
{
    struct recorded *r = calloc(1, sizeof *r);
    assert_non_null(r);
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < SAMPLES; i++) {
            r->value[j][i] = sin(0.001 * i + j);
        }
        for (int k = 0; k < 3; k++) {
            char *buffer = malloc(series_bound());
            assert_non_null(buffer);
            r->buffer[3 * j + k] = buffer;
            series_encode(&r->value[j][k * SERIES_CHUNK], k < 2 ? SERIES_CHUNK : 100, buffer,
                          &r->chunk[j][k]);
        }
        (void)snprintf(r->column[j].name, sizeof r->column[j].name, j == 0 ? "cl" : "cm");
        r->column[j].chunk = r->chunk[j];
    }
    r->series = (struct store_series){
        .t0 = 0.0, .step = 2e-4, .n = SAMPLES, .n_column = 2, .column = r->column};
    return r;
}

static void free_series(struct recorded *r)
{
    for (int i = 0; i < 6; i++) {
        free(r->buffer[i]);
    }
    free(r);
}

static void test_series_come_back_bit_for_bit(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    struct recorded *r = make_series();
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    assert_int_equal(publish(f, &t, &r->series), STORE_OK);

    struct series_data data;
    assert_int_equal(s->ops->get_series(s, t.id, &data), STORE_OK);
    assert_int_equal(data.n, SAMPLES);
    assert_int_equal(data.n_column, 2);
    assert_string_equal(data.column[1].name, "cm");
    assert_true(data.step == 2e-4);
    series_data_done(&data);
    static const struct {
        int from, n;
    } window[] = {{0, SAMPLES}, {0, 1}, {SERIES_CHUNK - 1, 2}, {SAMPLES - 1, 1}, {17, 5000}};
    double *back = malloc(SAMPLES * sizeof *back);
    assert_non_null(back);
    for (size_t i = 0; i < sizeof window / sizeof window[0]; i++) {
        const int from = window[i].from, n = window[i].n;
        assert_int_equal(s->ops->get_samples(s, t.id, 1, from, n, back), STORE_OK);
        assert_memory_equal(back, &r->value[1][from], (size_t)n * sizeof *back);
    }
    assert_int_equal(s->ops->get_samples(s, t.id, 2, 0, 1, back), STORE_CORRUPT); /* no column */
    free(back);
    free_series(r);
}

static void test_damaged_chunk_is_refused(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    struct recorded *r = make_series();
    (void)submit(f, 0, "h");
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    r->chunk[0][1].checksum ^= 1; /* as if the disk had changed a bit since */
    assert_int_equal(publish(f, &t, &r->series), STORE_OK);
    double value[10];
    assert_int_equal(s->ops->get_samples(s, t.id, 0, 0, 10, value), STORE_OK);
    assert_int_equal(s->ops->get_samples(s, t.id, 0, SERIES_CHUNK, 10, value), STORE_CORRUPT);
    free_series(r);
}

static void test_documents(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    struct store_ticket t;
    char *json = NULL;
    struct series_data data;
    assert_int_equal(s->ops->get_document(s, id_of[0], "summary", &json), STORE_NONE);
    (void)submit(f, 0, "h");
    assert_int_equal(s->ops->get_document(s, id_of[0], "summary", &json), STORE_NOT_READY);
    assert_int_equal(s->ops->get_series(s, id_of[0], &data), STORE_NOT_READY);
    assert_int_equal(claim(f, "p", &t), STORE_OK);
    assert_int_equal(publish(f, &t, NULL), STORE_OK);
    assert_int_equal(s->ops->get_document(s, t.id, "summary", &json), STORE_OK);
    assert_string_equal(json, "{\"a\":1}");
    free(json);
    assert_int_equal(s->ops->get_document(s, t.id, "damping", &json), STORE_NONE);
    assert_int_equal(s->ops->get_series(s, t.id, &data), STORE_NONE);
    assert_int_equal(s->ops->get_case(s, t.id, &json), STORE_OK);
    assert_string_equal(json, "{\"schema_version\":1}");
    free(json);
}

/* -- lists ------------------------------------------------------------------------------ */

static int list(const struct fixture *f, const struct service_filter *filter, const char *expect)
{
    struct store_session *s = writer(f);
    struct job_record *rows = NULL;
    int n = 0;
    bool more = false;
    assert_int_equal(s->ops->list(s, filter, &rows, &n, &more), STORE_OK);
    char got[16] = "";
    for (int i = 0; i < n; i++) {
        got[i] = rows[i].id[35];
    }
    free(rows);
    assert_string_equal(got, expect);
    return more;
}

static void test_lists(void **state)
{
    const struct fixture *f = *state;
    struct store_session *s = writer(f);
    static const char *const hash[] = {"a", "b", "c", "d", "e"};
    begin(f);
    for (int i = 0; i < 5; i++) {
        struct service_submit item = sample(hash[i]);
        item.kind = i == 3 ? CASE_MODES : CASE_SIMULATION;
        item.name = i % 2 == 0 ? "even" : "odd";
        struct service_submitted out;
        assert_int_equal(s->ops->submit(s, &item, id_of[i], i, &out), STORE_OK);
    }
    struct job_record job;
    assert_int_equal(s->ops->cancel(s, id_of[2], 9, &job), STORE_OK);
    commit(f);
    const struct service_filter all = {.limit = 10, .kind = -1, .state = -1};
    assert_false(list(f, &all, "43210"));
    struct service_filter page = {.limit = 2, .kind = -1, .state = -1};
    assert_true(list(f, &page, "43"));
    page.after = id_of[3];
    assert_true(list(f, &page, "21"));
    page.after = id_of[1];
    assert_false(list(f, &page, "0"));
    const struct service_filter even = {.limit = 10, .kind = -1, .state = -1, .name = "even"};
    assert_false(list(f, &even, "420"));
    const struct service_filter queued = {
        .limit = 10, .kind = CASE_SIMULATION, .state = JOB_QUEUED, .name = "even"};
    assert_false(list(f, &queued, "40"));
    const struct service_filter modes = {.limit = 10, .kind = CASE_MODES, .state = -1};
    assert_false(list(f, &modes, "3"));
    const struct service_filter cancelled = {.limit = 10, .kind = -1, .state = JOB_CANCELLED};
    assert_false(list(f, &cancelled, "2"));
    struct job_record *rows;
    int n;
    bool more;
    page.after = "unknown";
    assert_int_equal(s->ops->list(s, &page, &rows, &n, &more), STORE_NONE);
}

/* -- the file --------------------------------------------------------------------------- */

static void test_second_opening_is_refused(void **state)
{
    const struct fixture *f = *state;
    struct store *other = NULL;
    char why[STORE_MESSAGE] = "";
    assert_int_equal(store_open(f->url, &other, why), STORE_LOCKED);
    assert_null(other);
    char pid[32];
    (void)snprintf(pid, sizeof pid, "process %ld", (long)getpid());
    assert_non_null(strstr(why, pid));
}

static void test_reopening_finds_everything(void **state)
{
    struct fixture *f = *state;
    (void)submit(f, 0, "h");
    store_close(f->store);
    fixture_open(f);
    assert_int_equal(get(f, id_of[0]).state, JOB_QUEUED);
    char id[JOB_ID_SIZE];
    assert_int_equal(writer(f)->ops->newest_id(writer(f), id), STORE_OK);
    assert_string_equal(id, id_of[0]);
}

static void test_readers_cannot_write(void **state)
{
    const struct fixture *f = *state;
    const struct service_submit item = sample("h");
    struct service_submitted out;
    struct store_session *r = f->store->ops->reader_take(f->store);
    assert_non_null(r);
    assert_int_not_equal(r->ops->submit(r, &item, id_of[0], 1, &out), STORE_OK);
    f->store->ops->reader_give(f->store, r);
    assert_int_equal(depth(f), 0);
}

static void test_bad_locations(void **state)
{
    (void)state;
    static const char *const bad[] = {"", "sqlite:", "postgres://x", "sqlite:/dev/null/a.db"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct store *st = NULL;
        char why[STORE_MESSAGE] = "";
        assert_int_equal(store_open(bad[i], &st, why), STORE_REFUSED);
        assert_true(strlen(why) > 0);
    }
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, fixture_setup, fixture_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_series_come_back_bit_for_bit),
        TEST(test_damaged_chunk_is_refused),
        TEST(test_documents),
        TEST(test_lists),
        TEST(test_second_opening_is_refused),
        TEST(test_reopening_finds_everything),
        TEST(test_readers_cannot_write),
        cmocka_unit_test(test_bad_locations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
