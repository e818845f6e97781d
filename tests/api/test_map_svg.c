/* Drawings of maps: well-formed, in place, and with what the map holds. */
#include "api/map_svg.h"
#include "tests/support/unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Elements open and close in order, attributes are quoted, no bare "<" or "&". */
static void check_xml(const char *text)
{
    enum { DEPTH = 16 };
    char open[DEPTH][24];
    int depth = 0;
    for (const char *c = text; *c != '\0'; c++) {
        if (*c == '&') {
            const size_t n = strcspn(c, ";");
            assert_true(n >= 3 && n <= 5);
        }
        if (*c != '<') {
            assert_true(*c != '>');
            continue;
        }
        const bool closing = c[1] == '/';
        char name[24];
        assert_int_equal(sscanf(c + 1 + closing, "%23[a-z]", name), 1);
        bool quoted = false;
        while (*++c != '>' || quoted) {
            assert_true(*c != '\0' && *c != '<');
            quoted ^= *c == '"';
        }
        if (closing) {
            assert_true(depth > 0);
            assert_string_equal(open[--depth], name);
        } else if (c[-1] != '/') {
            assert_true(depth < DEPTH);
            memcpy(open[depth++], name, sizeof name);
        }
    }
    assert_int_equal(depth, 0);
}

static int count(const char *text, const char *part)
{
    int n = 0;
    for (const char *c = strstr(text, part); c != NULL; c = strstr(c + 1, part)) {
        n++;
    }
    return n;
}

static char *draw(const struct map_plot *plot)
{
    struct json_out out = {0};
    map_svg(&out, plot);
    char *text = json_out_take(&out, NULL);
    assert_non_null(text);
    check_xml(text);
    return text;
}

static const double angle[] = {-90.0, -45.0, 0.0, 45.0, 90.0};
static const double speed[] = {6.0, 2.0, 4.0}; /* out of order */

/* Damping falls through zero at 5 m/s; unlike the order of the speeds the drawing is sorted. */
static struct study_map damping_map(void)
{
    struct study_map m = {.value_name = "damping.tip_twist",
                          .n_dimension = 2,
                          .shape = {5, 3},
                          .n_axis = 2,
                          .axis = {{"/beam/section/layup/0/angle_deg", 0, 5, angle, NULL},
                                   {"/flow/speed_m_s", 1, 3, speed, NULL}}};
    assert_true(study_map_init(&m));
    for (int i = 0; i < m.n_cell; i++) {
        m.status[i] = STUDY_CELL_DONE;
        m.value[i] = 0.01 * (5.0 - speed[i % 3]);
    }
    return m;
}

static void a_map_of_numbers(void **state)
{
    (void)state;
    struct study_map m = damping_map();
    struct map_plot plot;
    map_plot_defaults(&m, &plot);
    assert_int_equal(plot.x, 0);
    assert_int_equal(plot.y, 1);
    assert_true(plot.level == 0.0);
    char *text = draw(&plot);
    assert_non_null(strstr(text, ">beam/section/layup/0/angle [deg]<"));
    assert_non_null(strstr(text, ">flow/speed [m/s]<"));
    assert_non_null(strstr(text, ">contour at 0, 15 of 15 cells<"));
    /* Equal neighbours are one rectangle: a row for each speed, slowest lowest. */
    const char *cells = strstr(text, "<g class=\"cells\">");
    const char *end = strstr(cells, "</g>");
    double y = 0.0, before = 1e9;
    int rows = 0;
    for (const char *c = strstr(cells, "<rect"); c != NULL && c < end; c = strstr(c + 1, "<rect")) {
        double x, width;
        assert_int_equal(sscanf(c, "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\"", &x, &y, &width), 3);
        assert_near_abs(x, 90.0, 0.01);
        assert_near_abs(width, 570.0, 0.01);
        assert_true(y < before);
        before = y;
        rows++;
    }
    assert_int_equal(rows, 3);
    /* 5 m/s is at (5 - 1)/(7 - 1) of the height: 480 - 280 = 200. */
    const char *contour = strstr(text, "<g class=\"contour\"><path d=\"");
    assert_non_null(contour);
    double a, b, c, d;
    assert_int_equal(sscanf(strchr(contour, 'M'), "M%lf %lfL%lf %lf", &a, &b, &c, &d), 4);
    assert_near_abs(b, 200.0, 0.06);
    assert_near_abs(d, 200.0, 0.06);
    assert_int_equal(count(contour, "200.0L"), 8); /* four squares, drawn twice */
    free(text);
    study_map_done(&m);
}

