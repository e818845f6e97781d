/* Some members of a large object without a tree of all the others. */
#include "api/json.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <string.h>

struct walk {
    const char *at, *end;
};

static bool skip_to(struct walk *w, char c)
{
    while (w->at < w->end &&
           (*w->at == ' ' || *w->at == '\n' || *w->at == '\t' || *w->at == '\r')) {
        w->at++;
    }
    return w->at < w->end && *w->at == c;
}

/* Over a string, from quote to behind quote. */
static bool skip_string(struct walk *w)
{
    for (w->at++; w->at < w->end; w->at++) {
        if (*w->at == '\\') {
            w->at++;
        } else if (*w->at == '"') {
            w->at++;
            return true;
        }
    }
    return false;
}

/* Over a value, to the comma or brace behind it. */
static bool skip_value(struct walk *w)
{
    for (int depth = 0; w->at < w->end;) {
        const char c = *w->at;
        if (c == '"') {
            if (!skip_string(w)) {
                return false;
            }
            continue;
        }
        if (depth == 0 && (c == ',' || c == '}')) {
            return true;
        }
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        w->at++;
    }
    return false;
}

static bool is_one_of(const char *key, size_t size, int n, const char *const *name)
{
    for (int i = 0; i < n; i++) {
        if (strlen(name[i]) == size && memcmp(name[i], key, size) == 0) {
            return true;
        }
    }
    return false;
}

static bool add(cJSON *object, const char *key, size_t key_size, const char *value, size_t size)
{
    char name[JSON_MEMBER_NAME_MAX + 1];
    cJSON *item = cJSON_ParseWithLengthOpts(value, size, NULL, false);
    memcpy(name, key, key_size);
    name[key_size] = '\0';
    if (item != NULL && !cJSON_AddItemToObject(object, name, item)) {
        cJSON_Delete(item);
        item = NULL;
    }
    return item != NULL;
}

/* The next member, entered when it is named. */
static bool read_member(struct walk *w, int n, const char *const *name, cJSON *object)
{
    if (!skip_to(w, '"')) {
        return false;
    }
    const char *key = w->at + 1;
    if (!skip_string(w)) {
        return false;
    }
    const size_t key_size = (size_t)(w->at - 1 - key);
    if (!skip_to(w, ':')) {
        return false;
    }
    const char *value = ++w->at;
    return skip_value(w) &&
           (key_size > JSON_MEMBER_NAME_MAX || !is_one_of(key, key_size, n, name) ||
            add(object, key, key_size, value, (size_t)(w->at - value)));
}

struct cJSON *json_parse_members(const char *text, size_t size, int n, const char *const *name)
{
    struct walk w = {.at = text, .end = text + size};
    cJSON *object = cJSON_CreateObject();
    bool ok = object != NULL && skip_to(&w, '{');
    bool more = ok;
    if (ok) {
        w.at++;
        more = !skip_to(&w, '}');
    }
    while (ok && more) {
        ok = read_member(&w, n, name, object);
        more = ok && *w.at == ',';
        w.at += more;
    }
    if (!ok) {
        cJSON_Delete(object);
        object = NULL;
    }
    return object;
}
