#include "api/entry_fields.h"

#include "api/entry.h"
#include "api/json.h"
#include "core/num.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>

/* Any JSON value, kept as text. */
static void read_note(struct reader *r, const struct cJSON *json, char **note)
{
    struct json_out out = {0};
    if (cJSON_IsNull(json)) {
        return;
    }
    json_value(&out, json);
    free(*note);
    *note = json_out_take(&out, NULL);
    if (*note == NULL) {
        reader_no_memory(r);
    }
}

static void read_description(struct reader *r, const struct cJSON *json, char **note)
{
    if (cJSON_IsString(json) || cJSON_IsNull(json)) {
        read_note(r, json, note);
    } else {
        reader_problem(r, "wrong_type", "a string", json, "the value must be a string");
    }
}

static void read_polar_description(struct reader *r, const struct cJSON *json, void *base)
{
    read_description(r, json, &((struct polar_entry *)base)->description);
}

static void write_polar_description(struct json_out *out, const void *base)
{
    json_raw(out, ((const struct polar_entry *)base)->description);
}

static void read_polar_provenance(struct reader *r, const struct cJSON *json, void *base)
{
    read_note(r, json, &((struct polar_entry *)base)->provenance);
}

static void write_polar_provenance(struct json_out *out, const void *base)
{
    json_raw(out, ((const struct polar_entry *)base)->provenance);
}

static void read_network_description(struct reader *r, const struct cJSON *json, void *base)
{
    read_description(r, json, &((struct network_entry *)base)->description);
}

static void write_network_description(struct json_out *out, const void *base)
{
    json_raw(out, ((const struct network_entry *)base)->description);
}

static void read_network_provenance(struct reader *r, const struct cJSON *json, void *base)
{
    read_note(r, json, &((struct network_entry *)base)->provenance);
}

static void write_network_provenance(struct json_out *out, const void *base)
{
    json_raw(out, ((const struct network_entry *)base)->provenance);
}

static const struct field_range positive = {.min = 0.0, .max = INFINITY, .above_min = true};
static const struct field_range poisson = {
    .min = -1.0, .max = 1.0, .above_min = true, .below_max = true};
static const struct field_range angle = {.min = -180.0, .max = 180.0};
static const struct field_range centre = {.min = -0.5, .max = 0.5};
static const struct field_range hidden = {.min = 1, .max = LIMIT_NET_HIDDEN};

static const char *const activation_names[] = {"tanh", NULL};
const char *const network_input_names[] = {
#define INPUT_NAME(code, name, text) [code] = (name),
    NETWORK_INPUT_LIST(INPUT_NAME)
#undef INPUT_NAME
        [NET_IN_COUNT] = NULL};
const char *const network_base_names[] = {
#define BASE_NAME(code, name) [code] = (name),
    NETWORK_BASE_LIST(BASE_NAME)
#undef BASE_NAME
        [NETWORK_BASES] = NULL};
const char *const network_output_names[] = {
    [NET_OUT_CL] = "cl", [NET_OUT_CM] = "cm", [NET_OUT_CD] = "cd", [NET_OUT_COUNT] = NULL};

const char *network_output_name(enum network_output output)
{
    return network_output_names[output];
}

#define MATERIAL(member_, key_, range_)                                                            \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .required = true,                                     \
        .offset = offsetof(struct material, member_), .range = (range_)                            \
    }

/* All five or none, which material_check sees to. */
#define STRENGTH(member_, key_)                                                                    \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .omit = has_no_strength,                              \
        .offset = offsetof(struct material, member_), .range = &positive                           \
    }

static bool has_no_strength(const void *base)
{
    return !material_has_strength(base);
}

const struct field material_fields[] = {
    {.key = "name",
     .kind = FIELD_TEXT,
     .required = true,
     .offset = offsetof(struct material, name),
     .size = LIMIT_NAME},
    MATERIAL(e_l, "e_l_pa", &positive),
    MATERIAL(e_t, "e_t_pa", &positive),
    MATERIAL(g_lt, "g_lt_pa", &positive),
    MATERIAL(g_tt, "g_tt_pa", &positive),
    MATERIAL(nu_lt, "nu_lt", NULL),
    MATERIAL(nu_tt, "nu_tt", &poisson),
    MATERIAL(density, "density_kg_m3", &positive),
    STRENGTH(x_tension, "x_tension_pa"),
    STRENGTH(x_compression, "x_compression_pa"),
    STRENGTH(y_tension, "y_tension_pa"),
    STRENGTH(y_compression, "y_compression_pa"),
    STRENGTH(s_shear, "s_shear_pa"),
    {0},
};

