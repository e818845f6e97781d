/* Members of a study document. */
#include "api/study_fields.h"

#include "api/json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const study_kind_names[] = {"study", NULL};
const char *const study_type_names[] = {[STUDY_GRID] = "grid",
                                        [STUDY_BOUNDARY] = "boundary",
                                        [STUDY_OPTIMUM] = "optimum",
                                        [STUDY_UNCERTAINTY] = "uncertainty",
                                        NULL};

/* -- values of an axis ------------------------------------------------------------------ */

static bool read_entry(struct reader *r, const cJSON *c, int i, struct study_axis *a)
{
    if (a->value != NULL && cJSON_IsNumber(c)) {
        a->value[i] = c->valuedouble;
    } else if (a->label != NULL && cJSON_IsString(c)) {
        a->label[i] = strdup(c->valuestring);
        if (a->label[i] == NULL) {
            reader_no_memory(r);
            return false;
        }
    } else {
        const char *what = a->value != NULL ? "a number" : "a text";
        reader_problem(r, "wrong_type", what, c, "the value must be %s, as the first one", what);
        return false;
    }
    return true;
}

static void read_values(struct reader *r, const struct cJSON *json, void *base)
{
    struct study_axis *a = base;
    a->listed = true;
    const int n = cJSON_IsArray(json) ? cJSON_GetArraySize(json) : -1;
    if (n < 0) {
        reader_problem(r, "wrong_type", "an array", json, "the value must be an array");
        return;
    }
    if (n == 0 || n > STUDY_CELLS_MAX) {
        reader_problem(r, n == 0 ? "empty_list" : "wrong_length", "1 to 100000 values", json,
                       "the list has %d entries", n);
        return;
    }
    if (cJSON_IsString(json->child)) {
        a->label = calloc((size_t)n, sizeof *a->label);
    } else {
        a->value = calloc((size_t)n, sizeof *a->value);
    }
    if (a->label == NULL && a->value == NULL) {
        reader_no_memory(r);
        return;
    }
    a->n = n;
    int i = 0;
    for (const cJSON *c = json->child; c != NULL; c = c->next, i++) {
        const size_t mark = reader_enter_index(r, i);
        const bool read = read_entry(r, c, i, a);
        reader_leave(r, mark);
        if (!read) {
            return;
        }
    }
}

static void write_values(struct json_out *out, const void *base)
{
    const struct study_axis *a = base;
    json_array_begin(out);
    for (int i = 0; i < a->n; i++) {
        if (a->value != NULL) {
            json_number(out, a->value[i]);
        } else {
            json_string(out, a->label[i]);
        }
    }
    json_array_end(out);
}

static void start_axis(const struct reader *r, void *element)
{
    struct study_axis *a = element;
    (void)r;
    a->from = a->to = (double)NAN;
}

static bool is_range(const void *base)
{
    return !((const struct study_axis *)base)->listed;
}

static bool is_list(const void *base)
{
    return ((const struct study_axis *)base)->listed;
}

static bool is_crossed(const void *base)
{
    return ((const struct study_axis *)base)->zip[0] == '\0';
}

static const struct field_range counts = {.min = 1, .max = STUDY_CELLS_MAX};

static const struct field axis_fields[] = {
    {.key = "pointer",
     .kind = FIELD_TEXT,
     .required = true,
     .offset = offsetof(struct study_axis, pointer),
     .size = sizeof((struct study_axis *)0)->pointer},
    {.key = "from",
     .kind = FIELD_NUMBER,
     .offset = offsetof(struct study_axis, from),
     .omit = is_list},
    {.key = "to", .kind = FIELD_NUMBER, .offset = offsetof(struct study_axis, to), .omit = is_list},
    {.key = "count",
     .kind = FIELD_INTEGER,
     .offset = offsetof(struct study_axis, count),
     .range = &counts,
     .omit = is_list},
    {.key = "values",
     .kind = FIELD_CUSTOM,
     .read = read_values,
     .write = write_values,
     .omit = is_range},
    {.key = "zip",
     .kind = FIELD_TEXT,
     .offset = offsetof(struct study_axis, zip),
     .size = sizeof((struct study_axis *)0)->zip,
     .omit = is_crossed},
    {0},
};

