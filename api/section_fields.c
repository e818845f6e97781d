#include "api/section_fields.h"

#include "api/case_refs.h"
#include "core/case_def.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

static const struct field_range positive = {.min = 0.0, .max = INFINITY, .above_min = true};
static const struct field_range not_negative = {.min = 0.0, .max = INFINITY};
static const struct field_range on_chord = {.min = 0.0, .max = 1.0};
static const struct field_range contour_elements = {.min = 1, .max = LIMIT_CONTOUR_ELEMENTS};
static const struct field_range angle = {.min = -180.0, .max = 180.0};
static const struct field_range point_index = {.min = 0, .max = LIMIT_POINTS - 1};
static const struct field_range cells = {.min = 0, .max = LIMIT_WALLS};

/* By the enums of core. */
const char *const section_type_names[] = {[SECTION_STRIP] = "strip",
                                          [SECTION_BOX] = "box",
                                          [SECTION_CONTOUR] = "contour",
                                          [SECTION_PROPERTIES] = "properties",
                                          NULL};
static const char *const chordwise_names[] = {
    [CHORDWISE_FREE] = "free", [CHORDWISE_RIGID] = "rigid", [CHORDWISE_CLAMPED] = "clamped", NULL};
static const char *const wall_shear_names[] = {
    [WALL_SHEAR_RIGID] = "rigid", [WALL_SHEAR_FLEXIBLE] = "flexible", NULL};
static const char *const inertia_axis_names[] = {[INERTIA_ELASTIC_AXIS] = "elastic_axis",
                                                 [INERTIA_MASS_CENTRE] = "mass_centre",
                                                 [INERTIA_MID_CHORD] = "mid_chord",
                                                 NULL};
static const char *const shear_names[] = {
    [SHEAR_CONDENSED] = "condensed", [SHEAR_RETAINED] = "retained", NULL};

static const struct field ply_fields[] = {
    {.key = "material",
     .kind = FIELD_CUSTOM,
     .required = true,
     .read = case_read_ply_material,
     .write = case_write_ply_material},
    {.key = "angle_deg",
     .kind = FIELD_NUMBER,
     .offset = offsetof(struct ply, angle),
     .unit = FIELD_DEGREE,
     .range = &angle},
    {.key = "thickness_m",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct ply, thickness),
     .range = &positive},
    {0},
};

#define AT(member_) offsetof(struct section_def, member_)
#define NUMBER(key_, member_, ...)                                                                 \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .offset = AT(member_), __VA_ARGS__                    \
    }
#define CHOICE(key_, member_, names_, ...)                                                         \
    {                                                                                              \
        .key = (key_), .kind = FIELD_ENUM, .offset = AT(member_), .names = (names_), __VA_ARGS__   \
    }
/* Plies of a layup in a struct. */
#define PLIES(key_, struct_, layup_, ...)                                                          \
    {                                                                                              \
        .key = (key_), .kind = FIELD_LIST, .offset = offsetof(struct_, layup_.ply),                \
        .size = sizeof(struct ply), .fields = ply_fields,                                          \
        .count = offsetof(struct_, layup_.n_ply), .min = 1, .max = LIMIT_PLIES, __VA_ARGS__        \
    }
#define TYPE CHOICE("type", shape.type, section_type_names, .required = true)
/* What every type has. */
#define COMMON                                                                                     \
    CHOICE("chordwise_curvature", shape.chordwise, chordwise_names, .required = false),            \
        CHOICE("shear", shear, shear_names, .required = false),                                    \
        CHOICE("wall_shear", shape.wall_shear, wall_shear_names, .required = false),               \
        {.key = "contour_elements",                                                                \
         .kind = FIELD_INTEGER,                                                                    \
         .offset = AT(shape.contour_elements),                                                     \
         .range = &contour_elements},                                                              \
        NUMBER("mid_chord_m", mid_chord, .required = false),                                       \
        NUMBER("twist_deg", shape.turn, .unit = FIELD_DEGREE, .range = &angle)

static bool has_no_chord(const void *base)
{
    return !(((const struct section_def *)base)->chord > 0.0);
}

static bool has_own_layups(const void *base)
{
    return ((const struct section_def *)base)->shape.n_layup == BOX_WALLS;
}

static bool has_one_layup(const void *base)
{
    return !has_own_layups(base);
}

static bool is_number_of_cells_open(const void *base)
{
    return ((const struct section_def *)base)->shape.cells < 0;
}

static const struct field strip_fields[] = {
    TYPE,
    NUMBER("chord_m", shape.width, .required = true, .range = &positive),
    PLIES("layup", struct section_def, shape.layup[0], .required = true),
    COMMON,
    {0},
};

