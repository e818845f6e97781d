/* The case document: defaults, canonical text, identity, and every way to be wrong. */
#include "core/num.h"
#include "tests/api/parsing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The smallest simulation, with one place for additions to each object. */
#define SECTION                                                                                    \
    "\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["                                  \
    "{\"material\":\"AS4/3501-6\",\"angle_deg\":-45,\"thickness_m\":0.00013},"                     \
    "{\"material\":\"foam\",\"thickness_m\":0.00387}]}"
#define HEAD "\"schema_version\":1,\"kind\":\"simulation\""
#define BEAM "\"beam\":{\"length_m\":0.37," SECTION "}"
#define FLOW "\"flow\":{\"speed_m_s\":6}"
#define AERO "\"aerodynamics\":{\"polar\":\"plate-4pct-channel\"}"
#define SOLVER "\"solver\":{\"duration_s\":3}"
static const char minimal[] = "{" HEAD "," BEAM "," FLOW "," AERO "," SOLVER "}";

static void test_defaults(void **state)
{
    struct api_case *c = parse_good(*state, minimal);
    const struct case_def *def = api_case_def(c);
    assert_int_equal(def->kind, CASE_SIMULATION);
    assert_string_equal(def->name, "");
    assert_int_equal(def->beam.elements, 16);
    assert_int_equal(def->beam.section.shape.layup[0].n_ply, 2);
    assert_near_abs(def->beam.section.shape.layup[0].ply[0].angle, num_rad(-45.0), 0.0);
    assert_near_abs(def->beam.section.shape.layup[0].ply[1].angle, 0.0, 0.0);
    assert_near_abs(def->beam.section.shape.layup[0].ply[0].material.e_l, 141.96e9, 0.0);
    assert_string_equal(def->beam.section.shape.layup[0].ply[1].material.name, "foam");
    assert_near_abs(def->flow.density, 1.225, 0.0);
    assert_string_equal(def->aero.polar->name, "plate-4pct-channel");
    assert_true(def->aero.lifting_line);
    assert_int_equal(def->aero.walls, WALLS_ROOT);
    assert_int_equal(def->solver.modes, 4);
    assert_near_abs(def->solver.time_step, 2e-4, 0.0);
    assert_near_abs(def->solver.twist_max, num_rad(60.0), 0.0);
    assert_int_equal(def->output.n_channel, 5);
    api_case_destroy(c);
}

static void test_canonical_text(void **state)
{
    struct api_case *c = parse_good(*state, minimal);
    assert_string_equal(
        api_case_canonical(c),
        "{\"schema_version\":1,\"kind\":\"simulation\",\"name\":\"\",\"beam\":{\"length_m\":0.37,"
        "\"elements\":16,\"root_warping\":\"restrained\",\"section\":{\"type\":\"strip\","
        "\"chord_m\":0.1,\"layup\":[{\"material\":\"AS4/3501-6\",\"angle_deg\":-45,"
        "\"thickness_m\":0.00013},{\"material\":\"foam\",\"angle_deg\":0,\"thickness_m\":0.00387}],"
        "\"chordwise_curvature\":\"free\",\"shear\":\"condensed\",\"wall_shear\":\"rigid\","
        "\"contour_elements\":16,\"mid_chord_m\":0,"
        "\"twist_deg\":0},\"masses\":[],\"gravity_m_s2\":{\"x\":0,\"y\":0,\"z\":0}},"
        "\"flow\":{\"speed_m_s\":6,\"density_kg_m3\":1.225,\"kinematic_viscosity_m2_s\":1.5e-05,"
        "\"incidence_deg\":0},\"aerodynamics\":{\"polar\":\"plate-4pct-channel\",\"dynamic\":{"
        "\"type\":\"none\"},\"lifting_line\":{\"walls\":\"root\","
        "\"tip_correction\":\"inset\",\"tolerance\":1e-09,"
        "\"iterations_max\":50}},\"solver\":{\"modes\":4,\"time_step_s\":0.0002,\"duration_s\":3,"
        "\"integrator\":\"exponential\",\"tolerance\":1e-09,\"load_order\":1,\"start\":{\"type\":"
        "\"rest\"},\"modal_damping_ratio\":0,\"modal_damping_ratios\":[],\"stop\":{"
        "\"twist_max_deg\":60,\"plunge_max_lengths\":1,\"outside_polar_max\":1}},\"output\":{"
        "\"channels\":["
        "\"tip_plunge_m\",\"tip_twist_deg\",\"cl\",\"cm\",\"cd\"],\"sample_every\":1,"
        "\"mean_window_s\":1,\"modal_window_s\":0.2}}");
    api_case_destroy(c);
}

