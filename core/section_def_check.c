/* The checks of core/section_def.h. */
#include "core/num.h"
#include "core/range.h"
#include "core/section_def.h"

#include <stdio.h>

/* Plies of a layup at `pointer` (of the list of plies). */
static void check_layup(const struct layup *l, const char *pointer, struct failure_list *out)
{
    const struct range count = {pointer, l->n_ply, 1, LIMIT_PLIES, false, false};
    range_check(1, &count, out);
    for (int i = 0; i < l->n_ply && i < LIMIT_PLIES; i++) {
        char angle[160], thickness[160], material[160];
        (void)snprintf(angle, sizeof angle, "%.120s/%d/angle_deg", pointer, i);
        (void)snprintf(thickness, sizeof thickness, "%.120s/%d/thickness_m", pointer, i);
        (void)snprintf(material, sizeof material, "%.120s/%d/material", pointer, i);
        const struct range ply[] = {
            {angle, num_deg(l->ply[i].angle), -180.0, 180.0, false, false},
            {thickness, l->ply[i].thickness, 0.0, HUGE_VAL, true, false},
        };
        RANGE_CHECK(ply, out);
        material_check(&l->ply[i].material, material, out);
    }
}

/* JSON pointer of layup l of a section at `pointer`. */
static void layup_pointer(const struct shape *s, const char *pointer, int l, char *text,
                          size_t size)
{
    static const char *const box[BOX_WALLS] = {"front", "top", "rear", "bottom"};
    if (s->type == SECTION_CONTOUR) {
        (void)snprintf(text, size, "%.100s/layups/%d/layup", pointer, l);
    } else if (s->n_layup == BOX_WALLS) {
        (void)snprintf(text, size, "%.100s/walls/%s", pointer, box[l]);
    } else {
        (void)snprintf(text, size, "%.100s/layup", pointer);
    }
}

static const char *const chordwise_name[] = {
    [CHORDWISE_FREE] = "free", [CHORDWISE_RIGID] = "rigid", [CHORDWISE_CLAMPED] = "clamped"};

/* Only a flat section bends across as a whole: the corners of others hold it. */
static void check_chordwise(const struct shape *s, const char *pointer, struct failure_list *out)
{
    const bool flat = s->type == SECTION_STRIP ||
                      (s->type == SECTION_CONTOUR && s->n_wall == 1 && !s->wall[0].curved);
    if (s->chordwise == CHORDWISE_CLAMPED && !flat) {
        char at[160];
        (void)snprintf(at, sizeof at, "%.120s/chordwise_curvature", pointer);
        failure_set(failure_add(out), ST_INVALID, at, "not_flat", "\"free\" or \"rigid\"",
                    chordwise_name[s->chordwise],
                    "only a section of one straight wall bends across as a whole");
    }
}

static void check_walls(const struct section_def *section, const char *pointer,
                        struct failure_list *out)
{
    const struct shape *s = &section->shape;
    char width[160], height[160], elements[160], layup[160], mid_chord[160];
    const bool strip = s->type == SECTION_STRIP;
    (void)snprintf(width, sizeof width, "%s/%s", pointer, strip ? "chord_m" : "width_m");
    (void)snprintf(height, sizeof height, "%s/height_m", pointer);
    (void)snprintf(elements, sizeof elements, "%s/contour_elements", pointer);
    (void)snprintf(mid_chord, sizeof mid_chord, "%s/mid_chord_m", pointer);
    const struct range size[] = {{width, s->width, 0.0, HUGE_VAL, true, false},
                                 {height, s->height, 0.0, HUGE_VAL, true, false}};
    const struct range mesh = {elements, s->contour_elements, 1, LIMIT_CONTOUR_ELEMENTS, false,
                               false};
    const struct range place = {mid_chord, section->mid_chord, -HUGE_VAL, HUGE_VAL, true, true};
    const int before = out->total;
    range_check(strip ? 1 : (s->type == SECTION_BOX ? 2 : 0), size, out);
    range_check(1, &mesh, out);
    range_check(1, &place, out);
    for (int l = 0; l < s->n_layup; l++) {
        layup_pointer(s, pointer, l, layup, sizeof layup);
        check_layup(&s->layup[l], layup, out);
    }
    const int walls = strip ? 1 : (s->type == SECTION_BOX ? BOX_WALLS : s->n_wall);
    if (out->total == before && walls * s->contour_elements > LIMIT_SECTION_ELEMENTS) {
        char expected[64], got[64];
        (void)snprintf(expected, sizeof expected, "at most %d", LIMIT_SECTION_ELEMENTS / walls);
        (void)snprintf(got, sizeof got, "%d", s->contour_elements);
        failure_set(failure_add(out), ST_LIMIT, elements, "too_many_elements", expected, got,
                    "%d walls would have more than %d contour elements", walls,
                    LIMIT_SECTION_ELEMENTS);
    }
    if (out->total == before) {
        shape_check(s, pointer, out);
    }
    check_chordwise(s, pointer, out);
}

