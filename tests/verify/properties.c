/* What must hold exactly: rigid-body motions, patch tests, rotation of the axes, symmetric
 * laminates, the same section drawn in several ways. */
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_STRAIN_COUNT, C = SECTION_CLASSIC, NODES = 6 };

static const char *const property = "property";

/* A box of three ply angles, without any symmetry: every coupling there is. */
static void draw_coupled_box(struct shape *s)
{
    static const double degrees[BOX_WALLS][2] = {{15, -40}, {30, 0}, {-20, 60}, {10, 45}};
    const struct material skin = fixture_skin();
    static struct layup layup[BOX_WALLS];
    memset(layup, 0, sizeof layup);
    for (int w = 0; w < BOX_WALLS; w++) {
        layup[w].n_ply = 2;
        layup[w].name[0] = (char)('a' + w);
        for (int i = 0; i < 2; i++) {
            layup[w].ply[i] = draw_ply(&skin, 0.0004 + 0.0002 * i);
            layup[w].ply[i].angle = num_rad(degrees[w][i]);
        }
    }
    draw_box(s, 0.08, 0.03, BOX_WALLS, layup);
}

/* The box as a beam that nothing holds, on a mesh of unequal elements, with a lumped mass. */
static const double node_z[NODES] = {0.0, 0.11, 0.19, 0.48, 0.55, 0.9};
static const struct beam_mass store = {
    .z = 0.48, .x = 0.03, .y = -0.02, .mass = 0.4, .inertia = {1e-3, 2e-3, 3e-3}};

static void free_beam(enum shear_model shear, int n_mass, struct section *section, struct beam *out)
{
    static struct shape shape;
    static struct model m;
    double z[NODES];
    memcpy(z, node_z, sizeof z);
    const struct beam_mesh mesh = {.n_element = NODES - 1, .z = z};
    draw_coupled_box(&shape);
    built_section(&shape, &m);
    *section = m.section;
    model_done(&m);
    const struct beam_spec spec = {.mesh = &mesh,
                                   .section = section,
                                   .uniform = true,
                                   .shear = shear,
                                   .root = ROOT_FREE,
                                   .n_mass = n_mass,
                                   .mass = &store};
    if (beam_build(&spec, out) != ST_OK) {
        abort();
    }
}

/* Largest force of k x on the nodes `from` to `to`, over sum sqrt(k_ii k_jj) |x_j|. */
static double residual(const struct beam *b, const double *x, int from, int to)
{
    double largest = 0.0;
    for (int node = from; node <= to; node++) {
        for (int f = 0; f < BEAM_NODE_FREEDOMS; f++) {
            const int row = beam_index(b, node, (enum beam_freedom)f);
            double sum = 0.0, size = 1e-300;
            for (int j = 0; j < b->n_dof; j++) {
                const double term = b->k[num_at(row, j, b->n_dof)] * x[j];
                const double kk = b->k[num_at(row, row, b->n_dof)] * b->k[num_at(j, j, b->n_dof)];
                sum += term;
                size += sqrt(kk) * fabs(x[j]);
            }
            largest = fmax(largest, fabs(sum) / size);
        }
    }
    return largest;
}

static double energy(int n, const double *m, const double *x)
{
    double sum = 0.0;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            sum += x[i] * m[num_at(i, j, n)] * x[j];
        }
    }
    return sum;
}

/* Motion number `number` of six: translations along x, y, z, rotations about them. */
static void rigid_motion(const struct beam *b, int number, double *x)
{
    static const enum beam_freedom along[3] = {D_U, D_V, D_W};
    memset(x, 0, (size_t)b->n_dof * sizeof *x);
    for (int node = 0; node < NODES; node++) {
        const double z = node_z[node];
        double value[BEAM_NODE_FREEDOMS] = {0};
        if (number < 3) {
            value[along[number]] = 1.0;
        } else if (number == 3) { /* phi = 1: v = -z */
            value[D_V] = -z;
            value[D_DV] = -1.0;
        } else if (number == 4) {
            value[D_U] = z;
            value[D_DU] = 1.0;
        } else {
            value[D_THETA] = 1.0;
        }
        for (int f = 0; f < BEAM_NODE_FREEDOMS; f++) {
            x[beam_index(b, node, (enum beam_freedom)f)] = value[f];
        }
    }
}

