#include "api/study_map.h"

#include "api/json.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 160 };

const char *study_cell_state_name(enum study_cell_state s)
{
    static const char *const name[] = {"pending", "done", "failed"};
    assert((unsigned)s < sizeof name / sizeof name[0]);
    return name[s];
}

bool study_map_init(struct study_map *m)
{
    size_t n = 1;
    for (int d = 0; d < m->n_dimension; d++) {
        n *= (size_t)m->shape[d];
    }
    m->n_cell = (int)n;
    m->value = malloc(n * sizeof *m->value);
    m->status = calloc(n, sizeof *m->status);
    if (m->value == NULL || m->status == NULL) {
        study_map_done(m);
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        m->value[i] = (double)NAN;
    }
    return true;
}

void study_map_done(struct study_map *m)
{
    free(m->value);
    free(m->status);
    m->value = NULL;
    m->status = NULL;
}

int study_map_index(const struct study_map *m, int cell, int dimension)
{
    for (int d = m->n_dimension - 1; d > dimension; d--) {
        cell /= m->shape[d];
    }
    return cell % m->shape[dimension];
}

const char *study_map_class(const struct study_map *m, int cell)
{
    const double value = m->value[cell];
    return isfinite(value) ? m->class_name[(int)value] : "";
}

/* -- values of a summary ---------------------------------------------------------------- */

static const struct {
    const char *name, *path;
} short_names[] = {
    {"damping.tip_twist", "damping.tip_twist.torsion.ratio"},
    {"damping.tip_plunge", "damping.tip_plunge.roots.0.ratio"},
};

/* Stands for what a longer list would hold. */
static const cJSON nothing = {.type = cJSON_NULL};

/* The member or entry a part of a path names; NULL when no summary could have it. */
static const cJSON *step(const cJSON *at, const char *part)
{
    if (!cJSON_IsArray(at)) {
        return cJSON_GetObjectItemCaseSensitive(at, part);
    }
    char *end = NULL;
    const long index = strtol(part, &end, 10);
    const bool whole = part[0] >= '0' && part[0] <= '9' && *end == '\0' && index < 100000;
    const cJSON *entry = whole ? cJSON_GetArrayItem(at, (int)index) : NULL;
    return whole && entry == NULL ? &nothing : entry;
}

static const cJSON *follow(const cJSON *at, const char *path)
{
    char part[PATH_SIZE];
    while (at != NULL && !cJSON_IsNull(at) && *path != '\0') {
        const size_t n = strcspn(path, ".");
        (void)snprintf(part, sizeof part, "%.*s", (int)n, path);
        at = step(at, part);
        path += n;
        path += *path == '.';
    }
    return at;
}

/* The path a short name stands for; NULL for other names. */
static const char *path_of(const char *name)
{
    for (size_t i = 0; i < sizeof short_names / sizeof short_names[0]; i++) {
        if (strcmp(name, short_names[i].name) == 0) {
            return short_names[i].path;
        }
    }
    return NULL;
}

struct cJSON *study_value_parse(const char *summary, int n, const char *const *path)
{
    assert(n <= STUDY_PATHS_MAX);
    char part[STUDY_PATHS_MAX][PATH_SIZE];
    const char *name[STUDY_PATHS_MAX + 1] = {"means"};
    for (int i = 0; i < n; i++) {
        const char *whole = path_of(path[i]) != NULL ? path_of(path[i]) : path[i];
        (void)snprintf(part[i], PATH_SIZE, "%.*s", (int)strcspn(whole, "."), whole);
        name[i + 1] = part[i];
    }
    return json_parse_members(summary, strlen(summary), n + 1, name);
}

static const cJSON *find(const cJSON *summary, const char *path)
{
    if (path_of(path) != NULL) {
        return follow(summary, path_of(path));
    }
    const cJSON *found = follow(summary, path);
    if (found == NULL) {
        const bool mean = strncmp(path, "mean_", 5) == 0;
        const cJSON *means = cJSON_GetObjectItemCaseSensitive(summary, "means");
        found = follow(means, mean ? path + 5 : path);
    }
    return found;
}

enum study_value_kind study_value(const struct cJSON *summary, const char *path, double *number,
                                  const char **text)
{
    const cJSON *item = find(summary, path);
    if (item == NULL || cJSON_IsNull(item)) {
        return item == NULL ? STUDY_VALUE_ABSENT : STUDY_VALUE_MISSING;
    }
    if (cJSON_IsNumber(item) || cJSON_IsBool(item)) {
        *number = cJSON_IsNumber(item) ? item->valuedouble : (cJSON_IsTrue(item) ? 1.0 : 0.0);
        return STUDY_VALUE_NUMBER;
    }
    if (cJSON_IsString(item)) {
        *text = item->valuestring;
        return STUDY_VALUE_TEXT;
    }
    return STUDY_VALUE_NONE;
}