#define OWN_MATERIAL                                                                               \
    "\"materials\":[{\"name\":\"steel\",\"e_l_pa\":2.1e11,\"e_t_pa\":2.1e11,\"g_lt_pa\":8e10,"     \
    "\"g_tt_pa\":8e10,\"nu_lt\":0.3,\"nu_tt\":0.3,\"density_kg_m3\":7850},{\"name\":\"foam\","     \
    "\"e_l_pa\":15e6,\"e_t_pa\":15e6,\"g_lt_pa\":5.86e6,\"g_tt_pa\":5.86e6,\"nu_lt\":0.28,"        \
    "\"nu_tt\":0.28,\"density_kg_m3\":35}]"
#define OWN_POLAR                                                                                  \
    "\"polars\":[{\"name\":\"mine\",\"provenance\":{\"by\":[1,0.1]},\"alpha_deg\":[-10,0,12.3],"   \
    "\"plunge_c\":[0,0.5],\"cl\":[[-1,0,1],[-1,0,1.1]],\"cd\":[[0,0,0],[0,0,0]],"                  \
    "\"cm\":[[0,0,0],[0,0,0.2]],\"linear_from_deg\":-5,\"linear_to_deg\":5.7,"                     \
    "\"dynamic_stall\":{\"lift_centre_c\":0.2,\"vortex_lag\":4}}]"
#define OWN_NETWORK                                                                                \
    "\"networks\":[{\"name\":\"net\",\"description\":\"two\",\"activation\":\"tanh\","             \
    "\"inputs\":[\"delta_alpha\",\"alpha_rate\"],\"outputs\":[\"cl\"],\"hidden\":3,"               \
    "\"input_offset\":[0,0],\"input_scale\":[1,2],\"output_offset\":[0],\"output_scale\":[1],"     \
    "\"hull_min\":[-1,-1],\"hull_max\":[1,1],\"w1\":[[1,2],[3,4],[5,6]],\"b1\":[0,0,0.25],"        \
    "\"w2\":[[1,-1,0.5]],\"b2\":[0.125]}]"
static const char full[] =
    "{" HEAD ",\"name\":\"everything \\u00e9\"," OWN_MATERIAL "," OWN_POLAR "," OWN_NETWORK
    ",\"beam\":{\"length_m\":0.37,\"elements\":8,\"root_warping\":\"free\"," SECTION
    "},\"flow\":{\"speed_m_s\":6,\"incidence_deg\":3.3},"
    "\"aerodynamics\":{\"polar\":\"mine\",\"dynamic\":{\"type\":\"network\",\"name\":\"net\"},"
    "\"lifting_line\":{\"walls\":\"root_and_far\",\"width_m\":0.4}},"
    "\"solver\":{\"modes\":3,\"duration_s\":1,\"integrator\":\"rk4_adaptive\",\"load_order\":0,"
    "\"start\":{\"type\":\"amplitudes\",\"amplitudes\":[0,1e-3],\"velocities\":[0.1,0]},"
    "\"modal_damping_ratio\":0.01,\"stop\":{\"twist_max_deg\":33.3}},"
    "\"output\":{\"channels\":[\"cl\",\"modal_amplitude\",\"station_cl\"],\"sample_every\":2}}";

