/* Beams: the paper's beam against shell finite elements and the model page, the beam of the paper's
 * Table 2, isotropic strips against closed forms, convergence of the mesh. */
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdlib.h>

enum { BENDING = 0, TORSION = 2 };

static const char *const shell = "[3D], model page section 2";
static const char *const page = "[C], model page section 2";

/* Frequencies of the paper's beam [Hz]: bending 1-3, torsion 1-2. */
struct paper_row {
    double angle;
    enum chordwise_curvature chordwise;
    double bending[3], torsion[2];
    double bending_tolerance, torsion_tolerance;
    const char *const *source;
};

static const struct paper_row paper_rows[] = {
    {0, CHORDWISE_FREE, {4.204, 26.28, 73.72}, {34.71, 106.8}, 0.025, 0.01, &shell},
    {-45, CHORDWISE_FREE, {4.041, 25.26, 70.88}, {35.31, 108.3}, 0.025, 0.01, &shell},
    {45, CHORDWISE_FREE, {4.041, 25.26, 70.88}, {35.31, 108.3}, 0.025, 0.01, &shell},
    {0, CHORDWISE_RIGID, {4.288, 26.99, 76.10}, {34.75, 107.2}, 0.015, 0.01, &page},
    {-45, CHORDWISE_RIGID, {4.140, 26.05, 73.42}, {35.40, 109.0}, 0.015, 0.01, &page},
};

static void paper_frequencies(struct check_list *list)
{
    for (size_t i = 0; i < sizeof paper_rows / sizeof paper_rows[0]; i++) {
        const struct paper_row *r = &paper_rows[i];
        const char *chord = r->chordwise == CHORDWISE_FREE ? "free" : "rigid";
        struct case_def def;
        struct model m;
        fixture_paper_beam(r->angle, NULL, &def);
        def.kind = CASE_MODES;
        def.solver.modes = 8;
        def.beam.section.shape.chordwise = r->chordwise;
        built_model(&def, &m);
        for (int k = 0; k < 3; k++) {
            check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, BENDING, k), r->bending[k],
                      r->bending_tolerance, *r->source, "paper beam, %g deg, %s chord, bending %d",
                      r->angle, chord, k + 1);
        }
        for (int k = 0; k < 2; k++) {
            check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, TORSION, k), r->torsion[k],
                      r->torsion_tolerance, *r->source, "paper beam, %g deg, %s chord, torsion %d",
                      r->angle, chord, k + 1);
        }
        model_done(&m);
    }
}

/* beta_k L of the clamped-free Euler beam. */
static const double euler_root[3] = {1.8751040687119611, 4.6940911329741746, 7.8547574382376126};

static double euler_frequency(double ei, double mass, double length, int k)
{
    return num_sq(euler_root[k] / length) * sqrt(ei / mass) / (2.0 * NUM_PI);
}

/* The values of the model page for bending 2 and 3 (26.01 and 73.33 Hz) come from a beam whose
 * axial displacement was linear: that locks with a one-sided laminate, by 0.5 % and 1.2 %. With the
 * axial force condensed the beam must follow Euler's ratios. */
static void paper_closed_form(struct check_list *list)
{
    struct case_def def;
    struct model m;
    fixture_paper_beam(0.0, NULL, &def);
    def.kind = CASE_MODES;
    def.solver.modes = 6;
    built_model(&def, &m);
    const double mass = m.section.mass[num_at(M_V, M_V, SECTION_MOTION_COUNT)];
    for (int k = 0; k < 3; k++) {
        check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, BENDING, k),
                  euler_frequency(m.section_summary.ei_flap, mass, def.beam.length, k), 0.002,
                  "closed form, EI with N = 0", "paper beam, 0 deg, free chord, bending %d", k + 1);
    }
    model_done(&m);
}

/* Tip deflection of the paper's beam under 1 N/m upward on the whole span. */
static struct beam_motion paper_static(double angle)
{
    struct case_def def;
    struct model m;
    fixture_paper_beam(angle, NULL, &def);
    def.kind = CASE_MODES;
    built_model(&def, &m);
    double *f = calloc((size_t)m.beam.n_dof, sizeof *f);
    const struct beam_load upward = {.force = {0.0, 1.0, 0.0}};
    beam_add_line_load(&m.beam, 0.0, m.beam.length, &upward, f);
    double *x = built_static(&m, f);
    const struct beam_motion tip = beam_motion_at(&m.beam, x, m.beam.length);
    free(x);
    free(f);
    model_done(&m);
    return tip;
}

