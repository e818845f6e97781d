#include "api/beam_fields.h"

#include "api/case_fields.h"
#include "api/drive_fields.h"
#include "api/section_fields.h"

#include <cjson/cJSON.h>
#include <math.h>

static const struct field_range positive = {.min = 0.0, .max = INFINITY, .above_min = true};
static const struct field_range not_negative = {.min = 0.0, .max = INFINITY};
static const struct field_range elements = {.min = 1, .max = LIMIT_ELEMENTS};

static const char *const warping_names[] = {
    [ROOT_WARPING_RESTRAINED] = "restrained", [ROOT_WARPING_FREE] = "free", NULL};

#define AT(member_) offsetof(struct api_case, member_)
#define PLAIN(key_, struct_, member_, ...)                                                         \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .offset = offsetof(struct_, member_), __VA_ARGS__     \
    }
/* The six parts of a load; the keys end with the unit. */
#define LOAD(struct_, member_, force_unit_, moment_unit_)                                          \
    PLAIN("force_x" force_unit_, struct_, member_.force[0], .required = false),                    \
        PLAIN("force_y" force_unit_, struct_, member_.force[1], .required = false),                \
        PLAIN("force_z" force_unit_, struct_, member_.force[2], .required = false),                \
        PLAIN("moment_x" moment_unit_, struct_, member_.moment[0], .required = false),             \
        PLAIN("moment_y" moment_unit_, struct_, member_.moment[1], .required = false),             \
        PLAIN("moment_z" moment_unit_, struct_, member_.moment[2], .required = false)

/* -- beam */

#define SECTION(struct_, member_, ...)                                                             \
    {                                                                                              \
        .key = "section", .kind = FIELD_VARIANT, .offset = offsetof(struct_, member_),             \
        .names = section_type_names, .variants = section_variants, .choose = section_choose,       \
        .finish = section_finish, __VA_ARGS__                                                      \
    }

static const struct field station_fields[] = {
    PLAIN("z_m", struct station_def, z, .required = true, .range = &not_negative),
    SECTION(struct station_def, section, .required = true),
    {0},
};

static const struct field mass_fields[] = {
    PLAIN("z_m", struct beam_mass, z, .required = true, .range = &not_negative),
    PLAIN("x_m", struct beam_mass, x, .required = false),
    PLAIN("y_m", struct beam_mass, y, .required = false),
    PLAIN("mass_kg", struct beam_mass, mass, .required = true, .range = &not_negative),
    PLAIN("inertia_x_kg_m2", struct beam_mass, inertia[0], .range = &not_negative),
    PLAIN("inertia_y_kg_m2", struct beam_mass, inertia[1], .range = &not_negative),
    PLAIN("inertia_z_kg_m2", struct beam_mass, inertia[2], .range = &not_negative),
    {0},
};

static const struct field gravity_fields[] = {
    PLAIN("x", struct api_case, def.beam.gravity[0], .required = false),
    PLAIN("y", struct api_case, def.beam.gravity[1], .required = false),
    PLAIN("z", struct api_case, def.beam.gravity[2], .required = false),
    {0},
};

static bool has_stations(const void *base)
{
    return ((const struct api_case *)base)->def.beam.n_station > 0;
}

static bool has_one_section(const void *base)
{
    return !has_stations(base);
}

static bool has_no_pitch(const void *base)
{
    return !((const struct api_case *)base)->def.beam.root_pitch.given;
}

static bool has_no_plunge(const void *base)
{
    return !((const struct api_case *)base)->def.beam.root_plunge.given;
}

static bool has_no_root_motion(const void *base)
{
    return has_no_pitch(base) && has_no_plunge(base);
}

static const struct field root_motion_fields[] = {
    {.key = "pitch",
     .kind = FIELD_VARIANT,
     .offset = AT(def.beam.root_pitch),
     .names = drive_type_names,
     .variants = pitch_variants,
     .choose = drive_choose,
     .finish = drive_finish,
     .omit = has_no_pitch},
    {.key = "plunge",
     .kind = FIELD_VARIANT,
     .offset = AT(def.beam.root_plunge),
     .names = drive_type_names,
     .variants = plunge_variants,
     .choose = drive_choose,
     .finish = drive_finish,
     .omit = has_no_plunge},
    {0},
};

