/* tests/support/draw.h
 * Sections for tests: contours drawn point by point, boxes from their plies, cases around them.
 * Plain values; nothing is owned. */
#ifndef AEROM_TESTS_SUPPORT_DRAW_H
#define AEROM_TESTS_SUPPORT_DRAW_H

#include "core/case_def.h"

/* An empty contour, chordwise curvature free, so many finite elements a wall. */
void draw_contour(struct shape *s, int elements);
/* Each appends one and returns its number. */
int draw_point(struct shape *s, double x, double y);
int draw_layup(struct shape *s, int n_ply, const struct ply *ply);
int draw_wall(struct shape *s, int from, int to, int layup);
/* An arc of a circle through (x, y). */
int draw_arc(struct shape *s, int from, int to, int layup, double x, double y);

/* One ply of a material along the span. */
struct ply draw_ply(const struct material *m, double thickness);

/* A box of outer dimensions [m] whose four walls have the same plies, or, with n_layup 4, those of
 * front, top, rear, bottom; the plies from inside to outside, angles towards +s (anticlockwise). */
void draw_box(struct shape *s, double width, double height, int n_layup, const struct layup *layup);

/* A beam of this section without loads: CASE_STATIC, warping free at the root. */
void draw_case(const struct shape *s, double length, struct case_def *out);

/* A case that has stations instead of one section; `station` is borrowed. */
void draw_stations(struct case_def *def, int n, const struct station_def *station);

#endif