#define POLAR_AXIS(key_, member_, count_, unit_, required_, range_, min_, max_)                    \
    {                                                                                              \
        .key = (key_), .kind = FIELD_VECTOR, .required = (required_), .kinds = ENTRY_TABLE,        \
        .offset = offsetof(struct polar_entry, def.member_),                                       \
        .count = offsetof(struct polar_entry, def.count_), .unit = (unit_), .range = (range_),     \
        .min = (min_), .max = (max_)                                                               \
    }
#define POLAR_TABLE(member_)                                                                       \
    {                                                                                              \
        .key = #member_, .kind = FIELD_MATRIX, .required = true, .kinds = ENTRY_TABLE,             \
        .offset = offsetof(struct polar_entry, def.member_),                                       \
        .count = offsetof(struct polar_entry, def.n_alpha),                                        \
        .rows = offsetof(struct polar_entry, def.n_plunge)                                         \
    }
#define POLAR_OPTIONAL_TABLE(member_, has_no_)                                                     \
    {                                                                                              \
        .key = #member_, .kind = FIELD_MATRIX, .kinds = ENTRY_TABLE, .omit = (has_no_),            \
        .offset = offsetof(struct polar_entry, def.member_),                                       \
        .count = offsetof(struct polar_entry, def.n_alpha),                                        \
        .rows = offsetof(struct polar_entry, def.n_plunge)                                         \
    }
#define POLAR_ANGLE(key_, member_)                                                                 \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .required = true, .kinds = ENTRY_TABLE,               \
        .offset = offsetof(struct polar_entry, def.member_), .unit = FIELD_DEGREE, .range = &angle \
    }

#define STALL_NUMBER(key_, member_, range_)                                                        \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .kinds = ENTRY_TABLE,                                 \
        .offset = offsetof(struct polar_entry, def.stall.member_), .range = (range_)               \
    }

static bool has_no_drag(const void *base)
{
    return !polar_def_has_drag(&((const struct polar_entry *)base)->def);
}

static const struct field stall_fields[] = {
    STALL_NUMBER("lift_slope_per_rad", lift_slope, &positive),
    STALL_NUMBER("lift_centre_c", lift_centre, &centre),
    STALL_NUMBER("pressure_lag", pressure_lag, &positive),
    STALL_NUMBER("boundary_layer_lag", boundary_layer_lag, &positive),
    STALL_NUMBER("vortex_lag", vortex_lag, &positive),
    {0},
};

/* Axes before tables: the shape of a table is checked against them. */
const struct field polar_fields[] = {
    {.key = "name",
     .kind = FIELD_TEXT,
     .required = true,
     .kinds = ENTRY_NAME,
     .offset = offsetof(struct polar_entry, def.name),
     .size = LIMIT_NAME},
    {.key = "description",
     .kind = FIELD_CUSTOM,
     .kinds = ENTRY_NOTES,
     .read = read_polar_description,
     .write = write_polar_description},
    {.key = "provenance",
     .kind = FIELD_CUSTOM,
     .kinds = ENTRY_NOTES,
     .read = read_polar_provenance,
     .write = write_polar_provenance},
    POLAR_AXIS("alpha_deg", alpha, n_alpha, FIELD_DEGREE, true, &angle, 2, LIMIT_POLAR_ANGLES),
    POLAR_AXIS("plunge_c", plunge, n_plunge, 1.0, false, NULL, 1, LIMIT_POLAR_PLUNGES),
    POLAR_TABLE(cl),
    POLAR_OPTIONAL_TABLE(cd, has_no_drag),
    POLAR_TABLE(cm),
    POLAR_ANGLE("linear_from_deg", linear_from),
    POLAR_ANGLE("linear_to_deg", linear_to),
    {.key = "dynamic_stall", .kind = FIELD_OBJECT, .kinds = ENTRY_TABLE, .fields = stall_fields},
    {0},
};

#define NETWORK_NAMES(key_, member_, count_, names_, max_)                                         \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NAMES, .required = true, .kinds = ENTRY_TABLE,                \
        .offset = offsetof(struct network_entry, def.member_), .names = (names_),                  \
        .count = offsetof(struct network_entry, def.count_), .min = 1, .max = (max_)               \
    }
#define NETWORK_ARRAY(key_, kind_, member_, count_)                                                \
    {                                                                                              \
        .key = (key_), .kind = (kind_), .required = true, .kinds = ENTRY_TABLE,                    \
        .offset = offsetof(struct network_entry, def.member_),                                     \
        .count = offsetof(struct network_entry, def.count_), .sized = true                         \
    }
#define NETWORK_MATRIX(member_, rows_, count_)                                                     \
    {                                                                                              \
        .key = #member_, .kind = FIELD_MATRIX, .required = true, .kinds = ENTRY_TABLE,             \
        .offset = offsetof(struct network_entry, def.member_),                                     \
        .count = offsetof(struct network_entry, def.count_),                                       \
        .rows = offsetof(struct network_entry, def.rows_)                                          \
    }

