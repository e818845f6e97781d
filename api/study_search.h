/* api/study_search.h
 * What a study looks for in each of its cells beside the run of a case: members of the document,
 * their checks, and the axes they stand for. Inside api only. */
#ifndef AEROM_API_STUDY_SEARCH_H
#define AEROM_API_STUDY_SEARCH_H

#include "api/field.h"
#include "api/study_map.h"
#include "core/study/boundary.h"
#include "core/study/optimum.h"
#include "core/study/sampling.h"

struct study;

enum { STUDY_POINTER_SIZE = 160, STUDY_PATH_SIZE = 96, STUDY_QUANTILES_MAX = 16 };

/* The name of a result that stands for the boundary of the field. */
extern const char study_boundary_name[]; /* "boundary" */

/* The field whose boundary is sought. */
struct study_field {
    char pointer[STUDY_POINTER_SIZE]; /* "" = none */
    struct boundary_def def;
    /* Found by the checks. */
    struct cJSON *leaf; /* in the tree of the case */
    double own_value;
    bool structural;
};

/* Holds where a result is at least `level`, or the verdict is the one named. */
struct study_criterion {
    char value[STUDY_PATH_SIZE];
    double level;
    char verdict[24];
};

struct study_tolerance {
    char pointer[STUDY_POINTER_SIZE];
    int distribution; /* enum sampling_distribution */
    double spread;
};

struct study_variable {
    char pointer[STUDY_POINTER_SIZE];
    double from, to, start; /* start NaN: the middle */
};

struct study_constraint {
    char value[STUDY_PATH_SIZE];
    double min, max; /* NaN: no limit */
};

struct study_search {
    struct study_field field;
    struct study_criterion criterion;
    bool hysteresis;
    /* Uncertainty. */
    int n_tolerance;
    struct study_tolerance tolerance[STUDY_AXES_MAX];
    char result[STUDY_PATH_SIZE];
    int samples, method, seed; /* method: enum sampling_method */
    int n_quantile;
    double quantile[STUDY_QUANTILES_MAX];
    double confidence;
    /* Optimum; bounds and starts stand in the variables. */
    int n_variable;
    struct study_variable variable[STUDY_AXES_MAX];
    char maximise[STUDY_PATH_SIZE], minimise[STUDY_PATH_SIZE];
    int n_constraint;
    struct study_constraint constraint[OPTIMUM_CONSTRAINTS_MAX / 2];
    struct optimum_def optimum;
    int optimum_method; /* enum optimum_method */
};

void study_search_defaults(struct study_search *s);

/* Members of the tables study_fields is made of. */
extern const struct field study_part_field[], study_part_criterion[];
extern const struct field study_part_tolerance[], study_part_variable[], study_part_constraint[];
void study_read_flag(struct reader *r, const struct cJSON *json, void *study); /* hysteresis */
void study_write_flag(struct json_out *out, const void *study);
void study_start_variable(const struct reader *r, void *element);
void study_start_constraint(const struct reader *r, void *element);

/* Whether the answer of a cell is a boundary, or needs one. */
bool study_seeks_boundary(const struct study *s);
/* Whether a cell is more than the run of its case. */
bool study_seeks(const struct study *s);

/* The search for an optimum in the terms of the core, from the members read. */
void study_search_define(struct study *s);

/* Tolerances and variables as axes that go together, their values to be filled: before the checks
 * of the axes. False when out of memory. */
bool study_search_axes(struct study *s);
/* Fills them, once the case's own values are known. ST_NO_MEMORY or ST_OK. */
MUST_CHECK enum status study_search_fill(struct study *s);
/* Checks of the members together, and of the ends of the field in the case. ST_NO_MEMORY or ST_OK;
 * problems go to the reader's list. */
MUST_CHECK enum status study_search_check(struct study *s, struct reader *r);

/* The number a path leads to, as study_value does; infinite where an instability is said not to be
 * in the range of speeds ("flutter.speed_m_s" with "flutter": "none_in_range"). */
enum study_value_kind study_number(const struct cJSON *summary, const char *path, double *out);

/* The criterion judged by an answer. A status other than ST_OK: it says nothing, *code why. */
MUST_CHECK enum status study_judge(const struct study_criterion *c, const struct cJSON *summary,
                                   int *side, double *value, const char **code);

#endif
