/* api/study.h
 * A study document: one case and what is varied in it, by JSON pointers -> checked axes, canonical
 * text and identity; and the case of each cell.
 *
 * A struct study owns its case as a tree whose varied values are set cell by cell, so it belongs to
 * one thread. Library entries are borrowed: the library must outlive it. Cells are counted from 0
 * with the last dimension fastest. */
#ifndef AEROM_API_STUDY_H
#define AEROM_API_STUDY_H

#include "api/case.h"
#include "api/study_map.h"

struct study;

enum { STUDY_CELLS_MAX = 100000 };
enum study_type { STUDY_GRID, STUDY_BOUNDARY, STUDY_OPTIMUM, STUDY_UNCERTAINTY };

/* Whether a document says that it is a study, by its "kind". */
bool study_is_one(const struct cJSON *tree);

/* Parses and checks everything that can be known before work starts: the case, the pointers, the
 * ranges, each varied value alone in the case (at most 1000 of an axis), and the corners of the
 * ranges together. On failure *out is unchanged and *problems says what is wrong where. */
MUST_CHECK enum status study_from_tree(const struct library *lib, const struct cJSON *tree,
                                       struct study **out, struct failure_list *problems);
/* The same from text. */
MUST_CHECK enum status study_parse(const struct library *lib, const char *json, size_t size,
                                   struct study **out, struct failure_list *problems);
/* A canonical text that was accepted before: its cells are not tried again. */
MUST_CHECK enum status study_open(const struct library *lib, const char *canonical,
                                  struct study **out, struct failure_list *problems);
void study_destroy(struct study *s);

const char *study_name(const struct study *s);
enum study_type study_type_of(const struct study *s);
enum case_kind study_case_kind(const struct study *s);
/* Canonical JSON, every default of the case filled in. */
const char *study_canonical(const struct study *s);
char *study_take_canonical(struct study *s);
/* BLAKE2b-256 over the canonical text without labels and the identity of its cases. */
const char *study_hash(const struct study *s);
int study_cells(const struct study *s);

/* How the cells are best computed: in the order of study_cell_at, where those on the same structure
 * (section, beam, modes) are `run` neighbours, in units of at most `unit` of a run, about a second
 * of work. */
struct study_plan {
    int n_cell, run, unit;
};
struct study_plan study_plan_of(const struct study *s);
/* Cell at a place of that order; 0 <= place < study_cells. */
int study_cell_at(const struct study *s, int place);

/* The value a map shows when none is named: "verdict", "boundary" or "objective". */
const char *study_main_value(const struct study *s);
/* The field whose boundary a study of that type seeks; NULL for another type. */
const char *study_field_pointer(const struct study *s);
/* Axes and shape of a map, without values. They borrow from the study. */
void study_map_axes(const struct study *s, struct study_map *out);

/* Members "cell" and "point" of an object: a cell and the values of the axes there. */
void study_point(struct json_out *out, const struct study *s, int cell);

/* The case of a cell. A cell that is not admissible: ST_INVALID with its problems. */
MUST_CHECK enum status study_case(struct study *s, int cell, struct api_case **out,
                                  struct failure_list *problems);
/* Whether two cells have the same section, beam and modes. */
bool study_same_structure(const struct study *s, int a, int b);

#endif