static bool stands_on_polar(const void *base)
{
    return ((const struct network_entry *)base)->def.frame.base == NETWORK_ON_POLAR;
}

static bool has_no_lags(const void *base)
{
    return ((const struct network_entry *)base)->def.frame.n_lag == 0;
}

static bool has_no_oscillators(const void *base)
{
    return ((const struct network_entry *)base)->def.frame.n_oscillator == 0;
}

static bool has_no_polar(const void *base)
{
    return ((const struct network_entry *)base)->def.polar_hash[0] == '\0';
}

void network_oscillator_start(const struct reader *r, void *element)
{
    (void)r;
    *(struct network_oscillator *)element =
        (struct network_oscillator){.frequency = 1.0, .damping = 0.5};
}

/* The core's check has the ranges. */
const struct field network_oscillator_fields[] = {
    {.key = "f_c_v",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct network_oscillator, frequency)},
    {.key = "damping",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct network_oscillator, damping)},
    {0},
};

/* Sizes before what has them. What older networks do not have is not printed either: their hash
 * stays what it was. */
const struct field network_fields[] = {
    {.key = "name",
     .kind = FIELD_TEXT,
     .required = true,
     .kinds = ENTRY_NAME,
     .offset = offsetof(struct network_entry, def.name),
     .size = LIMIT_NAME},
    {.key = "description",
     .kind = FIELD_CUSTOM,
     .kinds = ENTRY_NOTES,
     .read = read_network_description,
     .write = write_network_description},
    {.key = "provenance",
     .kind = FIELD_CUSTOM,
     .kinds = ENTRY_NOTES,
     .read = read_network_provenance,
     .write = write_network_provenance},
    {.key = "activation",
     .kind = FIELD_ENUM,
     .required = true,
     .kinds = ENTRY_TABLE,
     .offset = offsetof(struct network_entry, activation),
     .names = activation_names},
    {.key = "polar_hash",
     .kind = FIELD_TEXT,
     .kinds = ENTRY_TABLE,
     .offset = offsetof(struct network_entry, def.polar_hash),
     .size = LIMIT_HASH,
     .omit = has_no_polar},
    {.key = "base",
     .kind = FIELD_ENUM,
     .kinds = ENTRY_TABLE,
     .offset = offsetof(struct network_entry, def.frame.base),
     .names = network_base_names,
     .omit = stands_on_polar},
    {.key = "lags_c_v",
     .kind = FIELD_ARRAY,
     .kinds = ENTRY_TABLE,
     .offset = offsetof(struct network_entry, def.frame.lag),
     .count = offsetof(struct network_entry, def.frame.n_lag),
     .max = NETWORK_LAGS,
     .omit = has_no_lags},
    {.key = "oscillators",
     .kind = FIELD_LIST,
     .kinds = ENTRY_TABLE,
     .offset = offsetof(struct network_entry, def.frame.oscillator),
     .size = sizeof(struct network_oscillator),
     .fields = network_oscillator_fields,
     .count = offsetof(struct network_entry, def.frame.n_oscillator),
     .max = NETWORK_OSCILLATORS,
     .start = network_oscillator_start,
     .omit = has_no_oscillators},
    NETWORK_NAMES("inputs", input, n_in, network_input_names, LIMIT_NET_INPUTS),
    NETWORK_NAMES("outputs", output, n_out, network_output_names, LIMIT_NET_OUTPUTS),
    {.key = "hidden",
     .kind = FIELD_INTEGER,
     .required = true,
     .kinds = ENTRY_TABLE,
     .offset = offsetof(struct network_entry, def.n_hidden),
     .range = &hidden},
    NETWORK_ARRAY("input_offset", FIELD_ARRAY, in_offset, n_in),
    NETWORK_ARRAY("input_scale", FIELD_ARRAY, in_scale, n_in),
    NETWORK_ARRAY("output_offset", FIELD_ARRAY, out_offset, n_out),
    NETWORK_ARRAY("output_scale", FIELD_ARRAY, out_scale, n_out),
    NETWORK_ARRAY("hull_min", FIELD_ARRAY, hull_min, n_in),
    NETWORK_ARRAY("hull_max", FIELD_ARRAY, hull_max, n_in),
    NETWORK_MATRIX(w1, n_hidden, n_in),
    NETWORK_ARRAY("b1", FIELD_VECTOR, b1, n_hidden),
    NETWORK_MATRIX(w2, n_out, n_hidden),
    NETWORK_ARRAY("b2", FIELD_VECTOR, b2, n_out),
    {0},
};