static void rigid_motions(struct check_list *list)
{
    static const char *const name[6] = {"along x", "along y", "along z",
                                        "about x", "about y", "about z"};
    for (int shear = 0; shear < 2; shear++) {
        const char *model = shear == SHEAR_CONDENSED ? "condensed" : "retained";
        struct section s;
        struct beam b;
        free_beam((enum shear_model)shear, 1, &s, &b);
        double *x = malloc((size_t)b.n_dof * sizeof *x);
        assert(x != NULL);
        const double mass = s.mass[num_at(M_U, M_U, SECTION_MOTION_COUNT)] * node_z[NODES - 1];
        for (int k = 0; k < 6; k++) {
            rigid_motion(&b, k, x);
            check_add(list, CHECK_AT_MOST, "", residual(&b, x, 0, NODES - 1), 0.0, 1e-9, property,
                      "free box, shear %s: force of a rigid motion %s", model, name[k]);
            if (k < 3) {
                check_add(list, CHECK_RELATIVE, "kg", energy(b.n_dof, b.m, x), mass + store.mass,
                          1e-10, property, "free box, shear %s: mass %s", model, name[k]);
            }
        }
        /* About z: polar inertia of section and store. */
        const double polar =
            s.mass[num_at(M_THETA, M_THETA, SECTION_MOTION_COUNT)] * node_z[NODES - 1] +
            store.mass * (num_sq(store.x) + num_sq(store.y)) + store.inertia[2];
        check_add(list, CHECK_RELATIVE, "kg m2", energy(b.n_dof, b.m, x), polar, 1e-10, property,
                  "free box, shear %s: inertia about z", model);
        free(x);
        beam_done(&b);
    }
}

/* Nodes of a beam under one constant strain. */
static void constant_strain(const struct beam *b, int strain, double *x)
{
    memset(x, 0, (size_t)b->n_dof * sizeof *x);
    for (int node = 0; node < NODES; node++) {
        const double z = node_z[node], half = 0.5 * z * z;
        double value[BEAM_NODE_FREEDOMS] = {0};
        value[D_W] = strain == S_W ? z : 0.0;
        value[D_U] = strain == S_PSI ? half : 0.0; /* u'' = 1 */
        value[D_DU] = strain == S_PSI ? z : 0.0;
        value[D_V] = strain == S_PHI ? -half : 0.0; /* -v'' = 1 */
        value[D_DV] = strain == S_PHI ? -z : 0.0;
        value[D_THETA] = strain == S_THETA ? z : 0.0;
        value[D_DTHETA] = strain == S_THETA ? 1.0 : 0.0;
        for (int f = 0; f < BEAM_NODE_FREEDOMS; f++) {
            x[beam_index(b, node, (enum beam_freedom)f)] = value[f];
        }
    }
}

/* Largest difference of the strains along the beam from the constant ones. */
static double strain_error(const struct beam *b, const double *x, const double *expected)
{
    double largest = 0.0;
    for (int i = 0; i <= 50; i++) {
        double strain[SECTION_WIDE_COUNT];
        beam_strain_at(b, x, node_z[NODES - 1] * i / 50.0, strain);
        for (int k = 0; k < N; k++) {
            largest = fmax(largest, fabs(strain[k] - expected[k]));
        }
    }
    return largest;
}

/* A state of constant strain is met exactly at any mesh, and the inner nodes are in balance, since
 * no force of the section varies along the beam. */
static void patches(struct check_list *list)
{
    static const char *const name[] = {"extension", "lag curvature", "flap curvature", "twist"};
    struct section s;
    struct beam b;
    free_beam(SHEAR_CONDENSED, 0, &s, &b);
    double *x = malloc((size_t)b.n_dof * sizeof *x);
    assert(x != NULL);
    for (int k = S_W; k <= S_THETA; k++) {
        const double expected[N] = {[0] = k == S_W, k == S_PSI, k == S_PHI, k == S_THETA};
        constant_strain(&b, k, x);
        check_add(list, CHECK_AT_MOST, "", strain_error(&b, x, expected), 0.0, 1e-9, property,
                  "unequal elements, patch of constant %s: strains", name[k]);
        check_add(list, CHECK_AT_MOST, "", residual(&b, x, 1, NODES - 2), 0.0, 1e-9, property,
                  "unequal elements, patch of constant %s: balance", name[k]);
    }
    free(x);
    beam_done(&b);
}

