/* Maps of a study: values of summaries, missing ones, classes, nested lists. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "api/study_map.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char summary_text[] =
    "{\"verdict\":\"stable\",\"means\":{\"tip_twist_deg\":1.5,\"cl\":0.4},"
    "\"damping\":{\"tip_twist\":{\"roots\":[{\"ratio\":7}],\"torsion\":{\"ratio\":0.01}},"
    "\"tip_plunge\":{\"roots\":[{\"ratio\":0.2},{\"ratio\":9}],\"torsion\":null}},"
    "\"modes\":[{\"frequency_hz\":4},{\"frequency_hz\":25}],\"free\":true,\"nothing\":null}";

static double number_at(const cJSON *summary, const char *path)
{
    double number = (double)NAN;
    const char *text = NULL;
    assert_int_equal(study_value(summary, path, &number, &text), STUDY_VALUE_NUMBER);
    return number;
}

static void test_values(void **state)
{
    (void)state;
    cJSON *s = cJSON_Parse(summary_text);
    double number = 0.0;
    const char *text = NULL;
    assert_true(number_at(s, "means.tip_twist_deg") == 1.5);
    assert_true(number_at(s, "tip_twist_deg") == 1.5);
    assert_true(number_at(s, "mean_tip_twist_deg") == 1.5);
    assert_true(number_at(s, "cl") == 0.4);
    assert_true(number_at(s, "damping.tip_twist") == 0.01);
    assert_true(number_at(s, "damping.tip_plunge") == 0.2);
    assert_true(number_at(s, "damping.tip_plunge.roots.1.ratio") == 9.0);
    assert_true(number_at(s, "modes.1.frequency_hz") == 25.0);
    assert_true(number_at(s, "free") == 1.0);
    assert_int_equal(study_value(s, "verdict", &number, &text), STUDY_VALUE_TEXT);
    assert_string_equal(text, "stable");
    assert_int_equal(study_value(s, "nothing", &number, &text), STUDY_VALUE_MISSING);
    assert_int_equal(study_value(s, "modes.2.frequency_hz", &number, &text), STUDY_VALUE_MISSING);
    assert_int_equal(study_value(s, "nothing.more", &number, &text), STUDY_VALUE_MISSING);
    assert_int_equal(study_value(s, "damping.tip_plunge.torsion.ratio", &number, &text),
                     STUDY_VALUE_MISSING);
    assert_int_equal(study_value(s, "modes.x", &number, &text), STUDY_VALUE_ABSENT);
    assert_int_equal(study_value(s, "modes.-1", &number, &text), STUDY_VALUE_ABSENT);
    assert_int_equal(study_value(s, "modes", &number, &text), STUDY_VALUE_NONE);
    assert_int_equal(study_value(s, "means", &number, &text), STUDY_VALUE_NONE);
    cJSON_Delete(s);
}

/* What is read of a text for some paths gives what the whole gives. */
static void test_values_of_a_text(void **state)
{
    static const char *const path[] = {"means.tip_twist_deg",
                                       "tip_twist_deg",
                                       "mean_tip_twist_deg",
                                       "cl",
                                       "damping.tip_twist",
                                       "damping.tip_plunge",
                                       "verdict",
                                       "nothing",
                                       "modes.1.frequency_hz",
                                       "modes.2.frequency_hz",
                                       "modes",
                                       "free",
                                       "modes.x",
                                       "nothing.more",
                                       "absent",
                                       "absent.part"};
    (void)state;
    cJSON *whole = cJSON_Parse(summary_text);
    for (size_t i = 0; i < sizeof path / sizeof path[0]; i++) {
        double number[2] = {0.0, 0.0};
        const char *text[2] = {"", ""};
        cJSON *part = study_value_parse(summary_text, 1, &path[i]);
        assert_non_null(part);
        assert_true(cJSON_GetArraySize(part) < cJSON_GetArraySize(whole));
        assert_int_equal(study_value(part, path[i], &number[0], &text[0]),
                         study_value(whole, path[i], &number[1], &text[1]));
        assert_true(number[0] == number[1]);
        assert_string_equal(text[0], text[1]);
        cJSON_Delete(part);
    }
    cJSON_Delete(whole);
    assert_null(study_value_parse("{\"verdict\":\"stable", 1, path));
}

static const double speed[] = {2.0, 3.0, 4.0};
static const char *const polar[] = {"a", "b"};

static struct study_map make(const char *value)
{
    struct study_map m = {.value_name = value,
                          .n_dimension = 2,
                          .shape = {2, 3},
                          .n_axis = 2,
                          .axis = {{"/aerodynamics/polar", 0, 2, NULL, polar},
                                   {"/flow/speed_m_s", 1, 3, speed, NULL}}};
    assert_true(study_map_init(&m));
    return m;
}

static void expect_members(const struct study_map *m, const char *expected)
{
    struct json_out out = {0};
    json_object_begin(&out);
    study_map_members(&out, m);
    json_object_end(&out);
    char *text = json_out_take(&out, NULL);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

static void test_numbers(void **state)
{
    (void)state;
    struct study_map m = make("cl");
    cJSON *s = cJSON_Parse(summary_text);
    assert_int_equal(study_map_set(&m, 4, STUDY_CELL_DONE, s), STUDY_VALUE_NUMBER);
    assert_int_equal(study_map_set(&m, 2, STUDY_CELL_FAILED, NULL), STUDY_VALUE_MISSING);
    expect_members(
        &m,
        "{\"value\":\"cl\",\"axes\":[{\"pointer\":\"/aerodynamics/polar\",\"dimension\":0,"
        "\"values\":[\"a\",\"b\"]},{\"pointer\":\"/flow/speed_m_s\",\"dimension\":1,"
        "\"values\":[2,3,4]}],\"shape\":[2,3],\"values\":[[null,null,null],[null,0.4,null]],"
        "\"status\":[[\"pending\",\"pending\",\"failed\"],[\"pending\",\"done\",\"pending\"]]}");
    m.value_name = "modes";
    assert_int_equal(study_map_set(&m, 0, STUDY_CELL_DONE, s), STUDY_VALUE_NONE);
    cJSON_Delete(s);
    struct json_out out = {0};
    json_object_begin(&out);
    study_map_point(&out, &m, 4);
    json_object_end(&out);
    assert_string_equal(out.text, "{\"/aerodynamics/polar\":\"b\",\"/flow/speed_m_s\":3}");
    json_out_done(&out);
    study_map_done(&m);
}

static void test_classes(void **state)
{
    (void)state;
    static const char *const verdicts[] = {"stable", "flutter", "stable"};
    struct study_map m = make("verdict");
    for (int i = 0; i < 3; i++) {
        cJSON *s = cJSON_CreateObject();
        (void)cJSON_AddStringToObject(s, "verdict", verdicts[i]);
        assert_int_equal(study_map_set(&m, i, STUDY_CELL_DONE, s), STUDY_VALUE_TEXT);
        cJSON_Delete(s);
    }
    assert_int_equal(m.n_class, 2);
    assert_true(m.value[0] == 0.0 && m.value[1] == 1.0 && m.value[2] == 0.0);
    struct json_out out = {0};
    json_object_begin(&out);
    study_map_members(&out, &m);
    json_object_end(&out);
    assert_non_null(strstr(out.text, "\"values\":[[\"stable\",\"flutter\",\"stable\"],"
                                     "[null,null,null]]"));
    json_out_done(&out);
    study_map_done(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_values_of_a_text),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_classes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
