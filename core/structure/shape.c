#include "core/structure/shape.h"

#include "core/num.h"
#include "core/structure/camber.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static double layup_thickness(const struct layup *l)
{
    double sum = 0.0;
    for (int i = 0; i < l->n_ply; i++) {
        sum += l->ply[i].thickness;
    }
    return sum;
}

/* Points and walls of a box on the middle lines of its walls, anticlockwise from the lower front
 * corner: front up, top aft, rear down, bottom forward. */
static void box_walls(const struct shape *s, struct shape_point point[BOX_WALLS],
                      struct shape_wall wall[BOX_WALLS])
{
    double half[BOX_WALLS];
    for (int w = 0; w < BOX_WALLS; w++) {
        wall[w] = (struct shape_wall){
            .from = w, .to = (w + 1) % BOX_WALLS, .layup = s->n_layup == BOX_WALLS ? w : 0};
        half[w] = 0.5 * layup_thickness(&s->layup[wall[w].layup]);
    }
    const double front = 0.5 * s->width - half[BOX_FRONT], top = 0.5 * s->height - half[BOX_TOP];
    const double rear = -0.5 * s->width + half[BOX_REAR];
    const double bottom = -0.5 * s->height + half[BOX_BOTTOM];
    point[0] = (struct shape_point){front, bottom};
    point[1] = (struct shape_point){front, top};
    point[2] = (struct shape_point){rear, top};
    point[3] = (struct shape_point){rear, bottom};
}

/* Points and walls of any shape; returns the number of walls. */
static int walls_of(const struct shape *s, struct shape_point point[LIMIT_POINTS],
                    struct shape_wall wall[LIMIT_WALLS], int *n_point)
{
    switch (s->type) {
    case SECTION_STRIP: /* from the leading to the trailing edge: +s aft, +n up */
        point[0] = (struct shape_point){0.5 * s->width, 0.0};
        point[1] = (struct shape_point){-0.5 * s->width, 0.0};
        wall[0] = (struct shape_wall){.from = 0, .to = 1};
        *n_point = 2;
        return 1;
    case SECTION_BOX:
        box_walls(s, point, wall);
        *n_point = BOX_WALLS;
        return BOX_WALLS;
    case SECTION_CONTOUR:
    case SECTION_PROPERTIES:
        break;
    }
    memcpy(point, s->point, (size_t)s->n_point * sizeof *point);
    memcpy(wall, s->wall, (size_t)s->n_wall * sizeof *wall);
    *n_point = s->n_point;
    return s->n_wall;
}

int shape_wall_layup(const struct shape *s, int wall)
{
    switch (s->type) {
    case SECTION_STRIP:
        return 0;
    case SECTION_BOX:
        return s->n_layup == BOX_WALLS ? wall : 0;
    case SECTION_CONTOUR:
    case SECTION_PROPERTIES:
        break;
    }
    return s->wall[wall].layup;
}

int shape_cells(const struct shape *s)
{
    struct shape_point point[LIMIT_POINTS];
    struct shape_wall wall[LIMIT_WALLS];
    int n_point = 0;
    const int n_wall = walls_of(s, point, wall, &n_point);
    return n_wall - n_point + 1;
}

/* Centre and swept angle of the arc a - via - b; false when the three lie on a line. */
static bool arc_of(struct shape_point a, struct shape_point via, struct shape_point b,
                   struct shape_point *centre, double *start, double *sweep)
{
    const double bx = via.x - a.x, by = via.y - a.y, cx = b.x - a.x, cy = b.y - a.y;
    const double d = 2.0 * (bx * cy - by * cx);
    const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    if (fabs(d) <= 1e-12 * fmax(b2, c2)) {
        return false;
    }
    const double ux = (cy * b2 - by * c2) / d, uy = (bx * c2 - cx * b2) / d;
    *centre = (struct shape_point){a.x + ux, a.y + uy};
    *start = atan2(-uy, -ux);
    const double end = atan2(cy - uy, cx - ux), turn = 2.0 * NUM_PI;
    /* Anticlockwise when via lies to the right of a -> b, that is d > 0. */
    double swept = end - *start;
    swept += d > 0.0 ? (swept <= 0.0 ? turn : 0.0) : (swept >= 0.0 ? -turn : 0.0);
    *sweep = swept;
    return true;
}

