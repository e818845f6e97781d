/* Sections, stations, masses and loads of a case: what they become, and every way to be wrong. */
#include "core/num.h"
#include "tests/api/parsing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PLY "{\"material\":\"aluminium\",\"thickness_m\":0.001}"
#define STRIP "{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":[" PLY "]}"
#define SOFT                                                                                       \
    "{\"type\":\"strip\",\"chord_m\":0.1,\"shear\":\"retained\",\"wall_shear\":\"flexible\","      \
    "\"layup\":[" PLY "]}"
#define HELD                                                                                       \
    "{\"type\":\"strip\",\"chord_m\":0.1,\"chordwise_curvature\":\"clamped\",\"layup\":[" PLY "]}"
#define BOX_OF(layup_) "{\"type\":\"box\",\"width_m\":0.1,\"height_m\":0.05," layup_ "}"
#define BOX BOX_OF("\"layup\":[" PLY "]")
#define WALLS                                                                                      \
    "\"walls\":{\"front\":[" PLY "],\"top\":[" PLY "," PLY "],\"rear\":[" PLY "],\"bottom\":[" PLY \
    "]}"
#define LAYUPS "\"layups\":[{\"name\":\"skin\",\"layup\":[" PLY "]}]"
#define POINT(x_, y_) "{\"x_m\":" #x_ ",\"y_m\":" #y_ "}"
#define WALL(a_, b_) "{\"from\":" #a_ ",\"to\":" #b_ ",\"layup\":\"skin\"}"
#define CONTOUR_OF(layups_, points_, walls_)                                                       \
    "{\"type\":\"contour\"," layups_ ",\"points\":[" points_ "],\"walls\":[" walls_ "]}"
#define SQUARE POINT(0.1, 0) "," POINT(0.1, 0.1) "," POINT(0, 0.1) "," POINT(0, 0)
#define ROUND WALL(0, 1) "," WALL(1, 2) "," WALL(2, 3) "," WALL(3, 0)
#define SECTION_CASE(section_)                                                                     \
    "{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"section\":" section_ "}}"
#define CONTOUR_CASE(points_, walls_) SECTION_CASE(CONTOUR_OF(LAYUPS, points_, walls_))
#define MODES_CASE(beam_)                                                                          \
    "{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"length_m\":1," beam_ "}}"
#define STATIC_CASE(beam_, rest_)                                                                  \
    "{\"schema_version\":1,\"kind\":\"static\",\"beam\":{\"length_m\":1,\"section\":" STRIP beam_  \
    "}" rest_ "}"
#define STATION(z_, section_) "{\"z_m\":" #z_ ",\"section\":" section_ "}"
#define STEEL                                                                                      \
    "{\"name\":\"steel\",\"e_l_pa\":2.1e11,\"e_t_pa\":2.1e11,\"g_lt_pa\":8e10,"                    \
    "\"g_tt_pa\":8e10,\"nu_lt\":0.3,\"nu_tt\":0.3,\"density_kg_m3\":7850"

#define PROPERTIES_OF(rest_)                                                                       \
    "{\"type\":\"properties\",\"chord_m\":2,\"ei_flap_n_m2\":100,\"gj_n_m2\":25,"                  \
    "\"mass_kg_m\":3,\"torsion_inertia_kg_m\":0.5" rest_ "}"
#define PROPERTIES PROPERTIES_OF("")

