/* Gusts and prescribed motion in a case: what they become, and every way to be wrong. */
#include "core/num.h"
#include "tests/api/parsing.h"

#include <string.h>

#define CASE_OF(beam_, flow_)                                                                      \
    "{\"schema_version\":1,\"kind\":\"simulation\",\"beam\":{\"length_m\":1,\"section\":{"         \
    "\"type\":"                                                                                    \
    "\"strip\",\"chord_m\":0.1,\"layup\":[{\"material\":\"aluminium\",\"thickness_m\":0.001}]"     \
    "}" beam_ "},\"flow\":{\"speed_m_s\":10" flow_                                                 \
    "},\"aerodynamics\":{\"polar\":\"flat-plate-linear\"},\"solver\":{\"duration_s\":1}}"
#define GUST(members_) CASE_OF("", ",\"gust\":{" members_ "}")
#define ROOT(members_) CASE_OF(",\"root_motion\":{" members_ "}", "")
#define COSINE "\"type\":\"one_minus_cosine\",\"amplitude_m_s\":2"

static void test_gusts(void **state)
{
    struct api_case *c = parse_good(*state, GUST(COSINE ",\"start_s\":0.1,\"length_m\":5"));
    const struct gust_def *g = &api_case_def(c)->flow.gust;
    assert_true(g->given);
    assert_int_equal(g->type, GUST_ONE_MINUS_COSINE);
    assert_near_abs(g->length, 5.0, 0.0);
    assert_near_rel(case_def_driven_until(api_case_def(c)), 0.6, 1e-14);
    assert_null(strstr(api_case_canonical(c), "duration_s\":0"));
    api_case_destroy(c);
    c = parse_good(*state, GUST("\"type\":\"table\",\"time_s\":[0,1,2],\"velocity_m_s\":[0,3,0]"));
    assert_near_abs(api_case_def(c)->flow.gust.velocity[1], 3.0, 0.0);
    api_case_destroy(c);
    c = parse_good(*state, CASE_OF("", ""));
    assert_false(api_case_def(c)->flow.gust.given);
    assert_null(strstr(api_case_canonical(c), "gust"));
    assert_null(strstr(api_case_canonical(c), "root_motion"));
    api_case_destroy(c);
}

static void test_root_motion(void **state)
{
    struct api_case *c = parse_good(
        *state, ROOT("\"pitch\":{\"type\":\"sine\",\"amplitude_deg\":2,\"frequency_hz\":4},"
                     "\"plunge\":{\"type\":\"table\",\"time_s\":[0,1],"
                     "\"displacement_m\":[0,0.1]}"));
    const struct beam_def *b = &api_case_def(c)->beam;
    assert_near_rel(b->root_pitch.amplitude, num_rad(2.0), 1e-15);
    assert_near_abs(b->root_pitch.ramp, 0.25, 0.0);
    assert_int_equal(b->root_plunge.type, DRIVE_TABLE);
    assert_near_abs(b->root_plunge.value[1], 0.1, 0.0);
    assert_non_null(strstr(api_case_canonical(c), "\"ramp_s\":0.25"));
    api_case_destroy(c);
}

static void test_canonical_is_stable(void **state)
{
    static const char *const cases[] = {
        GUST(COSINE ",\"duration_s\":0.5"),
        GUST("\"type\":\"step\",\"amplitude_m_s\":-1"),
        GUST("\"type\":\"table\",\"time_s\":[0,1,2],\"velocity_m_s\":[0,3,0]"),
        ROOT("\"pitch\":{\"type\":\"table\",\"time_s\":[0,1],\"angle_deg\":[0,3]}"),
        ROOT("\"plunge\":{\"type\":\"sine\",\"amplitude_m\":0.1,\"frequency_hz\":1,"
             "\"phase_deg\":30,\"start_s\":0.2,\"ramp_s\":3}"),
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_stable(*state, cases[i]);
    }
}

static void test_bad_cases(void **state)
{
    static const struct bad_case bad[] = {
        {GUST("\"amplitude_m_s\":2"), "/flow/gust/type", "required"},
        {GUST("\"type\":\"squall\""), "/flow/gust/type", "unknown_value"},
        {GUST(COSINE), "/flow/gust/length_m", "required"},
        {GUST(COSINE ",\"length_m\":1,\"duration_s\":1"), "/flow/gust/length_m", "given_twice"},
        {GUST(COSINE ",\"length_m\":-1"), "/flow/gust/length_m", "out_of_range"},
        {GUST("\"type\":\"step\",\"amplitude_m_s\":1,\"start_s\":-1"), "/flow/gust/start_s",
         "out_of_range"},
        {GUST("\"type\":\"table\",\"time_s\":[0,1],\"velocity_m_s\":[0]"),
         "/flow/gust/velocity_m_s", "wrong_length"},
        {GUST("\"type\":\"table\",\"time_s\":[0,1,1],\"velocity_m_s\":[0,1,2]"),
         "/flow/gust/time_s/2", "out_of_range"},
        {ROOT("\"heave\":{}"), "/beam/root_motion/heave", "unknown_key"},
        {ROOT("\"pitch\":{\"type\":\"sine\",\"amplitude_deg\":1}"),
         "/beam/root_motion/pitch/frequency_hz", "required"},
        {ROOT("\"pitch\":{\"type\":\"sine\",\"amplitude_deg\":1,\"frequency_hz\":1,\"ramp_s\":0}"),
         "/beam/root_motion/pitch/ramp_s", "out_of_range"},
        {ROOT("\"plunge\":{\"type\":\"table\",\"time_s\":[1,0],\"displacement_m\":[0,0]}"),
         "/beam/root_motion/plunge/time_s/1", "out_of_range"},
        {ROOT("\"plunge\":{\"type\":\"table\",\"time_s\":[1],\"displacement_m\":[0]}"),
         "/beam/root_motion/plunge/time_s", "wrong_length"},
    };
    assert_all_refused(*state, sizeof bad / sizeof bad[0], bad);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gusts),
        cmocka_unit_test(test_root_motion),
        cmocka_unit_test(test_canonical_is_stable),
        cmocka_unit_test(test_bad_cases),
    };
    return cmocka_run_group_tests(tests, parsing_setup, parsing_teardown);
}
