#include "tests/api/schema_check.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const cJSON *get(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

const struct cJSON *schema_node(const struct cJSON *document, const char *reference)
{
    const cJSON *node = document;
    const char *at = reference + 1; /* after '#' */
    while (node != NULL && *at == '/') {
        char key[128];
        size_t n = 0;
        for (at++; *at != '\0' && *at != '/' && n + 1 < sizeof key; at++) {
            key[n] = *at;
            if (*at == '~') { /* RFC 6901 */
                at++;
                key[n] = *at == '1' ? '/' : '~';
            }
            n++;
        }
        key[n] = '\0';
        node = get(node, key);
    }
    return node;
}

const struct cJSON *schema_resolve(const struct cJSON *document, const struct cJSON *schema)
{
    const cJSON *reference = get(schema, "$ref");
    while (reference != NULL) {
        schema = schema_node(document, reference->valuestring);
        reference = get(schema, "$ref");
    }
    return schema;
}

struct check {
    const cJSON *document;
    char *why; /* 256 bytes */
};

static bool fits(struct check *c, const cJSON *schema, const cJSON *value, const char *place);

static bool no(struct check *c, const char *place, const char *keyword)
{
    (void)snprintf(c->why, 256, "%s: %s", place, keyword);
    return false;
}

static bool is_of_type(const cJSON *value, const char *type)
{
    const struct {
        const char *name;
        bool is;
    } types[] = {
        {"object", cJSON_IsObject(value)},
        {"array", cJSON_IsArray(value)},
        {"string", cJSON_IsString(value)},
        {"number", cJSON_IsNumber(value)},
        {"integer", cJSON_IsNumber(value) && value->valuedouble == floor(value->valuedouble)},
        {"boolean", cJSON_IsBool(value)},
        {"null", cJSON_IsNull(value)},
    };
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (strcmp(types[i].name, type) == 0) {
            return types[i].is;
        }
    }
    return false;
}

static bool check_type(const cJSON *types, const cJSON *value)
{
    if (cJSON_IsString(types)) {
        return is_of_type(value, types->valuestring);
    }
    const cJSON *type = NULL;
    cJSON_ArrayForEach(type, types)
    {
        if (is_of_type(value, type->valuestring)) {
            return true;
        }
    }
    return false;
}

static bool check_enum(const cJSON *list, const cJSON *value)
{
    const cJSON *allowed = NULL;
    cJSON_ArrayForEach(allowed, list)
    {
        if (cJSON_Compare(allowed, value, true)) {
            return true;
        }
    }
    return false;
}

/* Numbers and lengths; a keyword that is not about the value's type holds. */
static bool check_bound(const char *keyword, double bound, const cJSON *value)
{
    const double x = value->valuedouble;
    const int n = cJSON_IsArray(value) ? cJSON_GetArraySize(value) : 0;
    const size_t length = cJSON_IsString(value) ? strlen(value->valuestring) : 0;
    const struct {
        const char *name;
        bool about, holds;
    } bounds[] = {
        {"minimum", cJSON_IsNumber(value), x >= bound},
        {"maximum", cJSON_IsNumber(value), x <= bound},
        {"exclusiveMinimum", cJSON_IsNumber(value), x > bound},
        {"exclusiveMaximum", cJSON_IsNumber(value), x < bound},
        {"minItems", cJSON_IsArray(value), n >= bound},
        {"maxItems", cJSON_IsArray(value), n <= bound},
        {"minLength", cJSON_IsString(value), (double)length >= bound},
        {"maxLength", cJSON_IsString(value), (double)length <= bound},
    };
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        if (strcmp(bounds[i].name, keyword) == 0) {
            return !bounds[i].about || bounds[i].holds;
        }
    }
    return false; /* an unknown keyword */
}

static bool check_pattern(const char *pattern, const cJSON *value)
{
    regex_t r;
    if (!cJSON_IsString(value)) {
        return true;
    }
    if (regcomp(&r, pattern, REG_EXTENDED | REG_NOSUB) != 0) {
        return false;
    }
    const bool ok = regexec(&r, value->valuestring, 0, NULL, 0) == 0;
    regfree(&r);
    return ok;
}