static const struct field box_wall_fields[] = {
    PLIES("front", struct section_def, shape.layup[BOX_FRONT], .required = true),
    PLIES("top", struct section_def, shape.layup[BOX_TOP], .required = true),
    PLIES("rear", struct section_def, shape.layup[BOX_REAR], .required = true),
    PLIES("bottom", struct section_def, shape.layup[BOX_BOTTOM], .required = true),
    {0},
};

static const struct field box_fields[] = {
    TYPE,
    NUMBER("width_m", shape.width, .required = true, .range = &positive),
    NUMBER("height_m", shape.height, .required = true, .range = &positive),
    NUMBER("chord_m", chord, .range = &positive, .omit = has_no_chord),
    PLIES("layup", struct section_def, shape.layup[0], .omit = has_own_layups),
    {.key = "walls", .kind = FIELD_OBJECT, .fields = box_wall_fields, .omit = has_one_layup},
    COMMON,
    {0},
};

static const struct field layup_fields[] = {
    {.key = "name",
     .kind = FIELD_TEXT,
     .required = true,
     .offset = offsetof(struct layup, name),
     .size = LIMIT_NAME},
    {.key = "layup",
     .kind = FIELD_LIST,
     .required = true,
     .offset = offsetof(struct layup, ply),
     .size = sizeof(struct ply),
     .fields = ply_fields,
     .count = offsetof(struct layup, n_ply),
     .min = 1,
     .max = LIMIT_PLIES},
    {0},
};

static const struct field point_fields[] = {
    {.key = "x_m",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct shape_point, x)},
    {.key = "y_m",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct shape_point, y)},
    {0},
};

/* A wall names its layup: it is read and printed beside the shape that knows the names. */
struct wall_view {
    struct shape_wall wall;
    const struct shape *shape;
};
struct wall_list {
    int n;
    struct wall_view wall[LIMIT_WALLS];
};

static void read_wall_layup(struct reader *r, const struct cJSON *json, void *base)
{
    struct wall_view *w = base;
    const char *names[LIMIT_LAYUPS + 1] = {NULL};
    char expected[128];
    for (int i = 0; i < w->shape->n_layup; i++) {
        names[i] = w->shape->layup[i].name;
    }
    if (!cJSON_IsString(json)) {
        reader_problem(r, "wrong_type", "a name", json, "the value must be a name");
        return;
    }
    const int index = field_name_index(names, json->valuestring);
    if (index >= 0) {
        w->wall.layup = index;
    } else if (w->shape->n_layup > 0) { /* else they could not be read, which has been said */
        reader_join(names, sizeof expected, expected);
        reader_problem(r, "unknown_layup", expected, json, "the section has no layup of this name");
    }
}

static void write_wall_layup(struct json_out *out, const void *base)
{
    const struct wall_view *w = base;
    json_string(out, w->shape->layup[w->wall.layup].name);
}

static bool is_straight(const void *base)
{
    return !((const struct wall_view *)base)->wall.curved;
}

static const struct field via_fields[] = {
    {.key = "x_m",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct wall_view, wall.via.x)},
    {.key = "y_m",
     .kind = FIELD_NUMBER,
     .required = true,
     .offset = offsetof(struct wall_view, wall.via.y)},
    {0},
};

static const struct field wall_fields[] = {
    {.key = "from",
     .kind = FIELD_INTEGER,
     .required = true,
     .offset = offsetof(struct wall_view, wall.from),
     .range = &point_index},
    {.key = "to",
     .kind = FIELD_INTEGER,
     .required = true,
     .offset = offsetof(struct wall_view, wall.to),
     .range = &point_index},
    {.key = "layup",
     .kind = FIELD_CUSTOM,
     .required = true,
     .read = read_wall_layup,
     .write = write_wall_layup},
    {.key = "offset_m", .kind = FIELD_NUMBER, .offset = offsetof(struct wall_view, wall.offset)},
    {.key = "via",
     .kind = FIELD_OBJECT,
     .fields = via_fields,
     .nullable = true,
     .offset = offsetof(struct wall_view, wall.curved),
     .omit = is_straight},
    {0},
};

static const struct field wall_list = {.key = "walls",
                                       .kind = FIELD_LIST,
                                       .offset = offsetof(struct wall_list, wall),
                                       .size = sizeof(struct wall_view),
                                       .fields = wall_fields,
                                       .count = offsetof(struct wall_list, n),
                                       .min = 1,
                                       .max = LIMIT_WALLS};