static void test_full_case(void **state)
{
    struct api_case *c = parse_good(*state, full);
    const struct case_def *def = api_case_def(c);
    assert_near_abs(def->beam.section.shape.layup[0].ply[1].material.g_lt, 5.86e6,
                    0.0); /* the local foam wins */
    assert_int_equal(def->aero.polar->n_plunge, 2);
    assert_near_abs(def->aero.polar->cl[5], 1.1, 0.0);
    assert_near_abs(def->aero.polar->alpha[2], num_rad(12.3), 0.0);
    assert_near_abs(def->aero.polar->stall.lift_slope, 2.0 * NUM_PI, 0.0); /* the default */
    assert_near_abs(def->aero.polar->stall.lift_centre, 0.2, 0.0);
    assert_near_abs(def->aero.polar->stall.vortex_lag, 4.0, 0.0);
    assert_int_equal(def->aero.network->n_hidden, 3);
    assert_near_abs(def->aero.network->w1[3], 4.0, 0.0);
    assert_near_abs(def->aero.network->w2[2], 0.5, 0.0);
    assert_near_abs(def->aero.width, 0.4, 0.0);
    assert_int_equal(def->solver.n_amplitude, 2);
    assert_near_abs(def->solver.velocity[0], 0.1, 0.0);
    assert_int_equal(def->output.channel[1], CHANNEL_MODAL_AMPLITUDE);
    /* An older network prints as it was written: its hash stays. */
    assert_int_equal(def->aero.network->frame.base, NETWORK_ON_POLAR);
    assert_null(strstr(api_case_canonical(c), "lags_c_v"));
    assert_null(strstr(api_case_canonical(c), "force"));
    /* Definitions that are not used are left out, notes are kept. */
    assert_null(strstr(api_case_canonical(c), "steel"));
    assert_non_null(strstr(api_case_canonical(c), "{\"by\":[1,0.1]}"));
    assert_non_null(strstr(api_case_canonical(c), "\"description\":\"two\""));
    api_case_destroy(c);
}

static void test_canonical_is_stable(void **state)
{
    const char *text = NULL;
    size_t size = 0;
    int n = 0;
    assert_stable(*state, minimal);
    assert_stable(*state, full);
    for (; library_example_case(n, &text, &size) != NULL; n++) {
        assert_stable(*state, text);
    }
    assert_true(n >= 3);
}

static void hash_of(struct fixture *f, const char *json, char out[65])
{
    struct api_case *c = parse_good(f, json);
    (void)snprintf(out, 65, "%s", api_case_hash(c));
    api_case_destroy(c);
}

/* The identity follows what the result depends on, and nothing else. */
static void test_identity(void **state)
{
    static const struct {
        const char *json;
        bool same;
    } others[] = {
        {"{" HEAD ",\"name\":\"a label\"," BEAM "," FLOW "," AERO "," SOLVER "}", true},
        {"{" SOLVER "," AERO "," FLOW "," BEAM "," HEAD ",\"output\":{\"sample_every\":1}}", true},
        {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
         "\"lifting_line\":{}}," SOLVER "}",
         true},
        {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
         "\"lifting_line\":null}," SOLVER "}",
         false},
        {"{" HEAD "," BEAM ",\"flow\":{\"speed_m_s\":6.0000000000000009}," AERO "," SOLVER "}",
         false},
        {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"flat-plate-linear\"}," SOLVER
         "}",
         false},
        {"{" HEAD "," OWN_MATERIAL "," BEAM "," FLOW "," AERO "," SOLVER "}", false},
    };
    char reference[65], hash[65];
    hash_of(*state, minimal, reference);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        hash_of(*state, others[i].json, hash);
        assert_int_equal(strcmp(hash, reference) == 0, others[i].same);
    }
    /* A kind ignores what does not matter to it. */
    hash_of(*state, "{\"schema_version\":1,\"kind\":\"modes\"," BEAM "}", reference);
    hash_of(*state, "{\"schema_version\":1,\"kind\":\"modes\"," BEAM "," FLOW "," SOLVER "}", hash);
    assert_string_equal(hash, reference);
    hash_of(*state, "{\"schema_version\":1,\"kind\":\"section\",\"beam\":{" SECTION "}}", hash);
    assert_string_not_equal(hash, reference);
}