static void paper_deflection(struct check_list *list)
{
    const struct beam_motion minus = paper_static(-45.0), plus = paper_static(45.0);
    check_add(list, CHECK_RELATIVE, "mm", 1e3 * minus.v, 74.2, 0.05, shell,
              "paper beam, -45 deg, 1 N/m: tip plunge");
    check_add(list, CHECK_RELATIVE, "mm", 1e3 * minus.v, 77.1, 0.01, page,
              "paper beam, -45 deg, 1 N/m: tip plunge, section model");
    check_add(list, CHECK_RELATIVE, "deg", num_deg(minus.theta), -0.290, 0.05, shell,
              "paper beam, -45 deg, 1 N/m: tip twist, nose-down");
    check_add(list, CHECK_RELATIVE, "deg", num_deg(minus.theta), -0.280, 0.01, page,
              "paper beam, -45 deg, 1 N/m: tip twist, section model");
    check_add(list, CHECK_RELATIVE, "deg", num_deg(plus.theta), 0.290, 0.05, shell,
              "paper beam, +45 deg, 1 N/m: tip twist, nose-up");
}

/* Zeros of v (or theta) of a mode between 2 % and 98 % of the span, as z/L. */
static int mode_zeros(const struct model *m, int mode, bool twist, double *zero)
{
    enum { POINTS = 2000 };
    const double *x = m->modes.shape + (size_t)mode * (size_t)m->modes.n_dof;
    double before = 0.0;
    int n = 0;
    for (int i = POINTS / 50; i <= POINTS - POINTS / 50; i++) {
        const struct beam_motion at = beam_motion_at(&m->beam, x, m->beam.length * i / POINTS);
        const double now = twist ? at.theta : at.v;
        if (before * now < 0.0 && n < 4) {
            zero[n++] = (i - now / (now - before)) / POINTS;
        }
        before = now;
    }
    return n;
}

struct zeros {
    int mode;
    bool twist;
    int n;
    double at[3];
};

static void minguet_zeros(struct check_list *list, const struct model *m, const char *source)
{
    static const struct zeros expected[] = {
        {1, false, 1, {0.781}}, {2, false, 2, {0.501, 0.863}}, {3, false, 3, {0.356, 0.644, 0.906}},
        {1, true, 1, {0.462}},  {2, true, 2, {0.294, 0.681}},  {3, true, 1, {0.126}},
        {4, true, 0, {0.0}},
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        const struct zeros *e = &expected[i];
        const char *what = e->twist ? "twist" : "plunge";
        double zero[4] = {0};
        const int n = mode_zeros(m, e->mode, e->twist, zero);
        check_add(list, CHECK_ABSOLUTE, "", n, e->n, 0.0, source,
                  "Table-2 beam, mode %d: zeros of the %s", e->mode + 1, what);
        for (int k = 0; k < e->n; k++) {
            check_add(list, CHECK_ABSOLUTE, "L", zero[k], e->at[k], 0.01, source,
                      "Table-2 beam, mode %d: zero %d of the %s", e->mode + 1, k + 1, what);
        }
    }
}

static const char *const table_2 = "[C], validation data 1.4";

static void minguet_static(struct check_list *list, const struct model *m)
{
    double *f = calloc((size_t)m->beam.n_dof, sizeof *f);
    f[beam_index(&m->beam, m->beam.mesh.n_element, D_V)] = 1.0;
    double *x = built_static(m, f);
    const struct beam_motion tip = beam_motion_at(&m->beam, x, m->beam.length);
    check_add(list, CHECK_RELATIVE, "", fabs(tip.theta * m->beam.length / tip.v), 0.489, 0.005,
              table_2, "Table-2 beam, tip load: theta L / v");
    free(x);
    free(f);
}

/* The reference is a strip without warping stiffness at all. Ours has it, which turns the close
 * modes 4 and 5 into one another: theta L / v of mode 4 becomes 12.54. So the shapes are compared
 * with the warping stiffness taken away (a hundredth is left: the beam needs some). */
static void remove_warping(struct model *m)
{
    struct section bare = m->section;
    bare.classic[num_at(S_THETA2, S_THETA2, SECTION_CLASSIC)] *= 0.01;
    struct beam original = m->beam;
    const struct beam_spec spec = {
        .mesh = &original.mesh, .section = &bare, .uniform = true, .root = original.root};
    modes_done(&m->modes);
    if (beam_build(&spec, &m->beam) != ST_OK ||
        modes_solve(&m->beam, m->def.beam.section.shape.width, m->def.solver.modes, &m->modes) !=
            ST_OK) {
        abort();
    }
    beam_done(&original);
}

static void minguet(struct check_list *list)
{
    static const double hz[5] = {1.2838, 8.0427, 22.506, 43.997, 46.010};
    static const double ratio[4] = {0.450, 1.599, 2.796, 12.24};
    struct case_def def;
    struct model m;
    fixture_minguet_strip(&def);
    built_model(&def, &m);
    for (int j = 0; j < 5; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", m.modes.omega[j] / (2.0 * NUM_PI), hz[j], 0.003,
                  table_2, "Table-2 beam [45/0]s: mode %d", j + 1);
    }
    minguet_static(list, &m);
    remove_warping(&m);
    for (int j = 0; j < 5; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", m.modes.omega[j] / (2.0 * NUM_PI), hz[j], 0.0005,
                  table_2, "Table-2 beam, no warping stiffness: mode %d", j + 1);
    }
    for (int j = 0; j < 4; j++) {
        const struct beam_motion tip = modes_tip(&m.beam, &m.modes, j);
        check_add(list, CHECK_RELATIVE, "", fabs(tip.theta * def.beam.length / tip.v), ratio[j],
                  0.02, table_2, "Table-2 beam, mode %d: tip theta L / v", j + 1);
    }
    minguet_zeros(list, &m, table_2);
    model_done(&m);
}