/* Retained shear: a tip force on the clamped beam of unequal elements makes the shear strain of the
 * force, constant along the span, and the moments of statics. */
static void shear_patch(struct check_list *list)
{
    double z[NODES], strain[SECTION_WIDE_COUNT];
    memcpy(z, node_z, sizeof z);
    const struct material mat = fixture_isotropic(70e9, 0.3, 2700.0);
    const struct beam_mesh mesh = {.n_element = NODES - 1, .z = z};
    struct case_def def;
    struct model m;
    struct beam b;
    fixture_strip(&mat, 0.9, 0.08, 0.02, &def);
    def.kind = CASE_SECTION;
    built_model(&def, &m);
    const struct beam_spec spec = {.mesh = &mesh,
                                   .section = &m.section,
                                   .uniform = true,
                                   .shear = SHEAR_RETAINED,
                                   .root = ROOT_WARPING_RESTRAINED};
    if (beam_build(&spec, &b) != ST_OK) {
        abort();
    }
    double *f = calloc(2 * (size_t)b.n_dof, sizeof *f), *x = f + b.n_dof, worst = 0.0, bend = 0.0;
    assert(f != NULL);
    const struct beam_load load = {.force = {100.0, 50.0, 0.0}};
    beam_add_point_load(&b, 0.9, &load, f);
    if (static_solve(&b, f, x) != ST_OK) {
        abort();
    }
    const double *k = m.section.stiffness;
    for (int i = 0; i <= 50; i++) {
        const double at = 0.9 * i / 50.0;
        beam_strain_at(&b, x, at, strain);
        worst = fmax(worst, fabs(strain[S_GXZ] * k[num_at(S_GXZ, S_GXZ, N)] / 100.0 - 1.0));
        worst = fmax(worst, fabs(strain[S_GYZ] * k[num_at(S_GYZ, S_GYZ, N)] / 50.0 - 1.0));
        bend = fmax(bend, fabs(strain[S_PHI] * k[num_at(S_PHI, S_PHI, N)] + 50.0 * (0.9 - at)));
    }
    check_add(list, CHECK_AT_MOST, "", worst, 0.0, 1e-7, property,
              "unequal elements, force at the tip: constant shear Q/(k G A)");
    check_add(list, CHECK_AT_MOST, "N m", bend, 0.0, 1e-6, property,
              "unequal elements, force at the tip: moment Q (L - z)");
    free(f);
    beam_done(&b);
    model_done(&m);
}

/* Turning the section and all its axes changes no frequency. */
static void turned_axes(struct check_list *list)
{
    static struct shape shape;
    static struct case_def def;
    for (int shear = 0; shear < 2; shear++) {
        double hz[6] = {0.0};
        for (int turn = 0; turn < 3; turn++) {
            struct model m;
            draw_coupled_box(&shape);
            shape.turn = num_rad(35.0 * turn);
            draw_case(&shape, 0.9, &def);
            def.kind = CASE_MODES;
            def.solver.modes = 6;
            def.beam.section.shear = (enum shear_model)shear;
            def.beam.root_warping = ROOT_WARPING_RESTRAINED;
            built_model(&def, &m);
            for (int j = 0; j < 6; j++) {
                if (turn == 0) {
                    hz[j] = built_hz(&m, j);
                } else {
                    check_add(list, CHECK_RELATIVE, "Hz", built_hz(&m, j), hz[j], 1e-8, property,
                              "box turned by %g deg, shear %s: mode %d", 35.0 * turn,
                              shear == SHEAR_CONDENSED ? "condensed" : "retained", j + 1);
                }
            }
            model_done(&m);
        }
    }
}

/* Largest |a - b| over sqrt(b_ii b_jj) of the retained matrices, and of the mass matrices. */
static double distance(const struct section *a, const struct section *b)
{
    double largest = 0.0;
    for (int j = 0; j < N; j++) {
        for (int i = 0; i < N; i++) {
            const ptrdiff_t at = num_at(i, j, N);
            const double k = sqrt(b->stiffness[num_at(i, i, N)] * b->stiffness[num_at(j, j, N)]);
            const double m = sqrt(b->mass[num_at(i, i, N)] * b->mass[num_at(j, j, N)]);
            largest = fmax(largest, fabs(a->stiffness[at] - b->stiffness[at]) / k);
            largest = fmax(largest, fabs(a->mass[at] - b->mass[at]) / m);
        }
    }
    return largest;
}

