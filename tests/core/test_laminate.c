/* Lamination theory against formulas written out by hand. */
#include "core/num.h"
#include "core/structure/laminate.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

static struct ply ply_of(struct material m, double degrees, double thickness)
{
    return (struct ply){.material = m, .angle = num_rad(degrees), .thickness = thickness};
}

/* Reduced stiffness of a ply in its own axes. */
struct q {
    double q11, q22, q12, q66;
};

static struct q q_of(const struct material *m)
{
    const double den = 1.0 - m->nu_lt * m->nu_lt * m->e_t / m->e_l;
    return (struct q){m->e_l / den, m->e_t / den, m->nu_lt * m->e_t / den, m->g_lt};
}

static void one_ply_along_the_span(void **state)
{
    (void)state;
    const double h = 0.002;
    const struct ply p = ply_of(fixture_skin(), 0.0, h);
    const struct q q = q_of(&p.material);
    struct laminate lam;
    assert_ok(laminate_build(1, &p, CHORDWISE_FREE, &lam));
    /* The misprint of (A.14) would put 9.8 GPa here. */
    assert_near_rel(lam.a[0] / h, q.q11, 1e-14);
    assert_near_rel(lam.a[4] / h, q.q22, 1e-14);
    assert_near_rel(lam.a[1] / h, q.q12, 1e-14);
    assert_near_rel(lam.a[8] / h, q.q66, 1e-14);
    assert_near_rel(lam.d[0], q.q11 * h * h * h / 12.0, 1e-14);
    assert_near_rel(lam.f[0] + 1.0, 1.0, 1e-12);
    assert_near_rel(lam.h[0], q.q11 * pow(h, 5) / 80.0, 1e-14);
    for (int i = 0; i < 9; i++) {
        assert_near_abs(lam.b[i], 0.0, 1e-9);
    }
    /* Free stress across: the plain moduli come back. */
    assert_near_rel(lam.reduced[0], p.material.e_l * h, 1e-14);
    assert_near_rel(lam.reduced[5], p.material.g_lt * h, 1e-14);
    assert_near_rel(lam.reduced[10], p.material.e_l * h * h * h / 12.0, 1e-14);
    assert_near_rel(lam.reduced[15], p.material.g_lt * h * h * h / 12.0, 1e-14);
    assert_near_rel(lam.shear_zn, 5.0 / 6.0 * p.material.g_lt * h, 1e-14);
    assert_near_rel(lam.m0, p.material.density * h, 1e-14);
    assert_near_rel(lam.m2, p.material.density * h * h * h / 12.0, 1e-14);
}

static void rigid_chord_keeps_the_plate_modulus(void **state)
{
    (void)state;
    const double h = 0.002, nu = 0.3, e = 70e9;
    const struct ply p = ply_of(fixture_isotropic(e, nu, 2700.0), 0.0, h);
    struct laminate lam;
    assert_ok(laminate_build(1, &p, CHORDWISE_RIGID, &lam));
    assert_near_rel(lam.reduced[0], e * h, 1e-14); /* N_ss = 0 either way */
    assert_near_rel(lam.reduced[10], e * h * h * h / 12.0 / (1.0 - nu * nu), 1e-13);
}

/* Q-bar at 45 degrees by its own formulas. */
static void a_ply_at_45_degrees(void **state)
{
    (void)state;
    const struct ply plus = ply_of(fixture_skin(), 45.0, 1.0);
    const struct ply minus = ply_of(fixture_skin(), -45.0, 1.0);
    const struct q q = q_of(&plus.material);
    struct laminate a, b;
    assert_ok(laminate_build(1, &plus, CHORDWISE_FREE, &a));
    assert_ok(laminate_build(1, &minus, CHORDWISE_FREE, &b));
    assert_near_rel(a.a[0], 0.25 * (q.q11 + q.q22 + 2.0 * q.q12) + q.q66, 1e-13);
    assert_near_rel(a.a[4], a.a[0], 1e-13);
    assert_near_rel(a.a[8], 0.25 * (q.q11 + q.q22 - 2.0 * q.q12), 1e-13);
    /* Fibres towards +s: stretch along z drags +s with it. */
    assert_near_rel(a.a[2], 0.25 * (q.q11 - q.q22), 1e-13);
    assert_near_rel(b.a[2], -a.a[2], 1e-13);
}

