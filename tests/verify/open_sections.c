/* Isotropic thin-walled sections against closed forms: closed tubes (Bredt), two cells, channel and
 * I (shear centre, warping constant), restrained torsion (Vlasov). */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdio.h>

enum { N = SECTION_STRAIN_COUNT, C = SECTION_CLASSIC };

static const double modulus = 70e9, poisson = 0.3, density = 2700.0;

static struct material alloy(void)
{
    return fixture_isotropic(modulus, poisson, density);
}

static int one_ply(struct shape *s, double thickness)
{
    const struct material m = alloy();
    const struct ply ply = draw_ply(&m, thickness);
    return draw_layup(s, 1, &ply);
}

/* A tube of two half circles about the origin. */
static void draw_tube(double radius, double thickness, int elements, struct shape *out)
{
    draw_contour(out, elements);
    const int layup = one_ply(out, thickness);
    const int front = draw_point(out, radius, 0.0), rear = draw_point(out, -radius, 0.0);
    (void)draw_arc(out, front, rear, layup, 0.0, radius);
    (void)draw_arc(out, rear, front, layup, 0.0, -radius);
}

struct row {
    const char *what, *unit;
    double value, reference, tolerance;
};

static void add_rows(struct check_list *list, const char *beam, const char *source, size_t n,
                     const struct row *row)
{
    for (size_t i = 0; i < n; i++) {
        check_add(list, CHECK_RELATIVE, row[i].unit, row[i].value, row[i].reference,
                  row[i].tolerance, source, "%s: %s", beam, row[i].what);
    }
}

#define ADD_ROWS(list, beam, source, rows)                                                         \
    add_rows(list, beam, source, sizeof(rows) / sizeof((rows)[0]), rows)

static void tube(struct check_list *list)
{
    const double r = 0.05, t = 0.0005, g = modulus / (2.0 * (1.0 + poisson));
    const double area = 2.0 * NUM_PI * r * t, error = 0.001; /* 256 chords for the circle */
    static struct shape shape;
    static struct model m;
    draw_tube(r, t, 100, &shape);
    built_section(&shape, &m);
    const double *k = m.section.stiffness;
    const struct row row[] = {
        {"EA", "N", m.centres.ea, modulus * area, error},
        {"EI = pi E t R^3", "N m2", m.centres.ei_major, NUM_PI * modulus * t * r * r * r, error},
        {"GJ = 2 pi G t R^3 (Bredt)", "N m2", m.centres.gj, 2.0 * NUM_PI * g * t * r * r * r,
         error},
        {"shear stiffness G A/2, x", "N", k[num_at(S_GXZ, S_GXZ, N)], 0.5 * g * area, error},
        {"shear stiffness G A/2, y", "N", k[num_at(S_GYZ, S_GYZ, N)], 0.5 * g * area, error},
        {"mass", "kg/m", m.centres.mass, density * area, error},
        {"polar inertia", "kg m", m.centres.inertia_polar, density * area * r * r, error},
    };
    ADD_ROWS(list, "round tube", "closed form, t << R", row);
    model_done(&m);
}

/* Two cells side by side: front, rear widths and height of the middle lines; thicknesses of the
 * outer walls and of the web. */
static const double cell_front = 0.08, cell_rear = 0.14, cell_height = 0.06, cell_wall = 0.0012,
                    cell_web = 0.002;

static void draw_two_cells(struct shape *s)
{
    draw_contour(s, 8);
    const int outer = one_ply(s, cell_wall), web = one_ply(s, cell_web);
    const double y = 0.5 * cell_height;
    const int a = draw_point(s, cell_front, -y), b = draw_point(s, cell_front, y);
    const int c = draw_point(s, 0.0, y), d = draw_point(s, -cell_rear, y);
    const int e = draw_point(s, -cell_rear, -y), f = draw_point(s, 0.0, -y);
    const int around[7] = {a, b, c, d, e, f, a};
    for (int i = 0; i < 6; i++) {
        (void)draw_wall(s, around[i], around[i + 1], outer);
    }
    (void)draw_wall(s, f, c, web);
}

/* Bredt for two cells: sum q ds/(G t) = 2 A theta' in each, GJ = 2 (A1 q1 + A2 q2)/theta', and the
 * walls' own G s t^3/3. */
