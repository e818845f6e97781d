#include "tests/support/draw.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

void draw_contour(struct shape *s, int elements)
{
    *s = (struct shape){.type = SECTION_CONTOUR, .cells = -1, .contour_elements = elements};
}

int draw_point(struct shape *s, double x, double y)
{
    assert(s->n_point < LIMIT_POINTS);
    s->point[s->n_point] = (struct shape_point){x, y};
    return s->n_point++;
}

int draw_layup(struct shape *s, int n_ply, const struct ply *ply)
{
    assert(s->n_layup < LIMIT_LAYUPS && n_ply <= LIMIT_PLIES);
    struct layup *l = &s->layup[s->n_layup];
    *l = (struct layup){.n_ply = n_ply};
    (void)snprintf(l->name, sizeof l->name, "layup %d", s->n_layup);
    memcpy(l->ply, ply, (size_t)n_ply * sizeof *ply);
    return s->n_layup++;
}

int draw_wall(struct shape *s, int from, int to, int layup)
{
    assert(s->n_wall < LIMIT_WALLS);
    s->wall[s->n_wall] = (struct shape_wall){.from = from, .to = to, .layup = layup};
    return s->n_wall++;
}

int draw_arc(struct shape *s, int from, int to, int layup, double x, double y)
{
    const int wall = draw_wall(s, from, to, layup);
    s->wall[wall].curved = true;
    s->wall[wall].via = (struct shape_point){x, y};
    return wall;
}

struct ply draw_ply(const struct material *m, double thickness)
{
    return (struct ply){.material = *m, .thickness = thickness};
}

void draw_box(struct shape *s, double width, double height, int n_layup, const struct layup *layup)
{
    *s = (struct shape){.type = SECTION_BOX,
                        .width = width,
                        .height = height,
                        .n_layup = n_layup,
                        .cells = -1,
                        .contour_elements = 16};
    memcpy(s->layup, layup, (size_t)n_layup * sizeof *layup);
}

void draw_case(const struct shape *s, double length, struct case_def *out)
{
    case_def_defaults(out);
    out->kind = CASE_STATIC;
    out->beam.length = length;
    out->beam.root_warping = ROOT_WARPING_FREE;
    out->beam.section.shape = *s;
}

void draw_stations(struct case_def *def, int n, const struct station_def *station)
{
    def->beam.n_station = n;
    def->beam.station = station;
}
