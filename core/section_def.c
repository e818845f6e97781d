#include "core/section_def.h"

#include "core/num.h"

void section_def_defaults(enum section_type type, struct section_def *out)
{
    *out = (struct section_def){
        .shape = {.type = type,
                  .n_layup = type == SECTION_STRIP || type == SECTION_BOX ? 1 : 0,
                  .cells = -1,
                  .chordwise = CHORDWISE_FREE,
                  .contour_elements = type == SECTION_STRIP ? 16 : 8},
        .shear = SHEAR_CONDENSED,
    };
    properties_defaults(&out->properties);
}

double section_def_chord(const struct section_def *s)
{
    if (s->shape.type == SECTION_STRIP) {
        return s->shape.width;
    }
    if (s->shape.type == SECTION_PROPERTIES) {
        return s->properties.chord;
    }
    if (s->chord > 0.0) {
        return s->chord;
    }
    return shape_extent(&s->shape, 0);
}

double section_def_height(const struct section_def *s)
{
    return s->shape.type == SECTION_PROPERTIES ? (double)NAN : shape_extent(&s->shape, 1);
}

double section_def_mid_chord(const struct section_def *s)
{
    return s->shape.type == SECTION_PROPERTIES ? properties_mid_chord(&s->properties)
                                               : s->mid_chord;
}

const struct section_def *beam_def_root(const struct beam_def *b)
{
    return b->n_station > 0 ? &b->station[0].section : &b->section;
}

/* Sections on both sides of z and the share t of the outer one. */
static double sections_around(const struct beam_def *b, double z, const struct section_def **inner,
                              const struct section_def **outer)
{
    *inner = *outer = &b->section;
    if (b->n_station == 0) {
        return 0.0;
    }
    int i = 0;
    while (i + 2 < b->n_station && z >= b->station[i + 1].z) {
        i++;
    }
    *inner = &b->station[i].section;
    *outer = &b->station[i + 1].section;
    const double span = b->station[i + 1].z - b->station[i].z;
    return span > 0.0 ? num_clamp((z - b->station[i].z) / span, 0.0, 1.0) : 1.0;
}

static double mix(double a, double b, double t)
{
    return a + t * (b - a);
}

const struct section_def *beam_def_given_at(const struct beam_def *b, double z)
{
    const struct section_def *inner, *outer;
    (void)sections_around(b, z, &inner, &outer);
    return inner;
}

void beam_def_section_at(const struct beam_def *b, double z, struct section_def *out)
{
    const struct section_def *inner, *outer;
    const double t = sections_around(b, z, &inner, &outer);
    *out = *inner;
    if (inner == outer) {
        return;
    }
    if (inner->shape.type == SECTION_PROPERTIES) {
        properties_blend(&inner->properties, &outer->properties, t, &out->properties);
        return;
    }
    shape_blend(&inner->shape, &outer->shape, t, &out->shape);
    out->chord = mix(section_def_chord(inner), section_def_chord(outer), t);
    out->mid_chord = mix(inner->mid_chord, outer->mid_chord, t);
}

double beam_def_chord_at(const struct beam_def *b, double z)
{
    const struct section_def *inner, *outer;
    const double t = sections_around(b, z, &inner, &outer);
    return mix(section_def_chord(inner), section_def_chord(outer), t);
}

struct shape_point beam_def_mid_chord_at(const struct beam_def *b, double z)
{
    const struct section_def *inner, *outer;
    const double t = sections_around(b, z, &inner, &outer);
    if (inner->shape.type == SECTION_PROPERTIES) {
        struct properties p;
        properties_blend(&inner->properties, &outer->properties, t, &p);
        return (struct shape_point){properties_mid_chord(&p), 0.0};
    }
    const double x = mix(inner->mid_chord, outer->mid_chord, t);
    const double turn = mix(inner->shape.turn, outer->shape.turn, t);
    return (struct shape_point){x * cos(turn), x * sin(turn)};
}
