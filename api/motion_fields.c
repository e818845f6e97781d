#include "api/motion_fields.h"

#include "api/case_fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct field_range half_turn = {.min = -180.0, .max = 180.0};
static const struct field_range amplitude = {.min = 0.0, .max = 180.0};
static const struct field_range chords = {.min = 0.0, .max = 10.0};
static const struct field_range frequency = {.min = 0.0, .max = 10.0, .above_min = true};
static const struct field_range positive = {.min = 0.0, .max = INFINITY, .above_min = true};
static const struct field_range cycles = {.min = 1, .max = LOOP_CYCLES_MAX};
static const struct field_range steps = {.min = LOOP_STEPS_MIN, .max = LOOP_STEPS_MAX};

const char *const motion_type_names[] = {
    [MOTION_SINE] = "sine", [MOTION_TABLE] = "table", [MOTION_TYPES] = NULL};

#define AT(member_) offsetof(struct motion_entry, member_)
#define TYPE                                                                                       \
    {                                                                                              \
        .key = "type", .kind = FIELD_ENUM, .required = true, .offset = AT(type),                   \
        .names = motion_type_names                                                                 \
    }
#define NUMBER(key_, member_, ...)                                                                 \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .offset = AT(def.member_), __VA_ARGS__                \
    }
#define INTEGER(key_, member_, range_)                                                             \
    {                                                                                              \
        .key = (key_), .kind = FIELD_INTEGER, .offset = AT(def.member_), .range = &(range_)        \
    }

static const struct field sine_fields[] = {
    TYPE,
    NUMBER("mean_deg", mean, .unit = FIELD_DEGREE, .range = &half_turn),
    NUMBER("amplitude_deg", amplitude, .unit = FIELD_DEGREE, .range = &amplitude),
    NUMBER("plunge_c", plunge, .unit = 1.0, .range = &chords),
    NUMBER("phase_deg", phase, .unit = FIELD_DEGREE),
    NUMBER("frequency_c_v", frequency, .required = true, .range = &frequency),
    INTEGER("cycles", cycles, cycles),
    INTEGER("steps", steps, steps),
    {0},
};

static bool has_no_plunge(const void *base)
{
    return ((const struct motion_entry *)base)->n_row[MOTION_W] == 0;
}

#define ROW(key_, row_, ...)                                                                       \
    {                                                                                              \
        .key = (key_), .kind = FIELD_VECTOR, .offset = AT(row[row_]), __VA_ARGS__                  \
    }
#define COUNTED .min = 2, .max = LOOP_SAMPLES_MAX
#define PLUNGE(key_, row_) ROW(key_, row_, .count = AT(n_row[row_]), .omit = has_no_plunge, COUNTED)

/* The first row says how many samples there are; those of the plunge come together, or not. */
static const struct field table_fields[] = {
    TYPE,
    {.key = "step_c_v",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = AT(table.step),
     .range = &positive},
    ROW("alpha_deg", MOTION_THETA, .required = true, .count = AT(n), COUNTED),
    ROW("alpha_dot", MOTION_THETA_RATE, .required = true, .count = AT(n), .sized = true),
    ROW("alpha_ddot", MOTION_THETA_ACCELERATION, .required = true, .count = AT(n), .sized = true),
    PLUNGE("w", MOTION_W),
    PLUNGE("w_dot", MOTION_W_RATE),
    PLUNGE("w_ddot", MOTION_W_ACCELERATION),
    {0},
};

const struct field *const motion_variants[] = {
    [MOTION_SINE] = sine_fields, [MOTION_TABLE] = table_fields};

void motion_choose(void *part, int type)
{
    struct motion_entry *m = part;
    m->type = (enum motion_type)type;
    loop_def_defaults(&m->def);
}

/* Three rows of the plunge of as many samples as the angle, or none. */
static bool plunge_is_whole(struct reader *r, const struct motion_entry *m)
{
    static const char *const key[] = {"w", "w_dot", "w_ddot"};
    bool ok = true;
    for (int i = 0; i < 3; i++) {
        const int n = m->n_row[MOTION_W + i];
        const bool fits = m->n_row[MOTION_W] == 0 ? n == 0 : n == m->n;
        const bool first = i == 0 && m->n_row[MOTION_W_RATE] + m->n_row[MOTION_W_ACCELERATION] > 0;
        if (!fits || (n == 0 && first)) {
            const size_t mark = reader_enter_key(r, key[i]);
            reader_problem(r, n == 0 ? "required" : "wrong_length",
                           "w, w_dot and w_ddot, each as long as alpha_deg", NULL,
                           "the row has %d samples, alpha_deg has %d", n, m->n);
            reader_leave(r, mark);
            ok = false;
        }
    }
    return ok;
}

static void build_table(struct reader *r, struct motion_entry *m)
{
    m->table.value = calloc((size_t)m->n * MOTION_ROWS, sizeof *m->table.value);
    if (m->table.value == NULL) {
        reader_no_memory(r);
        return;
    }
    m->table.n = m->n;
    for (int k = 0; k < MOTION_ROWS; k++) {
        for (int i = 0; m->row[k] != NULL && i < m->n; i++) {
            const double unit = k == MOTION_THETA ? FIELD_DEGREE : 1.0;
            m->table.value[num_at(i, k, m->n)] = m->row[k][i] * unit;
        }
    }
}

void motion_finish(struct reader *r, const struct cJSON *json, void *part)
{
    struct motion_entry *m = part;
    struct api_case *c = r->context;
    (void)json;
    c->def.loop = m->def;
    if (m->type != MOTION_TABLE) {
        return;
    }
    c->def.loop.motion = &m->table; /* empty as long as it is not whole */
    const bool whole = m->row[MOTION_THETA] != NULL && m->row[MOTION_THETA_RATE] != NULL &&
                       m->row[MOTION_THETA_ACCELERATION] != NULL && plunge_is_whole(r, m);
    if (whole) {
        build_table(r, m);
    }
}

void motion_entry_done(struct motion_entry *m)
{
    for (int k = 0; k < MOTION_ROWS; k++) {
        free(m->row[k]);
    }
    free(m->table.value);
    *m = (struct motion_entry){0};
}