const struct field beam_fields[] = {
    PLAIN("length_m", struct api_case, def.beam.length, .kinds = CASE_WITH_BEAM, .required = true,
          .range = &positive),
    {.key = "elements",
     .kind = FIELD_INTEGER,
     .kinds = CASE_WITH_BEAM,
     .offset = AT(def.beam.elements),
     .range = &elements},
    {.key = "root_warping",
     .kind = FIELD_ENUM,
     .kinds = CASE_WITH_BEAM,
     .offset = AT(def.beam.root_warping),
     .names = warping_names},
    SECTION(struct api_case, def.beam.section, .omit = has_stations),
    {.key = "stations",
     .kind = FIELD_LIST,
     .kinds = CASE_WITH_BEAM,
     .offset = AT(station),
     .size = sizeof(struct station_def),
     .fields = station_fields,
     .count = AT(def.beam.n_station),
     .min = 2,
     .max = LIMIT_STATIONS,
     .owned = true,
     .omit = has_one_section},
    {.key = "masses",
     .kind = FIELD_LIST,
     .kinds = CASE_WITH_BEAM,
     .offset = AT(def.beam.mass),
     .size = sizeof(struct beam_mass),
     .fields = mass_fields,
     .count = AT(def.beam.n_mass),
     .max = LIMIT_MASSES},
    {.key = "gravity_m_s2",
     .kind = FIELD_OBJECT,
     .kinds = CASE_IN_SIMULATION | CASE_IN_STATIC,
     .fields = gravity_fields},
    {.key = "root_motion",
     .kind = FIELD_OBJECT,
     .kinds = CASE_IN_SIMULATION,
     .fields = root_motion_fields,
     .omit = has_no_root_motion},
    {0},
};

void beam_finish(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = base;
    c->def.beam.station = c->station;
    const bool one = cJSON_GetObjectItemCaseSensitive(json, "section") != NULL;
    const bool many = cJSON_GetObjectItemCaseSensitive(json, "stations") != NULL;
    const size_t mark = reader_enter_key(r, many ? "stations" : "section");
    if (one && many) {
        reader_problem(r, "section_twice", "either \"section\" or \"stations\"", NULL,
                       "the section of the beam is given twice, by \"section\" and by "
                       "\"stations\"");
    } else if (!one && !many) {
        reader_problem(r, "required", "a section, or \"stations\"", NULL,
                       "\"section\" is missing, and so is \"stations\"");
    } else if (many && r->kind == CASE_IN_SECTION) {
        reader_problem(r, "unexpected", "\"section\"", NULL,
                       "the kind section is about one section, not about a beam with stations");
    }
    reader_leave(r, mark);
}

/* -- loads */

static const struct field point_load_fields[] = {
    PLAIN("z_m", struct point_load_def, z, .required = true, .range = &not_negative),
    LOAD(struct point_load_def, load, "_n", "_n_m"),
    {0},
};

static const struct field line_load_fields[] = {
    PLAIN("from_m", struct line_load_def, from, .range = &not_negative),
    PLAIN("to_m", struct line_load_def, to, .range = &positive),
    LOAD(struct line_load_def, load, "_n_m", "_n"),
    {0},
};

static const struct field tip_fields[] = {
    LOAD(struct point_load_def, load, "_n", "_n_m"),
    {0},
};

static void start_line(const struct reader *r, void *element)
{
    const struct api_case *c = r->context;
    ((struct line_load_def *)element)->to = c->def.beam.length;
}

/* A point load at the free end, and printed as one. */
static void read_tip(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = base;
    struct loads_def *l = &c->def.loads;
    struct point_load_def tip = {.z = c->def.beam.length};
    field_read(r, tip_fields, json, &tip);
    if (l->n_point >= LIMIT_LOADS) {
        reader_problem(r, "too_many", "at most 16 point loads, that of the tip included", NULL,
                       "there is no room for one more point load");
        return;
    }
    l->point[l->n_point++] = tip;
}

static bool never(const void *base)
{
    (void)base;
    return true;
}

static bool has_no_point(const void *base)
{
    return ((const struct api_case *)base)->def.loads.n_point == 0;
}

static bool has_no_line(const void *base)
{
    return ((const struct api_case *)base)->def.loads.n_line == 0;
}

/* Points before the tip that joins them. */
const struct field loads_fields[] = {
    {.key = "points",
     .kind = FIELD_LIST,
     .offset = AT(def.loads.point),
     .size = sizeof(struct point_load_def),
     .fields = point_load_fields,
     .count = AT(def.loads.n_point),
     .max = LIMIT_LOADS,
     .omit = has_no_point},
    {.key = "lines",
     .kind = FIELD_LIST,
     .offset = AT(def.loads.line),
     .size = sizeof(struct line_load_def),
     .fields = line_load_fields,
     .count = AT(def.loads.n_line),
     .max = LIMIT_LOADS,
     .start = start_line,
     .omit = has_no_line},
    {.key = "tip", .kind = FIELD_CUSTOM, .fields = tip_fields, .omit = never, .read = read_tip},
    {0},
};