static void read_walls(struct reader *r, const struct cJSON *json, void *base)
{
    struct shape *s = &((struct section_def *)base)->shape;
    struct wall_list list = {.n = 0};
    for (int i = 0; i < LIMIT_WALLS; i++) {
        list.wall[i].shape = s;
    }
    field_read_value(r, &wall_list, json, &list);
    for (int i = 0; i < list.n; i++) {
        s->wall[i] = list.wall[i].wall;
    }
    s->n_wall = list.n;
}

static void write_walls(struct json_out *out, const void *base)
{
    const struct shape *s = &((const struct section_def *)base)->shape;
    struct wall_list list = {.n = s->n_wall};
    for (int i = 0; i < s->n_wall; i++) {
        list.wall[i] = (struct wall_view){.wall = s->wall[i], .shape = s};
    }
    field_write_value(out, &wall_list, (unsigned)READER_ALL, &list);
}

/* Layups before the walls that name them. */
static const struct field contour_fields[] = {
    TYPE,
    NUMBER("chord_m", chord, .range = &positive, .omit = has_no_chord),
    {.key = "layups",
     .kind = FIELD_LIST,
     .required = true,
     .offset = AT(shape.layup),
     .size = sizeof(struct layup),
     .fields = layup_fields,
     .count = AT(shape.n_layup),
     .min = 1,
     .max = LIMIT_LAYUPS},
    {.key = "points",
     .kind = FIELD_LIST,
     .required = true,
     .offset = AT(shape.point),
     .size = sizeof(struct shape_point),
     .fields = point_fields,
     .count = AT(shape.n_point),
     .min = 2,
     .max = LIMIT_POINTS},
    {.key = "walls",
     .kind = FIELD_CUSTOM,
     .required = true,
     .fields = wall_fields,
     .min = 1,
     .max = LIMIT_WALLS,
     .read = read_walls,
     .write = write_walls},
    {.key = "cells",
     .kind = FIELD_INTEGER,
     .offset = AT(shape.cells),
     .range = &cells,
     .omit = is_number_of_cells_open},
    COMMON,
    {0},
};

static const struct field properties_fields[] = {
    TYPE,
    NUMBER("chord_m", properties.chord, .required = true, .range = &positive),
    NUMBER("ei_flap_n_m2", properties.ei_flap, .required = true, .range = &positive),
    NUMBER("ei_lag_n_m2", properties.ei_lag, .range = &positive),
    NUMBER("gj_n_m2", properties.gj, .required = true, .range = &positive),
    NUMBER("ea_n", properties.ea, .range = &positive),
    NUMBER("bend_twist_n_m2", properties.bend_twist, .required = false),
    NUMBER("ei_warping_n_m4", properties.ei_warping, .range = &not_negative),
    NUMBER("mass_kg_m", properties.mass, .required = true, .range = &positive),
    NUMBER("torsion_inertia_kg_m", properties.torsion_inertia, .required = true,
           .range = &positive),
    CHOICE("torsion_inertia_about", properties.inertia_axis, inertia_axis_names, .required = false),
    NUMBER("elastic_axis_chord", properties.elastic_axis, .range = &on_chord),
    NUMBER("mass_axis_chord", properties.mass_axis, .range = &on_chord),
    CHOICE("shear", shear, shear_names, .required = false),
    {0},
};

const struct field *const section_variants[] = {[SECTION_STRIP] = strip_fields,
                                                [SECTION_BOX] = box_fields,
                                                [SECTION_CONTOUR] = contour_fields,
                                                [SECTION_PROPERTIES] = properties_fields};

void section_choose(void *section, int type)
{
    section_def_defaults((enum section_type)type, section);
}

void section_finish(struct reader *r, const struct cJSON *json, void *section)
{
    struct shape *s = &((struct section_def *)section)->shape;
    if (s->type == SECTION_PROPERTIES) {
        properties_complete(&((struct section_def *)section)->properties);
    }
    if (s->type != SECTION_BOX) {
        return;
    }
    const bool one = cJSON_GetObjectItemCaseSensitive(json, "layup") != NULL;
    const bool each = cJSON_GetObjectItemCaseSensitive(json, "walls") != NULL;
    s->n_layup = each ? BOX_WALLS : 1;
    if (one != each) {
        return;
    }
    const size_t mark = reader_enter_key(r, "layup");
    if (one) {
        reader_problem(r, "layup_twice", "either \"layup\" or \"walls\"", NULL,
                       "the layup of the box is given twice, by \"layup\" and by \"walls\"");
    } else {
        reader_problem(r, "required", "\"layup\" of all walls, or \"walls\"", NULL,
                       "\"layup\" is missing, and so is \"walls\"");
    }
    reader_leave(r, mark);
}
