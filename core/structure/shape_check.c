/* The geometric rules of core/structure/shape.h. */
#include "core/num.h"
#include "core/structure/shape.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { ARC_PIECES = 16 }; /* straight pieces of an arc in the crossing test */

struct report {
    const char *pointer;
    struct failure_list *out;
};

static void say(const struct report *r, const char *code, const char *expected, const char *detail,
                const char *where, ...) __attribute__((format(printf, 5, 6)));

/* One finding at `pointer`/where (a format). */
static void say(const struct report *r, const char *code, const char *expected, const char *detail,
                const char *where, ...)
{
    char place[80], pointer[160];
    va_list args;
    va_start(args, where);
    (void)vsnprintf(place, sizeof place, where, args);
    va_end(args);
    (void)snprintf(pointer, sizeof pointer, "%s/%s", r->pointer, place);
    failure_set(failure_add(r->out), ST_INVALID, pointer, code, expected, NULL, "%s", detail);
}

static void check_box(const struct shape *s, const struct report *r)
{
    double thickness[BOX_WALLS] = {0};
    for (int w = 0; w < BOX_WALLS; w++) {
        const struct layup *l = &s->layup[s->n_layup == BOX_WALLS ? w : 0];
        for (int i = 0; i < l->n_ply; i++) {
            thickness[w] += l->ply[i].thickness;
        }
    }
    if (!(s->width > thickness[BOX_FRONT] + thickness[BOX_REAR])) {
        say(r, "walls_too_thick", "more than the front and rear walls together",
            "the walls fill the width of the box", "width_m");
    }
    if (!(s->height > thickness[BOX_TOP] + thickness[BOX_BOTTOM])) {
        say(r, "walls_too_thick", "more than the top and bottom walls together",
            "the walls fill the height of the box", "height_m");
    }
}

static double extent(const struct shape *s)
{
    double size = 0.0;
    for (int i = 0; i < s->n_point; i++) {
        size = fmax(size, hypot(s->point[i].x - s->point[0].x, s->point[i].y - s->point[0].y));
    }
    return size;
}

/* Indices and lengths; false when the walls cannot be looked at further. */
static bool check_walls(const struct shape *s, const struct report *r)
{
    const int before = r->out->total;
    bool used[LIMIT_POINTS] = {false}, layup_used[LIMIT_LAYUPS] = {false};
    for (int w = 0; w < s->n_wall; w++) {
        const struct shape_wall *wall = &s->wall[w];
        const int end[2] = {wall->from, wall->to};
        static const char *const key[2] = {"from", "to"};
        for (int k = 0; k < 2; k++) {
            if (end[k] < 0 || end[k] >= s->n_point) {
                say(r, "unknown_point", "the index of a point, counted from 0",
                    "there is no such point", "walls/%d/%s", w, key[k]);
                return false;
            }
            used[end[k]] = true;
        }
        layup_used[wall->layup] = true;
        const struct shape_point a = s->point[wall->from], b = s->point[wall->to];
        if (!(hypot(b.x - a.x, b.y - a.y) > 1e-9 * extent(s))) {
            say(r, "zero_length", "two points apart", "the wall has no length", "walls/%d", w);
        }
    }
    for (int i = 0; i < s->n_point; i++) {
        if (!used[i]) {
            say(r, "unused_point", NULL, "no wall meets this point", "points/%d", i);
        }
        for (int j = 0; j < i; j++) {
            if (hypot(s->point[i].x - s->point[j].x, s->point[i].y - s->point[j].y) <=
                1e-9 * extent(s)) {
                say(r, "same_point", "points apart from each other",
                    "two points lie on each other; walls that meet share one point", "points/%d",
                    i);
            }
        }
    }
    for (int l = 0; l < s->n_layup; l++) {
        if (!layup_used[l]) {
            say(r, "unused_layup", NULL, "no wall has this layup", "layups/%d", l);
        }
    }
    return r->out->total == before;
}

/* Do the walls hang together? Colours spread along the walls. */
static void check_connected(const struct shape *s, const struct report *r)
{
    bool reached[LIMIT_POINTS] = {[0] = true};
    if (s->n_wall > 0) {
        reached[0] = false;
        reached[s->wall[0].from] = true;
    }
    for (int round = 0; round < s->n_wall; round++) {
        for (int w = 0; w < s->n_wall; w++) {
            const struct shape_wall *wall = &s->wall[w];
            if (reached[wall->from] || reached[wall->to]) {
                reached[wall->from] = reached[wall->to] = true;
            }
        }
    }
    for (int w = 0; w < s->n_wall; w++) {
        if (!reached[s->wall[w].from]) {
            say(r, "walls_do_not_meet", "walls that all hang together by shared points",
                "this wall meets none of those connected to the first one", "walls/%d", w);
            return;
        }
    }
}

