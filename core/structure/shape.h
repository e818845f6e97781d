/* core/structure/shape.h
 * The shape of a section as its user gives it: a strip, a box, or points joined by walls, with a
 * layup a wall. Checked here, and turned into a contour and its laminates.
 *
 * Coordinates: x towards the leading edge, y up, origin at mid-chord. A wall runs from its first to
 * its second point; +n lies to the right of +s ((dy/ds, -dx/ds)), so a contour drawn anticlockwise
 * (x to the right, y up) has n outward. Plies are listed from the face of lowest n (inner, lower)
 * to that of highest n, and a ply's angle is measured from the span axis towards +s. Plain values;
 * nothing is owned. */
#ifndef AEROM_CORE_STRUCTURE_SHAPE_H
#define AEROM_CORE_STRUCTURE_SHAPE_H

#include "core/structure/contour.h"

#include <stdbool.h>

/* SECTION_PROPERTIES has no walls and no shape: core/structure/properties.h. */
enum section_type { SECTION_STRIP, SECTION_BOX, SECTION_CONTOUR, SECTION_PROPERTIES };

struct layup {
    char name[LIMIT_NAME]; /* "" for the only one of a strip or box */
    int n_ply;
    struct ply ply[LIMIT_PLIES];
};

struct shape_point {
    double x, y; /* [m] */
};

struct shape_wall {
    int from, to;  /* points */
    int layup;     /* index into layup[] */
    double offset; /* of the middle of the laminate from the line of the wall, along +n [m] */
    bool curved;   /* an arc of a circle from `from` through `via` to `to` */
    struct shape_point via;
};

enum box_wall { BOX_FRONT, BOX_TOP, BOX_REAR, BOX_BOTTOM, BOX_WALLS };

struct shape {
    enum section_type type;
    double width;  /* strip: its chord; box: outer width along x [m] */
    double height; /* box: outer height along y [m] */
    double turn;   /* the whole section is turned nose-up by this angle about the origin [rad] */
    int n_layup;   /* strip 1; box 1, or 4 in the order of enum box_wall; contour any */
    struct layup layup[LIMIT_LAYUPS];
    int n_point; /* contour only, as are the next ones */
    struct shape_point point[LIMIT_POINTS];
    int n_wall;
    struct shape_wall wall[LIMIT_WALLS];
    int cells; /* closed cells the user says there are, -1 when not said */
    enum chordwise_curvature chordwise;
    enum wall_shear wall_shear;
    int contour_elements; /* finite elements: of a strip or of each wall */
};

/* Appends what is wrong with the geometry: points missing or of zero distance, walls that cross or
 * do not hang together, another number of closed cells than said, box walls thicker than the box,
 * a layup named twice or used nowhere. `pointer` is the JSON pointer of the section. */
void shape_check(const struct shape *s, const char *pointer, struct failure_list *out);

/* Closed cells of the walls: edges - points + 1 of the graph. */
int shape_cells(const struct shape *s);

/* Layup of a wall (numbered as the laminates of shape_build). */
int shape_wall_layup(const struct shape *s, int wall);

/* Builds contour and laminates (one per wall, at most LIMIT_WALLS) of a checked shape. */
MUST_CHECK enum status shape_build(const struct shape *s, struct contour *contour,
                                   struct laminate laminate[LIMIT_WALLS]);

/* Outer extent along x (axis 0) or y (axis 1) before the section is turned; across a wall only the
 * thickness of a strip counts. [m] */
double shape_extent(const struct shape *s, int axis);

/* Point of a wall at t in [0, 1] of its length, before the section is turned. */
struct shape_point shape_wall_point(const struct shape_wall *w, const struct shape_point *point,
                                    double t);

/* Linear blend (1 - t) a + t b of two shapes of the same make-up (shape_same); angles of plies and
 * thicknesses are blended too. */
void shape_blend(const struct shape *a, const struct shape *b, double t, struct shape *out);

/* Same type, walls, layups and number and materials of plies: can be blended. */
bool shape_same(const struct shape *a, const struct shape *b);

#endif
