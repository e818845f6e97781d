/* Members of the document that say what is sought in each cell. */
#include "api/study_fields.h"

#include <cjson/cJSON.h>
#include <math.h>

const char study_boundary_name[] = "boundary";

static const char *const distribution_names[] = {"uniform", "normal", NULL};
_Static_assert(SAMPLING_NORMAL == 1 && SAMPLING_DISTRIBUTIONS == 2, "names in order");

static const struct field_range any = {.min = -HUGE_VAL, .max = HUGE_VAL};
static const struct field_range positive = {.min = 0.0, .max = HUGE_VAL, .above_min = true};
static const struct field_range not_negative = {.min = 0.0, .max = HUGE_VAL};
static const struct field_range scans = {.min = 2, .max = BOUNDARY_SCAN_MAX};
static const struct field_range samples = {.min = 3, .max = BOUNDARY_SAMPLES_MAX};

#define TEXT_AT(struct_, member_)                                                                  \
    .kind = FIELD_TEXT, .offset = offsetof(struct struct_, member_),                               \
    .size = sizeof(((struct struct_ *)0)->member_)

const struct field study_part_field[] = {
    {.key = "pointer", .required = true, TEXT_AT(study_field, pointer)},
    {.key = "from",
     .kind = FIELD_NUMBER,
     .required = true,
     .range = &any,
     .offset = offsetof(struct study_field, def.from)},
    {.key = "to",
     .kind = FIELD_NUMBER,
     .required = true,
     .range = &any,
     .offset = offsetof(struct study_field, def.to)},
    {.key = "tolerance",
     .kind = FIELD_NUMBER,
     .required = true,
     .range = &positive,
     .offset = offsetof(struct study_field, def.tolerance)},
    {.key = "scan",
     .kind = FIELD_INTEGER,
     .range = &scans,
     .offset = offsetof(struct study_field, def.scan)},
    {.key = "evaluations_max",
     .kind = FIELD_INTEGER,
     .range = &samples,
     .offset = offsetof(struct study_field, def.evaluations_max)},
    {0},
};

static bool is_by_verdict(const void *base)
{
    return ((const struct study_criterion *)base)->value[0] == '\0';
}

static bool is_by_value(const void *base)
{
    return !is_by_verdict(base);
}

const struct field study_part_criterion[] = {
    {.key = "value", .omit = is_by_verdict, TEXT_AT(study_criterion, value)},
    {.key = "level",
     .kind = FIELD_NUMBER,
     .range = &any,
     .offset = offsetof(struct study_criterion, level),
     .applies = is_by_value,
     .omit = is_by_verdict},
    {.key = "verdict", .omit = is_by_value, TEXT_AT(study_criterion, verdict)},
    {0},
};

const struct field study_part_tolerance[] = {
    {.key = "pointer", .required = true, TEXT_AT(study_tolerance, pointer)},
    {.key = "distribution",
     .kind = FIELD_ENUM,
     .offset = offsetof(struct study_tolerance, distribution),
     .names = distribution_names},
    {.key = "spread",
     .kind = FIELD_NUMBER,
     .required = true,
     .range = &not_negative,
     .offset = offsetof(struct study_tolerance, spread)},
    {0},
};

static bool has_no_start(const void *base)
{
    return !isfinite(((const struct study_variable *)base)->start);
}

const struct field study_part_variable[] = {
    {.key = "pointer", .required = true, TEXT_AT(study_variable, pointer)},
    {.key = "from",
     .kind = FIELD_NUMBER,
     .required = true,
     .range = &any,
     .offset = offsetof(struct study_variable, from)},
    {.key = "to",
     .kind = FIELD_NUMBER,
     .required = true,
     .range = &any,
     .offset = offsetof(struct study_variable, to)},
    {.key = "start",
     .kind = FIELD_NUMBER,
     .range = &any,
     .offset = offsetof(struct study_variable, start),
     .omit = has_no_start},
    {0},
};

void study_start_variable(const struct reader *r, void *element)
{
    (void)r;
    ((struct study_variable *)element)->start = (double)NAN;
}

static bool has_no_min(const void *base)
{
    return !isfinite(((const struct study_constraint *)base)->min);
}

static bool has_no_max(const void *base)
{
    return !isfinite(((const struct study_constraint *)base)->max);
}

const struct field study_part_constraint[] = {
    {.key = "value", .required = true, TEXT_AT(study_constraint, value)},
    {.key = "min",
     .kind = FIELD_NUMBER,
     .range = &any,
     .offset = offsetof(struct study_constraint, min),
     .omit = has_no_min},
    {.key = "max",
     .kind = FIELD_NUMBER,
     .range = &any,
     .offset = offsetof(struct study_constraint, max),
     .omit = has_no_max},
    {0},
};

void study_start_constraint(const struct reader *r, void *element)
{
    struct study_constraint *c = element;
    (void)r;
    c->min = c->max = (double)NAN;
}

void study_read_flag(struct reader *r, const struct cJSON *json, void *study)
{
    if (!cJSON_IsBool(json)) {
        reader_problem(r, "wrong_type", "true or false", json, "the value must be true or false");
        return;
    }
    ((struct study *)study)->search.hysteresis = cJSON_IsTrue(json);
}

void study_write_flag(struct json_out *out, const void *study)
{
    json_boolean(out, ((const struct study *)study)->search.hysteresis);
}
