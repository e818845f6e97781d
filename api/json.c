#include "api/json.h"

#include "api/json_out.h"
#include "api/reader.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum status json_parse(const char *text, size_t size, struct cJSON **out, struct failure *fail)
{
    assert(out != NULL);
    enum status st = json_scan(text, size, fail);
    if (st != ST_OK) {
        return st;
    }
    /* What passed the scan is well-formed: only memory can fail here. */
    cJSON *tree = cJSON_ParseWithLengthOpts(text, size, NULL, false);
    if (tree == NULL) {
        failure_set(fail, ST_NO_MEMORY, "", "no_memory", NULL, NULL, "%s",
                    status_text(ST_NO_MEMORY));
        return ST_NO_MEMORY;
    }
    *out = tree;
    return ST_OK;
}

void json_free(struct cJSON *tree)
{
    cJSON_Delete(tree);
}

static bool has_twin_before(const cJSON *object, const cJSON *member)
{
    for (const cJSON *m = object->child; m != member; m = m->next) {
        if (strcmp(m->string, member->string) == 0) {
            return true;
        }
    }
    return false;
}

static void check_members(struct reader *r, const cJSON *object)
{
    int n = 0;
    for (const cJSON *m = object->child; m != NULL; m = m->next) {
        if (++n > JSON_MEMBERS_MAX) {
            reader_problem(r, "too_many_members", "at most 128 members", object,
                           "object has too many members");
            return;
        }
        if (has_twin_before(object, m)) {
            const size_t mark = reader_enter_key(r, m->string);
            reader_problem(r, "duplicate_key", "one member of this name", m,
                           "the key stands twice in its object");
            reader_leave(r, mark);
        }
    }
}

/* Recursion is bounded by JSON_DEPTH_MAX. */
void json_check(struct reader *r, const struct cJSON *tree)
{
    if (cJSON_IsNumber(tree) && !isfinite(tree->valuedouble)) {
        reader_problem(r, "not_finite", "a number within +-1.8e308", NULL,
                       "the number is beyond double precision");
    }
    if (cJSON_IsObject(tree)) {
        check_members(r, tree);
    }
    int index = 0;
    for (const cJSON *c = tree->child; c != NULL; c = c->next, index++) {
        if (cJSON_IsString(c)) {
            continue;
        }
        const size_t mark =
            c->string != NULL ? reader_enter_key(r, c->string) : reader_enter_index(r, index);
        json_check(r, c);
        reader_leave(r, mark);
    }
}

/* Recursion is bounded by JSON_DEPTH_MAX. */
void json_value(struct json_out *out, const struct cJSON *value)
{
    if (cJSON_IsNumber(value)) {
        json_number(out, value->valuedouble);
    } else if (cJSON_IsString(value)) {
        json_string(out, value->valuestring);
    } else if (cJSON_IsBool(value)) {
        json_boolean(out, cJSON_IsTrue(value));
    } else if (cJSON_IsNull(value)) {
        json_null(out);
    } else if (cJSON_IsArray(value)) {
        json_array_begin(out);
        for (const cJSON *c = value->child; c != NULL; c = c->next) {
            json_value(out, c);
        }
        json_array_end(out);
    } else {
        json_object_begin(out);
        for (const cJSON *c = value->child; c != NULL; c = c->next) {
            json_key(out, c->string);
            json_value(out, c);
        }
        json_object_end(out);
    }
}

void json_describe(const struct cJSON *value, size_t size, char *out)
{
    char number[NUMBER_TEXT_SIZE] = "a number that is not finite";
    if (cJSON_IsString(value)) {
        (void)snprintf(out, size, strlen(value->valuestring) < size - 3 ? "\"%s\"" : "\"%.60s...\"",
                       value->valuestring);
        return;
    }
    if (cJSON_IsNumber(value) && isfinite(value->valuedouble)) {
        (void)number_text(value->valuedouble, number);
    }
    const char *text = cJSON_IsNumber(value)  ? number
                       : cJSON_IsTrue(value)  ? "true"
                       : cJSON_IsFalse(value) ? "false"
                       : cJSON_IsNull(value)  ? "null"
                       : cJSON_IsArray(value) ? "an array"
                                              : "an object";
    if (cJSON_IsArray(value)) {
        (void)snprintf(out, size, "%s of %d", text, cJSON_GetArraySize(value));
    } else {
        (void)snprintf(out, size, "%s", text);
    }
}
