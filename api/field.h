/* api/field.h
 * Tables that tie JSON members to members of a struct: one row per member reads it, checks type,
 * range and presence, and prints it in canonical form. Tables are constant; the functions keep no
 * state. What no single member can tell (cross-field rules) belongs to the core's checks. */
#ifndef AEROM_API_FIELD_H
#define AEROM_API_FIELD_H

#include "api/json_out.h"
#include "api/reader.h"
#include "core/num.h"

#include <stdbool.h>
#include <stddef.h>

enum field_kind {
    FIELD_NUMBER,  /* double */
    FIELD_INTEGER, /* int */
    FIELD_ENUM,    /* an enum that counts from 0 in the order of `names` */
    FIELD_BOOLEAN, /* bool */
    FIELD_TEXT,    /* char[size] */
    FIELD_OBJECT,  /* members of the same struct, listed by `fields` */
    FIELD_PART,    /* the same of the struct inside, at `offset` */
    FIELD_VARIANT, /* like PART, with the table of its "type": `variants` in the order of `names` */
    FIELD_LIST,    /* array of objects of `size` bytes each */
    FIELD_NAMES,   /* array of distinct enum values, see FIELD_ENUM */
    FIELD_ARRAY,   /* double[] inside the struct */
    FIELD_VECTOR,  /* double *, malloc'ed, replaced when read */
    FIELD_MATRIX,  /* double *, malloc'ed: `rows` lists of `count` numbers, entries fastest */
    FIELD_CUSTOM   /* `read` and `write` do it */
};

#define FIELD_DEGREE (NUM_PI / 180.0)

/* Interval of a number in the unit of the document. */
struct field_range {
    double min, max;           /* -+INFINITY where there is no limit */
    bool above_min, below_max; /* the limit itself is excluded */
};

/* One member. Unused entries stay zero. */
struct field {
    const char *key;
    enum field_kind kind;
    unsigned kinds; /* kinds of document the member counts in (bits), 0 = all */
    size_t offset;  /* in the struct */
    size_t size;    /* TEXT: bytes with the zero; LIST: bytes of an element */
    double unit;    /* unit of the document in SI, 0 = 1 */
    const struct field_range *range;
    const char *const *names;   /* ENUM, NAMES, VARIANT: ends with NULL */
    const struct field *fields; /* OBJECT, PART, LIST; CUSTOM: what it reads, for the contract */
    const struct field *const *variants;
    size_t count; /* offset of the int that counts entries (MATRIX: of a row) */
    size_t rows;  /* MATRIX: offset of the int that counts rows */
    int min, max; /* entries allowed */
    /* Where it applies, in the kinds it counts in. A required OBJECT that is absent is read as an
     * empty one, so that each missing member is named. */
    bool required;
    unsigned optional; /* kinds of document (bits) in which a required member may be absent */
    bool nullable;     /* OBJECT: `offset` is that of a bool, false when the value is null */
    bool sized;        /* ARRAY, VECTOR: the count is known already and must be met */
    bool or_empty;     /* sized ARRAY: an empty list stands for zeros */
    bool owned; /* LIST: at `offset` is a pointer to the elements, malloc'ed, replaced when read */
    /* Whether the member may be given at all, judged by members before it; NULL = always. */
    bool (*applies)(const void *base);
    /* Not printed when true; NULL = always printed where it applies. */
    bool (*omit)(const void *base);
    /* VARIANT: sets what the type decides, before the members are read. */
    void (*choose)(void *part, int variant);
    /* LIST: sets the defaults of an element; NULL = zeros. */
    void (*start)(const struct reader *r, void *element);
    /* OBJECT, PART, VARIANT: what members say only together, after they were read; json is an
     * object, or NULL for an absent one. */
    void (*finish)(struct reader *r, const struct cJSON *json, void *base);
    /* CUSTOM; json is not NULL. */
    void (*read)(struct reader *r, const struct cJSON *json, void *base);
    void (*write)(struct json_out *out, const void *base);
};

/* Reads an object into *base, which holds the defaults. json NULL means an absent object. */
void field_read(struct reader *r, const struct field *fields, const struct cJSON *json, void *base);

/* Reads or prints the value of one member, for CUSTOM members that hold one. */
void field_read_value(struct reader *r, const struct field *f, const struct cJSON *json,
                      void *base);
void field_write_value(struct json_out *out, const struct field *f, unsigned kind,
                       const void *base);

/* Prints the object with every member that counts in `kind` (bits as in struct reader). */
void field_write(struct json_out *out, const struct field *fields, unsigned kind, const void *base);

/* Same, without the brackets, inside an object already begun. */
void field_write_members(struct json_out *out, const struct field *fields, unsigned kind,
                         const void *base);

/* "0 < x <= 1" for people. */
void field_range_text(const struct field_range *range, size_t size, char *out);

/* Index of a text in a list that ends with NULL, -1 when it is not there. */
int field_name_index(const char *const *names, const char *text);

#endif