static void test_properties(void **state)
{
    struct api_case *c = parse_good(
        *state, SECTION_CASE(PROPERTIES_OF(",\"elastic_axis_chord\":0.4,\"mass_axis_chord\":0.45,"
                                           "\"torsion_inertia_about\":\"mid_chord\","
                                           "\"bend_twist_n_m2\":-5,\"ei_warping_n_m4\":0.1")));
    const struct section_def *s = &api_case_def(c)->beam.section;
    assert_int_equal(s->shape.type, SECTION_PROPERTIES);
    assert_int_equal(s->properties.inertia_axis, INERTIA_MID_CHORD);
    assert_near_abs(s->properties.bend_twist, -5.0, 0.0);
    assert_near_abs(s->properties.ei_warping, 0.1, 0.0);
    assert_near_abs(section_def_chord(s), 2.0, 0.0);
    assert_near_abs(section_def_mid_chord(s), -0.2, 1e-15);
    assert_non_null(strstr(api_case_canonical(c), "\"torsion_inertia_about\":\"mid_chord\""));
    api_case_destroy(c);
    /* What may be left open is filled in from the rest, and shown. */
    c = parse_good(*state, SECTION_CASE(PROPERTIES_OF(",\"elastic_axis_chord\":0.3")));
    s = &api_case_def(c)->beam.section;
    assert_near_abs(s->properties.ei_lag, 1e6, 0.0);
    assert_near_abs(s->properties.ea, 3e6, 0.0);
    assert_near_abs(s->properties.mass_axis, 0.3, 0.0);
    assert_int_equal(s->properties.inertia_axis, INERTIA_ELASTIC_AXIS);
    assert_non_null(strstr(api_case_canonical(c), "\"ei_lag_n_m2\":1000000,"));
    assert_non_null(strstr(api_case_canonical(c), "\"mass_axis_chord\":0.3,"));
    api_case_destroy(c);
}

static void test_box(void **state)
{
    struct api_case *c = parse_good(*state, SECTION_CASE(BOX));
    const struct section_def *s = &api_case_def(c)->beam.section;
    assert_int_equal(s->shape.type, SECTION_BOX);
    assert_int_equal(s->shape.n_layup, 1);
    assert_near_abs(s->shape.height, 0.05, 0.0);
    assert_near_abs(section_def_chord(s), 0.1, 0.0);
    assert_int_equal(s->shape.contour_elements, 8);
    api_case_destroy(c);
    c = parse_good(*state, SECTION_CASE(BOX_OF(WALLS ",\"chord_m\":0.3,\"shear\":\"retained\","
                                                     "\"twist_deg\":-3")));
    s = &api_case_def(c)->beam.section;
    assert_int_equal(s->shape.n_layup, 4);
    assert_int_equal(s->shape.layup[BOX_TOP].n_ply, 2);
    assert_int_equal(s->shape.layup[BOX_REAR].n_ply, 1);
    assert_near_abs(section_def_chord(s), 0.3, 0.0);
    assert_int_equal(s->shear, SHEAR_RETAINED);
    assert_near_abs(s->shape.turn, num_rad(-3.0), 1e-17);
    api_case_destroy(c);
}

#define TWO_LAYUPS                                                                                 \
    "\"layups\":[{\"name\":\"skin\",\"layup\":[" PLY "]},{\"name\":\"web\",\"layup\":[" PLY        \
    "]}],\"cells\":1"
static void test_contour(void **state)
{
    struct api_case *c = parse_good(
        *state,
        SECTION_CASE(CONTOUR_OF(TWO_LAYUPS, SQUARE,
                                "{\"from\":0,\"to\":1,\"layup\":\"web\",\"offset_m\":0.0005},"
                                "{\"from\":1,\"to\":2,\"layup\":\"skin\",\"via\":" POINT(
                                    0.05, 0.12) "}," WALL(2, 3) "," WALL(3, 0))));
    const struct shape *s = &api_case_def(c)->beam.section.shape;
    assert_int_equal(s->n_point, 4);
    assert_int_equal(s->n_wall, 4);
    assert_int_equal(s->cells, 1);
    assert_int_equal(s->wall[0].layup, 1);
    assert_near_abs(s->wall[0].offset, 0.0005, 0.0);
    assert_false(s->wall[0].curved);
    assert_true(s->wall[1].curved);
    assert_near_abs(s->wall[1].via.y, 0.12, 0.0);
    assert_int_equal(s->wall[3].to, 0);
    api_case_destroy(c);
}

