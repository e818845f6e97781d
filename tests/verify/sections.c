/* Sections: stiffness of strips against closed forms, shear factors, invariances, Vlasov torsion.
 */
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdlib.h>

enum { N = SECTION_STRAIN_COUNT, C = SECTION_CLASSIC };

static void strip_stiffness(struct check_list *list)
{
    static const char *const closed = "closed form";
    const double e = 70e9, b = 0.05, h = 0.002;
    const struct material mat = fixture_isotropic(e, 0.3, 2700.0);
    const double g = mat.g_lt;
    struct case_def def;
    struct model m;
    fixture_strip(&mat, 1.0, b, h, &def);
    def.beam.section.shape.contour_elements = 64; /* the shear stress is a parabola: order 4 */
    built_model(&def, &m);
    const struct {
        const char *what, *unit;
        double value, reference;
    } row[] = {
        {"EA", "N", m.section.classic[num_at(S_W, S_W, C)], e * b * h},
        {"EI flap = E b h^3/12", "N m2", m.section_summary.ei_flap, e * b * h * h * h / 12.0},
        {"EI lag = E h b^3/12", "N m2", m.section_summary.ei_lag, e * h * b * b * b / 12.0},
        {"GJ = G b h^3/3", "N m2", m.section_summary.gj, g * b * h * h * h / 3.0},
        {"warping stiffness E b^3 h^3/144", "N m4",
         m.section.classic[num_at(S_THETA2, S_THETA2, C)], e * b * b * b * h * h * h / 144.0},
        {"shear in the plane, 5/6 G b h", "N", m.section.stiffness[num_at(S_GXZ, S_GXZ, N)],
         5.0 / 6.0 * g * b * h},
        {"shear out of the plane, 5/6 G b h", "N", m.section.stiffness[num_at(S_GYZ, S_GYZ, N)],
         5.0 / 6.0 * g * b * h},
        {"mass per length", "kg/m", m.section.mass[num_at(M_V, M_V, SECTION_MOTION_COUNT)],
         2700.0 * b * h},
        {"inertia about the axis", "kg m",
         m.section.mass[num_at(M_THETA, M_THETA, SECTION_MOTION_COUNT)],
         2700.0 * b * h * (b * b + h * h) / 12.0},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        check_add(list, CHECK_RELATIVE, row[i].unit, row[i].value, row[i].reference, 1e-6, closed,
                  "isotropic strip, nu = 0.3: %s", row[i].what);
    }
    model_done(&m);
}

/* CLT of the paper's beam by hand: validation data 1.5. */
static void paper_stiffness(struct check_list *list)
{
    static const struct {
        double angle, ei, gj, coupling;
    } row[] = {{0, 0.0330, 0.0635, 0.0},       {-15, 0.0325, 0.0642, -0.0014},
               {-30, 0.0314, 0.0656, -0.0019}, {-45, 0.0304, 0.0663, -0.0014},
               {-60, 0.0298, 0.0655, -0.0005}, {90, 0.0298, 0.0635, 0.0},
               {45, 0.0304, 0.0663, 0.0014}};
    static const char *const source = "[C], validation data 1.5 (3 digits)";
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct case_def def;
        struct model m;
        fixture_paper_beam(row[i].angle, NULL, &def);
        def.kind = CASE_SECTION;
        built_model(&def, &m);
        check_add(list, CHECK_RELATIVE, "N m2", m.section_summary.ei_flap, row[i].ei, 0.005, source,
                  "paper beam, %g deg: EI", row[i].angle);
        check_add(list, CHECK_RELATIVE, "N m2", m.section_summary.gj, row[i].gj, 0.005, source,
                  "paper beam, %g deg: GJ", row[i].angle);
        check_add(list, CHECK_ABSOLUTE, "N m2", m.section_summary.bend_twist, row[i].coupling, 6e-5,
                  source, "paper beam, %g deg: bending-twist", row[i].angle);
        model_done(&m);
    }
}

/* Largest |a - b| over sqrt(b_ii b_jj): the measure of a symmetric matrix of mixed units. */
static double matrix_distance(int n, const double *a, const double *b)
{
    double largest = 0.0;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            const double scale = sqrt(b[num_at(i, i, n)] * b[num_at(j, j, n)]);
            largest = fmax(largest, fabs(a[num_at(i, j, n)] - b[num_at(i, j, n)]) / scale);
        }
    }
    return largest;
}

/* The retained matrix with the shear forces zero, in the strains of the classic one (C x C). Where
 * theta' shears the section (gamma = -c theta'), its rate bends the beam: psi' = u'' - gamma_xz',
 * phi' = -v'' + gamma_yz', which belongs to theta'' then. */
static void condensed(const struct section *s, double *out)
{
    double shear[4], mixed[2 * C];
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            shear[i + 2 * j] = s->stiffness[num_at(S_GXZ + i, S_GXZ + j, N)];
        }
    }
    for (int j = 0; j < C; j++) {
        mixed[2 * j] = s->stiffness[num_at(S_GXZ, j, N)];
        mixed[2 * j + 1] = s->stiffness[num_at(S_GYZ, j, N)];
    }
    if (la_solve(2, shear, C, mixed) != ST_OK) {
        abort();
    }
    for (int j = 0; j < C; j++) {
        for (int i = 0; i < C; i++) {
            out[i + C * j] = s->stiffness[num_at(i, j, N)] -
                             s->stiffness[num_at(i, S_GXZ, N)] * mixed[2 * j] -
                             s->stiffness[num_at(i, S_GYZ, N)] * mixed[2 * j + 1];
        }
    }
    const double cx = mixed[2 * S_THETA], cy = mixed[2 * S_THETA + 1];
    for (int i = 0; i < C; i++) {
        out[i + C * S_THETA2] += cx * out[i + C * S_PSI] - cy * out[i + C * S_PHI];
    }
    for (int j = 0; j < C; j++) {
        out[S_THETA2 + C * j] += cx * out[S_PSI + C * j] - cy * out[S_PHI + C * j];
    }
}