static double side(struct shape_point a, struct shape_point b, struct shape_point p)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* Do the open segments cross, or does an end of one lie inside the other? Ends that are the same
 * point of the section do not count. */
static bool segments_cross(struct shape_point a, struct shape_point b, struct shape_point c,
                           struct shape_point d, double size)
{
    const double tolerance = 1e-9 * size * size;
    const double s1 = side(a, b, c), s2 = side(a, b, d), s3 = side(c, d, a), s4 = side(c, d, b);
    const bool apart = (s1 > tolerance && s2 > tolerance) || (s1 < -tolerance && s2 < -tolerance) ||
                       (s3 > tolerance && s4 > tolerance) || (s3 < -tolerance && s4 < -tolerance);
    if (apart) {
        return false;
    }
    /* Touching or crossing: the common point must be inside both, not where they share an end. */
    const double nearest = 1e-6 * size;
    const bool share =
        hypot(a.x - c.x, a.y - c.y) < nearest || hypot(a.x - d.x, a.y - d.y) < nearest ||
        hypot(b.x - c.x, b.y - c.y) < nearest || hypot(b.x - d.x, b.y - d.y) < nearest;
    const bool parallel = fabs(s1) <= tolerance && fabs(s2) <= tolerance;
    if (!parallel) {
        return !share;
    }
    /* On one line: do they overlap over a length? */
    const double ux = b.x - a.x, uy = b.y - a.y, l2 = ux * ux + uy * uy;
    const double tc = ((c.x - a.x) * ux + (c.y - a.y) * uy) / l2;
    const double td = ((d.x - a.x) * ux + (d.y - a.y) * uy) / l2;
    return fmin(fmax(tc, td), 1.0) - fmax(fmin(tc, td), 0.0) > 1e-6;
}

static bool walls_cross(const struct shape *s, const struct shape_wall *p,
                        const struct shape_wall *q, double size)
{
    const int np = p->curved ? ARC_PIECES : 1, nq = q->curved ? ARC_PIECES : 1;
    for (int i = 0; i < np; i++) {
        const struct shape_point a = shape_wall_point(p, s->point, (double)i / np);
        const struct shape_point b = shape_wall_point(p, s->point, (double)(i + 1) / np);
        for (int j = 0; j < nq; j++) {
            const struct shape_point c = shape_wall_point(q, s->point, (double)j / nq);
            const struct shape_point d = shape_wall_point(q, s->point, (double)(j + 1) / nq);
            if (segments_cross(a, b, c, d, size)) {
                return true;
            }
        }
    }
    return false;
}

static void check_crossings(const struct shape *s, const struct report *r)
{
    const double size = extent(s);
    for (int w = 0; w < s->n_wall; w++) {
        for (int v = 0; v < w; v++) {
            if (walls_cross(s, &s->wall[v], &s->wall[w], size)) {
                char detail[96];
                (void)snprintf(detail, sizeof detail,
                               "the wall crosses or overlaps wall %d away from a shared point", v);
                say(r, "walls_cross", "walls that meet at their points only", detail, "walls/%d",
                    w);
            }
        }
    }
}

/* False when walls cannot be told by their layups. */
static bool check_names(const struct shape *s, const struct report *r)
{
    const int before = r->out->total;
    for (int l = 0; l < s->n_layup; l++) {
        for (int k = 0; k < l; k++) {
            if (strcmp(s->layup[l].name, s->layup[k].name) == 0) {
                say(r, "duplicate_layup", "a name of its own", "a layup of this name came before",
                    "layups/%d/name", l);
            }
        }
    }
    return r->out->total == before;
}

void shape_check(const struct shape *s, const char *pointer, struct failure_list *out)
{
    const struct report r = {.pointer = pointer, .out = out};
    if (s->type == SECTION_BOX) {
        check_box(s, &r);
    }
    if (s->type == SECTION_CONTOUR) {
        if (!check_names(s, &r) || !check_walls(s, &r)) {
            return;
        }
        check_connected(s, &r);
        check_crossings(s, &r);
    }
    if (s->cells >= 0 && s->cells != shape_cells(s)) {
        char detail[96];
        (void)snprintf(detail, sizeof detail, "%d cells were said, the walls close %d", s->cells,
                       shape_cells(s));
        say(&r, "cells_not_closed", "walls that close the cells said", detail, "cells");
    }
}