static void symmetric_layups_do_not_couple(void **state)
{
    (void)state;
    static const double degrees[6] = {30.0, -45.0, 90.0, 90.0, -45.0, 30.0};
    struct ply ply[6];
    for (int i = 0; i < 6; i++) {
        ply[i] = ply_of(i == 2 || i == 3 ? fixture_foam() : fixture_skin(), degrees[i], 0.000125);
    }
    struct laminate lam;
    assert_ok(laminate_build(6, ply, CHORDWISE_FREE, &lam));
    for (int i = 0; i < 9; i++) {
        assert_near_abs(lam.b[i], 0.0, 1e-12 * lam.a[0] * lam.thickness);
    }
    assert_near_abs(lam.m1, 0.0, 1e-15);
}

/* One-sided skin on foam: B and m1 by hand. */
static void one_sided_laminate(void **state)
{
    (void)state;
    struct case_def def;
    fixture_paper_beam(0.0, NULL, &def);
    const struct ply *p = def.beam.section.shape.layup[0].ply;
    const double t = p[0].thickness, u = p[1].thickness;
    const struct q skin = q_of(&p[0].material), foam = q_of(&p[1].material);
    struct laminate lam;
    assert_ok(laminate_build(2, p, CHORDWISE_FREE, &lam));
    assert_near_rel(lam.thickness, 0.004, 1e-14);
    /* First ply is the lower one: its middle lies at -(h - t)/2. */
    const double b = skin.q11 * t * (-0.5 * (0.004 - t)) + foam.q11 * u * 0.5 * (0.004 - u);
    assert_near_rel(lam.b[0], b, 1e-13);
    const double m1 = 1445.0 * t * (-0.5 * (0.004 - t)) + 35.0 * u * 0.5 * (0.004 - u);
    assert_near_rel(lam.m1, m1, 1e-13);
    assert_near_rel(lam.m0, 1445.0 * t + 35.0 * u, 1e-13);
}

static void half_a_turn_changes_nothing(void **state)
{
    (void)state;
    struct case_def def;
    fixture_paper_beam(33.0, NULL, &def);
    struct ply turned[2] = {def.beam.section.shape.layup[0].ply[0],
                            def.beam.section.shape.layup[0].ply[1]};
    turned[0].angle += NUM_PI;
    turned[1].angle -= NUM_PI;
    struct laminate a, b;
    assert_ok(laminate_build(2, def.beam.section.shape.layup[0].ply, CHORDWISE_FREE, &a));
    assert_ok(laminate_build(2, turned, CHORDWISE_FREE, &b));
    for (int i = 0; i < 16; i++) {
        assert_near_abs(b.reduced[i], a.reduced[i], 1e-12 * a.reduced[0]);
    }
}

static void inadmissible_plies_are_refused(void **state)
{
    (void)state;
    const struct ply good = ply_of(fixture_skin(), 0.0, 0.001);
    struct ply bad[4] = {good, good, good, good};
    bad[0].thickness = 0.0;
    bad[1].thickness = (double)NAN;
    bad[2].material.e_t = -1.0;
    bad[3].material.nu_lt = 10.0;
    for (int i = 0; i < 4; i++) {
        struct laminate lam = {.thickness = -7.0};
        assert_int_equal(laminate_build(1, &bad[i], CHORDWISE_FREE, &lam), ST_INVALID);
        assert_true(lam.thickness == -7.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_ply_along_the_span),
        cmocka_unit_test(rigid_chord_keeps_the_plate_modulus),
        cmocka_unit_test(a_ply_at_45_degrees),
        cmocka_unit_test(symmetric_layups_do_not_couple),
        cmocka_unit_test(one_sided_laminate),
        cmocka_unit_test(half_a_turn_changes_nothing),
        cmocka_unit_test(inadmissible_plies_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