static void condensation(struct check_list *list)
{
    static const double angle[] = {-45.0, 30.0, 0.0};
    const struct material mat = fixture_isotropic(70e9, 0.3, 2700.0);
    struct case_def def;
    struct model m;
    double k[C * C];
    fixture_strip(&mat, 1.0, 0.05, 0.002, &def);
    built_model(&def, &m);
    condensed(&m.section, k);
    check_add(list, CHECK_AT_MOST, "", matrix_distance(C, k, m.section.classic), 0.0, 1e-8,
              "property", "isotropic strip: 7 x 7 condensed on the shears less the 5 x 5");
    model_done(&m);
    for (size_t i = 0; i < sizeof angle / sizeof angle[0]; i++) {
        fixture_paper_beam(angle[i], NULL, &def);
        def.kind = CASE_SECTION;
        def.beam.section.shape.contour_elements = 64;
        built_model(&def, &m);
        condensed(&m.section, k);
        check_add(list, CHECK_AT_MOST, "", matrix_distance(C, k, m.section.classic), 0.0, 1e-9,
                  "property", "paper beam, %g deg: 7 x 7 condensed on the shears less the 5 x 5",
                  angle[i]);
        model_done(&m);
    }
}

static void invariances(struct check_list *list)
{
    static const double angle[] = {-45.0, 30.0, 0.0};
    for (size_t i = 0; i < sizeof angle / sizeof angle[0]; i++) {
        struct case_def def;
        struct model m, turned, refined;
        fixture_paper_beam(angle[i], NULL, &def);
        def.kind = CASE_SECTION;
        built_model(&def, &m);
        def.beam.section.shape.layup[0].ply[0].angle += NUM_PI;
        def.beam.section.shape.layup[0].ply[1].angle -= NUM_PI;
        built_model(&def, &turned);
        check_add(list, CHECK_AT_MOST, "",
                  matrix_distance(N, turned.section.stiffness, m.section.stiffness), 0.0, 1e-10,
                  "property", "paper beam, %g deg: plies turned by 180 deg", angle[i]);
        def.beam.section.shape.contour_elements = 64;
        built_model(&def, &refined);
        check_add(list, CHECK_AT_MOST, "",
                  matrix_distance(C, refined.section.classic, m.section.classic), 0.0, 1e-9,
                  "property", "paper beam, %g deg: 64 instead of 16 wall elements, 5 x 5",
                  angle[i]);
        check_add(list, CHECK_AT_MOST, "",
                  matrix_distance(N, refined.section.stiffness, m.section.stiffness), 0.0, 1e-4,
                  "property: error 1/elements^4",
                  "paper beam, %g deg: 64 instead of 16 wall elements, 7 x 7", angle[i]);
        model_done(&m);
        model_done(&turned);
        model_done(&refined);
    }
}

/* Tip twist of a clamped strip under a tip torque with the warping held at the root: Vlasov's
 * theta = T/GJ (L - tanh(kL)/k), k = sqrt(GJ/EI_w). */
static void vlasov(struct check_list *list)
{
    static const double width[] = {0.05, 0.2, 0.5};
    const double length = 1.0, h = 0.004, e = 70e9, torque = 0.1;
    const struct material mat = fixture_isotropic(e, 0.0, 2700.0);
    for (size_t i = 0; i < sizeof width / sizeof width[0]; i++) {
        const double b = width[i];
        struct case_def def;
        struct model m;
        fixture_strip(&mat, length, b, h, &def);
        def.beam.root_warping = ROOT_WARPING_RESTRAINED;
        built_model(&def, &m);
        double *f = calloc((size_t)m.beam.n_dof, sizeof *f);
        f[beam_index(&m.beam, m.beam.mesh.n_element, D_THETA)] = torque;
        double *x = built_static(&m, f);
        const double gj = mat.g_lt * b * h * h * h / 3.0;
        const double ew = e * b * b * b * h * h * h / 144.0, k = sqrt(gj / ew);
        check_add(list, CHECK_RELATIVE, "deg", num_deg(beam_motion_at(&m.beam, x, length).theta),
                  num_deg(torque / gj * (length - tanh(k * length) / k)), 0.005,
                  "closed form, Vlasov", "strip b = %g L, tip torque, warping held: tip twist", b);
        free(x);
        free(f);
        model_done(&m);
    }
}

static void fill(struct check_list *list)
{
    strip_stiffness(list);
    paper_stiffness(list);
    condensation(list);
    invariances(list);
    vlasov(list);
}

const struct check_group group_sections = {
    .name = "sections",
    .title = "Sections: stiffness and mass",
    .text = "Distances of matrices are the largest difference of an entry over the root of the "
            "product of the two diagonal entries. Sign of the bending-twist stiffness: moment "
            "about -v'' per unit theta', so a negative ply angle (towards the leading edge) gives "
            "wash-out.",
    .fill = fill,
};