static const struct bad_case bad_cases[] = {
    {"{\"schema_version\":2,\"kind\":\"modes\"," BEAM "}", "/schema_version", "out_of_range"},
    {"{\"kind\":\"modes\"," BEAM "}", "/schema_version", "required"},
    {"{\"schema_version\":1," BEAM "}", "/kind", "required"},
    {"{\"schema_version\":1,\"kind\":\"Modes\"," BEAM "}", "/kind", "unknown_value"},
    {"{" HEAD ",\"Name\":\"x\"," BEAM "," FLOW "," AERO "," SOLVER "}", "/Name", "unknown_key"},
    {"{" HEAD "," BEAM ",\"flow\":{\"Speed_m_s\":6,\"speed_m_s\":6}," AERO "," SOLVER "}",
     "/flow/Speed_m_s", "unknown_key"},
    {"{" HEAD "," BEAM ",\"flow\":{\"speed_m_s\":6,\"speed_m_s\":7}," AERO "," SOLVER "}",
     "/flow/speed_m_s", "duplicate_key"},
    {"{" HEAD "," BEAM ",\"flow\":{\"speed_m_s\":1e999}," AERO "," SOLVER "}", "/flow/speed_m_s",
     "not_finite"},
    {"{" HEAD "," BEAM ",\"flow\":{\"speed_m_s\":NaN}," AERO "," SOLVER "}", "/flow/speed_m_s",
     "syntax"},
    {"{" HEAD "," BEAM ",\"flow\":{\"speed_m_s\":0}," AERO "," SOLVER "}", "/flow/speed_m_s",
     "out_of_range"},
    {"{" HEAD "," BEAM ",\"flow\":{\"speed_m_s\":\"6\"}," AERO "," SOLVER "}", "/flow/speed_m_s",
     "wrong_type"},
    {"{" HEAD "," BEAM "," AERO "," SOLVER "}", "/flow/speed_m_s", "required"},
    {"{" HEAD "," BEAM "," FLOW "," SOLVER "}", "/aerodynamics/polar", "required"},
    {"{" HEAD "," BEAM "," FLOW "," AERO "}", "/solver/duration_s", "required"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"none such\"}," SOLVER "}",
     "/aerodynamics/polar", "unknown_polar"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"dynamic\":{\"type\":\"network\"}}," SOLVER "}",
     "/aerodynamics/dynamic/name", "required"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"dynamic\":{\"type\":\"network\",\"name\":\"x\"}}," SOLVER "}",
     "/aerodynamics/dynamic/name", "unknown_network"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"dynamic\":{\"type\":\"none\",\"name\":\"x\"}}," SOLVER "}",
     "/aerodynamics/dynamic/name", "unexpected"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"lifting_line\":{\"walls\":\"root_and_far\"}}," SOLVER "}",
     "/aerodynamics/lifting_line/width_m", "required"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"lifting_line\":{\"walls\":\"root_and_far\",\"width_m\":0.3}}," SOLVER "}",
     "/aerodynamics/lifting_line/width_m", "out_of_range"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"lifting_line\":{\"walls\":\"root\",\"width_m\":0.4}}," SOLVER "}",
     "/aerodynamics/lifting_line/width_m", "unexpected"},
    {"{" HEAD "," BEAM "," FLOW ",\"aerodynamics\":{\"polar\":\"plate-4pct-channel\","
     "\"lifting_line\":{\"tip_correction\":\"prandtl\"}}," SOLVER "}",
     "/aerodynamics/lifting_line/tip_correction", "unknown_value"},
    {"{" HEAD "," BEAM "," FLOW "," AERO ",\"solver\":{\"duration_s\":1,\"modes\":2,"
     "\"start\":{\"type\":\"amplitudes\",\"amplitudes\":[1,2],\"velocities\":[1]}}}",
     "/solver/start/velocities", "wrong_length"},
    {"{" HEAD "," BEAM "," FLOW "," AERO ",\"solver\":{\"duration_s\":1,\"modes\":2,"
     "\"start\":{\"type\":\"amplitudes\",\"amplitudes\":[1,2,3]}}}",
     "/solver/start/amplitudes", "too_many"},
    {"{" HEAD "," BEAM "," FLOW "," AERO ",\"solver\":{\"duration_s\":-1}}", "/solver/duration_s",
     "out_of_range"},
    {"{" HEAD "," BEAM "," FLOW "," AERO ",\"solver\":{\"duration_s\":1e9}}", "/solver/duration_s",
     "too_long"},
    {"{" HEAD "," BEAM "," FLOW "," AERO "," SOLVER ",\"output\":{\"channels\":[]}}",
     "/output/channels", "empty_list"},
    {"{" HEAD "," BEAM "," FLOW "," AERO "," SOLVER ",\"output\":{\"channels\":[\"cl\",\"lift\"]}}",
     "/output/channels/1", "unknown_value"},
    {"{" HEAD "," BEAM "," FLOW "," AERO "," SOLVER ",\"output\":{\"channels\":[\"cl\",\"cl\"]}}",
     "/output/channels/1", "duplicate_value"},
    {"{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"length_m\":1,\"elements\":0," SECTION
     "}}",
     "/beam/elements", "out_of_range"},
    {"{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"length_m\":1,\"elements\":2.5," SECTION
     "}}",
     "/beam/elements", "wrong_type"},
    {"{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"length_m\":1,\"elements\":1," SECTION
     "},\"solver\":{\"modes\":9}}",
     "/solver/modes", "too_many_modes"},
    {"{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{" SECTION "}}", "/beam/length_m",
     "required"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\","
     "\"chord_m\":0.1,\"layup\":[]}}}",
     "/beam/section/layup", "empty_list"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\","
     "\"chord_m\":0.1,\"layup\":[{\"thickness_m\":1e-3}]}}}",
     "/beam/section/layup/0/material", "required"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\","
     "\"chord_m\":0.1,\"layup\":[{\"material\":\"balsa\",\"thickness_m\":1e-3}]}}}",
     "/beam/section/layup/0/material", "unknown_material"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\","
     "\"chord_m\":0.1,\"layup\":[{\"material\":\"foam\",\"thickness_m\":-1e-3}]}}}",
     "/beam/section/layup/0/thickness_m", "out_of_range"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":{\"type\":\"strip\","
     "\"chord_m\":0.1,\"layup\":[{\"material\":\"foam\",\"thickness_m\":1,\"angle_deg\":181}]}}}",
     "/beam/section/layup/0/angle_deg", "out_of_range"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"materials\":[{\"name\":\"m\",\"e_l_pa\":1,"
     "\"e_t_pa\":1,\"g_lt_pa\":1,\"g_tt_pa\":1,\"nu_lt\":1.5,\"nu_tt\":0,\"density_kg_m3\":1}],"
     "\"beam\":{" SECTION "}}",
     "/materials/0/nu_lt", "inadmissible_poisson"},
    {"[]", "", "wrong_type"},
    {"null", "", "wrong_type"},
    {"", "", "syntax"},
};

