/* Reading side of api/field.h: lists and objects. */
#include "api/field.h"
#include "api/field_scalar.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *member(void *base, size_t offset)
{
    return (char *)base + offset;
}

/* Checks an array and its length; -1 when refused. */
static int array_length(struct reader *r, const struct field *f, const cJSON *json, int wanted)
{
    char expected[64];
    if (!field_expect(r, cJSON_IsArray(json), "an array", json)) {
        return -1;
    }
    const int n = cJSON_GetArraySize(json);
    if (wanted >= 0 && n != wanted) {
        (void)snprintf(expected, sizeof expected, "%d entries", wanted);
        reader_problem(r, "wrong_length", expected, json, "the list has %d entries", n);
        return -1;
    }
    if (wanted < 0 && (n < f->min || (f->max > 0 && n > f->max))) {
        (void)snprintf(expected, sizeof expected, "%d to %d entries", f->min, f->max);
        reader_problem(r, n == 0 ? "empty_list" : "wrong_length", expected, json,
                       n == 0 ? "the list is empty" : "the list has %d entries", n);
        return -1;
    }
    return n;
}

static bool read_numbers(struct reader *r, const struct field *f, const cJSON *json, double *out)
{
    bool ok = true;
    int i = 0;
    for (const cJSON *c = json->child; c != NULL; c = c->next, i++) {
        const size_t mark = reader_enter_index(r, i);
        ok = field_read_number(r, f, c, &out[i]) && ok;
        reader_leave(r, mark);
    }
    return ok;
}

static double *allocate(struct reader *r, int n)
{
    double *block = calloc(n > 0 ? (size_t)n : 1, sizeof *block);
    if (block == NULL) {
        reader_no_memory(r);
    }
    return block;
}

static void read_array(struct reader *r, const struct field *f, const cJSON *json, void *base)
{
    int *count = member(base, f->count);
    if (f->or_empty && cJSON_IsArray(json) && cJSON_GetArraySize(json) == 0) {
        return;
    }
    /* A count that could not be read has been reported; nothing can be checked against it. */
    const int n = f->sized && *count == 0 ? -1 : array_length(r, f, json, f->sized ? *count : -1);
    if (n < 0) {
        return;
    }
    if (f->kind == FIELD_ARRAY) {
        if (read_numbers(r, f, json, member(base, f->offset))) {
            *count = n;
        }
        return;
    }
    double **vector = member(base, f->offset);
    double *block = allocate(r, n);
    if (block != NULL && read_numbers(r, f, json, block)) {
        free(*vector);
        *vector = block;
        *count = n;
    } else {
        free(block);
    }
}

static void read_matrix(struct reader *r, const struct field *f, const cJSON *json, void *base)
{
    const int *columns = member(base, f->count);
    const int *rows = member(base, f->rows);
    double **matrix = member(base, f->offset);
    /* As above. */
    if (*columns == 0 || *rows == 0 || array_length(r, f, json, *rows) < 0) {
        return;
    }
    double *block = allocate(r, *rows * *columns);
    bool ok = block != NULL;
    int i = 0;
    for (const cJSON *c = json->child; block != NULL && c != NULL; c = c->next, i++) {
        const size_t mark = reader_enter_index(r, i);
        ok = array_length(r, f, c, *columns) >= 0 &&
             read_numbers(r, f, c, block + (ptrdiff_t)i * *columns) && ok;
        reader_leave(r, mark);
    }
    if (ok) {
        free(*matrix);
        *matrix = block;
    } else {
        free(block);
    }
}

/* Where the n elements of a list go; NULL when there is no memory (reported). */
static char *elements_of(struct reader *r, const struct field *f, int n, void *base)
{
    if (!f->owned) {
        return member(base, f->offset);
    }
    void *block = calloc(n > 0 ? (size_t)n : 1, f->size);
    if (block == NULL) {
        reader_no_memory(r);
        return NULL;
    }
    void *old = NULL;
    memcpy(&old, member(base, f->offset), sizeof old);
    memcpy(member(base, f->offset), &block, sizeof block);
    free(old);
    return block;
}

static void read_list(struct reader *r, const struct field *f, const cJSON *json, void *base)
{
    int *count = member(base, f->count);
    const int n = array_length(r, f, json, -1);
    char *element = n >= 0 ? elements_of(r, f, n, base) : NULL;
    if (element == NULL) {
        return;
    }
    int i = 0;
    for (const cJSON *c = json->child; c != NULL; c = c->next, i++) {
        const size_t mark = reader_enter_index(r, i);
        if (f->start != NULL) {
            f->start(r, element + (size_t)i * f->size);
        }
        field_read(r, f->fields, c, element + (size_t)i * f->size);
        reader_leave(r, mark);
    }
    *count = n;
}

static void read_names(struct reader *r, const struct field *f, const cJSON *json, void *base)
{
    int *count = member(base, f->count);
    int *value = member(base, f->offset);
    const int n = array_length(r, f, json, -1);
    int used = 0;
    const cJSON *c = n > 0 ? json->child : NULL;
    for (int i = 0; c != NULL; c = c->next, i++) {
        const size_t mark = reader_enter_index(r, i);
        const int name = field_read_name(r, f->names, c);
        bool twin = false;
        for (int j = 0; j < used; j++) {
            twin = twin || value[j] == name;
        }
        if (name >= 0 && twin) {
            reader_problem(r, "duplicate_value", "distinct names", c, "the name stands twice");
        } else if (name >= 0) {
            value[used++] = name;
        }
        reader_leave(r, mark);
    }
    if (n > 0) {
        *count = used;
    }
}