static void same_section(struct check_list *list, const char *what, const struct shape *a,
                         const struct shape *b)
{
    static struct model one, other;
    built_section(a, &one);
    built_section(b, &other);
    check_add(list, CHECK_AT_MOST, "", distance(&one.section, &other.section), 0.0, 1e-8, property,
              "%s", what);
    model_done(&one);
    model_done(&other);
}

/* One straight wall at height y from front to rear, or the other way, laminate off by `offset`. */
static void draw_line(const struct shape *strip, double y, bool forward, double offset,
                      struct shape *out)
{
    struct ply ply[LIMIT_PLIES];
    const struct layup *l = &strip->layup[0];
    for (int i = 0; i < l->n_ply; i++) {
        ply[i] = l->ply[forward ? l->n_ply - 1 - i : i];
        ply[i].angle *= forward ? -1.0 : 1.0;
    }
    draw_contour(out, strip->contour_elements);
    const int layup = draw_layup(out, l->n_ply, ply);
    const int front = draw_point(out, 0.5 * strip->width, y);
    const int rear = draw_point(out, -0.5 * strip->width, y);
    const int wall =
        forward ? draw_wall(out, rear, front, layup) : draw_wall(out, front, rear, layup);
    out->wall[wall].offset = forward ? -offset : offset;
}

static void drawn(struct check_list *list)
{
    static struct case_def def;
    static struct shape line, other, box;
    fixture_paper_beam(-45.0, NULL, &def);
    const struct shape *strip = &def.beam.section.shape;
    draw_line(strip, 0.0, false, 0.0, &line);
    same_section(list, "a strip drawn as a contour", &line, strip);
    draw_line(strip, 0.0, true, 0.0, &line);
    same_section(list, "a strip drawn from rear to front, plies reversed", &line, strip);
    draw_line(strip, 0.0, false, 0.003, &line);
    draw_line(strip, 0.003, false, 0.0, &other);
    same_section(list, "a laminate 3 mm off its wall, and the wall 3 mm higher", &line, &other);
    draw_coupled_box(&box);
    draw_contour(&other, box.contour_elements);
    const double t = 0.5 * 0.001, x = 0.04 - t, y = 0.015 - t;
    const double corner[BOX_WALLS][2] = {{x, -y}, {x, y}, {-x, y}, {-x, -y}};
    for (int w = 0; w < BOX_WALLS; w++) {
        (void)draw_point(&other, corner[w][0], corner[w][1]);
        (void)draw_layup(&other, box.layup[w].n_ply, box.layup[w].ply);
    }
    for (int w = 0; w < BOX_WALLS; w++) {
        (void)draw_wall(&other, w, (w + 1) % BOX_WALLS, w);
    }
    same_section(list, "a box drawn as a contour", &other, &box);
}

/* A symmetric laminate has no B, and a strip of it no coupling of axial force and bending. */
static void symmetric_laminate(struct check_list *list)
{
    static const double degrees[3] = {30.0, -45.0, 80.0};
    const struct material skin = fixture_skin();
    struct ply ply[6];
    struct laminate lam;
    for (int i = 0; i < 6; i++) {
        ply[i] = draw_ply(&skin, 0.0002);
        ply[i].angle = num_rad(degrees[i < 3 ? i : 5 - i]);
    }
    if (laminate_build(6, ply, CHORDWISE_FREE, &lam) != ST_OK) {
        abort();
    }
    double largest = 0.0;
    for (int i = 0; i < 9; i++) {
        largest = fmax(largest, fabs(lam.b[i]) / (lam.a[0] * lam.thickness));
    }
    check_add(list, CHECK_AT_MOST, "", largest, 0.0, 1e-15, property,
              "[30/-45/80]s: largest B over A_zz h");
}

static void fill(struct check_list *list)
{
    rigid_motions(list);
    patches(list);
    shear_patch(list);
    turned_axes(list);
    drawn(list);
    symmetric_laminate(list);
}

const struct check_group group_properties = {
    .name = "properties",
    .title = "Exact properties",
    .text =
        "The box has four different unsymmetric layups, so that every coupling is there. Forces "
        "are measured against the sum of the sizes of the products they are made of.",
    .fill = fill,
};
