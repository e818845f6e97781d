/* Cases with a network: the polar it adds to, what it stands on and remembers. */
#include "tests/api/parsing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A network of a polar that is not the one of the case;. */
static const char document[] =
    "{\"schema_version\":1,\"kind\":\"simulation\",\"networks\":[{\"name\":\"net\","
    "\"activation\":\"tanh\",\"polar_hash\":\"abc\",\"base\":\"dynamic_stall\","
    "\"lags_c_v\":[0.5,3],\"oscillators\":[{\"f_c_v\":0.7,\"damping\":0.25}],\"inputs\":[\"%s\","
    "\"stall_lost\"],\"outputs\":[\"cl\"],"
    "\"hidden\":1,\"input_offset\":[0,0],\"input_scale\":[1,2],\"output_offset\":[0],"
    "\"output_scale\":[1],\"hull_min\":[-1,-1],\"hull_max\":[1,1],\"w1\":[[1,2]],\"b1\":[0],"
    "\"w2\":[[1]],\"b2\":[0]}],\"beam\":{\"length_m\":0.37,\"elements\":8,\"section\":{"
    "\"type\":\"strip\",\"chord_m\":0.1,\"layup\":[{\"material\":\"AS4/3501-6\","
    "\"thickness_m\":0.001}]}},\"flow\":{\"speed_m_s\":6},\"aerodynamics\":{\"polar\":"
    "\"plate-4pct-channel\",\"dynamic\":{\"type\":\"network\",\"name\":\"net\"%s}},\"solver\":{"
    "\"duration_s\":1}}";

static struct api_case *parse_with(struct fixture *f, const char *input, const char *force)
{
    char text[2 * sizeof document];
    (void)snprintf(text, sizeof text, document, input, force);
    return parse(f, text);
}

static void assert_refused(struct fixture *f, const char *input, const char *force,
                           const char *pointer, const char *code)
{
    assert_null(parse_with(f, input, force));
    assert_string_equal(f->problems->item[0].pointer, pointer);
    assert_string_equal(f->problems->item[0].code, code);
}

static void another_polar_wants_force(void **state)
{
    struct fixture *f = *state;
    assert_refused(f, "alpha_lag_2", "", "/aerodynamics/dynamic/name", "other_polar");
    assert_refused(f, "alpha_lag_2", ",\"force\":false", "/aerodynamics/dynamic/name",
                   "other_polar");
    assert_refused(f, "alpha_lag_2", ",\"force\":1", "/aerodynamics/dynamic/force", "wrong_type");
    struct api_case *c = parse_with(f, "alpha_lag_2", ",\"force\":true");
    assert_non_null(c);
    assert_non_null(strstr(api_case_canonical(c), "\"force\":true"));
    api_case_destroy(c);
}

static void lags_and_base_are_read_and_printed(void **state)
{
    struct fixture *f = *state;
    struct api_case *c = parse_with(f, "alpha_lag_2", ",\"force\":true");
    assert_non_null(c);
    const struct network_def *net = api_case_def(c)->aero.network;
    assert_int_equal(net->frame.base, NETWORK_ON_STALL);
    assert_int_equal(net->frame.n_lag, 2);
    assert_near_abs(net->frame.lag[1], 3.0, 0.0);
    assert_int_equal(net->frame.n_oscillator, 1);
    assert_near_abs(net->frame.oscillator[0].damping, 0.25, 0.0);
    assert_non_null(strstr(api_case_canonical(c),
                           "\"oscillators\":[{\"f_c_v\":0.7,\"damping\":0.25}],\"inputs\""));
    assert_int_equal(net->input[1], NET_IN_STALL_LOST);
    assert_non_null(strstr(api_case_canonical(c), "\"base\":\"dynamic_stall\",\"lags_c_v\""));
    api_case_destroy(c);
    assert_refused(f, "alpha_lag_3", ",\"force\":true", "/networks/0/inputs/0", "contradiction");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_polar_wants_force),
        cmocka_unit_test(lags_and_base_are_read_and_printed),
    };
    return cmocka_run_group_tests(tests, parsing_setup, parsing_teardown);
}
