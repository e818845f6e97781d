#include "core/coupling/model.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static const double length = 1.5, chord = 0.1, thickness = 0.004, modulus = 70e9;

static void build(enum root_warping root, int elements, struct model *m)
{
    const struct material mat = fixture_isotropic(modulus, 0.3, 2700.0);
    struct case_def def;
    struct failure fail;
    fixture_strip(&mat, length, chord, thickness, &def);
    def.beam.root_warping = root;
    def.beam.elements = elements;
    assert_ok(model_build(&def, m, &fail));
}

static double *solve(const struct model *m, const double *f)
{
    const size_t n = (size_t)m->beam.n_dof;
    double *x = malloc(n * sizeof *x), *k = malloc(n * n * sizeof *k);
    memcpy(x, f, n * sizeof *x);
    memcpy(k, m->beam.k, n * n * sizeof *k);
    assert_ok(la_solve_symmetric(m->beam.n_dof, k, 1, x));
    free(k);
    return x;
}

static void indices_are_a_permutation(void **state)
{
    (void)state;
    for (int root = ROOT_WARPING_RESTRAINED; root <= ROOT_WARPING_FREE; root++) {
        struct model m;
        build((enum root_warping)root, 5, &m);
        int *seen = calloc((size_t)m.beam.n_dof, sizeof *seen);
        for (int node = 0; node <= m.beam.mesh.n_element; node++) {
            for (int f = 0; f < BEAM_NODE_FREEDOMS; f++) {
                const int i = beam_index(&m.beam, node, (enum beam_freedom)f);
                if (i >= 0) {
                    assert_true(i < m.beam.n_dof);
                    assert_int_equal(beam_freedom_at(&m.beam, i), f);
                    seen[i]++;
                } else {
                    assert_int_equal(node, 0);
                }
            }
        }
        for (int i = 0; i < m.beam.n_dof; i++) {
            assert_int_equal(seen[i], 1);
        }
        free(seen);
        model_done(&m);
    }
}

/* Cubic elements give the exact deflection of a tip load at every point, with any mesh. */
static void tip_load_is_exact(void **state)
{
    (void)state;
    const double ei = modulus * chord * pow(thickness, 3) / 12.0, force = 2.0;
    for (int elements = 1; elements <= 7; elements += 3) {
        struct model m;
        build(ROOT_WARPING_FREE, elements, &m);
        double *f = calloc((size_t)m.beam.n_dof, sizeof *f);
        f[beam_index(&m.beam, elements, D_V)] = force;
        double *x = solve(&m, f);
        for (double z = 0.0; z <= length; z += 0.1) {
            assert_near_abs(beam_motion_at(&m.beam, x, z).v,
                            force * z * z * (3.0 * length - z) / (6.0 * ei), 1e-9);
        }
        free(x);
        free(f);
        model_done(&m);
    }
}

/* Loads in both planes and an axial pull, each with its closed form. */
static void other_loads(void **state)
{
    (void)state;
    const double lag = modulus * thickness * pow(chord, 3) / 12.0, ea = modulus * thickness * chord;
    struct model m;
    build(ROOT_WARPING_FREE, 4, &m);
    double *f = calloc((size_t)m.beam.n_dof, sizeof *f);
    f[beam_index(&m.beam, 4, D_U)] = 100.0;
    f[beam_index(&m.beam, 4, D_W)] = 1e4;
    double *x = solve(&m, f);
    assert_near_rel(beam_motion_at(&m.beam, x, length).u, 100.0 * pow(length, 3) / (3.0 * lag),
                    1e-9);
    assert_near_rel(x[beam_index(&m.beam, 4, D_W)], 1e4 * length / ea, 1e-9);
    free(x);
    free(f);
    model_done(&m);
}

/* A rigid translation carries the whole mass: unit vectors through the mass matrix. The clamped
 * part is missing, so the free root is added by hand: compare with the kinetic energy of a linear
 * velocity field, which the cubic elements hold exactly: int m (z/L)^2 dz = m L / 3. */
static void mass_of_a_linear_field(void **state)
{
    (void)state;
    const double per_length = 2700.0 * chord * thickness;
    struct model m;
    build(ROOT_WARPING_FREE, 6, &m);
    const int n = m.beam.n_dof;
    double *x = calloc((size_t)n, sizeof *x), *y = calloc((size_t)n, sizeof *y);
    for (int node = 1; node <= 6; node++) {
        x[beam_index(&m.beam, node, D_W)] = node / 6.0; /* w is linear from the clamp */
    }
    fixture_multiply(n, m.beam.m, x, y);
    double energy = 0.0;
    for (int i = 0; i < n; i++) {
        energy += x[i] * y[i];
    }
    assert_near_rel(energy, per_length * length / 3.0, 1e-6);
    free(x);
    free(y);
    model_done(&m);
}

static void matrices_are_symmetric(void **state)
{
    (void)state;
    struct case_def def;
    struct failure fail;
    struct model m;
    fixture_paper_beam(-30.0, NULL, &def);
    def.kind = CASE_MODES;
    assert_ok(model_build(&def, &m, &fail));
    const int n = m.beam.n_dof;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) {
            const double k = sqrt(m.beam.k[num_at(i, i, n)] * m.beam.k[num_at(j, j, n)]);
            const double w = sqrt(m.beam.m[num_at(i, i, n)] * m.beam.m[num_at(j, j, n)]);
            assert_near_abs(m.beam.k[num_at(i, j, n)], m.beam.k[num_at(j, i, n)], 1e-12 * k);
            assert_near_abs(m.beam.m[num_at(i, j, n)], m.beam.m[num_at(j, i, n)], 1e-12 * w);
        }
    }
    model_done(&m);
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(indices_are_a_permutation),
        cmocka_unit_test(tip_load_is_exact),
        cmocka_unit_test(other_loads),
        cmocka_unit_test(mass_of_a_linear_field),
        cmocka_unit_test(matrices_are_symmetric),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
