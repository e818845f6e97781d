/* Printing side of api/field.h. */
#include "api/field.h"

#include <string.h>

static const void *member(const void *base, size_t offset)
{
    return (const char *)base + offset;
}

static void write_number(struct json_out *out, const struct field *f, double value)
{
    json_number_in_unit(out, value, f->unit > 0.0 ? f->unit : 1.0);
}

static void write_numbers(struct json_out *out, const struct field *f, int n, const double *value)
{
    json_array_begin(out);
    for (int i = 0; i < n; i++) {
        write_number(out, f, value[i]);
    }
    json_array_end(out);
}

static int count_at(const void *base, size_t offset)
{
    int n = 0;
    memcpy(&n, member(base, offset), sizeof n);
    return n;
}

static const double *pointer_at(const void *base, size_t offset)
{
    const double *p = NULL;
    memcpy(&p, member(base, offset), sizeof p);
    return p;
}

static void write_list(struct json_out *out, const struct field *f, unsigned kind, const void *base)
{
    const char *element = member(base, f->offset);
    if (f->owned) {
        memcpy(&element, member(base, f->offset), sizeof element);
    }
    json_array_begin(out);
    for (int i = 0; i < count_at(base, f->count); i++) {
        field_write(out, f->fields, kind, element + (size_t)i * f->size);
    }
    json_array_end(out);
}

static void write_matrix(struct json_out *out, const struct field *f, const void *base)
{
    const int columns = count_at(base, f->count);
    const double *value = pointer_at(base, f->offset);
    json_array_begin(out);
    for (int i = 0; i < count_at(base, f->rows); i++) {
        write_numbers(out, f, columns, value + (ptrdiff_t)i * columns);
    }
    json_array_end(out);
}

static void write_names(struct json_out *out, const struct field *f, const void *base)
{
    json_array_begin(out);
    for (int i = 0; i < count_at(base, f->count); i++) {
        json_string(out, f->names[count_at(base, f->offset + (size_t)i * sizeof(int))]);
    }
    json_array_end(out);
}

void field_write_value(struct json_out *out, const struct field *f, unsigned kind, const void *base)
{
    switch (f->kind) {
    case FIELD_NUMBER:
        write_number(out, f, *(const double *)member(base, f->offset));
        break;
    case FIELD_INTEGER:
        json_integer(out, count_at(base, f->offset));
        break;
    case FIELD_ENUM:
        json_string(out, f->names[count_at(base, f->offset)]);
        break;
    case FIELD_BOOLEAN:
        json_boolean(out, *(const bool *)member(base, f->offset));
        break;
    case FIELD_TEXT:
        json_string(out, member(base, f->offset));
        break;
    case FIELD_OBJECT:
        if (f->nullable && !*(const bool *)member(base, f->offset)) {
            json_null(out);
        } else {
            field_write(out, f->fields, kind, base);
        }
        break;
    case FIELD_PART:
        field_write(out, f->fields, kind, member(base, f->offset));
        break;
    case FIELD_VARIANT:
        /* The enum stands where the table has its "type". */
        field_write(out, f->variants[count_at(member(base, f->offset), f->variants[0]->offset)],
                    kind, member(base, f->offset));
        break;
    case FIELD_LIST:
        write_list(out, f, kind, base);
        break;
    case FIELD_NAMES:
        write_names(out, f, base);
        break;
    case FIELD_ARRAY:
        write_numbers(out, f, count_at(base, f->count), member(base, f->offset));
        break;
    case FIELD_VECTOR:
        write_numbers(out, f, count_at(base, f->count), pointer_at(base, f->offset));
        break;
    case FIELD_MATRIX:
        write_matrix(out, f, base);
        break;
    case FIELD_CUSTOM:
        f->write(out, base);
        break;
    }
}

void field_write_members(struct json_out *out, const struct field *fields, unsigned kind,
                         const void *base)
{
    for (const struct field *f = fields; f->key != NULL; f++) {
        const bool counts = f->kinds == 0 || (f->kinds & kind) != 0;
        const bool omitted = f->omit != NULL && f->omit(base);
        if (counts && !omitted && (f->applies == NULL || f->applies(base))) {
            json_key(out, f->key);
            field_write_value(out, f, kind, base);
        }
    }
}

void field_write(struct json_out *out, const struct field *fields, unsigned kind, const void *base)
{
    json_object_begin(out);
    field_write_members(out, fields, kind, base);
    json_object_end(out);
}
