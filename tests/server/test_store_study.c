/* The store suite for studies: units, their leases, and the cells they leave. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "api/pack.h"
#include "api/study.h"
#include "tests/server/store_support.h"

/* Two structures of five cells in units of three and two: places [0,3) [3,5) [5,8) [8,10). */
static void submit_study(const struct fixture *f, int i, const char *hash)
{
    const struct study_plan plan = {.n_cell = 10, .run = 5, .unit = 3};
    struct service_submit item = sample(hash);
    struct service_submitted out;
    item.kind = JOB_STUDY;
    item.plan = &plan;
    begin(f);
    assert_int_equal(writer(f)->ops->submit(writer(f), &item, id_of[i], 100 + i, &out), STORE_OK);
    commit(f);
}

static enum store_status claim_unit(const struct fixture *f, const char *owner, int64_t now,
                                    struct store_claim *out)
{
    struct store_claim c = {.attempt = 0};
    begin(f);
    const enum store_status st = writer(f)->ops->claim_unit(writer(f), owner, now, now + 1000, &c);
    commit(f);
    if (st == STORE_OK) {
        assert_string_equal(c.case_json, "{\"schema_version\":1}");
        free(c.case_json);
        c.case_json = NULL;
        *out = c;
    }
    return st;
}

static struct store_claim must_claim(const struct fixture *f, int64_t now, int unit, int next,
                                     int last)
{
    struct store_claim c = {.attempt = 0};
    assert_int_equal(claim_unit(f, "me", now, &c), STORE_OK);
    assert_int_equal(c.ticket.unit, unit);
    assert_int_equal(c.next, next);
    assert_int_equal(c.last, last);
    return c;
}

/* Cells [from, to), whose answers are told apart by their numbers. */
static enum store_status publish_range(const struct fixture *f, const struct store_claim *c,
                                       int from, int to, enum store_unit_move move,
                                       struct store_progress *out)
{
    struct store_cell cell[10];
    char hash[10][24];
    for (int i = from; i < to; i++) {
        (void)snprintf(hash[i - from], sizeof hash[0], "cell%d", i);
        cell[i - from] = (struct store_cell){.cell = i,
                                             .state = STUDY_CELL_DONE,
                                             .content_hash = hash[i - from],
                                             .verdict = "stable",
                                             .error_code = "",
                                             .error_detail = "",
                                             .cpu_s = 0.5,
                                             .summary = "packed",
                                             .summary_size = 9,
                                             .summary_packed = 6};
    }
    const struct store_batch batch = {.n = to - from, .cell = cell, .next = to, .move = move};
    begin(f);
    const enum store_status st =
        writer(f)->ops->publish_cells(writer(f), &c->ticket, &batch, 5000, out);
    if (st == STORE_OK) {
        commit(f);
    } else {
        writer(f)->ops->rollback(writer(f));
    }
    return st;
}

static struct service_study progress_of(const struct fixture *f, int i)
{
    struct service_study s = {.n_cell = -1};
    assert_int_equal(writer(f)->ops->get_study(writer(f), id_of[i], &s), STORE_OK);
    return s;
}

static struct store_recovered recover(const struct fixture *f, const char *owner, int64_t now)
{
    struct store_recovered r = {.queued = -1};
    begin(f);
    assert_int_equal(writer(f)->ops->recover(writer(f), owner, now, 3, &r), STORE_OK);
    commit(f);
    return r;
}

static void test_life(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    struct store_claim none;
    assert_int_equal(claim_unit(f, "me", 1, &none), STORE_NONE);
    submit_study(f, 0, "h");
    assert_int_equal(depth(f), 1);
    assert_int_equal(get(f, id_of[0]).kind, JOB_STUDY);
    struct store_ticket t;
    assert_int_equal(claim(f, "me", &t), STORE_NONE); /* no job for the other queue */
    static const int from[] = {0, 3, 5, 8}, to[] = {3, 5, 8, 10};
    for (int u = 0; u < 4; u++) {
        const struct store_claim c = must_claim(f, 1000, u + 1, from[u], to[u]);
        assert_int_equal(c.ticket.fence, u + 1);
        assert_int_equal(get(f, id_of[0]).state, JOB_RUNNING);
        assert_int_equal(publish_range(f, &c, from[u], to[u], STORE_UNIT_RELEASE, &p), STORE_OK);
        assert_int_equal(p.state, u < 3 ? JOB_RUNNING : JOB_DONE);
        assert_int_equal(publish_range(f, &c, 0, 0, STORE_UNIT_KEEP, &p), STORE_CONFLICT);
    }
    const struct job_record job = get(f, id_of[0]);
    assert_int_equal(job.state, JOB_DONE);
    assert_int_equal(job.finished_us, 5000);
    assert_int_equal(depth(f), 0);
    const struct service_study s = progress_of(f, 0);
    assert_int_equal(s.done, 10);
    assert_true(s.cpu_s == 5.0);
}