/* -- the case --------------------------------------------------------------------------- */

/* Rough processor time of a run, to cut a study in units [s]. */
static double cost_of(const struct case_def *def)
{
    static const double step_and_station = 3e-7, speed_and_station = 2e-5, other = 2e-3;
    const double stations = def->beam.elements;
    if (def->kind == CASE_SIMULATION) {
        return other + step_and_station * case_def_steps(def) * stations;
    }
    return def->kind == CASE_STABILITY ? other + speed_and_station * def->stability.count * stations
                                       : other;
}

static void read_case(struct reader *r, const struct cJSON *json, void *base)
{
    struct study *s = base;
    struct api_case *c = NULL;
    if (api_case_from_tree(s->library, json, r->pointer, &c, r->problems) != ST_OK) {
        return; /* reported */
    }
    const struct case_def *def = api_case_def(c);
    if (def->kind == CASE_TRAINING) { /* it leaves a network, not a summary to compare */
        reader_problem(r, "unexpected", "a case of any other kind", NULL,
                       "a study has no cases of kind \"training\"");
        api_case_destroy(c);
        return;
    }
    s->case_kind = def->kind;
    s->cost_s = cost_of(def);
    memcpy(s->base_hash, api_case_hash(c), sizeof s->base_hash);
    free(s->base);
    s->base = api_case_take_canonical(c);
    api_case_destroy(c);
}

static void write_case(struct json_out *out, const void *base)
{
    json_raw(out, ((const struct study *)base)->base);
}

/* -- the document ----------------------------------------------------------------------- */

static const struct field_range samples = {.min = 1, .max = STUDY_CELLS_MAX};
static const struct field_range seeds = {.min = 0, .max = 2147483647.0};
static const struct field_range shares = {
    .min = 0.0, .max = 1.0, .above_min = true, .below_max = true};
static const struct field_range starts = {.min = 1, .max = OPTIMUM_STARTS_MAX};
static const struct field_range evaluations = {.min = 3, .max = OPTIMUM_EVALUATIONS_MAX};
static const struct field_range tolerances = {.min = 1e-8, .max = 0.5};

static const char *const sampling_names[] = {"latin_hypercube", "sobol", NULL};
_Static_assert(SAMPLING_SOBOL == 1 && SAMPLING_METHODS == 2, "names in order");
static const char *const method_names[] = {"cobyla", "direct", NULL};
_Static_assert(OPTIMUM_DIRECT == 1 && OPTIMUM_METHODS == 2, "names in order");

static bool is_grid(const void *base)
{
    return ((const struct study *)base)->type == STUDY_GRID;
}

static bool is_no_grid(const void *base)
{
    return !is_grid(base);
}

static bool is_boundary(const void *base)
{
    return ((const struct study *)base)->type == STUDY_BOUNDARY;
}

static bool is_optimum(const void *base)
{
    return ((const struct study *)base)->type == STUDY_OPTIMUM;
}

static bool is_uncertainty(const void *base)
{
    return ((const struct study *)base)->type == STUDY_UNCERTAINTY;
}

static bool has_no_field(const void *base)
{
    return ((const struct study *)base)->search.field.pointer[0] == '\0';
}

static bool is_maximised(const void *base)
{
    return ((const struct study *)base)->search.maximise[0] != '\0';
}

static bool is_minimised(const void *base)
{
    return !is_maximised(base);
}

static const struct field_range version = {.min = 1, .max = 1};

#define AT(member_) offsetof(struct study, member_)
#define AXES(key_, applies_)                                                                       \
    {                                                                                              \
        .key = (key_), .kind = FIELD_LIST, .kinds = STUDY_BODY, .required = true,                  \
        .offset = AT(axis), .size = sizeof(struct study_axis), .fields = axis_fields,              \
        .count = AT(n_axis), .min = 1, .max = STUDY_AXES_MAX, .start = start_axis,                 \
        .applies = (applies_)                                                                      \
    }
/* Rows of struct study_search. */
#define MEMBER(key_, kind_, member_, kinds_, applies_, ...)                                        \
    {                                                                                              \
        .key = (key_), .kind = (kind_), .kinds = (kinds_), .offset = AT(search.member_),           \
        .applies = (applies_), __VA_ARGS__                                                         \
    }