/* `shear` is that of the whole beam: a section without known shear cannot serve a beam that keeps
 * it.
 */
static void check_section(const struct section_def *section, enum shear_model shear,
                          const char *pointer, struct failure_list *out)
{
    if (section->shape.type != SECTION_PROPERTIES) {
        check_walls(section, pointer, out);
        return;
    }
    properties_check(&section->properties, pointer, out);
    if (shear == SHEAR_RETAINED) {
        char at[160];
        (void)snprintf(at, sizeof at, "%.120s/shear", pointer);
        failure_set(failure_add(out), ST_INVALID, at, "shear_not_known",
                    "\"condensed\" in every section of the beam", "retained",
                    "properties do not hold the shear stiffness that retained shear needs");
    }
}

/* With retained shear flexible walls bring a freedom to every node of the beam (beam.h). */
static void check_wall_shear(const struct section_def *section, const struct section_def *before,
                             const char *pointer, struct failure_list *out)
{
    static const char *const name[] = {
        [WALL_SHEAR_RIGID] = "rigid", [WALL_SHEAR_FLEXIBLE] = "flexible"};
    const enum wall_shear walls = section->shape.wall_shear, wanted = before->shape.wall_shear;
    if (walls != wanted) {
        char at[160], expected[64];
        (void)snprintf(at, sizeof at, "%.120s/wall_shear", pointer);
        (void)snprintf(expected, sizeof expected, "\"%s\", as the station before", name[wanted]);
        failure_set(failure_add(out), ST_INVALID, at, "walls_differ", expected, name[walls],
                    "a beam that keeps its shear has rigid or flexible walls throughout");
    }
}

/* A curvature across that the clamp holds brings freedoms to every node of the beam (beam.h). */
static void check_same_chordwise(const struct section_def *section,
                                 const struct section_def *before, const char *pointer,
                                 struct failure_list *out)
{
    const enum chordwise_curvature is = section->shape.chordwise, was = before->shape.chordwise;
    if ((is == CHORDWISE_CLAMPED) != (was == CHORDWISE_CLAMPED)) {
        char at[160], expected[64];
        (void)snprintf(at, sizeof at, "%.120s/chordwise_curvature", pointer);
        (void)snprintf(expected, sizeof expected, "\"%s\", as the station before",
                       chordwise_name[was]);
        failure_set(failure_add(out), ST_INVALID, at, "chordwise_differs", expected,
                    chordwise_name[is],
                    "the clamp holds the curvature across of all sections of a beam or of none");
    }
}

/* Stations ascend from the root to the tip, at most two at one place between them, and neighbours
 * apart from each other can be blended. */
static void check_stations(const struct beam_def *b, struct failure_list *out)
{
    char pointer[160];
    for (int i = 0; i < b->n_station; i++) {
        (void)snprintf(pointer, sizeof pointer, "/beam/stations/%d/section", i);
        check_section(&b->station[i].section, beam_def_root(b)->shear, pointer, out);
        if (i > 0) {
            check_same_chordwise(&b->station[i].section, &b->station[i - 1].section, pointer, out);
        }
        if (i > 0 && beam_def_root(b)->shear == SHEAR_RETAINED) {
            check_wall_shear(&b->station[i].section, &b->station[i - 1].section, pointer, out);
        }
        (void)snprintf(pointer, sizeof pointer, "/beam/stations/%d/z_m", i);
        const double z = b->station[i].z, last = i > 0 ? b->station[i - 1].z : 0.0;
        const bool placed = isfinite(z) && (i == 0 ? z == 0.0 : z >= last) &&
                            (i < b->n_station - 1 || fabs(z - b->length) <= 1e-9 * b->length) &&
                            !(i > 1 && z <= b->station[i - 2].z) &&
                            !(i > 0 && z == last && (z == 0.0 || i == b->n_station - 1));
        if (!placed) {
            char got[32];
            (void)snprintf(got, sizeof got, "%.10g", z);
            failure_set(failure_add(out), ST_INVALID, pointer, "misplaced_station",
                        "ascending from 0 to beam.length_m, at most two at one place between", got,
                        "the station is out of place");
        } else if (i > 0 && z > last &&
                   !shape_same(&b->station[i - 1].section.shape, &b->station[i].section.shape)) {
            failure_set(failure_add(out), ST_INVALID, pointer, "stations_differ",
                        "the same type, walls, layups and materials as the station before", NULL,
                        "the sections cannot be blended; put two stations at one place for a jump");
        }
    }
    if (b->n_station == 1) {
        failure_set(failure_add(out), ST_INVALID, "/beam/stations", "too_short",
                    "at least two stations, or `section` for the whole beam", "1 station",
                    "one station does not make a beam");
    }
}

void beam_def_check_sections(const struct beam_def *b, struct failure_list *out)
{
    if (b->n_station > 0) {
        check_stations(b, out);
    } else {
        check_section(&b->section, b->section.shear, "/beam/section", out);
    }
}
