/* Polars with and without drag: what is recorded, refused and reported. */
#include "api/channel.h"
#include "api/result.h"
#include "core/num.h"
#include "tests/api/parsing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ZERO_DRAG "\"cd\":[[0,0,0]],"
#define CASE(drag_, output_)                                                                       \
    "{\"schema_version\":1,\"kind\":\"simulation\",\"polars\":[{\"name\":\"mine\",\"alpha_deg\":"  \
    "[-10,0,10],\"cl\":[[-1,0,1]]," drag_ "\"cm\":[[0,0,0]],\"linear_from_deg\":-5,"               \
    "\"linear_to_deg\":5}],\"beam\":{\"length_m\":0.37,\"elements\":4,\"section\":{\"type\":"      \
    "\"strip\",\"chord_m\":0.1,\"layup\":[{\"material\":\"AS4/3501-6\",\"thickness_m\":0.001}]}}," \
    "\"flow\":{\"speed_m_s\":6,\"incidence_deg\":3},\"aerodynamics\":{\"polar\":\"mine\"},"        \
    "\"solver\":{\"duration_s\":0.05}" output_ "}"

static const struct sim_result *run(const struct api_case *c, struct sim **sim)
{
    struct failure fail = {.detail = ""};
    assert_ok(sim_create(api_case_def(c), sim, &fail));
    assert_ok(sim_run(*sim, NULL, &fail));
    return sim_result(*sim);
}

static bool records(const struct api_case *c, enum channel channel)
{
    const struct output_def *o = &api_case_def(c)->output;
    for (int i = 0; i < o->n_channel; i++) {
        if (o->channel[i] == channel) {
            return true;
        }
    }
    return false;
}

static void defaults_without_drag(void **state)
{
    struct fixture *f = *state;
    struct api_case *none = parse_good(f, CASE("", "")), *zero = parse_good(f, CASE(ZERO_DRAG, ""));
    assert_false(records(none, CHANNEL_CD));
    assert_true(records(none, CHANNEL_CM));
    assert_true(records(zero, CHANNEL_CD));
    assert_null(strstr(api_case_canonical(none), "\"cd\""));
    assert_string_not_equal(api_case_hash(none), api_case_hash(zero));
    struct api_case *again = parse_good(f, api_case_canonical(none));
    assert_string_equal(api_case_canonical(again), api_case_canonical(none));
    api_case_destroy(again);
    api_case_destroy(zero);
    api_case_destroy(none);
}

static void asked_for_without_drag(void **state)
{
    static const char *const channel[] = {"efficiency", "drag_n", "cd", "station_cd"};
    struct fixture *f = *state;
    for (size_t i = 0; i < sizeof channel / sizeof channel[0]; i++) {
        char json[1024];
        (void)snprintf(json, sizeof json, CASE("", ",\"output\":{\"channels\":[\"cl\",\"%s\"]}"),
                       channel[i]);
        assert_null(parse(f, json));
        const struct failure *p = &f->problems->item[0];
        assert_int_equal(f->problems->total, 1);
        assert_string_equal(p->pointer, "/output/channels/1");
        assert_string_equal(p->code, "no_drag");
        assert_string_equal(p->got, channel[i]);
        assert_non_null(strstr(p->detail, "mine"));
        (void)snprintf(json, sizeof json,
                       CASE(ZERO_DRAG, ",\"output\":{\"channels\":[\"cl\",\"%s\"]}"), channel[i]);
        api_case_destroy(parse_good(f, json));
    }
}

/* Drag that is not known is null, not zero; lift is that of a polar with zero drag. */
static void reports_without_drag(void **state)
{
    struct fixture *f = *state;
    struct api_case *none = parse_good(f, CASE("", "")), *zero = parse_good(f, CASE(ZERO_DRAG, ""));
    struct sim *a = NULL, *b = NULL;
    const struct sim_result *without = run(none, &a), *with = run(zero, &b);
    assert_true(isnan(without->means.cd));
    assert_true(isnan(without->means.drag));
    assert_true(isnan(without->means.efficiency));
    assert_true(isnan(without->loads.drag[2]));
    assert_near_abs(without->means.lift, with->means.lift, 0.0);
    assert_true(with->means.drag > 0.0); /* of the induced angle alone */
    const struct run_timing timing = {.cpu_s = 1.0};
    char *summary = result_document("summary", none, without, &timing);
    assert_non_null(strstr(summary, "\"cd\":null"));
    assert_non_null(strstr(summary, "\"drag_n\":null"));
    assert_non_null(strstr(summary, "\"efficiency\":null"));
    char *loads = result_document("loads", none, without, &timing);
    assert_non_null(strstr(loads, "\"cd\":[null,null,null,null]"));
    assert_null(strstr(loads, "\"cl\":[null"));
    free(loads);
    free(summary);
    sim_destroy(b);
    sim_destroy(a);
    api_case_destroy(zero);
    api_case_destroy(none);
}

/* The channel is lift over drag at every sample. */
static void efficiency_channel(void **state)
{
    struct fixture *f = *state;
    struct api_case *c =
        parse_good(f, CASE("\"cd\":[[0.1,0.02,0.1]],",
                           ",\"output\":{\"channels\":[\"lift_n\",\"drag_n\",\"efficiency\"]}"));
    struct sim *sim = NULL;
    const struct sim_result *r = run(c, &sim);
    assert_int_equal(r->n_column, 3);
    for (int i = 0; i < r->n_sample; i++) {
        assert_near_rel(sim_column(sim, 2)[i], sim_column(sim, 0)[i] / sim_column(sim, 1)[i],
                        1e-14);
    }
    assert_near_rel(r->means.efficiency, r->means.lift / r->means.drag, 1e-15);
    sim_destroy(sim);
    api_case_destroy(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_without_drag),
        cmocka_unit_test(asked_for_without_drag),
        cmocka_unit_test(reports_without_drag),
        cmocka_unit_test(efficiency_channel),
    };
    sim_process_init();
    return cmocka_run_group_tests(tests, parsing_setup, parsing_teardown);
}