static void read_members(struct reader *r, const struct field *f, const struct field *fields,
                         const cJSON *json, void *base)
{
    const unsigned kind = r->kind;
    if (f->kinds != 0 && (f->kinds & kind) == 0) {
        r->kind = 0; /* it does not count here: nothing in it is required */
    }
    field_read(r, fields, json, base);
    if (f->finish != NULL && (json == NULL || cJSON_IsObject(json))) {
        f->finish(r, json, base);
    }
    r->kind = kind;
}

static void read_object(struct reader *r, const struct field *f, const cJSON *json, void *base)
{
    if (f->nullable) {
        bool *given = member(base, f->offset);
        if (cJSON_IsNull(json)) {
            *given = false;
            return;
        }
        *given = json != NULL || *given;
    }
    read_members(r, f, f->fields, json, base);
}

static void read_variant(struct reader *r, const struct field *f, const cJSON *json, void *part)
{
    if (!field_expect(r, cJSON_IsObject(json), "an object", json)) {
        return;
    }
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(json, "type");
    const size_t mark = reader_enter_key(r, "type");
    int variant = -1;
    if (type == NULL) {
        reader_problem(r, "required", "a value", NULL, "\"type\" is missing");
    } else {
        variant = field_read_name(r, f->names, type);
    }
    reader_leave(r, mark);
    /* Without its type nothing can be said about the rest. */
    if (variant >= 0) {
        f->choose(part, variant);
        read_members(r, f, f->variants[variant], json, part);
    }
}

void field_read_value(struct reader *r, const struct field *f, const struct cJSON *json, void *base)
{
    int name = -1;
    switch (f->kind) {
    case FIELD_NUMBER:
        (void)field_read_number(r, f, json, member(base, f->offset));
        break;
    case FIELD_INTEGER:
        field_read_integer(r, f, json, member(base, f->offset));
        break;
    case FIELD_ENUM:
        name = field_read_name(r, f->names, json);
        if (name >= 0) {
            memcpy(member(base, f->offset), &name, sizeof name);
        }
        break;
    case FIELD_BOOLEAN:
        if (field_expect(r, cJSON_IsBool(json), "true or false", json)) {
            *(bool *)member(base, f->offset) = cJSON_IsTrue(json);
        }
        break;
    case FIELD_TEXT:
        field_read_text(r, f, json, member(base, f->offset));
        break;
    case FIELD_OBJECT:
        read_object(r, f, json, base);
        break;
    case FIELD_PART:
        read_members(r, f, f->fields, json, member(base, f->offset));
        break;
    case FIELD_VARIANT:
        read_variant(r, f, json, member(base, f->offset));
        break;
    case FIELD_LIST:
        read_list(r, f, json, base);
        break;
    case FIELD_NAMES:
        read_names(r, f, json, base);
        break;
    case FIELD_ARRAY:
    case FIELD_VECTOR:
        read_array(r, f, json, base);
        break;
    case FIELD_MATRIX:
        read_matrix(r, f, json, base);
        break;
    case FIELD_CUSTOM:
        f->read(r, json, base);
        break;
    }
}

static void read_member(struct reader *r, const struct field *f, const cJSON *json, void *base)
{
    const bool applies = f->applies == NULL || f->applies(base);
    const bool counts = f->kinds == 0 || (f->kinds & r->kind) != 0;
    const bool required = f->required && counts && (f->optional & r->kind) == 0;
    if (json != NULL && !applies) {
        reader_problem(r, "unexpected", "no such member with the other values", json,
                       "the member does not apply here");
    } else if (json != NULL || (f->kind == FIELD_OBJECT && required && applies)) {
        field_read_value(r, f, json, base);
    } else if (required && f->kind != FIELD_OBJECT && applies && r->kind != 0) {
        reader_problem(r, "required", "a value", NULL, "\"%s\" is missing", f->key);
    }
}

static void report_unknown(struct reader *r, const struct field *fields, const cJSON *json)
{
    enum { KEYS_MAX = 32 };
    const char *names[KEYS_MAX + 1] = {NULL};
    for (int i = 0; fields[i].key != NULL; i++) {
        assert(i < KEYS_MAX);
        names[i] = fields[i].key;
    }
    for (const cJSON *c = json->child; c != NULL; c = c->next) {
        if (field_name_index(names, c->string) < 0) {
            char expected[128];
            reader_join(names, sizeof expected, expected);
            const size_t mark = reader_enter_key(r, c->string);
            reader_problem(r, "unknown_key", expected, c, "there is no such key here");
            reader_leave(r, mark);
        }
    }
}

void field_read(struct reader *r, const struct field *fields, const struct cJSON *json, void *base)
{
    if (json != NULL) {
        if (!field_expect(r, cJSON_IsObject(json), "an object", json)) {
            return;
        }
        report_unknown(r, fields, json);
    }
    for (const struct field *f = fields; f->key != NULL; f++) {
        const cJSON *item = json != NULL ? cJSON_GetObjectItemCaseSensitive(json, f->key) : NULL;
        const size_t mark = reader_enter_key(r, f->key);
        read_member(r, f, item, base);
        reader_leave(r, mark);
    }
}
