/* Shapes: geometry of walls, meshes, what is refused, blending. */
#include "core/num.h"
#include "core/structure/shape.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static struct shape shape, other;
static struct laminate laminate[LIMIT_WALLS];

/* A square of four walls, side 2, anticlockwise, one layup of 0.1. */
static void draw_square(struct shape *s)
{
    static const double corner[4][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    const struct material m = fixture_isotropic(1.0, 0.3, 1.0);
    const struct ply ply = draw_ply(&m, 0.1);
    draw_contour(s, 4);
    (void)draw_layup(s, 1, &ply);
    for (int i = 0; i < 4; i++) {
        (void)draw_point(s, corner[i][0], corner[i][1]);
    }
    for (int i = 0; i < 4; i++) {
        (void)draw_wall(s, i, (i + 1) % 4, 0);
    }
}

/* The first finding, by code and pointer. */
static void assert_refused(const struct shape *s, const char *code, const char *pointer)
{
    static struct failure_list list;
    list = (struct failure_list){.count = 0};
    shape_check(s, "/beam/section", &list);
    assert_true(list.total >= 1);
    assert_string_equal(list.item[0].code, code);
    assert_string_equal(list.item[0].pointer, pointer);
}

static void assert_accepted(const struct shape *s)
{
    static struct failure_list list;
    list = (struct failure_list){.count = 0};
    shape_check(s, "/beam/section", &list);
    assert_int_equal(list.total, 0);
}

static void sound_shapes_are_accepted(void **state)
{
    (void)state;
    draw_square(&shape);
    assert_accepted(&shape);
    assert_int_equal(shape_cells(&shape), 1);
    shape.cells = 1;
    assert_accepted(&shape);
    (void)draw_wall(&shape, 0, 2, 0); /* a diagonal makes a second cell */
    shape.cells = 2;
    assert_accepted(&shape);
}

static void bad_geometry_is_refused(void **state)
{
    (void)state;
    draw_square(&shape);
    shape.wall[2].to = 9;
    assert_refused(&shape, "unknown_point", "/beam/section/walls/2/to");
    draw_square(&shape);
    shape.wall[1].to = shape.wall[1].from;
    assert_refused(&shape, "zero_length", "/beam/section/walls/1");
    draw_square(&shape);
    (void)draw_point(&shape, 3.0, 3.0);
    assert_refused(&shape, "unused_point", "/beam/section/points/4");
    draw_square(&shape);
    shape.cells = 2;
    assert_refused(&shape, "cells_not_closed", "/beam/section/cells");
    draw_square(&shape); /* both diagonals, no point where they cross */
    (void)draw_wall(&shape, 0, 2, 0);
    (void)draw_wall(&shape, 1, 3, 0);
    assert_refused(&shape, "walls_cross", "/beam/section/walls/5");
}

static void a_box_too_thick_is_refused(void **state)
{
    (void)state;
    const struct material m = fixture_isotropic(1.0, 0.3, 1.0);
    const struct layup layup = {.n_ply = 1, .ply = {draw_ply(&m, 0.1)}};
    draw_box(&shape, 0.5, 0.2, 1, &layup);
    assert_refused(&shape, "walls_too_thick", "/beam/section/height_m");
    draw_box(&shape, 0.5, 0.21, 1, &layup);
    assert_accepted(&shape);
}

/* Length and enclosed area of the walls' elements. */
static void measure(const struct contour *c, double *length, double *area)
{
    *length = *area = 0.0;
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *e = &c->element[i];
        *length += hypot(e->x[1] - e->x[0], e->y[1] - e->y[0]);
        *area += 0.5 * (e->x[0] * e->y[1] - e->x[1] * e->y[0]);
    }
}

static void box_walls_lie_on_their_middle_lines(void **state)
{
    (void)state;
    const struct material m = fixture_isotropic(1.0, 0.3, 1.0);
    struct layup layup[BOX_WALLS];
    struct contour c;
    double length = 0.0, area = 0.0;
    memset(layup, 0, sizeof layup);
    for (int w = 0; w < BOX_WALLS; w++) {
        layup[w].n_ply = 1;
        layup[w].ply[0] = draw_ply(&m, 0.02 * (w + 1)); /* front, top, rear, bottom */
    }
    draw_box(&shape, 1.0, 0.6, BOX_WALLS, layup);
    assert_ok(shape_build(&shape, &c, laminate));
    measure(&c, &length, &area);
    const double width = 1.0 - 0.5 * (0.02 + 0.06), height = 0.6 - 0.5 * (0.04 + 0.08);
    assert_near_rel(length, 2.0 * (width + height), 1e-12);
    assert_near_rel(area, width * height, 1e-12); /* positive: anticlockwise */
    for (int w = 0; w < BOX_WALLS; w++) {
        assert_int_equal(shape_wall_layup(&shape, w), w);
        assert_near_rel(laminate[w].thickness, 0.02 * (w + 1), 1e-12);
    }
    contour_done(&c);
}

