#include "core/structure/shape.h"
#include "tests/support/unit.h"

static void a_strip_runs_from_leading_to_trailing_edge(void **state)
{
    (void)state;
    static struct shape shape = {
        .type = SECTION_STRIP, .width = 0.1, .n_layup = 1, .cells = -1, .contour_elements = 5};
    static struct laminate laminate[LIMIT_WALLS];
    struct contour c;
    shape.layup[0] =
        (struct layup){.n_ply = 1,
                       .ply = {{.material = {.e_l = 1.0, .e_t = 1.0, .g_lt = 1.0, .g_tt = 1.0},
                                .thickness = 1e-3}}};
    assert_ok(shape_build(&shape, &c, laminate));
    assert_int_equal(c.n_element, 5);
    assert_int_equal(c.n_node, 11);
    assert_near_abs(c.element[0].x[0], 0.05, 1e-16);
    assert_near_abs(c.element[4].x[1], -0.05, 1e-16);
    double length = 0.0;
    for (int i = 0; i < 5; i++) {
        const struct contour_point p = contour_at(&c.element[i], 0.3);
        length += 2.0 * p.jacobian;
        assert_near_abs(p.dx, -1.0, 1e-15);
        assert_near_abs(p.dy, 0.0, 1e-15);
        assert_near_abs(p.r_n, 0.0, 1e-16);
        assert_near_abs(p.r_t, -p.x, 1e-16);
        if (i > 0) {
            assert_int_equal(c.element[i].node[0], c.element[i - 1].node[2]);
            assert_near_abs(c.element[i].x[0], c.element[i - 1].x[1], 1e-16);
        }
    }
    assert_near_rel(length, 0.1, 1e-14);
    contour_done(&c);
    assert_null(c.element);
    contour_done(&c); /* a zeroed struct is accepted */
}

/* Quadratic shape functions reproduce a parabola and its slope, on a slanted wall as well. */
static void shape_functions_are_quadratic(void **state)
{
    (void)state;
    const struct contour_element e = {.node = {0, 1, 2}, .x = {0.2, 0.5}, .y = {-0.1, 0.3}};
    const double length = 0.5, c = 3.0, b = -1.0;
    const double value[3] = {0.0, c * length * length / 4.0 + b * length / 2.0,
                             c * length * length + b * length};
    for (double xi = -1.0; xi <= 1.0; xi += 0.25) {
        const struct contour_point p = contour_at(&e, xi);
        const double s = 0.5 * (1.0 + xi) * length;
        double sum = 0.0, slope = 0.0;
        for (int a = 0; a < 3; a++) {
            sum += p.shape[a] * value[a];
            slope += p.slope[a] * value[a];
        }
        assert_near_abs(sum, c * s * s + b * s, 1e-14);
        assert_near_abs(slope, 2.0 * c * s + b, 1e-13);
        assert_near_abs(p.dx, 0.6, 1e-15);
        assert_near_abs(p.dy, 0.8, 1e-15);
        assert_near_abs(p.r_n, p.x * 0.8 - p.y * 0.6, 1e-15);
        assert_near_abs(p.r_t, p.x * 0.6 + p.y * 0.8, 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_strip_runs_from_leading_to_trailing_edge),
        cmocka_unit_test(shape_functions_are_quadratic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
