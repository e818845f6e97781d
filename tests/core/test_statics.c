/* What a static case returns beyond its numbers, which tests/verify/loads.c checks. */
#include "core/analysis/statics.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/draw.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

static struct case_def def;

/* The paper's beam with an upward force at its tip. */
static void make(double force)
{
    fixture_paper_beam(-45.0, NULL, &def);
    def.kind = CASE_STATIC;
    def.loads.n_point = 1;
    def.loads.point[0] =
        (struct point_load_def){.z = def.beam.length, .load = {.force = {0.0, force, 0.0}}};
}

static void run(struct model *m, struct static_result *r)
{
    struct failure fail;
    assert_ok(model_build(&def, m, &fail));
    assert_ok(statics_run(m, r));
}

static void the_span_runs_from_root_to_tip(void **state)
{
    (void)state;
    struct model m;
    struct static_result r;
    make(1.0);
    run(&m, &r);
    assert_near_abs(r.span[0].z, 0.0, 0.0);
    assert_near_abs(r.span[0].motion.v, 0.0, 0.0);
    assert_near_abs(r.span[0].motion.theta_rate, 0.0, 0.0);
    assert_near_rel(r.span[STATIC_SAMPLES - 1].z, def.beam.length, 1e-15);
    assert_near_rel(r.span[STATIC_SAMPLES - 1].motion.v, r.tip.v, 1e-12);
    for (int i = 1; i < STATIC_SAMPLES; i++) {
        assert_true(r.span[i].motion.v > r.span[i - 1].motion.v);
    }
    assert_true(r.tip.theta < 0.0); /* fibres towards the leading edge: wash-out */
    statics_done(&r);
    model_done(&m);
}

static void answers_are_linear_in_the_loads(void **state)
{
    (void)state;
    struct model m;
    struct static_result once, twice;
    make(1.0);
    run(&m, &once);
    model_done(&m);
    make(-2.0);
    run(&m, &twice);
    assert_near_rel(twice.tip.v, -2.0 * once.tip.v, 1e-10);
    assert_near_rel(twice.tip.theta, -2.0 * once.tip.theta, 1e-10);
    assert_near_rel(twice.reaction_force[1], -2.0 * once.reaction_force[1], 1e-12);
    statics_done(&once);
    statics_done(&twice);
    model_done(&m);
}

/* The foam has no strengths: its states have no index, and the reserve is that of the skin. */
static void reserve_is_that_of_the_plies_with_strengths(void **state)
{
    (void)state;
    struct model m;
    struct static_result r;
    make(0.5);
    struct material *skin = &def.beam.section.shape.layup[0].ply[0].material;
    skin->x_tension = skin->x_compression = 1500e6;
    skin->y_tension = skin->y_compression = 60e6;
    skin->s_shear = 90e6;
    def.output.n_stress = 2;
    def.output.stress[0] = 0.3;
    def.output.stress[1] = 0.05;
    run(&m, &r);
    assert_int_equal(r.n_stress, 2);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(r.stress[i].n_ply, 2);
        assert_true(!isnan(r.stress[i].ply[0].reserve));
        assert_true(isnan(r.stress[i].ply[1].reserve));
    }
    assert_int_equal(r.critical_position, 1); /* nearer to the root */
    assert_int_equal(r.critical_ply, 0);
    assert_near_abs(r.reserve_min, r.stress[1].ply[0].reserve, 0.0);
    statics_done(&r);
    model_done(&m);
}

static void without_strengths_there_is_no_reserve(void **state)
{
    (void)state;
    struct model m;
    struct static_result r;
    make(0.5);
    def.output.n_stress = 1;
    def.output.stress[0] = 0.1;
    run(&m, &r);
    assert_true(isnan(r.reserve_min));
    assert_int_equal(r.critical_position, -1);
    assert_int_equal(r.critical_ply, -1);
    statics_done(&r);
    statics_done(&r); /* twice is once */
    model_done(&m);
}

static void no_load_no_motion(void **state)
{
    (void)state;
    struct model m;
    struct static_result r;
    make(0.0);
    run(&m, &r);
    assert_near_abs(r.tip.v, 0.0, 0.0);
    assert_near_abs(r.tip.theta, 0.0, 0.0);
    for (int d = 0; d < 3; d++) {
        assert_near_abs(r.reaction_force[d], 0.0, 0.0);
        assert_near_abs(r.reaction_moment[d], 0.0, 0.0);
    }
    statics_done(&r);
    model_done(&m);
}

/* A torque on a sandwich at a clamp that holds the warping: the section twists there by eta alone,
 * as a rigid figure, T = (D_tt b + K_zn b^3/12) eta, and the outer face shears by eta h/2. */
static void plies_shear_where_the_warping_is_held(void **state)
{
    (void)state;
    const double b = 0.1, torque = 0.01;
    struct model m;
    struct static_result r;
    struct laminate laminate;
    make(0.0);
    def.loads.point[0].load.moment[2] = torque;
    struct section_def *s = &def.beam.section;
    struct layup *l = &s->shape.layup[0];
    l->ply[0].angle = 0.0;
    l->ply[1].thickness -= l->ply[0].thickness;
    l->ply[2] = l->ply[0];
    l->n_ply = 3;
    s->shear = SHEAR_RETAINED;
    s->shape.wall_shear = WALL_SHEAR_FLEXIBLE;
    def.output.n_stress = 1;
    def.output.stress[0] = 0.0;
    assert_ok(laminate_build(3, l->ply, s->shape.chordwise, &laminate));
    run(&m, &r);
    const double d_tt = laminate.reduced[W_TWIST + WALL_STRAINS * W_TWIST];
    const double eta = torque / (d_tt * b + laminate.shear_zn * b * b * b / 12.0);
    assert_near_rel(r.stress[0].strain[S_ETA], eta, 0.01);
    assert_near_abs(r.stress[0].strain[S_THETA], 0.0, 1e-9);
    for (int i = 0; i < r.stress[0].n_ply; i++) {
        if (i != 1) {
            assert_near_rel(fabs(r.stress[0].ply[i].strain_lt), 0.5 * laminate.thickness * eta,
                            0.01);
        }
    }
    statics_done(&r);
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
        cmocka_unit_test(the_span_runs_from_root_to_tip),
        cmocka_unit_test(answers_are_linear_in_the_loads),
        cmocka_unit_test(reserve_is_that_of_the_plies_with_strengths),
        cmocka_unit_test(without_strengths_there_is_no_reserve),
        cmocka_unit_test(no_load_no_motion),
        cmocka_unit_test(plies_shear_where_the_warping_is_held),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