static void test_stations(void **state)
{
    struct api_case *c = parse_good(
        *state, MODES_CASE("\"stations\":[" STATION(0, BOX) "," STATION(0.5, BOX) "," STATION(
                    0.5, STRIP) "," STATION(1, STRIP) "],\"masses\":[{\"z_m\":0.5,\"x_m\":-0.1,"
                                                      "\"mass_kg\":2,\"inertia_z_kg_m2\":0.01}]"));
    const struct beam_def *b = &api_case_def(c)->beam;
    assert_int_equal(b->n_station, 4);
    assert_near_abs(b->station[1].z, 0.5, 0.0);
    assert_int_equal(b->station[1].section.shape.type, SECTION_BOX);
    assert_int_equal(b->station[2].section.shape.type, SECTION_STRIP);
    assert_int_equal(b->station[2].section.shape.contour_elements, 16);
    assert_int_equal(b->n_mass, 1);
    assert_near_abs(b->mass[0].x, -0.1, 0.0);
    assert_near_abs(b->mass[0].inertia[2], 0.01, 0.0);
    assert_null(strstr(api_case_canonical(c), "\"section\":{\"type\":\"box\"},\"stations\""));
    api_case_destroy(c);
}

static void test_loads(void **state)
{
    struct api_case *c = parse_good(
        *state, STATIC_CASE(",\"gravity_m_s2\":{\"y\":-9.81}",
                            ",\"loads\":{\"points\":[{\"z_m\":0.5,\"moment_z_n_m\":2}],"
                            "\"lines\":[{\"force_y_n_m\":3,\"moment_z_n\":4}],"
                            "\"tip\":{\"force_x_n\":5}},\"output\":{\"stress_at_m\":[0,0.5]}"));
    const struct case_def *def = api_case_def(c);
    assert_int_equal(def->kind, CASE_STATIC);
    assert_near_abs(def->beam.gravity[1], -9.81, 0.0);
    assert_int_equal(def->loads.n_point, 2);
    assert_near_abs(def->loads.point[0].load.moment[2], 2.0, 0.0);
    assert_near_abs(def->loads.point[1].z, 1.0, 0.0);
    assert_near_abs(def->loads.point[1].load.force[0], 5.0, 0.0);
    assert_int_equal(def->loads.n_line, 1);
    assert_near_abs(def->loads.line[0].to, 1.0, 0.0);
    assert_near_abs(def->loads.line[0].load.force[1], 3.0, 0.0);
    assert_near_abs(def->loads.line[0].load.moment[2], 4.0, 0.0);
    assert_int_equal(def->output.n_stress, 2);
    api_case_destroy(c);
}

#define STREAM(rest_)                                                                              \
    ",\"flow\":{\"speed_m_s\":20},\"aerodynamics\":{\"polar\":\"flat-plate-linear\"" rest_ "}"

/* A static case may have a stream; what only moves has no part in it. */
static void test_static_in_a_stream(void **state)
{
    struct api_case *c =
        parse_good(*state, STATIC_CASE("", STREAM(",\"dynamic\":{\"type\":\"attached\"}")));
    assert_true(case_def_flows(api_case_def(c)));
    assert_near_abs(api_case_def(c)->flow.speed, 20.0, 0.0);
    assert_non_null(strstr(api_case_canonical(c), "\"flow\":{\"speed_m_s\":20,"));
    assert_null(strstr(api_case_canonical(c), "\"dynamic\""));
    api_case_destroy(c);
    c = parse_good(*state, STATIC_CASE("", ",\"loads\":{\"tip\":{\"force_y_n\":1}}"));
    assert_false(case_def_flows(api_case_def(c)));
    assert_null(strstr(api_case_canonical(c), "\"flow\""));
    api_case_destroy(c);
}