static bool check_members(struct check *c, const cJSON *schema, const cJSON *value,
                          const char *place)
{
    const cJSON *properties = get(schema, "properties");
    const cJSON *others = get(schema, "additionalProperties");
    const cJSON *member = NULL;
    cJSON_ArrayForEach(member, value)
    {
        char inner[160];
        (void)snprintf(inner, sizeof inner, "%.100s/%.50s", place, member->string);
        const cJSON *own = get(properties, member->string);
        if ((own != NULL || others != NULL) &&
            !fits(c, own != NULL ? own : others, member, inner)) {
            return false;
        }
    }
    return true;
}

static bool check_items(struct check *c, const cJSON *items, const cJSON *value, const char *place)
{
    int i = 0;
    for (const cJSON *e = cJSON_IsArray(value) ? value->child : NULL; e != NULL; e = e->next, i++) {
        char inner[160];
        (void)snprintf(inner, sizeof inner, "%.140s/%d", place, i);
        if (!fits(c, items, e, inner)) {
            return false;
        }
    }
    return true;
}

static bool check_required(const cJSON *list, const cJSON *value)
{
    const cJSON *name = NULL;
    cJSON_ArrayForEach(name, list)
    {
        if (cJSON_IsObject(value) && get(value, name->valuestring) == NULL) {
            return false;
        }
    }
    return true;
}

static int count_fitting(struct check *c, const cJSON *list, const cJSON *value, const char *place)
{
    int n = 0;
    const cJSON *schema = NULL;
    cJSON_ArrayForEach(schema, list)
    {
        n += fits(c, schema, value, place);
    }
    return n;
}

/* if, then and else belong together. */
static bool check_condition(struct check *c, const cJSON *schema, const cJSON *value,
                            const char *place)
{
    const bool holds = fits(c, get(schema, "if"), value, place);
    const cJSON *branch = get(schema, holds ? "then" : "else");
    return branch == NULL || fits(c, branch, value, place);
}

static bool check_keyword(struct check *c, const cJSON *schema, const cJSON *k, const cJSON *value,
                          const char *place)
{
    static const char *const notes[] = {"description", "default", "format",
                                        "uniqueItems", "then",    "else"};
    const char *name = k->string;
    for (size_t i = 0; i < sizeof notes / sizeof notes[0]; i++) {
        if (strcmp(notes[i], name) == 0) {
            return true;
        }
    }
    if (strcmp(name, "$ref") == 0) {
        const cJSON *target = schema_node(c->document, k->valuestring);
        return target != NULL && fits(c, target, value, place);
    }
    if (strcmp(name, "type") == 0) {
        return check_type(k, value);
    }
    if (strcmp(name, "enum") == 0) {
        return check_enum(k, value);
    }
    if (strcmp(name, "const") == 0) {
        return cJSON_Compare(k, value, true);
    }
    if (strcmp(name, "required") == 0) {
        return check_required(k, value);
    }
    if (strcmp(name, "properties") == 0 || strcmp(name, "additionalProperties") == 0) {
        return !cJSON_IsObject(value) || check_members(c, schema, value, place);
    }
    if (strcmp(name, "items") == 0) {
        return check_items(c, k, value, place);
    }
    if (strcmp(name, "pattern") == 0) {
        return check_pattern(k->valuestring, value);
    }
    if (strcmp(name, "allOf") == 0) {
        return count_fitting(c, k, value, place) == cJSON_GetArraySize(k);
    }
    if (strcmp(name, "anyOf") == 0) {
        return count_fitting(c, k, value, place) >= 1;
    }
    if (strcmp(name, "oneOf") == 0) {
        return count_fitting(c, k, value, place) == 1;
    }
    if (strcmp(name, "if") == 0) {
        return check_condition(c, schema, value, place);
    }
    return cJSON_IsNumber(k) && check_bound(name, k->valuedouble, value);
}

static bool fits(struct check *c, const cJSON *schema, const cJSON *value, const char *place)
{
    if (cJSON_IsBool(schema)) {
        return cJSON_IsTrue(schema) || no(c, place, "not allowed");
    }
    const cJSON *k = NULL;
    cJSON_ArrayForEach(k, schema)
    {
        c->why[0] = '\0';
        if (!check_keyword(c, schema, k, value, place)) {
            /* The innermost reason is the telling one. */
            return c->why[0] != '\0' ? false : no(c, place, k->string);
        }
    }
    return true;
}

bool schema_check(const struct cJSON *document, const struct cJSON *schema,
                  const struct cJSON *value, char why[256])
{
    struct check c = {.document = document, .why = why};
    why[0] = '\0';
    return fits(&c, schema, value, "");
}