/* Part by part under one lease; after a loss the next claim goes on where the last one was stored.
 */
static void test_parts_and_losses(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    submit_study(f, 0, "h");
    const struct store_claim c = must_claim(f, 1000, 1, 0, 3);
    assert_int_equal(publish_range(f, &c, 0, 1, STORE_UNIT_YIELD, &p), STORE_OK);
    assert_true(p.kept); /* nobody else waits: other units of this study do not count */
    assert_true(get(f, id_of[0]).progress == 0.1);
    assert_int_equal(recover(f, "me", 1999).units, 0);
    begin(f);
    assert_int_equal(writer(f)->ops->heartbeat(writer(f), &c.ticket, 3000), STORE_OK);
    commit(f);
    assert_int_equal(recover(f, "me", 2500).units, 0);
    assert_int_equal(recover(f, "me", 3001).units, 1);
    assert_int_equal(publish_range(f, &c, 1, 2, STORE_UNIT_KEEP, &p), STORE_CONFLICT);
    begin(f);
    assert_int_equal(writer(f)->ops->heartbeat(writer(f), &c.ticket, 3000), STORE_CONFLICT);
    commit(f);
    struct store_claim again = must_claim(f, 4000, 1, 1, 3);
    assert_int_equal(again.lost, 1);
    assert_int_equal(recover(f, "another process", 4001).units, 1);
    again = must_claim(f, 4000, 1, 1, 3);
    assert_int_equal(again.lost, 2);
    assert_int_equal(publish_range(f, &again, 1, 2, STORE_UNIT_RELEASE, &p), STORE_OK);
    assert_false(p.kept);
    again = must_claim(f, 4000, 1, 2, 3);
    assert_int_equal(again.lost, 0); /* it got further */
    assert_int_equal(progress_of(f, 0).done, 2);
}

static void test_a_cell_is_stored_once(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    submit_study(f, 0, "h");
    struct store_claim c = must_claim(f, 1000, 1, 0, 3);
    assert_int_equal(publish_range(f, &c, 0, 2, STORE_UNIT_KEEP, &p), STORE_OK);
    assert_int_equal(publish_range(f, &c, 0, 2, STORE_UNIT_KEEP, &p), STORE_OK);
    assert_int_equal(progress_of(f, 0).done, 2);
    struct store_cell_row *row = NULL;
    int n = 0;
    assert_int_equal(writer(f)->ops->get_cells(writer(f), id_of[0], 1, 5, true, &row, &n),
                     STORE_OK);
    assert_int_equal(n, 1);
    assert_int_equal(row[0].cell.cell, 1);
    assert_string_equal(row[0].cell.content_hash, "cell1");
    assert_int_equal(row[0].packed_size, 6);
    assert_memory_equal(row[0].packed, "packed", 6);
    assert_int_equal(row[0].size, 9);
    free(row[0].packed);
    free(row);
    assert_int_equal(writer(f)->ops->get_cells(writer(f), id_of[0], 0, 1, false, &row, &n),
                     STORE_OK);
    assert_int_equal(n, 1);
    assert_null(row[0].packed);
    free(row);
}

/* What one study has found out is known to others, as is what a job has. */
static void test_known_answers(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    struct store_known known = {.known = -1};
    submit_study(f, 0, "h");
    struct store_claim c = must_claim(f, 1000, 1, 0, 3);
    assert_int_equal(writer(f)->ops->find_known(writer(f), "cell0", &known), STORE_NONE);
    assert_int_equal(publish_range(f, &c, 0, 3, STORE_UNIT_KEEP, &p), STORE_OK);
    assert_int_equal(writer(f)->ops->find_known(writer(f), "cell0", &known), STORE_OK);
    assert_true(known.known > 0);
    assert_null(known.summary);
    struct store_cell cell = {
        .cell = 3, .reused = true, .known = known.known, .state = STUDY_CELL_DONE, .cpu_s = 7.0};
    const struct store_batch batch = {.n = 1, .cell = &cell, .next = 4, .move = STORE_UNIT_KEEP};
    c = must_claim(f, 1000, 2, 3, 5);
    begin(f);
    assert_int_equal(writer(f)->ops->publish_cells(writer(f), &c.ticket, &batch, 1, &p), STORE_OK);
    commit(f);
    assert_int_equal(progress_of(f, 0).reused, 1);
    assert_true(progress_of(f, 0).cpu_s == 1.5);
    (void)submit(f, 1, "job");
    assert_int_equal(writer(f)->ops->find_known(writer(f), "job", &known), STORE_NONE);
    struct store_ticket t;
    assert_int_equal(claim(f, "me", &t), STORE_OK);
    assert_int_equal(publish(f, &t, NULL), STORE_OK);
    assert_int_equal(writer(f)->ops->find_known(writer(f), "job", &known), STORE_OK);
    assert_int_equal(known.known, 0);
    assert_string_equal(known.summary, "{\"a\":1}");
    assert_string_equal(known.verdict, "stable");
    free(known.summary);
}