static void nodes_are_shared_where_walls_meet(void **state)
{
    (void)state;
    struct contour c;
    draw_square(&shape);
    assert_ok(shape_build(&shape, &c, laminate));
    assert_int_equal(c.n_element, 16);
    assert_int_equal(c.n_node, 4 + 4 * 7); /* corners, and seven inner nodes a wall */
    int *seen = calloc((size_t)c.n_node, sizeof *seen);
    assert_non_null(seen);
    for (int i = 0; i < c.n_element; i++) {
        for (int k = 0; k < 3; k++) {
            assert_in_range(c.element[i].node[k], 0, c.n_node - 1);
            seen[c.element[i].node[k]]++;
        }
    }
    for (int i = 0; i < c.n_node; i++) {
        assert_in_range(seen[i], 1, 2);
    }
    assert_int_equal(seen[0], 2);
    free(seen);
    contour_done(&c);
}

static void arcs_keep_their_radius(void **state)
{
    (void)state;
    const struct shape_point point[2] = {{2.0, 1.0}, {0.0, 1.0}}; /* circle about (1, 1) */
    const struct shape_wall over = {.to = 1, .curved = true, .via = {1.0, 2.0}};
    const struct shape_wall under = {.to = 1, .curved = true, .via = {1.0, 0.0}};
    const struct shape_wall line = {.to = 1, .curved = true, .via = {1.0, 1.0}};
    for (double t = 0.0; t <= 1.0; t += 0.125) {
        const struct shape_point p = shape_wall_point(&over, point, t);
        const struct shape_point q = shape_wall_point(&under, point, t);
        assert_near_abs(hypot(p.x - 1.0, p.y - 1.0), 1.0, 1e-12);
        assert_near_abs(p.x, 1.0 + cos(NUM_PI * t), 1e-12);
        assert_near_abs(p.y, 1.0 + sin(NUM_PI * t), 1e-12);
        assert_near_abs(q.x, p.x, 1e-12);
        assert_near_abs(q.y, 2.0 - p.y, 1e-12);
        /* Three points on a line are a straight wall. */
        assert_near_abs(shape_wall_point(&line, point, t).x, 2.0 - 2.0 * t, 1e-12);
    }
}

static void a_turn_is_nose_up(void **state)
{
    (void)state;
    struct contour c;
    draw_square(&shape);
    shape.type = SECTION_STRIP;
    shape.width = 2.0;
    shape.turn = num_rad(30.0);
    assert_ok(shape_build(&shape, &c, laminate));
    assert_near_abs(c.element[0].x[0], cos(shape.turn), 1e-15);
    assert_near_abs(c.element[0].y[0], sin(shape.turn), 1e-15); /* the leading edge is up */
    assert_near_rel(shape_extent(&shape, 0), 2.0, 1e-15);
    contour_done(&c);
}

static void extents_follow_arcs(void **state)
{
    (void)state;
    draw_square(&shape);
    assert_near_rel(shape_extent(&shape, 0), 2.0, 1e-12);
    shape.wall[0].curved = true; /* the front wall bulges to x = 2 */
    shape.wall[0].via = (struct shape_point){2.0, 0.0};
    assert_near_rel(shape_extent(&shape, 0), 3.0, 1e-12);
    assert_near_rel(shape_extent(&shape, 1), 2.0, 1e-12);
}

static void blends_are_linear(void **state)
{
    (void)state;
    static struct shape mid;
    draw_square(&shape);
    other = shape;
    for (int i = 0; i < 4; i++) {
        other.point[i].x *= 3.0;
        other.point[i].y *= 0.5;
    }
    other.turn = 0.4;
    other.wall[1].offset = 0.02;
    other.layup[0].ply[0].thickness = 0.3;
    other.layup[0].ply[0].angle = 0.8;
    assert_true(shape_same(&shape, &other));
    shape_blend(&shape, &other, 0.25, &mid);
    assert_near_rel(mid.point[1].x, 1.5, 1e-15);
    assert_near_rel(mid.point[1].y, 0.875, 1e-15);
    assert_near_rel(mid.turn, 0.1, 1e-15);
    assert_near_rel(mid.wall[1].offset, 0.005, 1e-15);
    assert_near_rel(mid.layup[0].ply[0].thickness, 0.15, 1e-15);
    assert_near_rel(mid.layup[0].ply[0].angle, 0.2, 1e-15);
}

static void other_make_ups_do_not_blend(void **state)
{
    (void)state;
    draw_square(&shape);
    other = shape;
    other.layup[0].ply[0].material.name[0] = 'X';
    assert_false(shape_same(&shape, &other));
    other = shape;
    other.wall[3].to = 1;
    assert_false(shape_same(&shape, &other));
    other = shape;
    other.layup[0].n_ply = 2;
    assert_false(shape_same(&shape, &other));
    other = shape;
    other.contour_elements++;
    assert_false(shape_same(&shape, &other));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_shapes_are_accepted),
        cmocka_unit_test(bad_geometry_is_refused),
        cmocka_unit_test(a_box_too_thick_is_refused),
        cmocka_unit_test(box_walls_lie_on_their_middle_lines),
        cmocka_unit_test(nodes_are_shared_where_walls_meet),
        cmocka_unit_test(arcs_keep_their_radius),
        cmocka_unit_test(a_turn_is_nose_up),
        cmocka_unit_test(extents_follow_arcs),
        cmocka_unit_test(blends_are_linear),
        cmocka_unit_test(other_make_ups_do_not_blend),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
