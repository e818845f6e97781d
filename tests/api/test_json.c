/* Strict reading and exact printing of JSON. */
#include "api/json.h"
#include "api/json_out.h"
#include "api/reader.h"
#include "core/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *scan_code(const char *text, size_t size, struct failure *fail)
{
    return json_scan(text, size, fail) == ST_OK ? "ok" : fail->code;
}

static void test_scan_accepts(void **state)
{
    static const char *const good[] = {
        "{}",
        "[]",
        " [ 1 , -0 , 0.5e-3 , 1E+9 , \"\", true , false , null ] ",
        "\"\\u00e9\\ud83d\\ude00\\n\\\\\"",
        "\"\xc3\xa9\xf0\x9f\x98\x80\"",
        "{\"a\":{\"b\":[[],{}]},\"c\":0}",
        "0",
    };
    struct failure fail;
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        assert_string_equal(scan_code(good[i], strlen(good[i]), &fail), "ok");
    }
}

static void test_scan_refuses(void **state)
{
    static const struct {
        const char *text, *code, *pointer;
    } bad[] = {
        {"", "syntax", ""},
        {"{", "syntax", ""},
        {"{\"a\" 1}", "syntax", "/a"},
        {"{\"a\":}", "syntax", "/a"},
        {"{\"a\":1,}", "syntax", ""},
        {"{a:1}", "syntax", ""},
        {"[1,]", "syntax", "/1"},
        {"[1 2]", "syntax", "/0"},
        {"[1", "syntax", "/0"},
        {"{\"a\":[0,{\"b\":nul}]}", "syntax", "/a/1/b"},
        {"'a'", "syntax", ""},
        {"\"a", "syntax", ""},
        {"NaN", "syntax", ""},
        {"{\"flow\":{\"speed_m_s\":NaN}}", "syntax", "/flow/speed_m_s"},
        {"[Infinity]", "syntax", "/0"},
        {"[-Infinity]", "bad_number", "/0"},
        {"01", "bad_number", ""},
        {"[-01]", "bad_number", "/0"},
        {"1.", "bad_number", ""},
        {".5", "syntax", ""},
        {"+1", "syntax", ""},
        {"1e", "bad_number", ""},
        {"1e+", "bad_number", ""},
        {"0x10", "trailing_text", ""},
        {"{} {}", "trailing_text", ""},
        {"1,", "trailing_text", ""},
        {"\"\\x\"", "bad_escape", ""},
        {"\"\\u12g4\"", "bad_escape", ""},
        {"\"\\u0000\"", "bad_escape", ""},
        {"\"\\ud800\"", "bad_escape", ""},
        {"\"\\ud800\\u0041\"", "bad_escape", ""},
        {"\"\\udc00\"", "bad_escape", ""},
        {"\"a\tb\"", "control_character", ""},
        {"\"\xff\"", "bad_utf8", ""},
        {"\"\xc0\x80\"", "bad_utf8", ""},
        {"\"\xed\xa0\x80\"", "bad_utf8", ""},
        {"\"\xf4\x90\x80\x80\"", "bad_utf8", ""},
        {"\xef\xbb\xbf{}", "byte_order_mark", ""},
    };
    struct failure fail;
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_string_equal(scan_code(bad[i].text, strlen(bad[i].text), &fail), bad[i].code);
        assert_string_equal(fail.pointer, bad[i].pointer);
        assert_true(fail.expected[0] != '\0');
    }
    assert_string_equal(scan_code("{}\0", 3, &fail), "trailing_text");
    assert_string_equal(scan_code("\"a\0b\"", 5, &fail), "control_character");
}

static void test_scan_says_where(void **state)
{
    struct failure fail;
    static const char text[] = "{\n  \"a\": 1,\n  \"b\": tru\n}";
    (void)state;
    assert_string_equal(scan_code(text, strlen(text), &fail), "syntax");
    assert_string_equal(fail.pointer, "/b");
    assert_non_null(strstr(fail.detail, "line 3, column 8"));
}

static void test_depth(void **state)
{
    enum { HOSTILE = 100000 };
    struct failure fail;
    char *text = malloc(HOSTILE);
    (void)state;
    memset(text, '[', HOSTILE);
    assert_string_equal(scan_code(text, HOSTILE, &fail), "too_deep");
    memset(text + JSON_DEPTH_MAX, ']', JSON_DEPTH_MAX);
    assert_string_equal(scan_code(text, 2 * (size_t)JSON_DEPTH_MAX, &fail), "ok");
    memset(text, '[', JSON_DEPTH_MAX + 1);
    memset(text + JSON_DEPTH_MAX + 1, ']', JSON_DEPTH_MAX + 1);
    assert_string_equal(scan_code(text, 2 * ((size_t)JSON_DEPTH_MAX + 1), &fail), "too_deep");
    free(text);
}

static void test_limits(void **state)
{
    struct failure fail;
    const size_t size = 2 * ((size_t)JSON_VALUES_MAX + 1) + 1;
    char *text = malloc(size);
    char number[JSON_NUMBER_MAX + 2];
    (void)state;
    for (size_t i = 0; i < size; i++) {
        text[i] = i % 2 == 1 ? '0' : ',';
    }
    text[0] = '[';
    text[size - 1] = ']';
    assert_string_equal(scan_code(text, size, &fail), "too_many_values");
    free(text);
    memset(number, '1', sizeof number);
    assert_string_equal(scan_code(number, JSON_NUMBER_MAX, &fail), "ok");
    assert_string_equal(scan_code(number, JSON_NUMBER_MAX + 1, &fail), "bad_number");
}