struct shape_point shape_wall_point(const struct shape_wall *w, const struct shape_point *point,
                                    double t)
{
    const struct shape_point a = point[w->from], b = point[w->to];
    struct shape_point centre;
    double start = 0.0, sweep = 0.0;
    if (w->curved && arc_of(a, w->via, b, &centre, &start, &sweep)) {
        const double radius = hypot(a.x - centre.x, a.y - centre.y), angle = start + t * sweep;
        return (struct shape_point){centre.x + radius * cos(angle), centre.y + radius * sin(angle)};
    }
    return (struct shape_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

double shape_extent(const struct shape *s, int axis)
{
    enum { PIECES = 16 }; /* of a curved wall */
    switch (s->type) {
    case SECTION_STRIP:
        return axis == 0 ? s->width : layup_thickness(&s->layup[0]);
    case SECTION_BOX:
        return axis == 0 ? s->width : s->height;
    case SECTION_CONTOUR:
    case SECTION_PROPERTIES:
        break;
    }
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int w = 0; w < s->n_wall; w++) {
        for (int i = 0; i <= PIECES; i++) {
            const struct shape_point p =
                shape_wall_point(&s->wall[w], s->point, (double)i / PIECES);
            lo = fmin(lo, axis == 0 ? p.x : p.y);
            hi = fmax(hi, axis == 0 ? p.x : p.y);
        }
    }
    return hi > lo ? hi - lo : 0.0;
}

static struct shape_point turned(struct shape_point p, double angle)
{
    /* Nose-up about z: x + i y is turned by +angle (u = -y theta, v = x theta). */
    const double c = cos(angle), s = sin(angle);
    return (struct shape_point){c * p.x - s * p.y, s * p.x + c * p.y};
}

/* Elements of one wall. Its inner nodes are numbered from *next_node on. */
static void mesh_wall(const struct shape *s, const struct shape_wall *w,
                      const struct shape_point *point, int laminate, int *next_node,
                      struct contour_element *e)
{
    const int n = s->contour_elements;
    for (int i = 0; i < n; i++) {
        e[i].node[0] = i == 0 ? w->from : *next_node - 1;
        e[i].node[1] = (*next_node)++;
        e[i].node[2] = i == n - 1 ? w->to : (*next_node)++;
        e[i].laminate = laminate;
        for (int end = 0; end < 2; end++) {
            /* The ends are the points themselves, so that walls meet to the last bit. */
            const struct shape_point raw = i + end == 0 ? point[w->from]
                                           : i + end == n
                                               ? point[w->to]
                                               : shape_wall_point(w, point, (double)(i + end) / n);
            const struct shape_point p = turned(raw, s->turn);
            e[i].x[end] = p.x;
            e[i].y[end] = p.y;
        }
    }
}

enum status shape_build(const struct shape *s, struct contour *contour,
                        struct laminate laminate[LIMIT_WALLS])
{
    assert(s->contour_elements >= 1);
    struct shape_point point[LIMIT_POINTS];
    struct shape_wall wall[LIMIT_WALLS];
    int n_point = 0;
    const int n_wall = walls_of(s, point, wall, &n_point);
    struct contour c = {.n_element = n_wall * s->contour_elements, .shear = s->wall_shear};
    c.element = calloc((size_t)c.n_element, sizeof *c.element);
    if (c.element == NULL) {
        return ST_NO_MEMORY;
    }
    enum status st = ST_OK;
    int next_node = n_point;
    for (int w = 0; w < n_wall && st == ST_OK; w++) {
        const struct layup *l = &s->layup[wall[w].layup];
        st = laminate_build_at(l->n_ply, l->ply, wall[w].offset, s->chordwise, &laminate[w]);
        mesh_wall(s, &wall[w], point, w, &next_node,
                  c.element + (ptrdiff_t)w * s->contour_elements);
    }
    c.n_node = next_node;
    if (s->chordwise == CHORDWISE_CLAMPED) {
        const struct contour_element *first = c.element, *last = &c.element[c.n_element - 1];
        c.camber = camber_line_of(&laminate[0], first->x[0], first->y[0], last->x[1], last->y[1]);
    }
    if (st != ST_OK) {
        contour_done(&c);
        return st;
    }
    *contour = c;
    return ST_OK;
}

bool shape_same(const struct shape *a, const struct shape *b)
{
    bool same = a->type == b->type && a->n_layup == b->n_layup && a->n_point == b->n_point &&
                a->n_wall == b->n_wall && a->chordwise == b->chordwise &&
                a->wall_shear == b->wall_shear && a->contour_elements == b->contour_elements;
    for (int w = 0; w < a->n_wall && same; w++) {
        const struct shape_wall *p = &a->wall[w], *q = &b->wall[w];
        same =
            p->from == q->from && p->to == q->to && p->layup == q->layup && p->curved == q->curved;
    }
    for (int l = 0; l < a->n_layup && same; l++) {
        same = a->layup[l].n_ply == b->layup[l].n_ply;
        for (int i = 0; i < a->layup[l].n_ply && same; i++) {
            same = strcmp(a->layup[l].ply[i].material.name, b->layup[l].ply[i].material.name) == 0;
        }
    }
    return same;
}

static double mix(double a, double b, double t)
{
    return a + t * (b - a);
}

static struct shape_point mix_point(struct shape_point a, struct shape_point b, double t)
{
    return (struct shape_point){mix(a.x, b.x, t), mix(a.y, b.y, t)};
}

void shape_blend(const struct shape *a, const struct shape *b, double t, struct shape *out)
{
    assert(shape_same(a, b));
    *out = *a;
    out->width = mix(a->width, b->width, t);
    out->height = mix(a->height, b->height, t);
    out->turn = mix(a->turn, b->turn, t);
    for (int l = 0; l < a->n_layup; l++) {
        for (int i = 0; i < a->layup[l].n_ply; i++) {
            const struct ply *p = &a->layup[l].ply[i], *q = &b->layup[l].ply[i];
            out->layup[l].ply[i].angle = mix(p->angle, q->angle, t);
            out->layup[l].ply[i].thickness = mix(p->thickness, q->thickness, t);
        }
    }
    for (int i = 0; i < a->n_point; i++) {
        out->point[i] = mix_point(a->point[i], b->point[i], t);
    }
    for (int w = 0; w < a->n_wall; w++) {
        out->wall[w].offset = mix(a->wall[w].offset, b->wall[w].offset, t);
        out->wall[w].via = mix_point(a->wall[w].via, b->wall[w].via, t);
    }
}
