/* Every rule of case_def_check names its field. Geometry rules of shapes are tested with shapes. */
#include "core/case_def.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>

static struct polar_def polar;
static struct failure_list list;

static void good_case(struct case_def *def)
{
    fixture_paper_beam(-45.0, &polar, def);
}

static void check(const struct case_def *def)
{
    list = (struct failure_list){0};
    case_def_check(def, &list);
}

static void the_paper_case_is_good(void **state)
{
    (void)state;
    struct case_def def;
    good_case(&def);
    check(&def);
    assert_int_equal(list.count, 0);
    case_def_defaults(&def);
    check(&def); /* an empty case has many faults, each said once */
    assert_true(list.count >= 4);
    for (int i = 0; i < list.count; i++) {
        assert_true(list.item[i].pointer[0] == '/');
        assert_true(list.item[i].code[0] != '\0');
        assert_true(list.item[i].detail[0] != '\0');
    }
}

/* One number of the case set wrong: exactly one fault, at its pointer. */
struct fault {
    const char *pointer;
    size_t offset;
    double wrong[3];
};

#define AT(member) offsetof(struct case_def, member)

static void every_number_has_its_range(void **state)
{
    (void)state;
    const double nan = (double)NAN, inf = (double)INFINITY;
    const struct fault fault[] = {
        {"/beam/length_m", AT(beam.length), {0.0, -1.0, inf}},
        {"/beam/section/chord_m", AT(beam.section.shape.width), {0.0, -0.1, nan}},
        {"/beam/section/layup/0/angle_deg",
         AT(beam.section.shape.layup[0].ply[0].angle),
         {4.0, -4.0, nan}},
        {"/beam/section/layup/1/thickness_m",
         AT(beam.section.shape.layup[0].ply[1].thickness),
         {0.0, -1e-3, inf}},
        {"/beam/section/layup/1/material/e_t_pa",
         AT(beam.section.shape.layup[0].ply[1].material.e_t),
         {0.0, -1.0, -inf}},
        {"/flow/speed_m_s", AT(flow.speed), {0.0, -1.0, nan}},
        {"/flow/density_kg_m3", AT(flow.density), {-1e-9, inf, nan}},
        {"/flow/kinematic_viscosity_m2_s", AT(flow.kinematic_viscosity), {0.0, -1.0, inf}},
        {"/flow/incidence_deg", AT(flow.incidence), {1.6, -1.6, nan}},
        {"/aerodynamics/lifting_line/tolerance", AT(aero.tolerance), {0.0, 1.0, nan}},
        {"/solver/time_step_s", AT(solver.time_step), {0.0, -1.0, nan}},
        {"/solver/duration_s", AT(solver.duration), {0.0, -1.0, nan}},
        {"/solver/tolerance", AT(solver.tolerance), {0.0, 1.0, nan}},
        {"/solver/modal_damping_ratio", AT(solver.modal_damping), {-1e-9, 1.0, nan}},
        {"/solver/stop/twist_max_deg", AT(solver.twist_max), {0.0, 4.0, nan}},
        {"/solver/stop/plunge_max_lengths", AT(solver.plunge_max), {0.0, -1.0, nan}},
        {"/solver/stop/outside_polar_max", AT(solver.outside_max), {-0.1, 1.1, nan}},
        {"/output/mean_window_s", AT(output.mean_window), {0.0, -1.0, nan}},
        {"/output/modal_window_s", AT(output.modal_window), {0.0, -1.0, nan}},
    };
    for (size_t i = 0; i < sizeof fault / sizeof fault[0]; i++) {
        for (int k = 0; k < 3; k++) {
            struct case_def def;
            good_case(&def);
            *(double *)(void *)((char *)&def + fault[i].offset) = fault[i].wrong[k];
            check(&def);
            if (list.count != 1) {
                print_error("%s = %g: %d faults\n", fault[i].pointer, fault[i].wrong[k],
                            list.count);
            }
            assert_int_equal(list.count, 1);
            assert_string_equal(list.item[0].pointer, fault[i].pointer);
            assert_string_equal(list.item[0].code, "out_of_range");
        }
    }
}

static void every_count_has_its_range(void **state)
{
    (void)state;
    const struct {
        const char *pointer;
        size_t offset;
        int wrong[2];
    } fault[] = {
        {"/beam/elements", AT(beam.elements), {0, LIMIT_ELEMENTS + 1}},
        {"/beam/section/contour_elements",
         AT(beam.section.shape.contour_elements),
         {0, LIMIT_CONTOUR_ELEMENTS + 1}},
        {"/beam/section/layup", AT(beam.section.shape.layup[0].n_ply), {0, -1}},
        {"/solver/modes", AT(solver.modes), {0, LIMIT_MODES + 1}},
        {"/solver/load_order", AT(solver.load_order), {-1, LIMIT_LOAD_ORDER + 1}},
        {"/aerodynamics/lifting_line/iterations_max", AT(aero.iterations_max), {0, 1001}},
        {"/output/sample_every", AT(output.sample_every), {0, -5}},
    };
    for (size_t i = 0; i < sizeof fault / sizeof fault[0]; i++) {
        for (int k = 0; k < 2; k++) {
            struct case_def def;
            good_case(&def);
            *(int *)(void *)((char *)&def + fault[i].offset) = fault[i].wrong[k];
            check(&def);
            assert_int_equal(list.count, 1);
            assert_string_equal(list.item[0].pointer, fault[i].pointer);
        }
    }
}

static void assert_fault(const struct case_def *def, const char *pointer, const char *code)
{
    check(def);
    assert_int_equal(list.count, 1);
    assert_string_equal(list.item[0].pointer, pointer);
    assert_string_equal(list.item[0].code, code);
}