struct strip_case {
    const char *name;
    double nu;
    enum chordwise_curvature chordwise;
    double ei_factor; /* EI over E b h^3/12 */
};

static void isotropic_strip(struct check_list *list)
{
    static const struct strip_case strip[] = {
        {"nu = 0", 0.0, CHORDWISE_FREE, 1.0},
        {"nu = 0.3, free chord", 0.3, CHORDWISE_FREE, 1.0},
        {"nu = 0.3, rigid chord", 0.3, CHORDWISE_RIGID, 1.0 / (1.0 - 0.3 * 0.3)},
    };
    const double length = 1.0, b = 0.02, h = 0.002, e = 70e9, rho = 2700.0;
    for (size_t i = 0; i < sizeof strip / sizeof strip[0]; i++) {
        const struct strip_case *s = &strip[i];
        const struct material mat = fixture_isotropic(e, s->nu, rho);
        const double ei = s->ei_factor * e * b * h * h * h / 12.0, mass = rho * b * h;
        const double gj = mat.g_lt * b * h * h * h / 3.0;
        const double inertia = rho * b * h * (b * b + h * h) / 12.0;
        struct case_def def;
        struct model m;
        fixture_strip(&mat, length, b, h, &def);
        def.beam.section.shape.chordwise = s->chordwise;
        def.solver.modes = 30;
        built_model(&def, &m);
        for (int k = 0; k < 3; k++) {
            check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, BENDING, k),
                      euler_frequency(ei, mass, length, k), 0.001, "closed form, Euler beam",
                      "isotropic strip, %s: bending %d", s->name, k + 1);
        }
        for (int k = 0; k < 2; k++) {
            check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, TORSION, k),
                      (2 * k + 1) / (4.0 * length) * sqrt(gj / inertia), 0.001,
                      "closed form, St Venant", "isotropic strip, %s: torsion %d", s->name, k + 1);
        }
        model_done(&m);
    }
}

/* First torsion (wide strip, so that the layer where the warping fades is resolved) or third
 * bending mode of a strip. */
static double strip_frequency(int elements, int share)
{
    const struct material mat = fixture_isotropic(70e9, 0.0, 2700.0);
    struct case_def def;
    struct model m;
    fixture_strip(&mat, 1.0, share == TORSION ? 1.0 : 0.1, 0.01, &def);
    def.beam.elements = elements;
    def.solver.modes = 12;
    built_model(&def, &m);
    const double f = built_frequency(&m, share, share == TORSION ? 0 : 2);
    model_done(&m);
    return f;
}

/* Cubic elements and operators of fourth order, EI and EI_w: the error of an eigenvalue falls with
 * the fourth power of the element length. */
static void mesh_convergence(struct check_list *list)
{
    static const int share[2] = {BENDING, TORSION};
    static const char *const name[2] = {"bending 3", "torsion 1, b = L"};
    for (int k = 0; k < 2; k++) {
        const double exact = strip_frequency(64, share[k]);
        const double coarse = strip_frequency(6, share[k]) / exact - 1.0;
        const double fine = strip_frequency(12, share[k]) / exact - 1.0;
        check_add(list, CHECK_AT_LEAST, "", log2(coarse / fine), 0.0, 3.8, "property: order 4",
                  "observed order from 6 to 12 elements, %s (errors %.2g and %.2g)", name[k],
                  coarse, fine);
    }
}

static void fill(struct check_list *list)
{
    paper_frequencies(list);
    paper_closed_form(list);
    paper_deflection(list);
    minguet(list);
    isotropic_strip(list);
    mesh_convergence(list);
}

const struct check_group group_beams = {
    .name = "beams",
    .title = "Beams: frequencies, shapes, static deflection",
    .text = "The paper's beam is [theta/foam], L 0.37 m, c 0.1 m, materials of Table 1, 16 "
            "elements, root warping restrained. Bending 2 and 3 of the section model on the model "
            "page (26.01 and 73.33 Hz at 0 deg) are 0.5 % and 1.2 % above ours: they come from a "
            "beam with linear axial displacement, which locks with a one-sided laminate. The "
            "closed form shows it. The Table-2 beam is [45/0]s of AS4/3501-6, 4 plies of 0.134 mm, "
            "L 0.55 m, b 0.03 m, without warping restraint at the root (with it mode 5 rises by "
            "1.7 %). The reference of its shapes has no warping stiffness, which matters for the "
            "close modes 4 and 5: the shapes are compared without it.",
    .fill = fill,
};