/* Canonical text parsed again gives the same text and the same identity. */
static void test_canonical_is_stable(void **state)
{
    static const char *const cases[] = {
        SECTION_CASE(BOX),
        SECTION_CASE(PROPERTIES),
        SECTION_CASE(BOX_OF(WALLS ",\"chord_m\":0.3,\"twist_deg\":3.3")),
        SECTION_CASE(CONTOUR_OF(TWO_LAYUPS, SQUARE,
                                "{\"from\":0,\"to\":1,\"layup\":\"web\",\"offset_m\":0.0005},"
                                "{\"from\":1,\"to\":2,\"layup\":\"skin\",\"via\":" POINT(
                                    0.05, 0.12) "}," WALL(2, 3) "," WALL(3, 0))),
        MODES_CASE("\"stations\":[" STATION(0, BOX) "," STATION(1, BOX) "]"),
        STATIC_CASE("", STREAM("")),
        STATIC_CASE("", ",\"loads\":{\"lines\":[{\"from_m\":0.1,\"force_y_n_m\":3}],"
                        "\"tip\":{\"force_x_n\":5}}"),
        "{\"schema_version\":1,\"kind\":\"section\",\"materials\":[" STEEL
        ",\"x_tension_pa\":1e9,\"x_compression_pa\":1e9,\"y_tension_pa\":1e9,\"y_compression_pa\":"
        "1e9,\"s_shear_pa\":5e8}],\"beam\":{\"section\":" BOX_OF(
            "\"walls\":{\"front\":[" PLY "],\"top\":[" PLY "],\"rear\":[{\"material\":\"steel\","
            "\"thickness_m\":0.001}],\"bottom\":[" PLY "]}") "}}",
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_stable(*state, cases[i]);
    }
}

/* A material of the case counts for the identity wherever a ply refers to it. */
static void test_identity_sees_every_layup(void **state)
{
#define STEEL_CASE(density_)                                                                       \
    "{\"schema_version\":1,\"kind\":\"modes\",\"materials\":[{\"name\":\"steel\",\"e_l_pa\":"      \
    "2.1e11,\"e_t_pa\":2.1e11,\"g_lt_pa\":8e10,\"g_tt_pa\":8e10,\"nu_lt\":0.3,\"nu_tt\":0.3,"      \
    "\"density_kg_m3\":" density_                                                                  \
    "}],\"beam\":{\"length_m\":1,\"stations\":[" STATION(0, STRIP) "," STATION(                    \
        0.5, STRIP) "," STATION(0.5, BOX_STEEL) "," STATION(1, BOX_STEEL) "]}}"
#define BOX_STEEL                                                                                  \
    BOX_OF("\"walls\":{\"front\":[" PLY "],\"top\":[" PLY "],\"rear\":[" PLY                       \
           "],\"bottom\":[{\"material\":\"steel\",\"thickness_m\":0.001}]}")
    struct api_case *a = parse_good(*state, STEEL_CASE("7850"));
    struct api_case *b = parse_good(*state, STEEL_CASE("7851"));
    assert_non_null(strstr(api_case_canonical(a), "\"density_kg_m3\":7850"));
    assert_string_not_equal(api_case_hash(a), api_case_hash(b));
    api_case_destroy(a);
    api_case_destroy(b);
}

#define WEAK                                                                                       \
    "{\"schema_version\":1,\"kind\":\"section\",\"materials\":[{\"name\":\"weak\",\"e_l_pa\":"     \
    "1e-300,\"e_t_pa\":1e-300,\"g_lt_pa\":1e-300,\"g_tt_pa\":1e-300,\"nu_lt\":0.3,\"nu_tt\":0.3,"  \
    "\"density_kg_m3\":1}],\"beam\":{\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["  \
    "{\"material\":\"weak\",\"thickness_m\":1e-6}]}}}"
#define WITH_MATERIAL(material_)                                                                   \
    "{\"schema_version\":1,\"kind\":\"section\",\"materials\":[" material_                         \
    "],\"beam\":{\"section\":" STRIP "}}"