static void test_bad_cases(void **state)
{
    assert_all_refused(*state, sizeof bad_cases / sizeof bad_cases[0], bad_cases);
}

static void test_unknown_names_list_known_ones(void **state)
{
    struct fixture *f = *state;
    assert_null(parse(f, "{" HEAD "," OWN_POLAR "," BEAM "," FLOW
                         ",\"aerodynamics\":{\"polar\":\"x\"}," SOLVER "}"));
    const struct failure *p = &f->problems->item[0];
    assert_non_null(strstr(p->expected, "\"mine\""));
    assert_non_null(strstr(p->expected, "\"plate-4pct-channel\""));
    assert_string_equal(p->got, "\"x\"");
}

/* Everything that is wrong is said at once, each thing once. */
static void test_all_problems_at_once(void **state)
{
    struct fixture *f = *state;
    assert_null(parse(f, "{" HEAD ",\"beam\":{\"length_m\":-1,\"elements\":0,\"color\":1,"
                         "\"section\":{\"type\":\"strip\",\"chord_m\":0,\"layup\":["
                         "{\"material\":\"balsa\",\"thickness_m\":0}]}},"
                         "\"flow\":{\"speed_m_s\":0}," AERO ",\"solver\":{\"modes\":\"4\"}}"));
    static const char *const pointers[] = {"/beam/length_m",
                                           "/beam/elements",
                                           "/beam/color",
                                           "/beam/section/chord_m",
                                           "/beam/section/layup/0/material",
                                           "/beam/section/layup/0/thickness_m",
                                           "/flow/speed_m_s",
                                           "/solver/modes",
                                           "/solver/duration_s"};
    const int n = (int)(sizeof pointers / sizeof pointers[0]);
    assert_int_equal(f->problems->total, n);
    for (int i = 0; i < n; i++) {
        int found = 0;
        for (int j = 0; j < f->problems->count; j++) {
            found += strcmp(f->problems->item[j].pointer, pointers[i]) == 0;
        }
        assert_int_equal(found, 1);
    }
}