static void check(const char *text, struct failure_list *problems)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    struct reader r;
    problems->count = problems->total = 0;
    assert_int_equal(json_parse(text, strlen(text), &tree, &fail), ST_OK);
    reader_init(&r, "", problems);
    json_check(&r, tree);
    json_free(tree);
}

static void test_check(void **state)
{
    struct failure_list *p = calloc(1, sizeof *p);
    (void)state;
    check("{\"a\":{\"b\":1,\"c\":2,\"b\":3},\"x\":[{\"y\":1,\"Y\":2}]}", p);
    assert_int_equal(p->total, 1);
    assert_string_equal(p->item[0].code, "duplicate_key");
    assert_string_equal(p->item[0].pointer, "/a/b");
    check("{\"a/b~\":0,\"\\u0061/b~\":0}", p); /* the same key after decoding */
    assert_int_equal(p->total, 1);
    assert_string_equal(p->item[0].pointer, "/a~1b~0");
    check("[0,1e999,-1e999]", p);
    assert_int_equal(p->total, 2);
    assert_string_equal(p->item[1].code, "not_finite");
    assert_string_equal(p->item[1].pointer, "/2");
    free(p);
}

static void test_check_many_members(void **state)
{
    struct failure_list *p = calloc(1, sizeof *p);
    char *text = malloc(16 * ((size_t)JSON_MEMBERS_MAX + 2));
    char *at = text;
    (void)state;
    for (int i = 0; i <= JSON_MEMBERS_MAX; i++) {
        at += sprintf(at, "%c\"k%d\":0", i == 0 ? '{' : ',', i);
    }
    (void)sprintf(at, "}");
    check(text, p);
    assert_int_equal(p->total, 1);
    assert_string_equal(p->item[0].code, "too_many_members");
    free(text);
    free(p);
}

/* Degrees survive the way to radians and back as text, and radians as bits. */
static void test_numbers_in_units(void **state)
{
    const double degree = 3.14159265358979323846 / 180.0;
    uint64_t seed = 7;
    (void)state;
    for (int i = -180000; i <= 180000; i += 7) {
        struct json_out out = {0};
        char wanted[NUMBER_TEXT_SIZE];
        const double value = i / 1000.0;
        (void)number_text(value, wanted);
        json_number_in_unit(&out, value * degree, degree);
        assert_string_equal(out.text, wanted);
        json_out_done(&out);
    }
    for (int i = 0; i < 20000; i++) {
        struct json_out out = {0};
        const double value = random_uniform(&seed) * 360.0 - 180.0;
        const double si = value * degree;
        json_number_in_unit(&out, si, degree);
        const double back = strtod(out.text, NULL) * degree;
        assert_memory_equal(&back, &si, sizeof si);
        json_out_done(&out);
    }
}

static void test_writer(void **state)
{
    struct json_out out = {0};
    size_t size = 0;
    (void)state;
    json_object_begin(&out);
    json_key_string(&out, "a\"\\\n\x01", "b\xff\xc3\xa9");
    json_key_number(&out, "nan", (double)NAN);
    json_key_numbers(&out, "v", 2, (const double[]){1, 9, 2}, 2, 0.5);
    json_key(&out, "e");
    json_array_begin(&out);
    json_array_end(&out);
    json_key_string(&out, "none", NULL);
    json_object_end(&out);
    char *text = json_out_take(&out, &size);
    assert_string_equal(text, "{\"a\\\"\\\\\\n\\u0001\":\"b\xef\xbf\xbd\xc3\xa9\",\"nan\":null,"
                              "\"v\":[0.5,1],\"e\":[],\"none\":null}");
    assert_int_equal(size, strlen(text));
    free(text);
}

static void test_tree_prints_exactly(void **state)
{
    static const char text[] = "{\"a\":[0.1,-0,1e+300,true,null,\"x\\u0001\"],\"b\":{}}";
    struct cJSON *tree = NULL;
    struct failure fail;
    struct json_out out = {0};
    (void)state;
    assert_int_equal(json_parse(text, strlen(text), &tree, &fail), ST_OK);
    json_value(&out, tree);
    assert_string_equal(out.text, text);
    json_out_done(&out);
    json_free(tree);
}

static void test_members(void **state)
{
    static const char text[] =
        "{ \"a\" : {\"b\":[1,{\"c\":\"}],\\\"\"}]},\"b\":\"\\\\\", \"c\":[[2]] ,\"d\":-1e3}";
    static const char *const names[] = {"b", "d", "e"};
    static const char *const broken[] = {"",           "[]",         "{\"a\"}",     "{\"a\":1",
                                         "{\"a\":1,}", "{\"b\":\"x", "{\"b\":tru}", "{\"b\":[}"};
    (void)state;
    struct cJSON *found = json_parse_members(text, strlen(text), 3, names);
    struct json_out out = {0};
    assert_non_null(found);
    json_value(&out, found);
    assert_string_equal(out.text, "{\"b\":\"\\\\\",\"d\":-1000}");
    json_out_done(&out);
    json_free(found);
    found = json_parse_members("{}", 2, 3, names);
    assert_non_null(found);
    json_free(found);
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        found = json_parse_members(broken[i], strlen(broken[i]), 3, names);
        assert_null(found);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scan_accepts),
        cmocka_unit_test(test_scan_refuses),
        cmocka_unit_test(test_scan_says_where),
        cmocka_unit_test(test_depth),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_check),
        cmocka_unit_test(test_check_many_members),
        cmocka_unit_test(test_numbers_in_units),
        cmocka_unit_test(test_writer),
        cmocka_unit_test(test_tree_prints_exactly),
        cmocka_unit_test(test_members),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