static void two_cells(struct check_list *list)
{
    const double g = modulus / (2.0 * (1.0 + poisson)), h = cell_height;
    const double a1 = cell_front * h, a2 = cell_rear * h, web = h / cell_web;
    const double l1 = (2.0 * cell_front + h) / cell_wall + web;
    const double l2 = (2.0 * cell_rear + h) / cell_wall + web;
    const double det = l1 * l2 - web * web;
    const double q1 = 2.0 * g * (a1 * l2 + a2 * web) / det;
    const double q2 = 2.0 * g * (a2 * l1 + a1 * web) / det;
    const double outer = 2.0 * (cell_front + cell_rear + h);
    const double own = g * (outer * pow(cell_wall, 3) + h * pow(cell_web, 3)) / 3.0;
    const double area = outer * cell_wall + h * cell_web;
    const double x =
        cell_wall * (cell_front * (cell_front + h) - cell_rear * (cell_rear + h)) / area;
    static struct shape shape;
    static struct model m;
    draw_two_cells(&shape);
    built_section(&shape, &m);
    const struct row row[] = {
        {"GJ, two coupled Bredt flows", "N m2", m.centres.gj, 2.0 * (a1 * q1 + a2 * q2) + own,
         1e-9},
        {"EA", "N", m.centres.ea, modulus * area, 1e-9},
        {"tension centre x", "m", m.centres.tension_x, x, 1e-9},
        {"mass centre x", "m", m.centres.mass_x, x, 1e-9},
    };
    ADD_ROWS(list, "two cells", "closed form", row);
    check_add(list, CHECK_ABSOLUTE, "", shape_cells(&shape), 2, 0, "property", "two cells: cells");
    model_done(&m);
}

/* Flange width, web height (middle lines), thickness of both open sections; the channel's web
 * stands `web_x` before the origin, its flanges reach aft. */
static const double flange = 0.04, web = 0.06, wall = 0.001, web_x = 0.015;

static void draw_channel(struct shape *s)
{
    draw_contour(s, 12);
    const int layup = one_ply(s, wall);
    const int a = draw_point(s, web_x - flange, -0.5 * web), b = draw_point(s, web_x, -0.5 * web);
    const int c = draw_point(s, web_x, 0.5 * web), d = draw_point(s, web_x - flange, 0.5 * web);
    (void)draw_wall(s, a, b, layup);
    (void)draw_wall(s, b, c, layup);
    (void)draw_wall(s, c, d, layup);
}

static void draw_i(struct shape *s)
{
    draw_contour(s, 12);
    const int layup = one_ply(s, wall);
    const double y = 0.5 * web, x = 0.5 * flange;
    const int bottom = draw_point(s, 0.0, -y), top = draw_point(s, 0.0, y);
    (void)draw_wall(s, bottom, top, layup);
    (void)draw_wall(s, draw_point(s, x, -y), bottom, layup);
    (void)draw_wall(s, bottom, draw_point(s, -x, -y), layup);
    (void)draw_wall(s, draw_point(s, x, y), top, layup);
    (void)draw_wall(s, top, draw_point(s, -x, y), layup);
}

static double open_gj(void)
{
    const double g = modulus / (2.0 * (1.0 + poisson));
    return g * (2.0 * flange + web) * wall * wall * wall / 3.0;
}

/* Flanges and web of one thickness. */
static double channel_warping(void)
{
    return modulus * wall * pow(flange, 3) * web * web / 12.0 * (3.0 * flange + 2.0 * web) /
           (6.0 * flange + web);
}

static double i_warping(void)
{
    return modulus * wall * pow(flange, 3) * web * web / 24.0;
}

static void open_centres(struct check_list *list)
{
    static struct shape shape;
    static struct model m;
    const double flap = modulus * wall * (pow(web, 3) / 12.0 + flange * web * web / 2.0);
    const double e = 3.0 * flange * flange / (6.0 * flange + web);
    draw_channel(&shape);
    built_section(&shape, &m);
    const struct row channel[] = {
        {"shear centre before the web", "m", m.centres.shear_x - web_x, e, 0.002},
        {"tension centre aft of the web", "m", web_x - m.centres.tension_x,
         flange * flange / (2.0 * flange + web), 1e-9},
        {"EI flap", "N m2", m.centres.ei_major, flap, 0.001},
        {"GJ = G sum s t^3/3", "N m2", m.centres.gj, open_gj(), 1e-6},
        {"warping constant about the shear centre", "N m4", m.centres.ei_warping, channel_warping(),
         0.002},
    };
    ADD_ROWS(list, "channel", "closed form, Vlasov", channel);
    check_add(list, CHECK_ABSOLUTE, "m", m.centres.shear_y, 0.0, 1e-9, "symmetry",
              "channel: height of the shear centre");
    model_done(&m);
    draw_i(&shape);
    built_section(&shape, &m);
    const struct row i_section[] = {
        {"GJ = G sum s t^3/3", "N m2", m.centres.gj, open_gj(), 1e-6},
        {"warping constant E t b^3 h^2/24", "N m4", m.centres.ei_warping, i_warping(), 0.002},
        {"EI flap", "N m2", m.centres.ei_major, flap, 0.001},
    };
    ADD_ROWS(list, "I section", "closed form, Vlasov", i_section);
    check_add(list, CHECK_ABSOLUTE, "m", m.centres.shear_x, 0.0, 1e-9, "symmetry",
              "I section: shear centre x");
    model_done(&m);
}