static void test_at_most_100_problems(void **state)
{
    struct fixture *f = *state;
    char *text = malloc((size_t)64 * 1024);
    char *at = text + sprintf(text, "{\"schema_version\":1,\"kind\":\"section\",\"beam\":{"
                                    "\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":[");
    for (int i = 0; i < LIMIT_PLIES; i++) {
        at += sprintf(at, "%s{\"a\":0,\"b\":0}", i > 0 ? "," : "");
    }
    (void)sprintf(at, "]}}}");
    assert_null(parse(f, text));
    assert_int_equal(f->problems->count, FAILURE_LIST_MAX);
    assert_int_equal(f->problems->total, 4 * LIMIT_PLIES);
    free(text);
}

static void test_prefix(void **state)
{
    struct fixture *f = *state;
    static const char text[] = "{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"length_m\":1,"
                               "\"elements\":1," SECTION "},\"solver\":{\"modes\":9}}";
    struct api_case *c = NULL;
    f->problems->count = f->problems->total = 0;
    assert_int_equal(api_case_parse(f->lib, text, strlen(text), "/jobs/7", &c, f->problems),
                     ST_INVALID);
    assert_null(c);
    assert_string_equal(f->problems->item[0].pointer, "/jobs/7/solver/modes");
}

#define MODES_WITH(definition) "{\"schema_version\":1,\"kind\":\"modes\"," definition "," BEAM "}"
static const struct bad_case bad_definitions[] = {
    {MODES_WITH("\"polars\":{}"), "/polars", "wrong_type"},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[0,1],\"cl\":[[0,1,2]],"
                "\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":0,\"linear_to_deg\":1}]"),
     "/polars/0/cl/0", "wrong_length"},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[0,1],\"cl\":[[0,1],[0,1]],"
                "\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":0,\"linear_to_deg\":1}]"),
     "/polars/0/cl", "wrong_length"},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[1,0],\"cl\":[[0,1]],"
                "\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":0,\"linear_to_deg\":1}]"),
     "/polars/0/alpha_deg", NULL},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[0],\"cl\":[[0]],"
                "\"cd\":[[0]],\"cm\":[[0]],\"linear_from_deg\":0,\"linear_to_deg\":1}]"),
     "/polars/0/alpha_deg", "wrong_length"},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[0,\"1\"],\"cl\":[[0,0]],"
                "\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":0,\"linear_to_deg\":1}]"),
     "/polars/0/alpha_deg/1", "wrong_type"},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[0,1],\"cl\":[[0,1]],"
                "\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":0,\"linear_to_deg\":1,"
                "\"dynamic_stall\":{\"pressure_lag\":0}}]"),
     "/polars/0/dynamic_stall/pressure_lag", "out_of_range"},
    {MODES_WITH("\"polars\":[{\"name\":\"p\",\"alpha_deg\":[0,1],\"cl\":[[0,1]],"
                "\"cd\":[[0,0]],\"cm\":[[0,0]],\"linear_from_deg\":0,\"linear_to_deg\":1,"
                "\"dynamic_stall\":{\"lag\":1}}]"),
     "/polars/0/dynamic_stall/lag", "unknown_key"},
    {MODES_WITH("\"networks\":[{\"name\":\"n\",\"activation\":\"relu\",\"inputs\":[\"alpha_rate\"],"
                "\"outputs\":[\"cl\"],\"hidden\":1,\"input_offset\":[0],\"input_scale\":[1],"
                "\"output_offset\":[0],\"output_scale\":[1],\"hull_min\":[0],\"hull_max\":[1],"
                "\"w1\":[[1]],\"b1\":[1],\"w2\":[[1]],\"b2\":[1]}]"),
     "/networks/0/activation", "unknown_value"},
    {MODES_WITH("\"networks\":[{\"name\":\"n\",\"activation\":\"tanh\",\"inputs\":[\"alpha_rate\"],"
                "\"outputs\":[\"cl\"],\"hidden\":2,\"input_offset\":[0],\"input_scale\":[1],"
                "\"output_offset\":[0],\"output_scale\":[1],\"hull_min\":[0],\"hull_max\":[1],"
                "\"w1\":[[1],[2]],\"b1\":[1],\"w2\":[[1,2]],\"b2\":[1]}]"),
     "/networks/0/b1", "wrong_length"},
    {MODES_WITH("\"networks\":[{\"name\":\"n\",\"activation\":\"tanh\",\"inputs\":[\"alpha_dot\"],"
                "\"outputs\":[\"cl\"],\"hidden\":1,\"input_offset\":[0],\"input_scale\":[1],"
                "\"output_offset\":[0],\"output_scale\":[1],\"hull_min\":[0],\"hull_max\":[1],"
                "\"w1\":[[1]],\"b1\":[1],\"w2\":[[1]],\"b2\":[1]}]"),
     "/networks/0/inputs/0", "unknown_value"},
    {MODES_WITH("\"materials\":[{\"name\":\"\",\"e_l_pa\":1,\"e_t_pa\":1,\"g_lt_pa\":1,"
                "\"g_tt_pa\":1,\"nu_lt\":0,\"nu_tt\":0,\"density_kg_m3\":1}]"),
     "/materials/0/name", "empty_text"},
};

