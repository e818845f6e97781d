/* api/study_map.h
 * One result of every cell of a study over the axes that were varied, ready to plot.
 *
 * A struct study_map is a plain value that owns its arrays; study_map_done frees them. Texts of the
 * axes are borrowed from the study it was made for. */
#ifndef AEROM_API_STUDY_MAP_H
#define AEROM_API_STUDY_MAP_H

#include "api/json_out.h"

#include <stdbool.h>
#include <stddef.h>

struct cJSON;

enum {
    STUDY_AXES_MAX = 8,
    STUDY_PATHS_MAX = 4,
    STUDY_CLASSES_MAX = 32, /* distinct texts of a result, e.g. verdicts */
    STUDY_CLASS_SIZE = 48
};

enum study_cell_state { STUDY_CELL_PENDING, STUDY_CELL_DONE, STUDY_CELL_FAILED };
const char *study_cell_state_name(enum study_cell_state s); /* "pending" "done" "failed" */

/* What varies along a dimension; zipped axes share theirs. */
struct study_axis_view {
    const char *pointer; /* into the case, "/flow/speed_m_s" */
    int dimension;
    int n;
    const double *value;      /* (n), in the unit of the document; NULL for texts */
    const char *const *label; /* (n); NULL for numbers */
};

/* Cells are counted from 0 with the last dimension fastest. */
struct study_map {
    const char *value_name; /* as it was asked for, "damping.tip_twist"; borrowed */
    int n_dimension;
    int shape[STUDY_AXES_MAX];
    int n_axis;
    struct study_axis_view axis[STUDY_AXES_MAX];
    int n_cell;
    double *value;         /* (n_cell); NaN where missing */
    unsigned char *status; /* (n_cell) enum study_cell_state */
    /* A result that is a text: value is the index of its class, in the order of first cells. */
    int n_class;
    char class_name[STUDY_CLASSES_MAX][STUDY_CLASS_SIZE];
};

/* Prepares a map of which axes and shape are set: everything missing and pending. False when out of
 * memory. */
bool study_map_init(struct study_map *m);
void study_map_done(struct study_map *m);

/* Place of a cell along a dimension. */
int study_map_index(const struct study_map *m, int cell, int dimension);
/* The text of a cell's result, "" where it is missing. Only of a map with classes. */
const char *study_map_class(const struct study_map *m, int cell);

/* What a path leads to in a summary. */
enum study_value_kind {
    STUDY_VALUE_ABSENT,  /* not there */
    STUDY_VALUE_MISSING, /* null */
    STUDY_VALUE_NUMBER,  /* also true and false: 1 and 0 */
    STUDY_VALUE_TEXT,
    STUDY_VALUE_NONE /* an object or an array: no value of a map */
};

/* Follows names and positions divided by dots, "modes.0.frequency_hz". Short names stand for
 * longer ones: "damping.tip_twist" for the ratio of its torsion root, "damping.tip_plunge" for that
 * of its first root, names of means without "means.", "mean_NAME" for "means.NAME". */
enum study_value_kind study_value(const struct cJSON *summary, const char *path, double *number,
                                  const char **text);

/* What of the text of a summary study_value needs for these paths, at most STUDY_PATHS_MAX; NULL:
 * the text is broken, or no memory. */
struct cJSON *study_value_parse(const char *summary, int n, const char *const *path);

/* Enters a finished cell and tells what its value is; a failed one has none (summary NULL) and
 * counts as missing, as does a text beyond the maximum of classes. */
enum study_value_kind study_map_set(struct study_map *m, int cell, enum study_cell_state state,
                                    const struct cJSON *summary);

/* Members of an object: the values of the axes at a cell, by pointer. */
void study_map_point(struct json_out *out, const struct study_map *m, int cell);

/* Members "value", "axes", "shape", "values" and "status", the last two as nested lists. */
void study_map_members(struct json_out *out, const struct study_map *m);

#endif