static void rules_across_fields(void **state)
{
    (void)state;
    struct case_def def;
    good_case(&def);
    def.beam.elements = 1;
    def.solver.modes = 8;
    assert_fault(&def, "/solver/modes", "too_many_modes");
    good_case(&def);
    def.aero.walls = WALLS_ROOT_AND_FAR;
    def.aero.width = def.beam.length;
    assert_fault(&def, "/aerodynamics/lifting_line/width_m", "out_of_range");
    def.aero.lifting_line = false; /* nobody asks for the width then */
    check(&def);
    assert_int_equal(list.count, 0);
    good_case(&def);
    def.aero.polar = NULL;
    assert_fault(&def, "/aerodynamics/polar", "missing");
    good_case(&def);
    def.aero.dynamic = DYNAMIC_NETWORK;
    assert_fault(&def, "/aerodynamics/dynamic/name", "missing");
    good_case(&def);
    def.solver.start = START_AMPLITUDES;
    def.solver.n_amplitude = def.solver.modes + 1;
    assert_fault(&def, "/solver/start/amplitudes", "too_many");
    def.solver.n_amplitude = 2;
    def.solver.velocity[1] = (double)NAN;
    assert_fault(&def, "/solver/start", "not_finite");
}

static void stability_is_checked(void **state)
{
    (void)state;
    struct case_def def;
    good_case(&def);
    def.kind = CASE_STABILITY;
    def.flow.speed = 0.0; /* nobody asks for it then, nor for a duration */
    def.solver.duration = 0.0;
    def.stability.from = 2.0;
    def.stability.to = 20.0;
    check(&def);
    assert_int_equal(list.count, 0);
    def.stability.to = 2.0;
    assert_fault(&def, "/stability/to_m_s", "out_of_range");
    def.stability.to = 20.0;
    def.stability.from = 0.0;
    assert_fault(&def, "/stability/from_m_s", "out_of_range");
    def.stability.from = 2.0;
    def.stability.count = 1;
    assert_fault(&def, "/stability/count", "out_of_range");
    def.stability.count = 2;
    def.stability.tolerance = 0.0;
    assert_fault(&def, "/stability/tolerance", "out_of_range");
    def.stability.tolerance = 1e-6;
    def.solver.mode_damping[0] = 1.0;
    def.solver.n_mode_damping = 1;
    assert_fault(&def, "/solver/modal_damping_ratios/0", "out_of_range");
    def.solver.n_mode_damping = 0;
    def.aero.dynamic = DYNAMIC_STALL;
    def.beam.elements = LIMIT_ELEMENTS;
    assert_fault(&def, "/beam/elements", "too_many_states");
    def.beam.elements = 16;
    struct network_def network = fixture_network(4, 0.1, 1);
    def.aero.dynamic = DYNAMIC_NETWORK;
    def.aero.network = &network;
    assert_fault(&def, "/aerodynamics/dynamic/type", "no_states");
    network_def_done(&network);
}

static void runs_too_large_are_refused(void **state)
{
    (void)state;
    struct case_def def;
    good_case(&def);
    def.solver.duration = 1e300;
    assert_fault(&def, "/solver/duration_s", "too_long");
    good_case(&def);
    def.solver.time_step = 1e-300;
    assert_fault(&def, "/solver/duration_s", "too_long");
    good_case(&def);
    def.beam.elements = 256;
    def.solver.duration = 30.0;
    def.output.n_channel = 1;
    def.output.channel[0] = CHANNEL_STATION_CL;
    assert_fault(&def, "/output/sample_every", "record_too_large");
    def.output.sample_every = 10;
    check(&def);
    assert_int_equal(list.count, 0);
    def.output.n_channel = 3; /* 768 columns */
    def.output.channel[1] = CHANNEL_STATION_CD;
    def.output.channel[2] = CHANNEL_STATION_CM;
    assert_fault(&def, "/output/sample_every", "record_too_large");
}

/* Kinds ask only for what they use. */
static void kinds(void **state)
{
    (void)state;
    struct case_def def;
    good_case(&def);
    def.kind = CASE_SECTION;
    def.beam.length = 0.0;
    def.flow.speed = 0.0;
    def.aero.polar = NULL;
    check(&def);
    assert_int_equal(list.count, 0);
    def.kind = CASE_MODES;
    assert_fault(&def, "/beam/length_m", "out_of_range");
}

static void sizes_of_a_run(void **state)
{
    (void)state;
    struct case_def def;
    good_case(&def);
    def.solver.time_step = 2e-4;
    def.solver.duration = 3.0;
    assert_int_equal(case_def_steps(&def), 15000); /* 3/2e-4 is a hair above 15000 in binary */
    assert_int_equal(case_def_samples(&def), 15001);
    def.output.sample_every = 7;
    assert_int_equal(case_def_samples(&def), 2143);
    def.solver.duration = 1e-9;
    assert_int_equal(case_def_steps(&def), 1);
    assert_int_equal(case_def_channel_columns(&def, CHANNEL_CL), 1);
    assert_int_equal(case_def_channel_columns(&def, CHANNEL_MODAL_VELOCITY), 4);
    assert_int_equal(case_def_channel_columns(&def, CHANNEL_STATION_PLUNGE), 16);
}

static int setup(void **state)
{
    (void)state;
    polar = fixture_linear_polar(5.0, 0.5, 0.02, 0.5);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    polar_def_done(&polar);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_paper_case_is_good),
        cmocka_unit_test(every_number_has_its_range),
        cmocka_unit_test(every_count_has_its_range),
        cmocka_unit_test(rules_across_fields),
        cmocka_unit_test(stability_is_checked),
        cmocka_unit_test(runs_too_large_are_refused),
        cmocka_unit_test(kinds),
        cmocka_unit_test(sizes_of_a_run),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
