/* A section given by numbers: its matrices, what follows from what, and what is refused. */
#include "core/case_def.h"
#include "core/num.h"
#include "core/structure/centres.h"
#include "tests/support/unit.h"

#include <string.h>

enum { C = SECTION_CLASSIC, M = SECTION_MOTION_COUNT };

/* Elastic axis at 0.3, mass centre at 0.45 of a chord of 2 m: x = -0.3 m; mid-chord x = -0.4 m. */
static struct properties given(void)
{
    struct properties p;
    properties_defaults(&p);
    p.chord = 2.0;
    p.ei_flap = 100.0;
    p.gj = 25.0;
    p.bend_twist = 10.0;
    p.mass = 3.0;
    p.torsion_inertia = 0.8;
    p.elastic_axis = 0.3;
    p.mass_axis = 0.45;
    properties_complete(&p);
    return p;
}

static void matrices_follow_from_the_numbers(void **state)
{
    (void)state;
    const struct properties p = given();
    struct section s;
    struct section_summary summary;
    struct centres c;
    properties_build(&p, &s);
    assert_ok(section_summarise(&s, &summary));
    assert_near_rel(summary.ei_flap, 100.0, 1e-15);
    assert_near_rel(summary.ei_lag, 1e6, 1e-15);
    assert_near_rel(summary.gj, 25.0, 1e-15);
    assert_near_rel(summary.bend_twist, 10.0, 1e-15);
    assert_ok(centres_find(&s, &c));
    assert_near_rel(c.ea, 3e6, 1e-15);
    assert_near_abs(c.tension_x, 0.0, 1e-15);
    assert_near_abs(c.shear_x, 0.0, 1e-15);
    assert_near_rel(c.mass_x, -0.3, 1e-14);
    assert_near_rel(c.inertia_polar, 0.8 - 3.0 * 0.09, 1e-13);
    assert_near_rel(c.gj, 25.0 - 1.0, 1e-14); /* with free bending: K^2/EI less */
    assert_near_abs(c.ei_warping, 0.0, 0.0);
    assert_true(isnan(s.stiffness[num_at(S_GXZ, S_GXZ, SECTION_STRAIN_COUNT)]));
    assert_true(isnan(c.extension_shear_x));
}

/* Kinetic energy of a motion is that of the mass on its line and of its own turning. */
static void mass_matrix_is_the_kinetic_energy(void **state)
{
    (void)state;
    const struct properties p = given();
    struct section s;
    properties_build(&p, &s);
    const double rate[M] = {[M_U] = 0.3,  [M_V] = -0.7,    [M_W] = 0.2,     [M_DV] = 0.9,
                            [M_DU] = 1.1, [M_THETA] = 0.6, [M_DTHETA] = 5.0};
    const double x = -0.3, v = rate[M_V] + x * rate[M_THETA], w = rate[M_W] - x * rate[M_DU];
    double twice = 0.0;
    for (int i = 0; i < M; i++) {
        for (int j = 0; j < M; j++) {
            twice += rate[i] * s.mass[num_at(i, j, M)] * rate[j];
        }
    }
    assert_near_rel(
        twice, 3.0 * (num_sq(rate[M_U]) + v * v + w * w) + (0.8 - 0.27) * num_sq(rate[M_THETA]),
        1e-14);
}

/* The same wing whatever axis its inertia is given about. */
static void inertia_about_any_axis(void **state)
{
    (void)state;
    static const struct {
        enum inertia_axis axis;
        double arm;
    } row[] = {{INERTIA_ELASTIC_AXIS, 0.3}, {INERTIA_MASS_CENTRE, 0.0}, {INERTIA_MID_CHORD, 0.1}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct properties p = given();
        p.inertia_axis = row[i].axis;
        p.torsion_inertia = 0.53 + 3.0 * num_sq(row[i].arm);
        assert_near_rel(properties_central_inertia(&p), 0.53, 1e-14);
    }
}

