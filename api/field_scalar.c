/* Single values of api/field.h: numbers, words, texts. */
#include "api/field_scalar.h"

#include <cjson/cJSON.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

bool field_expect(struct reader *r, bool fits, const char *what, const cJSON *got)
{
    if (!fits) {
        reader_problem(r, "wrong_type", what, got, "the value must be %s", what);
    }
    return fits;
}

int field_name_index(const char *const *names, const char *text)
{
    for (int i = 0; names[i] != NULL; i++) {
        if (strcmp(names[i], text) == 0) {
            return i;
        }
    }
    return -1;
}

void field_range_text(const struct field_range *range, size_t size, char *out)
{
    if (range->min == range->max) {
        (void)number_text(range->min, out);
        return;
    }
    char min[NUMBER_TEXT_SIZE + 8] = "", max[NUMBER_TEXT_SIZE + 8] = "", number[NUMBER_TEXT_SIZE];
    if (isfinite(range->min)) {
        (void)number_text(range->min, number);
        (void)snprintf(min, sizeof min, "%s %s ", number, range->above_min ? "<" : "<=");
    }
    if (isfinite(range->max)) {
        (void)number_text(range->max, number);
        (void)snprintf(max, sizeof max, " %s %s", range->below_max ? "<" : "<=", number);
    }
    (void)snprintf(out, size, "%sx%s", min, max);
}

static bool in_range(const struct field_range *range, double x)
{
    const bool low = range->above_min ? x > range->min : x >= range->min;
    const bool high = range->below_max ? x < range->max : x <= range->max;
    return low && high;
}

static bool check_range(struct reader *r, const struct field *f, const cJSON *json)
{
    char text[96];
    if (f->range == NULL || in_range(f->range, json->valuedouble)) {
        return true;
    }
    field_range_text(f->range, sizeof text, text);
    reader_problem(r, "out_of_range", text, json, "the value is outside its range %s", text);
    return false;
}

/* One number in SI. False when refused. */
bool field_read_number(struct reader *r, const struct field *f, const cJSON *json, double *out)
{
    /* A number that is not finite has been reported by json_check. */
    if (!field_expect(r, cJSON_IsNumber(json), "a number", json) || !isfinite(json->valuedouble) ||
        !check_range(r, f, json)) {
        return false;
    }
    *out = f->unit > 0.0 ? json->valuedouble * f->unit : json->valuedouble;
    return true;
}

void field_read_integer(struct reader *r, const struct field *f, const cJSON *json, int *out)
{
    const double x = cJSON_IsNumber(json) ? json->valuedouble : (double)NAN;
    if (isinf(x)) {
        return;
    }
    if (field_expect(r, x == floor(x) && fabs(x) <= INT_MAX, "an integer", json) &&
        check_range(r, f, json)) {
        *out = (int)x;
    }
}

/* Value of an enum by its name, -1 when refused. */
int field_read_name(struct reader *r, const char *const *names, const cJSON *json)
{
    char expected[128];
    if (!field_expect(r, cJSON_IsString(json), "a string", json)) {
        return -1;
    }
    const int index = field_name_index(names, json->valuestring);
    if (index < 0) {
        reader_join(names, sizeof expected, expected);
        reader_problem(r, "unknown_value", expected, json, "the value is not one of those known");
    }
    return index;
}

void field_read_text(struct reader *r, const struct field *f, const cJSON *json, char *out)
{
    if (!field_expect(r, cJSON_IsString(json), "a string", json)) {
        return;
    }
    const size_t length = strlen(json->valuestring);
    if (length >= f->size) {
        char expected[48];
        (void)snprintf(expected, sizeof expected, "at most %zu bytes", f->size - 1);
        reader_problem(r, "too_long", expected, json, "the text has %zu bytes", length);
    } else if (length == 0 && f->required) {
        reader_problem(r, "empty_text", "at least one character", json, "the text is empty");
    } else {
        memcpy(out, json->valuestring, length + 1);
    }
}