/* Index of a class, entered when it is new; -1 when there is no room. */
static int class_of(struct study_map *m, const char *text)
{
    char name[STUDY_CLASS_SIZE];
    (void)snprintf(name, sizeof name, "%s", text);
    for (int i = 0; i < m->n_class; i++) {
        if (strcmp(m->class_name[i], name) == 0) {
            return i;
        }
    }
    if (m->n_class == STUDY_CLASSES_MAX) {
        return -1;
    }
    memcpy(m->class_name[m->n_class], name, sizeof name);
    return m->n_class++;
}

enum study_value_kind study_map_set(struct study_map *m, int cell, enum study_cell_state state,
                                    const struct cJSON *summary)
{
    assert(cell >= 0);
    assert(cell < m->n_cell);
    double number = 0.0;
    const char *text = "";
    m->status[cell] = (unsigned char)state;
    if (state != STUDY_CELL_DONE || summary == NULL) {
        return STUDY_VALUE_MISSING;
    }
    const enum study_value_kind kind = study_value(summary, m->value_name, &number, &text);
    if (kind == STUDY_VALUE_NUMBER) {
        m->value[cell] = number;
    } else if (kind == STUDY_VALUE_TEXT) {
        const int index = class_of(m, text);
        m->value[cell] = index >= 0 ? index : (double)NAN;
    }
    return kind;
}

/* -- as JSON ---------------------------------------------------------------------------- */

void study_map_point(struct json_out *out, const struct study_map *m, int cell)
{
    for (int i = 0; i < m->n_axis; i++) {
        const struct study_axis_view *a = &m->axis[i];
        const int k = study_map_index(m, cell, a->dimension);
        if (a->value != NULL) {
            json_key_number(out, a->pointer, a->value[k]);
        } else {
            json_key_string(out, a->pointer, a->label[k]);
        }
    }
}

static void write_axis(struct json_out *out, const struct study_axis_view *a)
{
    json_object_begin(out);
    json_key_string(out, "pointer", a->pointer);
    json_key_integer(out, "dimension", a->dimension);
    if (a->value != NULL) {
        json_key_numbers(out, "values", a->n, a->value, 1, 1.0);
    } else {
        json_key(out, "values");
        json_array_begin(out);
        for (int i = 0; i < a->n; i++) {
            json_string(out, a->label[i]);
        }
        json_array_end(out);
    }
    json_object_end(out);
}

static void write_value(struct json_out *out, const struct study_map *m, int cell)
{
    if (m->n_class > 0 && isfinite(m->value[cell])) {
        json_string(out, study_map_class(m, cell));
    } else {
        json_number(out, m->value[cell]);
    }
}

static void write_status(struct json_out *out, const struct study_map *m, int cell)
{
    json_string(out, study_cell_state_name((enum study_cell_state)m->status[cell]));
}

/* Lists in lists, one level for each dimension; *cell counts on. Recursion is bounded by the number
 * of dimensions. */
static void write_nested(struct json_out *out, const struct study_map *m, int dimension, int *cell,
                         void (*write)(struct json_out *, const struct study_map *, int))
{
    if (dimension == m->n_dimension) {
        write(out, m, (*cell)++);
        return;
    }
    json_array_begin(out);
    for (int i = 0; i < m->shape[dimension]; i++) {
        write_nested(out, m, dimension + 1, cell, write);
    }
    json_array_end(out);
}

void study_map_members(struct json_out *out, const struct study_map *m)
{
    int cell = 0;
    json_key_string(out, "value", m->value_name);
    json_key(out, "axes");
    json_array_begin(out);
    for (int i = 0; i < m->n_axis; i++) {
        write_axis(out, &m->axis[i]);
    }
    json_array_end(out);
    json_key(out, "shape");
    json_array_begin(out);
    for (int d = 0; d < m->n_dimension; d++) {
        json_integer(out, m->shape[d]);
    }
    json_array_end(out);
    json_key(out, "values");
    write_nested(out, m, 0, &cell, write_value);
    cell = 0;
    json_key(out, "status");
    write_nested(out, m, 0, &cell, write_status);
}