static void classes_and_what_is_missing(void **state)
{
    (void)state;
    struct study_map m = damping_map();
    struct map_plot plot;
    m.value_name = "verdict";
    m.n_class = 2;
    (void)snprintf(m.class_name[0], STUDY_CLASS_SIZE, "stable");
    (void)snprintf(m.class_name[1], STUDY_CLASS_SIZE, "a<b&\"c\"");
    for (int i = 0; i < m.n_cell; i++) {
        m.value[i] = i % 2;
    }
    m.status[3] = STUDY_CELL_FAILED;
    m.value[3] = (double)NAN;
    m.status[4] = STUDY_CELL_PENDING;
    m.value[4] = (double)NAN;
    map_plot_defaults(&m, &plot);
    assert_true(isnan(plot.level));
    char *text = draw(&plot);
    assert_non_null(strstr(text, ">a&lt;b&amp;&quot;c&quot;<"));
    assert_non_null(strstr(text, ">13 of 15 cells, 1 failed<"));
    assert_int_equal(count(text, "fill=\"url(#failed)\""), 2); /* cell and legend */
    assert_int_equal(count(text, "fill=\"url(#pending)\""), 2);
    assert_null(strstr(text, "class=\"contour\""));
    free(text);
    study_map_done(&m);
}

static void curves_lie_on_top(void **state)
{
    (void)state;
    struct study_map m = damping_map();
    struct map_plot plot;
    const double x[] = {-90.0, -45.0, 0.0, 45.0}, y[] = {2.0, 4.0, (double)NAN, 6.0};
    const struct map_curve curve = {"boundary", 4, x, y};
    map_plot_defaults(&m, &plot);
    plot.level = (double)NAN;
    plot.n_curve = 1;
    plot.curve = &curve;
    char *text = draw(&plot);
    /* Ends of the axis are half a cell beyond the angles: 90 + 22.5/225 * 570. */
    assert_non_null(strstr(text, "M147.0 410.0L261.0 270.0M489.0 130.0"));
    assert_int_equal(count(text, "<circle"), 3);
    assert_true(strstr(text, "class=\"cells\"") < strstr(text, "<title>boundary"));
    free(text);
    study_map_done(&m);
}

static void a_line_over_one_axis(void **state)
{
    (void)state;
    static const double x[] = {1.0, 2.0, 3.0, 4.0};
    struct study_map m = {.value_name = "means.lift_n",
                          .n_dimension = 1,
                          .shape = {4},
                          .n_axis = 1,
                          .axis = {{"/flow/speed_m_s", 0, 4, x, NULL}}};
    struct map_plot plot;
    assert_true(study_map_init(&m));
    for (int i = 0; i < 4; i++) {
        m.status[i] = i == 2 ? STUDY_CELL_FAILED : STUDY_CELL_DONE;
        m.value[i] = i == 2 ? (double)NAN : i * 10.0;
    }
    map_plot_defaults(&m, &plot);
    assert_int_equal(plot.y, -1);
    char *text = draw(&plot);
    assert_non_null(strstr(text, ">means.lift [N]<"));
    /* 0..30 with 6 % of room: 480 - 1.8/33.6 * 420 = 457.5; a gap at the third. */
    assert_non_null(strstr(text, "d=\"M90.0 457.5L280.0 332.5M660.0 82.5\""));
    assert_int_equal(count(text, "<circle"), 3);
    free(text);
    study_map_done(&m);
}

/* Nothing computed, one cell, axes of texts, a third dimension: no division by an empty range. */
static void corner_cases(void **state)
{
    (void)state;
    static const char *const polar[] = {"flat & thin", "b"};
    static const double one[] = {3.0};
    struct study_map m = {.value_name = "means.cl",
                          .n_dimension = 3,
                          .shape = {2, 1, 3},
                          .n_axis = 3,
                          .axis = {{"/aerodynamics/polar", 0, 2, NULL, polar},
                                   {"/flow/incidence_deg", 1, 1, one, NULL},
                                   {"/flow/speed_m_s", 2, 3, speed, NULL}}};
    struct map_plot plot;
    assert_true(study_map_init(&m));
    map_plot_defaults(&m, &plot);
    assert_int_equal(plot.x, 0);
    assert_int_equal(plot.y, 2);
    char *text = draw(&plot);
    assert_non_null(strstr(text, ">flat &amp; thin<"));
    assert_non_null(strstr(text, "flow/incidence [deg] = 3<"));
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf"));
    free(text);
    plot.x = 1;
    plot.y = 2;
    plot.fixed[0] = 1;
    text = draw(&plot);
    assert_non_null(strstr(text, "aerodynamics/polar = b<"));
    assert_null(strstr(text, "nan"));
    free(text);
    plot.y = -1;
    text = draw(&plot);
    assert_null(strstr(text, "nan"));
    free(text);
    study_map_done(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_map_of_numbers),  cmocka_unit_test(classes_and_what_is_missing),
        cmocka_unit_test(curves_lie_on_top), cmocka_unit_test(a_line_over_one_axis),
        cmocka_unit_test(corner_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