/* Studies take turns, and give way to jobs. */
static void test_turns(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    submit_study(f, 0, "a");
    submit_study(f, 1, "b");
    struct store_claim c;
    static const int turn[] = {0, 1, 0, 1};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(claim_unit(f, "me", 1000 + i, &c), STORE_OK);
        assert_string_equal(c.ticket.id, id_of[turn[i]]);
        assert_int_equal(c.ticket.unit, 1 + i / 2);
    }
    assert_int_equal(publish_range(f, &c, 3, 4, STORE_UNIT_YIELD, &p), STORE_OK);
    assert_false(p.kept); /* the other study waits */
    begin(f);
    struct job_record job;
    assert_int_equal(writer(f)->ops->cancel(writer(f), id_of[0], 9, &job), STORE_OK);
    commit(f);
    c = must_claim(f, 2000, 2, 4, 5);
    assert_int_equal(publish_range(f, &c, 4, 4, STORE_UNIT_YIELD, &p), STORE_OK);
    assert_true(p.kept);
    (void)submit(f, 2, "job");
    assert_int_equal(publish_range(f, &c, 4, 4, STORE_UNIT_YIELD, &p), STORE_OK);
    assert_false(p.kept);
}

static void test_cancel(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    struct job_record job;
    submit_study(f, 0, "a");
    begin(f);
    assert_int_equal(writer(f)->ops->cancel(writer(f), id_of[0], 9, &job), STORE_OK);
    commit(f);
    assert_int_equal(job.state, JOB_CANCELLED); /* none had begun */
    assert_int_equal(depth(f), 0);

    submit_study(f, 1, "a");
    const struct store_claim c = must_claim(f, 1000, 1, 0, 3);
    begin(f);
    assert_int_equal(writer(f)->ops->cancel(writer(f), id_of[1], 10, &job), STORE_OK);
    commit(f);
    assert_int_equal(job.state, JOB_CANCELLING);
    struct store_claim none;
    assert_int_equal(claim_unit(f, "me", 1000, &none), STORE_NONE);
    assert_int_equal(publish_range(f, &c, 0, 1, STORE_UNIT_RELEASE, &p), STORE_OK);
    assert_int_equal(p.state, JOB_CANCELLED);
    assert_int_equal(get(f, id_of[1]).state, JOB_CANCELLED);
    assert_int_equal(progress_of(f, 1).done, 1);
    assert_int_equal(depth(f), 0);

    submit_study(f, 2, "a"); /* a cancelled one answers nothing */
    (void)must_claim(f, 1000, 1, 0, 3);
    begin(f);
    assert_int_equal(writer(f)->ops->cancel(writer(f), id_of[2], 11, &job), STORE_OK);
    commit(f);
    assert_int_equal(recover(f, "another process", 1).cancelled, 1);
    assert_int_equal(get(f, id_of[2]).state, JOB_CANCELLED);
    assert_int_equal(depth(f), 0);
}

static void test_fail(void **state)
{
    const struct fixture *f = *state;
    struct store_progress p;
    submit_study(f, 0, "a");
    const struct store_claim c = must_claim(f, 1000, 1, 0, 3), other = must_claim(f, 1000, 2, 3, 5);
    begin(f);
    assert_int_equal((writer(f)->ops->fail)(writer(f), &c.ticket, "invalid", "/case", 7), STORE_OK);
    commit(f);
    const struct job_record job = get(f, id_of[0]);
    assert_int_equal(job.state, JOB_FAILED);
    assert_string_equal(job.error_detail, "/case");
    assert_int_equal(depth(f), 0);
    assert_int_equal(publish_range(f, &other, 3, 4, STORE_UNIT_KEEP, &p), STORE_CONFLICT);
}

static void test_pack(void **state)
{
    static const char text[] = "{\"a\":1,\"b\":[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]}";
    size_t size = 0;
    (void)state;
    unsigned char *packed = pack_text(text, sizeof text - 1, 1, &size);
    assert_non_null(packed);
    assert_true(size < sizeof text - 1);
    char *back = unpack_text(packed, size, sizeof text - 1);
    assert_string_equal(back, text);
    free(back);
    assert_null(unpack_text(packed, size, sizeof text));
    assert_null(unpack_text(packed, size - 1, sizeof text - 1));
    packed[0] ^= 1;
    assert_null(unpack_text(packed, size, sizeof text - 1));
    free(packed);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_setup, fixture_teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_life),
        TEST(test_parts_and_losses),
        TEST(test_a_cell_is_stored_once),
        TEST(test_known_answers),
        TEST(test_turns),
        TEST(test_cancel),
        TEST(test_fail),
        cmocka_unit_test(test_pack),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
