#include "api/drive_fields.h"

#include "core/case_def.h"

#include <cjson/cJSON.h>
#include <math.h>

static const struct field_range positive = {.min = 0.0, .max = INFINITY, .above_min = true};
static const struct field_range not_negative = {.min = 0.0, .max = INFINITY};

/* By the enums of core. */
const char *const drive_type_names[] = {[DRIVE_SINE] = "sine", [DRIVE_TABLE] = "table", NULL};
const char *const gust_type_names[] = {[GUST_ONE_MINUS_COSINE] = "one_minus_cosine",
                                       [GUST_STEP] = "step",
                                       [GUST_TABLE] = "table",
                                       NULL};

#define NUMBER(struct_, key_, member_, ...)                                                        \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .offset = offsetof(struct struct_, member_),          \
        __VA_ARGS__                                                                                \
    }
#define TYPE(struct_, names_)                                                                      \
    {                                                                                              \
        .key = "type", .kind = FIELD_ENUM, .required = true,                                       \
        .offset = offsetof(struct struct_, type), .names = (names_)                                \
    }
/* Times, and as many values. */
#define TABLE(struct_, key_, member_, ...)                                                         \
    {.key = "time_s",                                                                              \
     .kind = FIELD_ARRAY,                                                                          \
     .required = true,                                                                             \
     .offset = offsetof(struct struct_, time),                                                     \
     .count = offsetof(struct struct_, n),                                                         \
     .min = 2,                                                                                     \
     .max = LIMIT_TABLE,                                                                           \
     .range = &not_negative},                                                                      \
    {                                                                                              \
        .key = (key_), .kind = FIELD_ARRAY, .required = true,                                      \
        .offset = offsetof(struct struct_, member_), .count = offsetof(struct struct_, n),         \
        .sized = true, __VA_ARGS__                                                                 \
    }
/* What is the same of either motion. */
#define SINE                                                                                       \
    NUMBER(drive_def, "frequency_hz", frequency, .required = true, .range = &positive),            \
        NUMBER(drive_def, "phase_deg", phase, .unit = FIELD_DEGREE),                               \
        NUMBER(drive_def, "start_s", start, .range = &not_negative),                               \
        NUMBER(drive_def, "ramp_s", ramp, .range = &positive)

static const struct field pitch_sine[] = {
    TYPE(drive_def, drive_type_names),
    NUMBER(drive_def, "amplitude_deg", amplitude, .required = true, .unit = FIELD_DEGREE),
    SINE,
    {0},
};
static const struct field pitch_table[] = {
    TYPE(drive_def, drive_type_names),
    TABLE(drive_def, "angle_deg", value, .unit = FIELD_DEGREE),
    {0},
};
static const struct field plunge_sine[] = {
    TYPE(drive_def, drive_type_names),
    NUMBER(drive_def, "amplitude_m", amplitude, .required = true),
    SINE,
    {0},
};
static const struct field plunge_table[] = {
    TYPE(drive_def, drive_type_names),
    TABLE(drive_def, "displacement_m", value, .unit = 1.0),
    {0},
};

const struct field *const pitch_variants[] = {
    [DRIVE_SINE] = pitch_sine, [DRIVE_TABLE] = pitch_table};
const struct field *const plunge_variants[] = {
    [DRIVE_SINE] = plunge_sine, [DRIVE_TABLE] = plunge_table};

void drive_choose(void *drive, int type)
{
    drive_defaults((enum drive_type)type, drive);
}

void drive_finish(struct reader *r, const struct cJSON *json, void *drive)
{
    (void)r;
    (void)json;
    drive_complete(drive);
}

static bool has_no_length(const void *base)
{
    return !(((const struct gust_def *)base)->length > 0.0);
}

static bool has_no_duration(const void *base)
{
    return !(((const struct gust_def *)base)->duration > 0.0);
}

static const struct field gust_cosine[] = {
    TYPE(gust_def, gust_type_names),
    NUMBER(gust_def, "amplitude_m_s", amplitude, .required = true),
    NUMBER(gust_def, "start_s", start, .range = &not_negative),
    NUMBER(gust_def, "length_m", length, .range = &positive, .omit = has_no_length),
    NUMBER(gust_def, "duration_s", duration, .range = &positive, .omit = has_no_duration),
    {0},
};
static const struct field gust_step[] = {
    TYPE(gust_def, gust_type_names),
    NUMBER(gust_def, "amplitude_m_s", amplitude, .required = true),
    NUMBER(gust_def, "start_s", start, .range = &not_negative),
    {0},
};
static const struct field gust_table[] = {
    TYPE(gust_def, gust_type_names),
    TABLE(gust_def, "velocity_m_s", velocity, .unit = 1.0),
    {0},
};

const struct field *const gust_variants[] = {
    [GUST_ONE_MINUS_COSINE] = gust_cosine, [GUST_STEP] = gust_step, [GUST_TABLE] = gust_table};

void gust_choose(void *gust, int type)
{
    *(struct gust_def *)gust = (struct gust_def){.given = true, .type = (enum gust_type)type};
}

void gust_finish(struct reader *r, const struct cJSON *json, void *gust)
{
    if (((const struct gust_def *)gust)->type != GUST_ONE_MINUS_COSINE) {
        return;
    }
    const bool length = cJSON_GetObjectItemCaseSensitive(json, "length_m") != NULL;
    const bool duration = cJSON_GetObjectItemCaseSensitive(json, "duration_s") != NULL;
    if (length == duration) {
        const size_t mark = reader_enter_key(r, "length_m");
        reader_problem(
            r, length ? "given_twice" : "required", "either \"length_m\" or \"duration_s\"", NULL,
            length ? "the length of the gust is given twice" : "the length of the gust is missing");
        reader_leave(r, mark);
    }
}
