/* api/study_fields.h
 * The study document as field tables, and the struct they fill. Inside api only. */
#ifndef AEROM_API_STUDY_FIELDS_H
#define AEROM_API_STUDY_FIELDS_H

#include "api/field.h"
#include "api/study.h"
#include "api/study_search.h"

/* One varied member. */
struct study_axis {
    char pointer[160];
    double from, to; /* NaN when a list is given */
    int count;       /* 0 when a list is given */
    char zip[32];    /* "" = crossed with all others */
    bool listed;     /* the values were given, even if they could not be read */
    int n;
    double *value; /* (n), NULL for texts; owned */
    char **label;  /* (n), NULL for numbers; owned with its texts */
    /* Found by the checks. */
    int dimension;
    bool structural;    /* decides section, beam or modes */
    struct cJSON *leaf; /* in the tree of the case */
    double own_value;   /* what the case has there */
    char *own_label;    /* owned */
};

struct study {
    int schema_version;
    int kind; /* index of study_kind_names */
    int type; /* enum study_type */
    char name[sizeof((struct case_def *)0)->name];
    const struct library *library;
    char *base; /* canonical case, owned; NULL when it could not be read */
    char base_hash[LIMIT_HASH];
    enum case_kind case_kind;
    double cost_s; /* rough processor time of a cell */
    int n_axis;
    struct study_axis axis[STUDY_AXES_MAX];
    struct study_search search;
    struct cJSON *tree; /* of `base`, with the values of the cell looked at last; owned */
    int n_dimension, shape[STUDY_AXES_MAX];
    int n_cell;
    char *canonical; /* owned */
    char hash[LIMIT_HASH];
};

/* Bits of `kinds`. Which members a type of study has is told by `applies` alone. */
enum study_group {
    STUDY_BODY = 1u << 0,     /* what makes the identity */
    STUDY_LABEL = 1u << 1,    /* what does not count for it */
    STUDY_IN_SEARCH = 1u << 2 /* what is sought in a cell */
};

extern const char *const study_kind_names[]; /* "study"; ends with NULL */
extern const char *const study_type_names[]; /* of enum study_type */
extern const struct field study_fields[];    /* of struct study; r->context is the study itself */

#endif