#define LIST(key_, member_, kinds_, applies_, max_, ...)                                           \
    MEMBER(key_, FIELD_LIST, member_, kinds_, applies_, .size = sizeof(struct study_##member_),    \
           .fields = study_part_##member_, .count = AT(search.n_##member_), .max = (max_),         \
           __VA_ARGS__)

/* A member of a cell's search belongs to the body as well. */
enum { BODY = STUDY_BODY, SEARCH = STUDY_BODY | STUDY_IN_SEARCH };

const struct field study_fields[] = {
    {.key = "schema_version",
     .kind = FIELD_INTEGER,
     .required = true,
     .offset = AT(schema_version),
     .range = &version},
    {.key = "kind",
     .kind = FIELD_ENUM,
     .required = true,
     .offset = AT(kind),
     .names = study_kind_names},
    {.key = "type",
     .kind = FIELD_ENUM,
     .required = true,
     .offset = AT(type),
     .names = study_type_names},
    {.key = "name",
     .kind = FIELD_TEXT,
     .kinds = STUDY_LABEL,
     .offset = AT(name),
     .size = sizeof((struct study *)0)->name},
    {.key = "case",
     .kind = FIELD_CUSTOM,
     .kinds = STUDY_BODY | STUDY_LABEL,
     .required = true,
     .read = read_case,
     .write = write_case},
    AXES("vary", is_grid),
    AXES("over", is_boundary),
    MEMBER("field", FIELD_PART, field, SEARCH, is_no_grid, .fields = study_part_field,
           .omit = has_no_field),
    MEMBER("criterion", FIELD_PART, criterion, SEARCH, is_no_grid, .fields = study_part_criterion,
           .omit = has_no_field),
    {.key = "hysteresis",
     .kind = FIELD_CUSTOM,
     .kinds = SEARCH,
     .read = study_read_flag,
     .write = study_write_flag,
     .applies = is_boundary},
    LIST("tolerances", tolerance, BODY, is_uncertainty, STUDY_AXES_MAX, .required = true, .min = 1),
    MEMBER("result", FIELD_TEXT, result, BODY, is_uncertainty, .size = STUDY_PATH_SIZE),
    MEMBER("samples", FIELD_INTEGER, samples, BODY, is_uncertainty, .range = &samples),
    MEMBER("sampling", FIELD_ENUM, method, BODY, is_uncertainty, .names = sampling_names),
    MEMBER("seed", FIELD_INTEGER, seed, BODY, is_uncertainty, .range = &seeds),
    MEMBER("quantiles", FIELD_ARRAY, quantile, BODY, is_uncertainty, .count = AT(search.n_quantile),
           .range = &shares, .min = 1, .max = STUDY_QUANTILES_MAX),
    MEMBER("confidence", FIELD_NUMBER, confidence, BODY, is_uncertainty, .range = &shares),
    LIST("variables", variable, SEARCH, is_optimum, STUDY_AXES_MAX, .required = true, .min = 1,
         .start = study_start_variable),
    MEMBER("maximise", FIELD_TEXT, maximise, SEARCH, is_optimum, .size = STUDY_PATH_SIZE,
           .omit = is_minimised),
    MEMBER("minimise", FIELD_TEXT, minimise, SEARCH, is_optimum, .size = STUDY_PATH_SIZE,
           .omit = is_maximised),
    LIST("constraints", constraint, SEARCH, is_optimum, OPTIMUM_CONSTRAINTS_MAX / 2,
         .start = study_start_constraint),
    MEMBER("method", FIELD_ENUM, optimum_method, SEARCH, is_optimum, .names = method_names),
    MEMBER("starts", FIELD_INTEGER, optimum.starts, SEARCH, is_optimum, .range = &starts),
    MEMBER("evaluations_max", FIELD_INTEGER, optimum.evaluations_max, SEARCH, is_optimum,
           .range = &evaluations),
    MEMBER("tolerance", FIELD_NUMBER, optimum.tolerance, SEARCH, is_optimum, .range = &tolerances),
    {0},
};