static struct beam_motion tip_of(const struct shape *s, double length, enum shear_model shear,
                                 enum root_warping root, const struct beam_load *load)
{
    static struct case_def def;
    draw_case(s, length, &def);
    def.beam.root_warping = root;
    def.beam.section.shear = shear;
    def.loads.n_point = 1;
    def.loads.point[0] = (struct point_load_def){.z = length, .load = *load};
    return built_tip(&def);
}

/* Tip torque T, warping held at the root: theta = T/GJ (L - tanh(kL)/k), k^2 = GJ/EI_w. */
static void restrained_torsion(struct check_list *list)
{
    static struct shape shape;
    static const struct {
        const char *name;
        void (*draw)(struct shape *);
        double (*warping)(void);
    } section[] = {{"channel", draw_channel, channel_warping}, {"I section", draw_i, i_warping}};
    static const double length[] = {0.4, 0.8, 1.6};
    const struct beam_load torque = {.moment = {0.0, 0.0, 1.0}};
    for (size_t i = 0; i < sizeof section / sizeof section[0]; i++) {
        section[i].draw(&shape);
        for (size_t j = 0; j < sizeof length / sizeof length[0]; j++) {
            for (int shear = 0; shear < 2; shear++) {
                const double gj = open_gj(), k = sqrt(gj / section[i].warping()), l = length[j];
                const struct beam_motion tip =
                    tip_of(&shape, l, (enum shear_model)shear, ROOT_WARPING_RESTRAINED, &torque);
                check_add(list, CHECK_RELATIVE, "deg", num_deg(tip.theta),
                          num_deg((l - tanh(k * l) / k) / gj), 0.005, "closed form, Vlasov",
                          "%s, L %g m, shear %s, 1 N m, warping held: tip twist", section[i].name,
                          l, shear == SHEAR_CONDENSED ? "condensed" : "retained");
            }
        }
    }
}

/* A force at the shear centre does not twist; half a flange beside it, it does. */
static void force_at_shear_centre(struct check_list *list)
{
    static struct shape shape;
    static struct model m;
    draw_channel(&shape);
    built_section(&shape, &m);
    const double xs = m.centres.shear_x, length = 0.8;
    model_done(&m);
    for (int shear = 0; shear < 2; shear++) {
        const struct beam_load there = {.force = {0.0, 1.0, 0.0}, .moment = {0.0, 0.0, xs}};
        const struct beam_load here = {.force = {0.0, 1.0, 0.0}};
        const enum shear_model model = (enum shear_model)shear;
        const double none = tip_of(&shape, length, model, ROOT_WARPING_RESTRAINED, &there).theta;
        const double some = tip_of(&shape, length, model, ROOT_WARPING_RESTRAINED, &here).theta;
        check_add(list, CHECK_AT_MOST, "", fabs(none / some), 0.0, 1e-3, "property",
                  "channel, shear %s: twist of a force at the shear centre over one at the origin",
                  shear == SHEAR_CONDENSED ? "condensed" : "retained");
    }
}

static void fill(struct check_list *list)
{
    tube(list);
    two_cells(list);
    open_centres(list);
    restrained_torsion(list);
    force_at_shear_centre(list);
}

const struct check_group group_open_sections = {
    .name = "open_sections",
    .title = "Tubes, cells, open sections",
    .text =
        "Isotropic, nu = 0.3. A curved wall is a chain of straight elements: the tube of 2 x "
        "100 keeps 0.02 % of that. The closed forms of open sections are those of walls without "
        "thickness; the sections here have a bending stiffness of the walls as well, of the "
        "order (t/b)^2.",
    .fill = fill,
};