static void test_bad_definitions(void **state)
{
    struct fixture *f = *state;
    for (size_t i = 0; i < sizeof bad_definitions / sizeof bad_definitions[0]; i++) {
        const struct bad_case *b = &bad_definitions[i];
        assert_null(parse(f, b->json));
        const struct failure *p = &f->problems->item[0];
        if (strncmp(p->pointer, b->pointer, strlen(b->pointer)) != 0 ||
            (b->code != NULL && strcmp(p->code, b->code) != 0)) {
            fail_msg("definition %zu: %s at \"%s\" (%s)", i, p->code, p->pointer, p->detail);
        }
    }
}

static void test_duplicate_definition(void **state)
{
    struct fixture *f = *state;
    assert_null(parse(f, MODES_WITH("\"materials\":[{\"name\":\"a\",\"e_l_pa\":1,\"e_t_pa\":1,"
                                    "\"g_lt_pa\":1,\"g_tt_pa\":1,\"nu_lt\":0,\"nu_tt\":0,"
                                    "\"density_kg_m3\":1},{\"name\":\"a\",\"e_l_pa\":1,"
                                    "\"e_t_pa\":1,\"g_lt_pa\":1,\"g_tt_pa\":1,\"nu_lt\":0,"
                                    "\"nu_tt\":0,\"density_kg_m3\":1}]")));
    assert_int_equal(f->problems->total, 1);
    assert_string_equal(f->problems->item[0].pointer, "/materials/1/name");
    assert_string_equal(f->problems->item[0].code, "duplicate_name");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_canonical_text),
        cmocka_unit_test(test_full_case),
        cmocka_unit_test(test_canonical_is_stable),
        cmocka_unit_test(test_identity),
        cmocka_unit_test(test_bad_cases),
        cmocka_unit_test(test_unknown_names_list_known_ones),
        cmocka_unit_test(test_all_problems_at_once),
        cmocka_unit_test(test_at_most_100_problems),
        cmocka_unit_test(test_prefix),
        cmocka_unit_test(test_bad_definitions),
        cmocka_unit_test(test_duplicate_definition),
    };
    return cmocka_run_group_tests(tests, parsing_setup, parsing_teardown);
}
