/* The OpenAPI document against the program: routes, parameters, field tables, defaults, codes,
 * examples. Neither may say what the other does not. */
#include "api/case_fields.h"
#include "api/channel.h"
#include "api/embedded.h"
#include "api/entry_fields.h"
#include "api/json.h"
#include "api/route.h"
#include "api/study_fields.h"
#include "tests/api/fake_service.h"
#include "tests/api/schema_check.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct fixture {
    struct fake *fake;
    cJSON *doc;
};

static int setup(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    struct failure fail;
    struct failure_list problems = {0};
    struct reader r;
    f->fake = fake_create();
    if (json_parse(openapi_files[0].data, embedded_size(&openapi_files[0]), &f->doc, &fail) !=
        ST_OK) {
        print_error("openapi.json%s: %s\n", fail.pointer, fail.detail);
        return -1;
    }
    reader_init(&r, "", &problems);
    json_check(&r, f->doc);
    *state = f;
    return problems.total;
}

static int teardown(void **state)
{
    struct fixture *f = *state;
    json_free(f->doc);
    fake_destroy(f->fake);
    free(f);
    return 0;
}

static const cJSON *get(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static const cJSON *schema_named(const struct fixture *f, const char *name)
{
    const cJSON *s = get(get(get(f->doc, "components"), "schemas"), name);
    assert_non_null(s);
    return s;
}

/* -- routes */

static const cJSON *operation_of(const struct fixture *f, const char *path, const char *method)
{
    char lower[16] = "";
    for (size_t i = 0; method[i] != '\0' && i + 1 < sizeof lower; i++) {
        lower[i] = (char)(method[i] | 0x20);
        lower[i + 1] = '\0';
    }
    return get(get(get(f->doc, "paths"), path), lower);
}

static bool route_takes(const struct route *route, const char *key)
{
    return route->query != NULL && field_name_index(route->query, key) >= 0;
}

static void check_parameters(const struct fixture *f, const struct route *route,
                             const cJSON *operation)
{
    int n = 0, known = 0;
    const cJSON *p = NULL;
    cJSON_ArrayForEach(p, get(operation, "parameters"))
    {
        const cJSON *full = schema_resolve(f->doc, p);
        if (strcmp(get(full, "in")->valuestring, "query") == 0) {
            n++;
            assert_true(route_takes(route, get(full, "name")->valuestring));
        }
    }
    while (route->query != NULL && route->query[known] != NULL) {
        known++;
    }
    assert_int_equal(n, known);
}

static void test_routes(void **state)
{
    const struct fixture *f = *state;
    int n_route = 0, n_operation = 0;
    for (const struct route *t = route_table; t->method != NULL; t++, n_route++) {
        const cJSON *operation = operation_of(f, t->path, t->method);
        if (operation == NULL) {
            fail_msg("%s %s is not in the document", t->method, t->path);
        }
        check_parameters(f, t, operation);
    }
    const cJSON *path = NULL, *operation = NULL;
    cJSON_ArrayForEach(path, get(f->doc, "paths"))
    {
        cJSON_ArrayForEach(operation, path)
        {
            n_operation += strcmp(operation->string, "parameters") != 0;
        }
    }
    assert_int_equal(n_operation, n_route);
}

/* -- field tables */

static void expect_number(const cJSON *schema, const char *keyword, bool given, double value,
                          const char *key)
{
    const cJSON *k = get(schema, keyword);
    if ((k != NULL) != given || (given && k->valuedouble != value)) {
        fail_msg("%s: %s of the document is not that of the table", key, keyword);
    }
}

static void check_range(const cJSON *schema, const struct field_range *range, const char *key)
{
    const struct field_range none = {.min = (double)-INFINITY, .max = (double)INFINITY};
    const struct field_range *r = range != NULL ? range : &none;
    const bool low = isfinite(r->min), high = isfinite(r->max);
    expect_number(schema, "minimum", low && !r->above_min, r->min, key);
    expect_number(schema, "exclusiveMinimum", low && r->above_min, r->min, key);
    expect_number(schema, "maximum", high && !r->below_max, r->max, key);
    expect_number(schema, "exclusiveMaximum", high && r->below_max, r->max, key);
}

static void check_names(const cJSON *schema, const char *const *names, const char *key)
{
    const cJSON *list = get(schema, "enum");
    int n = 0;
    for (; names[n] != NULL; n++) {
        const cJSON *e = cJSON_GetArrayItem(list, n);
        if (e == NULL || strcmp(e->valuestring, names[n]) != 0) {
            fail_msg("%s: \"%s\" is not in its place in the document", key, names[n]);
        }
    }
    assert_int_equal(cJSON_GetArraySize(list), n);
}

static void check_table(const struct fixture *f, const cJSON *schema, const struct field *fields,
                        unsigned kinds);

/* One schema for each table, told apart by the constant "type". */
static void check_variants(const struct fixture *f, const cJSON *s, const struct field *t,
                           unsigned kinds)
{
    const cJSON *list = get(s, "oneOf");
    int n = 0;
    for (; t->names[n] != NULL; n++) {
        const cJSON *one = schema_resolve(f->doc, cJSON_GetArrayItem(list, n));
        assert_string_equal(get(get(get(one, "properties"), "type"), "const")->valuestring,
                            t->names[n]);
        check_table(f, one, t->variants[n], kinds);
    }
    assert_int_equal(cJSON_GetArraySize(list), n);
}

static void check_field(const struct fixture *f, const cJSON *s, const struct field *t,
                        unsigned kinds)
{
    switch (t->kind) {
    case FIELD_NUMBER:
    case FIELD_INTEGER:
        assert_string_equal(get(s, "type")->valuestring,
                            t->kind == FIELD_NUMBER ? "number" : "integer");
        check_range(s, t->range, t->key);
        break;
    case FIELD_ENUM:
        if (get(s, "const") == NULL) { /* the type of a variant: see there */
            check_names(s, t->names, t->key);
        }
        break;
    case FIELD_BOOLEAN:
        assert_string_equal(get(s, "type")->valuestring, "boolean");
        break;
    case FIELD_TEXT:
        expect_number(s, "maxLength", true, (double)t->size - 1.0, t->key);
        expect_number(s, "minLength", t->required, 1, t->key);
        break;
    case FIELD_OBJECT:
        assert_int_equal(cJSON_IsArray(get(s, "type")), t->nullable); /* ["object", "null"] */
        check_table(f, s, t->fields, t->kinds != 0 ? t->kinds : kinds);
        break;
    case FIELD_PART:
        check_table(f, s, t->fields, t->kinds != 0 ? t->kinds : kinds);
        break;
    case FIELD_VARIANT:
        check_variants(f, s, t, kinds);
        break;
    case FIELD_LIST:
        expect_number(s, "minItems", true, t->min, t->key);
        expect_number(s, "maxItems", true, t->max, t->key);
        check_table(f, schema_resolve(f->doc, get(s, "items")), t->fields, kinds);
        break;
    case FIELD_NAMES:
        expect_number(s, "minItems", true, t->min, t->key);
        expect_number(s, "maxItems", true, t->max, t->key);
        check_names(get(s, "items"), t->names, t->key);
        break;
    case FIELD_ARRAY:
    case FIELD_VECTOR:
        expect_number(s, "minItems", t->min > 0, t->min, t->key);
        check_range(get(s, "items"), t->range, t->key);
        break;
    case FIELD_MATRIX:
        assert_string_equal(get(get(s, "items"), "type")->valuestring, "array");
        break;
    case FIELD_CUSTOM:
        if (t->fields != NULL && t->max > 0) { /* a list */
            expect_number(s, "minItems", true, t->min, t->key);
            expect_number(s, "maxItems", true, t->max, t->key);
            check_table(f, schema_resolve(f->doc, get(s, "items")), t->fields, kinds);
        } else if (t->fields != NULL) {
            check_table(f, s, t->fields, kinds);
        } /* else a reference or a note: nothing but the key */
        break;
    }
}

/* Whether every document that has the object must have the member. */
static bool always_required(const struct field *t, unsigned kinds)
{
    return t->required && t->applies == NULL && (t->kinds == 0 || (t->kinds & kinds) == kinds);
}

static bool lists_required(const cJSON *schema, const char *key)
{
    const cJSON *name = NULL;
    cJSON_ArrayForEach(name, get(schema, "required"))
    {
        if (strcmp(name->valuestring, key) == 0) {
            return true;
        }
    }
    return false;
}

static void check_table(const struct fixture *f, const cJSON *schema, const struct field *fields,
                        unsigned kinds)
{
    const cJSON *properties = get(schema, "properties");
    int n = 0;
    assert_true(cJSON_IsFalse(get(schema, "additionalProperties")));
    for (const struct field *t = fields; t->key != NULL; t++, n++) {
        const cJSON *s = get(properties, t->key);
        if (s == NULL) {
            fail_msg("\"%s\" is not in the document", t->key);
        }
        if (lists_required(schema, t->key) != always_required(t, kinds)) {
            fail_msg("\"%s\": required differs between table and document", t->key);
        }
        check_field(f, schema_resolve(f->doc, s), t, kinds);
    }
    assert_int_equal(cJSON_GetArraySize(properties), n);
}

static void test_tables(void **state)
{
    const struct fixture *f = *state;
    check_table(f, schema_named(f, "Case"), case_fields, (1u << CASE_KIND_COUNT) - 1u);
    check_table(f, schema_named(f, "Study"), study_fields, STUDY_BODY);
    check_table(f, schema_named(f, "Material"), material_fields, 0);
    check_table(f, schema_named(f, "Polar"), polar_fields, 0);
    check_table(f, schema_named(f, "Network"), network_fields, 0);
}

/* -- defaults */

static int check_defaults(const struct fixture *f, const cJSON *schema, const cJSON *value);

static int check_list_defaults(const struct fixture *f, const cJSON *schema, const cJSON *list)
{
    int n = 0;
    const cJSON *element = NULL;
    cJSON_ArrayForEach(element, list)
    {
        n += check_defaults(f, schema_resolve(f->doc, get(schema, "items")), element);
    }
    return n;
}

/* Every default of the schema is what the canonical case shows, and what is not required has one.
 */
static int check_defaults(const struct fixture *f, const cJSON *schema, const cJSON *value)
{
    int n = 0;
    const cJSON *member = NULL;
    if (get(schema, "properties") == NULL) { /* a variant: the one of this type */
        const cJSON *one = get(schema, "oneOf")->child;
        const char *type = get(value, "type")->valuestring;
        while (strcmp(get(get(get(schema_resolve(f->doc, one), "properties"), "type"), "const")
                          ->valuestring,
                      type) != 0) {
            one = one->next;
        }
        schema = schema_resolve(f->doc, one);
    }
    cJSON_ArrayForEach(member, value)
    {
        const cJSON *s = schema_resolve(f->doc, get(get(schema, "properties"), member->string));
        const cJSON *fallback = get(s, "default");
        assert_non_null(s);
        if (cJSON_IsArray(member) && cJSON_IsObject(member->child)) {
            n += check_list_defaults(f, s, member);
        } else if (fallback != NULL) {
            n++;
            if (!cJSON_Compare(fallback, member, true)) {
                fail_msg("\"%s\": default differs between document and program", member->string);
            }
        } else if (cJSON_IsObject(member)) {
            n += check_defaults(f, s, member);
        } else if (!lists_required(schema, member->string) &&
                   strcmp(member->string, "length_m") != 0 &&
                   strcmp(member->string, "duration_s") != 0 && /* required by the kind, */
                   strcmp(member->string, "speed_m_s") != 0 &&  /* likewise */
                   strcmp(member->string, "to_m") != 0) {       /* the length */
            fail_msg("\"%s\" has a default the document does not tell", member->string);
        }
    }
    return n;
}

#define STRIP                                                                                      \
    "{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":[{\"material\":\"foam\",\"thickness_m\":0.01}]" \
    "}"
#define BOX                                                                                        \
    "{\"type\":\"box\",\"width_m\":0.1,\"height_m\":0.1,\"layup\":[{\"material\":\"foam\","        \
    "\"thickness_m\":0.01}]}"
#define CONTOUR                                                                                    \
    "{\"type\":\"contour\",\"layups\":[{\"name\":\"a\",\"layup\":[{\"material\":\"foam\","         \
    "\"thickness_m\":0.01}]}],\"points\":[{\"x_m\":0,\"y_m\":0},{\"x_m\":1,\"y_m\":0}],"           \
    "\"walls\":[{\"from\":0,\"to\":1,\"layup\":\"a\"}]}"
#define HEAD(kind_, section_)                                                                      \
    "{\"schema_version\":1,\"kind\":\"" kind_ "\",\"beam\":{\"length_m\":1,\"section\":" section_

static void test_defaults(void **state)
{
    static const struct {
        const char *json;
        int defaults; /* shown in the canonical case */
    } minimal[] = {
        {HEAD("simulation", STRIP) "},\"flow\":{\"speed_m_s\":1},\"aerodynamics\":{\"polar\":"
                                   "\"plate-4pct-channel\"},\"solver\":{\"duration_s\":1}}",
         37},
        {HEAD("modes", BOX) ",\"masses\":[{\"z_m\":1,\"mass_kg\":1}]}}", 16},
        {HEAD("static", CONTOUR) "},\"loads\":{\"points\":[{\"z_m\":1}],\"lines\":[{}]}}", 29},
    };
    const struct fixture *f = *state;
    for (size_t i = 0; i < sizeof minimal / sizeof minimal[0]; i++) {
        struct failure_list *problems = calloc(1, sizeof *problems);
        struct api_case *c = NULL;
        struct cJSON *tree = NULL;
        struct failure fail;
        if (api_case_parse(f->fake->library, minimal[i].json, strlen(minimal[i].json), "", &c,
                           problems) != ST_OK) {
            fail_msg("%s: %s", problems->item[0].pointer, problems->item[0].detail);
        }
        const char *text = api_case_canonical(c);
        assert_int_equal(json_parse(text, strlen(text), &tree, &fail), ST_OK);
        const int n = check_defaults(f, schema_named(f, "Case"), tree);
        if (n != minimal[i].defaults) {
            fail_msg("%d defaults instead of %d in %s", n, minimal[i].defaults, text);
        }
        json_free(tree);
        api_case_destroy(c);
        free(problems);
    }
}

/* -- lists of words */

static void test_words(void **state)
{
    const struct fixture *f = *state;
    const char *problems[PROBLEM_COUNT + 1] = {NULL};
    const char *states[JOB_STATE_COUNT + 1] = {NULL};
    const char *kinds[JOB_KIND_COUNT + 1] = {NULL};
    for (int i = 0; i < PROBLEM_COUNT; i++) {
        problems[i] = problem_code((enum problem)i);
    }
    for (int i = 0; i < JOB_KIND_COUNT; i++) {
        kinds[i] = job_kind_name(i);
    }
    for (int i = 0; i < JOB_STATE_COUNT; i++) {
        states[i] = job_state_name((enum job_state)i);
    }
    check_names(schema_node(f->doc, "#/components/schemas/Problem/properties/code"), problems,
                "code");
    check_names(schema_node(f->doc, "#/components/schemas/Job/properties/state"), states, "state");
    check_names(schema_node(f->doc, "#/components/schemas/Job/properties/kind"), kinds, "kind");
    check_names(schema_node(f->doc, "#/components/schemas/Output/properties/channels/items"),
                channel_names, "channels");
}

/* -- examples */

/* The program and the schema agree on a text: both take it. */
static void check_admissible(const struct fixture *f, const char *text, size_t size)
{
    struct failure_list *problems = calloc(1, sizeof *problems);
    struct api_case *c = NULL;
    struct cJSON *tree = NULL;
    struct failure fail;
    char why[256];
    if (api_case_parse(f->fake->library, text, size, "", &c, problems) != ST_OK) {
        fail_msg("%s: %s", problems->item[0].pointer, problems->item[0].detail);
    }
    assert_int_equal(json_parse(text, size, &tree, &fail), ST_OK);
    if (!schema_check(f->doc, schema_named(f, "Case"), tree, why)) {
        fail_msg("%s: %s", api_case_def(c)->name, why);
    }
    json_free(tree);
    assert_int_equal(json_parse(api_case_canonical(c), strlen(api_case_canonical(c)), &tree, &fail),
                     ST_OK);
    if (!schema_check(f->doc, schema_named(f, "Case"), tree, why)) {
        fail_msg("canonical %s: %s", api_case_def(c)->name, why);
    }
    json_free(tree);
    api_case_destroy(c);
    free(problems);
}

static void test_examples(void **state)
{
    const struct fixture *f = *state;
    const cJSON *body = get(get(get(operation_of(f, "/v1/jobs", "POST"), "requestBody"), "content"),
                            "application/json");
    const cJSON *example = NULL, *one = NULL;
    int n = 0;
    cJSON_ArrayForEach(example, get(body, "examples"))
    {
        const cJSON *value = get(example, "value");
        const cJSON *jobs = get(value, "jobs");
        for (one = jobs != NULL ? jobs->child : value; one != NULL;
             one = jobs != NULL ? one->next : NULL, n++) {
            struct json_out out = {0};
            size_t size = 0;
            json_value(&out, one);
            char *text = json_out_take(&out, &size);
            check_admissible(f, text, size);
            free(text);
        }
    }
    assert_true(n >= 5);
    const char *text = NULL;
    size_t size = 0;
    for (n = 0; library_example_case(n, &text, &size) != NULL; n++) {
        check_admissible(f, text, size);
    }
    assert_true(n >= 3);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_routes), TEST(test_tables),   TEST(test_defaults),
        TEST(test_words),  TEST(test_examples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
