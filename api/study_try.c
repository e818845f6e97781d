/* What of a study's cells can be known before they are computed: their cases are parsed. */
#include "api/json.h"
#include "api/study_axes.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Text of the values a trial has set, "/flow/speed_m_s = -1, ..."; `moved` are the axes set. */
static void describe_trial(const struct study *s, unsigned moved, size_t size, char *out)
{
    size_t used = 0;
    out[0] = '\0';
    for (int i = 0; i < s->n_axis && used < size; i++) {
        if ((moved >> i & 1u) != 0) {
            char value[64];
            json_describe(s->axis[i].leaf, sizeof value, value);
            used += (size_t)snprintf(out + used, size - used, "%s%s = %s", used > 0 ? ", " : "",
                                     s->axis[i].pointer, value);
        }
    }
}

static bool is_under(const char *inner, const char *outer)
{
    const size_t n = strlen(outer);
    return strncmp(inner, outer, n) == 0 && (inner[n] == '\0' || inner[n] == '/');
}

/* One problem for a trial that is refused: at the axis it is about, or else the first one moved. */
static void report_trial(const struct study *s, struct reader *r, unsigned moved,
                         const struct failure *why)
{
    char trial[200], got[64] = "", pointer[32];
    int about = -1;
    for (int i = s->n_axis - 1; i >= 0; i--) {
        if ((moved >> i & 1u) != 0 && is_under(why->pointer, s->axis[i].pointer)) {
            about = i;
        }
    }
    for (int i = 0; about < 0 && i < s->n_axis; i++) {
        about = (moved >> i & 1u) != 0 ? i : about;
    }
    describe_trial(s, moved, sizeof trial, trial);
    json_describe(s->axis[about].leaf, sizeof got, got);
    (void)snprintf(pointer, sizeof pointer, "/%s/%d", study_axes_key(s), about);
    failure_set(failure_add(r->problems), ST_INVALID, pointer, why->code, why->expected, got,
                "with %s: %s: %s", trial, why->pointer, why->detail);
}

/* Whether the tree as it stands is a case; reports when it is not. ST_NO_MEMORY or ST_OK. */
static enum status try_case(const struct study *s, struct reader *r, unsigned moved,
                            struct json_out *identity, bool *good)
{
    struct api_case *c = NULL;
    struct failure_list *found = calloc(1, sizeof *found);
    if (found == NULL) {
        return ST_NO_MEMORY;
    }
    enum status st = api_case_from_tree(s->library, s->tree, "", &c, found);
    *good = st == ST_OK;
    if (st == ST_OK) {
        json_string(identity, api_case_hash(c));
        api_case_destroy(c);
    } else if (st == ST_INVALID) {
        report_trial(s, r, moved, &found->item[0]);
        st = ST_OK;
    }
    free(found);
    return st;
}

/* Sets all axes along a dimension; returns their bits. False in *ok: no memory. */
static unsigned set_dimension(const struct study *s, int dimension, int k, bool *ok)
{
    unsigned moved = 0;
    for (int i = 0; i < s->n_axis; i++) {
        if (s->axis[i].dimension == dimension) {
            *ok = study_axis_set(&s->axis[i], k) && *ok;
            moved |= 1u << i;
        }
    }
    return moved;
}

/* Back to the values the case came with. */
static bool restore(const struct study *s, int dimension)
{
    bool ok = true;
    for (int i = 0; i < s->n_axis; i++) {
        const struct study_axis *a = &s->axis[i];
        if (a->dimension == dimension && a->value != NULL) {
            (void)cJSON_SetNumberHelper(a->leaf, a->own_value);
        } else if (a->dimension == dimension) {
            ok = cJSON_SetValuestring(a->leaf, a->own_label) != NULL && ok;
        }
    }
    return ok;
}

/* Values of one dimension, the others as in the case: at most `TRIALS` of them, ends included. The
 * first bad one ends it. */
static enum status try_dimension(struct study *s, struct reader *r, int dimension,
                                 struct json_out *identity)
{
    enum { TRIALS = 1000 };
    const int n = s->shape[dimension], trials = n < TRIALS ? n : TRIALS;
    bool ok = true, good = true;
    enum status st = ST_OK;
    for (int t = 0; st == ST_OK && good && t < trials; t++) {
        const int k = trials > 1 ? (int)((long long)t * (n - 1) / (trials - 1)) : 0;
        const unsigned moved = set_dimension(s, dimension, k, &ok);
        st = ok ? try_case(s, r, moved, identity, &good) : ST_NO_MEMORY;
    }
    return st == ST_OK && !restore(s, dimension) ? ST_NO_MEMORY : st;
}

static enum status try_corners(struct study *s, struct reader *r, struct json_out *identity)
{
    enum status st = ST_OK;
    bool ok = true, good = true;
    for (unsigned corner = 0; st == ST_OK && good && corner < 1u << s->n_dimension; corner++) {
        unsigned moved = 0;
        for (int d = 0; d < s->n_dimension; d++) {
            const bool last = (corner >> d & 1u) != 0;
            moved |= set_dimension(s, d, last ? s->shape[d] - 1 : 0, &ok);
        }
        st = ok ? try_case(s, r, moved, identity, &good) : ST_NO_MEMORY;
    }
    return st;
}

enum status study_axes_try(struct study *s, struct reader *r, struct json_out *identity)
{
    enum status st = ST_OK;
    for (int d = 0; st == ST_OK && d < s->n_dimension; d++) {
        st = try_dimension(s, r, d, identity);
    }
    if (st == ST_OK && r->problems->total == 0 && s->n_dimension > 1) {
        st = try_corners(s, r, identity);
    }
    return st;
}

enum status study_try_field(struct study *s, struct reader *r)
{
    const struct study_field *f = &s->search.field;
    const double ends[] = {f->def.from, f->def.to};
    static const char *const names[] = {"from", "to"};
    struct failure_list *found = calloc(1, sizeof *found);
    enum status st = found != NULL ? ST_OK : ST_NO_MEMORY;
    for (int i = 0; st == ST_OK && i < 2; i++) {
        struct api_case *c = NULL;
        (void)cJSON_SetNumberHelper(f->leaf, ends[i]);
        found->count = found->total = 0;
        st = api_case_from_tree(s->library, s->tree, "", &c, found);
        api_case_destroy(c);
        if (st == ST_INVALID) {
            const struct failure *why = &found->item[0];
            char pointer[32], got[32];
            (void)snprintf(pointer, sizeof pointer, "/field/%s", names[i]);
            (void)snprintf(got, sizeof got, "%.9g", ends[i]);
            failure_set(failure_add(r->problems), ST_INVALID, pointer, why->code, why->expected,
                        got, "with %.120s = %.9g: %.80s: %.160s", f->pointer, ends[i], why->pointer,
                        why->detail);
            st = ST_OK;
        }
    }
    (void)cJSON_SetNumberHelper(f->leaf, f->own_value);
    free(found);
    return st;
}