static const struct bad_case bad_cases[] = {
    /* sections */
    {SECTION_CASE("{\"type\":\"tube\",\"radius_m\":1}"), "/beam/section/type", "unknown_value"},
    {SECTION_CASE("{\"chord_m\":1}"), "/beam/section/type", "required"},
    {SECTION_CASE("[]"), "/beam/section", "wrong_type"},
    {SECTION_CASE("{\"type\":\"strip\",\"chord_m\":0.1,\"height_m\":1,\"layup\":[" PLY "]}"),
     "/beam/section/height_m", "unknown_key"},
    {SECTION_CASE(BOX_OF("\"layup\":[" PLY "]," WALLS)), "/beam/section/layup", "layup_twice"},
    {SECTION_CASE("{\"type\":\"box\",\"width_m\":0.1,\"height_m\":0.05}"), "/beam/section/layup",
     "required"},
    {SECTION_CASE(BOX_OF("\"walls\":{\"front\":[" PLY "],\"top\":[" PLY "],\"rear\":[" PLY "]}")),
     "/beam/section/walls/bottom", "required"},
    {SECTION_CASE(BOX_OF("\"layup\":[{\"material\":\"foam\",\"thickness_m\":0.025}]")),
     "/beam/section/height_m", "walls_too_thick"},
    {SECTION_CASE(BOX_OF("\"layup\":[{\"material\":\"foam\",\"angle_deg\":181,\"thickness_m\":"
                         "0.001}]")),
     "/beam/section/layup/0/angle_deg", "out_of_range"},
    {SECTION_CASE(BOX_OF("\"layup\":[" PLY "],\"contour_elements\":200")),
     "/beam/section/contour_elements", "too_many_elements"},
    {CONTOUR_CASE(SQUARE, ROUND "," WALL(0, 2) "," WALL(1, 3)), "/beam/section/walls/5",
     "walls_cross"},
    {CONTOUR_CASE(SQUARE "," POINT(1, 1) "," POINT(2, 1), ROUND "," WALL(4, 5)),
     "/beam/section/walls/4", "walls_do_not_meet"},
    {CONTOUR_CASE(SQUARE, ROUND "," WALL(0, 4)), "/beam/section/walls/4/to", "unknown_point"},
    {CONTOUR_CASE(SQUARE, ROUND "," WALL(0, 64)), "/beam/section/walls/4/to", "out_of_range"},
    {CONTOUR_CASE(SQUARE, ROUND "," WALL(2, 2)), "/beam/section/walls/4", "zero_length"},
    {CONTOUR_CASE(SQUARE "," POINT(0, 0), ROUND "," WALL(0, 4)), "/beam/section/points/4",
     "same_point"},
    {CONTOUR_CASE(SQUARE "," POINT(1, 1), ROUND), "/beam/section/points/4", "unused_point"},
    {SECTION_CASE(
         CONTOUR_OF(LAYUPS ",\"cells\":1", SQUARE, WALL(0, 1) "," WALL(1, 2) "," WALL(2, 3))),
     "/beam/section/cells", "cells_not_closed"},
    {SECTION_CASE(CONTOUR_OF("\"layups\":[{\"name\":\"skin\",\"layup\":[" PLY
                             "]},{\"name\":\"skin\",\"layup\":[" PLY "]}]",
                             SQUARE, ROUND)),
     "/beam/section/layups/1/name", "duplicate_layup"},
    {SECTION_CASE(CONTOUR_OF(TWO_LAYUPS, SQUARE, ROUND)), "/beam/section/layups/1", "unused_layup"},
    {CONTOUR_CASE(SQUARE, ROUND ",{\"from\":0,\"to\":2,\"layup\":\"rib\"}"),
     "/beam/section/walls/4/layup", "unknown_layup"},
    {CONTOUR_CASE(SQUARE, ROUND ",{\"from\":0,\"to\":2,\"layup\":\"skin\",\"via\":{\"x_m\":1}}"),
     "/beam/section/walls/4/via/y_m", "required"},
    {WEAK, "/beam/section", "cannot_carry_load"},
    /* properties */
    {SECTION_CASE("{\"type\":\"properties\",\"chord_m\":2,\"ei_flap_n_m2\":100,\"mass_kg_m\":3,"
                  "\"torsion_inertia_kg_m\":0.5}"),
     "/beam/section/gj_n_m2", "required"},
    {SECTION_CASE("{\"type\":\"properties\",\"chord_m\":2,\"gj_n_m2\":100,\"mass_kg_m\":3,"
                  "\"torsion_inertia_kg_m\":0.5}"),
     "/beam/section/ei_flap_n_m2", "required"},
    {SECTION_CASE(PROPERTIES_OF(",\"ea_n\":0")), "/beam/section/ea_n", "out_of_range"},
    {SECTION_CASE(PROPERTIES_OF(",\"ei_lag_n_m2\":-1")), "/beam/section/ei_lag_n_m2",
     "out_of_range"},
    {SECTION_CASE(PROPERTIES_OF(",\"ei_warping_n_m4\":-1")), "/beam/section/ei_warping_n_m4",
     "out_of_range"},
    {SECTION_CASE(PROPERTIES_OF(",\"elastic_axis_chord\":1.01")),
     "/beam/section/elastic_axis_chord", "out_of_range"},
    {SECTION_CASE(PROPERTIES_OF(",\"mass_axis_chord\":-0.01")), "/beam/section/mass_axis_chord",
     "out_of_range"},
    {SECTION_CASE(PROPERTIES_OF(",\"bend_twist_n_m2\":-50")), "/beam/section/bend_twist_n_m2",
     "not_positive_definite"},
    {SECTION_CASE(PROPERTIES_OF(",\"mass_axis_chord\":0.8")), "/beam/section/torsion_inertia_kg_m",
     "inertia_too_small"},
    {SECTION_CASE(PROPERTIES_OF(",\"torsion_inertia_about\":\"quarter_chord\"")),
     "/beam/section/torsion_inertia_about", "unknown_value"},
    {SECTION_CASE(PROPERTIES_OF(",\"shear\":\"retained\"")), "/beam/section/shear",
     "shear_not_known"},
    {SECTION_CASE(PROPERTIES_OF(",\"layup\":[]")), "/beam/section/layup", "unknown_key"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) "," STATION(1, PROPERTIES) "]"),
     "/beam/stations/1/z_m", "stations_differ"},
    {"{\"schema_version\":1,\"kind\":\"static\",\"beam\":{\"length_m\":1,\"section\":" PROPERTIES
     "},\"loads\":{\"tip\":{\"force_y_n\":1}},\"output\":{\"stress_at_m\":[0.5]}}",
     "/output/stress_at_m/0", "no_walls"},
    /* materials */
    {WITH_MATERIAL("{\"name\":\"m\",\"e_l_pa\":1,\"e_t_pa\":4,\"g_lt_pa\":1,\"g_tt_pa\":1,"
                   "\"nu_lt\":0.5,\"nu_tt\":0,\"density_kg_m3\":1}"),
     "/materials/0/nu_lt", "inadmissible_poisson"},
    {WITH_MATERIAL(STEEL ",\"x_tension_pa\":0}"), "/materials/0/x_tension_pa", "out_of_range"},
    {WITH_MATERIAL(STEEL ",\"x_tension_pa\":1,\"x_compression_pa\":1,\"y_tension_pa\":1,"
                         "\"y_compression_pa\":1}"),
     "/materials/0/s_shear_pa", "out_of_range"},
    /* stations */
    {MODES_CASE("\"elements\":4"), "/beam/section", "required"},
    {MODES_CASE("\"section\":" STRIP ",\"stations\":[" STATION(0, STRIP) "," STATION(1, STRIP) "]"),
     "/beam/stations", "section_twice"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) "]"), "/beam/stations", "wrong_length"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) "," STATION(0.9, STRIP) "]"),
     "/beam/stations/1/z_m", "misplaced_station"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) "," STATION(0, BOX) "," STATION(1, BOX) "]"),
     "/beam/stations/1/z_m", "misplaced_station"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) "," STATION(1, STRIP) "," STATION(1, BOX) "]"),
     "/beam/stations/2/z_m", "misplaced_station"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) "," STATION(1, BOX) "]"), "/beam/stations/1/z_m",
     "stations_differ"},
    {MODES_CASE("\"stations\":[" STATION(0, SOFT) "," STATION(0.5, SOFT) "," STATION(
         0.5, STRIP) "," STATION(1, STRIP) "]"),
     "/beam/stations/2/section/wall_shear", "walls_differ"},
    {SECTION_CASE("{\"type\":\"box\",\"width_m\":0.1,\"height_m\":0.05,\"layup\":[" PLY
                  "],\"chordwise_curvature\":\"clamped\"}"),
     "/beam/section/chordwise_curvature", "not_flat"},
    {MODES_CASE("\"stations\":[" STATION(0, HELD) "," STATION(0.5, HELD) "," STATION(
         0.5, STRIP) "," STATION(1, STRIP) "]"),
     "/beam/stations/2/section/chordwise_curvature", "chordwise_differs"},
    {MODES_CASE("\"stations\":[" STATION(0, STRIP) ",{\"z_m\":1,\"section\":{\"type\":\"strip\","
                                                   "\"chord_m\":0,\"layup\":[" PLY "]}}]"),
     "/beam/stations/1/section/chord_m", "out_of_range"},
    {"{\"schema_version\":1,\"kind\":\"section\",\"beam\":{\"stations\":[" STATION(
         0, STRIP) "," STATION(1, STRIP) "]}}",
     "/beam/stations", "unexpected"},
    /* masses */
    {MODES_CASE("\"section\":" STRIP ",\"masses\":[{\"z_m\":1.5,\"mass_kg\":1}]"),
     "/beam/masses/0/z_m", "out_of_range"},
    {MODES_CASE("\"section\":" STRIP ",\"masses\":[{\"z_m\":1,\"mass_kg\":-1}]"),
     "/beam/masses/0/mass_kg", "out_of_range"},
    {MODES_CASE("\"section\":" STRIP ",\"masses\":[{\"mass_kg\":1}]"), "/beam/masses/0/z_m",
     "required"},
    /* loads */
    {STATIC_CASE("", ""), "/loads", "missing"},
    {STATIC_CASE("", ",\"flow\":{\"speed_m_s\":20}"), "/aerodynamics", "missing"},
    {STATIC_CASE("", ",\"flow\":{},\"aerodynamics\":{\"polar\":\"flat-plate-linear\"}"),
     "/flow/speed_m_s", "required"},
    {STATIC_CASE("", ",\"aerodynamics\":{\"polar\":\"flat-plate-linear\"}"), "/flow/speed_m_s",
     "out_of_range"},
    {STATIC_CASE("", ",\"loads\":{\"points\":[{\"z_m\":1.5,\"force_y_n\":1}]}"),
     "/loads/points/0/z_m", "out_of_range"},
    {STATIC_CASE("", ",\"loads\":{\"points\":[{\"force_y_n\":1}]}"), "/loads/points/0/z_m",
     "required"},
    {STATIC_CASE("", ",\"loads\":{\"lines\":[{\"from_m\":0.5,\"to_m\":0.5,\"force_y_n_m\":1}]}"),
     "/loads/lines/0/to_m", "out_of_range"},
    {STATIC_CASE("", ",\"loads\":{\"tip\":{\"force_y\":1}}"), "/loads/tip/force_y", "unknown_key"},
    {STATIC_CASE("", ",\"loads\":{\"tip\":{\"force_y_n\":1}},\"output\":{\"stress_at_m\":[0,2]}"),
     "/output/stress_at_m/1", "out_of_range"},
};

static void test_bad_cases(void **state)
{
    assert_all_refused(*state, sizeof bad_cases / sizeof bad_cases[0], bad_cases);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_properties),
        cmocka_unit_test(test_box),
        cmocka_unit_test(test_contour),
        cmocka_unit_test(test_stations),
        cmocka_unit_test(test_loads),
        cmocka_unit_test(test_static_in_a_stream),
        cmocka_unit_test(test_canonical_is_stable),
        cmocka_unit_test(test_identity_sees_every_layup),
        cmocka_unit_test(test_bad_cases),
    };
    return cmocka_run_group_tests(tests, parsing_setup, parsing_teardown);
}