static void blend_is_linear_and_stays_admissible(void **state)
{
    (void)state;
    static struct failure_list found;
    struct properties a = given(), b = given(), mid;
    /* Both barely above the least inertia about the elastic axis; the mass moves inwards. */
    a.mass = 0.1;
    a.mass_axis = 0.8;
    a.torsion_inertia = 0.1 + 1e-6;
    b.mass = 1.0;
    b.mass_axis = 0.35;
    b.chord = 1.0;
    b.torsion_inertia = 0.0025 + 1e-6;
    b.ei_flap = 50.0;
    properties_blend(&a, &b, 0.25, &mid);
    assert_near_rel(mid.ei_flap, 87.5, 1e-15);
    assert_near_rel(mid.chord, 1.75, 1e-15);
    assert_near_rel(mid.mass, 0.325, 1e-15);
    assert_near_rel(properties_central_inertia(&mid), 1e-6, 1e-9);
    memset(&found, 0, sizeof found);
    properties_check(&mid, "/s", &found);
    assert_int_equal(found.total, 0);
    properties_blend(&a, &a, 0.5, &mid);
    assert_near_rel(properties_mass_centre(&mid), properties_mass_centre(&a), 1e-15);
    assert_near_rel(properties_mid_chord(&mid), properties_mid_chord(&a), 1e-15);
}

static void expect(const struct properties *p, const char *pointer, const char *code)
{
    static struct failure_list found;
    memset(&found, 0, sizeof found);
    properties_check(p, "/s", &found);
    assert_int_equal(found.total, 1);
    assert_string_equal(found.item[0].pointer, pointer);
    assert_string_equal(found.item[0].code, code);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    static const struct {
        size_t member;
        double value;
        const char *pointer, *code;
    } row[] = {
#define ROW(member_, value_, key_, code_)                                                          \
    {offsetof(struct properties, member_), value_, "/s/" key_, code_}
        ROW(chord, 0.0, "chord_m", "out_of_range"),
        ROW(chord, (double)NAN, "chord_m", "out_of_range"),
        ROW(ei_flap, -1.0, "ei_flap_n_m2", "out_of_range"),
        ROW(ei_lag, 0.0, "ei_lag_n_m2", "out_of_range"),
        ROW(gj, 0.0, "gj_n_m2", "out_of_range"),
        ROW(ea, (double)INFINITY, "ea_n", "out_of_range"),
        ROW(ei_warping, -1e-9, "ei_warping_n_m4", "out_of_range"),
        ROW(bend_twist, (double)NAN, "bend_twist_n_m2", "out_of_range"),
        ROW(bend_twist, 50.0, "bend_twist_n_m2", "not_positive_definite"),
        ROW(mass, 0.0, "mass_kg_m", "out_of_range"),
        ROW(torsion_inertia, 0.0, "torsion_inertia_kg_m", "out_of_range"),
        ROW(torsion_inertia, 0.26, "torsion_inertia_kg_m", "inertia_too_small"),
        ROW(elastic_axis, -0.1, "elastic_axis_chord", "out_of_range"),
        ROW(mass_axis, 1.1, "mass_axis_chord", "out_of_range"),
#undef ROW
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct properties p = given();
        memcpy((char *)&p + row[i].member, &row[i].value, sizeof(double));
        expect(&p, row[i].pointer, row[i].code);
    }
}

/* Shear that the beam keeps must be known all along it. */
static void retained_shear_needs_walls(void **state)
{
    (void)state;
    static struct failure_list found;
    static struct case_def def;
    memset(&found, 0, sizeof found);
    case_def_defaults(&def);
    def.kind = CASE_MODES;
    def.beam.length = 1.0;
    section_def_defaults(SECTION_PROPERTIES, &def.beam.section);
    def.beam.section.properties = given();
    case_def_check(&def, &found);
    assert_int_equal(found.total, 0);
    def.beam.section.shear = SHEAR_RETAINED;
    case_def_check(&def, &found);
    assert_int_equal(found.total, 1);
    assert_string_equal(found.item[0].pointer, "/beam/section/shear");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrices_follow_from_the_numbers),
        cmocka_unit_test(mass_matrix_is_the_kinetic_energy),
        cmocka_unit_test(inertia_about_any_axis),
        cmocka_unit_test(blend_is_linear_and_stays_admissible),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(retained_shear_needs_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
