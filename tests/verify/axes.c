/* Wings given by stiffness numbers: closed forms of the cantilever, published wings, and the
 * paper's beam by the numbers its own section reports. */
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BENDING = 0, LAG = 1, TORSION = 2 };

static const char *const closed = "closed form";

/* EI_flap 2e4, EI_lag 3e5, GJ 1e4, 0.75 kg/m, 0.1 kg m, 16 m, 1 m chord; axes at mid-chord. */
static void plain_wing(struct case_def *def)
{
    case_def_defaults(def);
    def->kind = CASE_MODES;
    def->beam.length = 16.0;
    def->solver.modes = 12;
    section_def_defaults(SECTION_PROPERTIES, &def->beam.section);
    struct properties *p = &def->beam.section.properties;
    p->chord = 1.0;
    p->ei_flap = 2e4;
    p->ei_lag = 3e5;
    p->gj = 1e4;
    p->mass = 0.75;
    p->torsion_inertia = 0.1;
    properties_complete(p);
}

static void uniform_cantilever(struct check_list *list)
{
    static const double euler_root[3] = {1.8751040687119611, 4.6940911329741746,
                                         7.8547574382376126};
    struct case_def def;
    struct model m;
    plain_wing(&def);
    built_model(&def, &m);
    const struct properties *p = &def.beam.section.properties;
    for (int k = 0; k < 3; k++) {
        const double wave = num_sq(euler_root[k] / def.beam.length) / (2.0 * NUM_PI);
        check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, BENDING, k),
                  wave * sqrt(p->ei_flap / p->mass), 1e-4, closed, "uniform wing, flap %d", k + 1);
        if (k < 2) {
            check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, LAG, k),
                      wave * sqrt(p->ei_lag / p->mass), 1e-4, closed, "uniform wing, lag %d",
                      k + 1);
        }
        check_add(list, CHECK_RELATIVE, "Hz", built_frequency(&m, TORSION, k),
                  (k + 0.5) / (2.0 * def.beam.length) * sqrt(p->gj / p->torsion_inertia), 1e-4,
                  closed, "uniform wing, torsion %d", k + 1);
    }
    model_done(&m);
}

static struct beam_motion tip_under(struct case_def *def, double force, double torque)
{
    def->kind = CASE_STATIC;
    def->loads.n_point = 1;
    def->loads.point[0] = (struct point_load_def){
        .z = def->beam.length, .load = {.force = {0.0, force, 0.0}, .moment = {0.0, 0.0, torque}}};
    return built_tip(def);
}

/* No torque: theta' = K v''/GJ, so EI falls to EI - K^2/GJ. */
static void bend_twist(struct check_list *list)
{
    struct case_def def;
    plain_wing(&def);
    struct properties *p = &def.beam.section.properties;
    p->bend_twist = 6e3;
    const double force = 5.0, length = def.beam.length;
    const double soft = p->ei_flap - num_sq(p->bend_twist) / p->gj;
    const struct beam_motion tip = tip_under(&def, force, 0.0);
    check_add(list, CHECK_RELATIVE, "m", tip.v, force * length * length * length / (3.0 * soft),
              1e-8, closed, "bend-twist coupling 6e3 N m^2, tip force: plunge");
    check_add(list, CHECK_RELATIVE, "rad", tip.theta,
              p->bend_twist / p->gj * force * length * length / (2.0 * soft), 1e-8, closed,
              "bend-twist coupling 6e3 N m^2, tip force: nose-up twist");
}

/* Tip torque T: theta = T/GJ (L - tanh(lambda L)/lambda) where the clamp holds the warping. */
static void warping(struct check_list *list)
{
    struct case_def def;
    plain_wing(&def);
    struct properties *p = &def.beam.section.properties;
    const double torque = 3.0, length = def.beam.length;
    const double free_twist = torque * length / p->gj;
    check_add(list, CHECK_RELATIVE, "rad", tip_under(&def, 0.0, torque).theta, free_twist, 1e-9,
              closed, "no warping stiffness, clamp holds warping, tip torque: twist");
    p->ei_warping = 4e4;
    const double lambda = sqrt(p->gj / p->ei_warping);
    check_add(list, CHECK_RELATIVE, "rad", tip_under(&def, 0.0, torque).theta,
              torque / p->gj * (length - tanh(lambda * length) / lambda), 1e-4, closed,
              "warping stiffness 4e4 N m^4, clamp holds warping, tip torque: twist");
    def.beam.root_warping = ROOT_WARPING_FREE;
    check_add(list, CHECK_RELATIVE, "rad", tip_under(&def, 0.0, torque).theta, free_twist, 1e-9,
              closed, "warping stiffness 4e4 N m^4, clamp lets it go, tip torque: twist");
}

/* Stiffness falls linearly to (1 - taper) at the tip; with t = 1 - z/L the tip moves by
 * P L^3/EI_0 times the integral of t^2/((1 - taper) + taper t). */
static void taper(struct check_list *list)
{
    struct case_def def;
    plain_wing(&def);
    static struct station_def station[2];
    const double share = 0.6, length = def.beam.length, force = 5.0, torque = 3.0;
    station[0] = (struct station_def){.z = 0.0, .section = def.beam.section};
    station[1] = (struct station_def){.z = length, .section = def.beam.section};
    struct properties *root = &station[0].section.properties, *tip = &station[1].section.properties;
    tip->ei_flap = (1.0 - share) * root->ei_flap;
    tip->gj = (1.0 - share) * root->gj;
    tip->chord = 0.5 * root->chord;
    root->elastic_axis = tip->elastic_axis = 0.3;
    def.beam.n_station = 2;
    def.beam.station = station;
    const double rest = 1.0 - share;
    const double integral = 1.0 / (2.0 * share) - rest / num_sq(share) -
                            num_sq(rest) * log(rest) / (share * share * share);
    check_add(list, CHECK_RELATIVE, "m", tip_under(&def, force, 0.0).v,
              force * length * length * length / root->ei_flap * integral, 1e-5, closed,
              "stiffness tapered to 0.4, tip force on the axis: plunge");
    const struct beam_motion turned = tip_under(&def, 0.0, torque);
    check_add(list, CHECK_RELATIVE, "rad", turned.theta,
              -torque * length / root->gj * log(rest) / share, 1e-5, closed,
              "stiffness tapered to 0.4, tip torque: twist");
    check_add(list, CHECK_RELATIVE, "", turned.v / turned.theta, -0.2 * tip->chord, 1e-9, closed,
              "axis at 0.3 chord, tip torque: plunge of mid-chord over twist, m");
}

static void published(struct check_list *list)
{
    static const struct {
        const char *file, *wing;
        int mode;
        double omega;
        const char *source;
    } row[] = {
        {"goland-modes", "Goland wing", 0, 48.16, "[C], validation data 3.3"},
        {"goland-modes", "Goland wing", 1, 95.84, "[C], validation data 3.3"},
        {"goland-modes", "Goland wing", 2, 244.0, "[C], validation data 3.3"},
        {"goland-modes", "Goland wing", 3, 347.8, "[C], validation data 3.3"},
        {"wing-16m-modes", "16 m wing", 0, 2.243, "[C], validation data 3.4"},
        {"wing-16m-modes", "16 m wing", 1, 14.056, "[C], validation data 3.4"},
        {"wing-16m-modes", "16 m wing", 2, 31.046, "[C], validation data 3.4"},
        {"wing-16m-modes", "16 m wing", 4, 39.356, "[C], validation data 3.4"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        struct built_case *shipped = built_shipped(row[i].file);
        struct model m;
        built_model(built_case_def(shipped), &m);
        check_add(list, CHECK_RELATIVE, "rad/s",
                  row[i].mode < m.modes.n_mode ? m.modes.omega[row[i].mode] : (double)NAN,
                  row[i].omega, 2e-4, row[i].source, "%s in a vacuum, mode %d", row[i].wing,
                  row[i].mode + 1);
        model_done(&m);
        built_release(shipped);
    }
}

/* What a section reports, given back as properties, makes nearly the same beam: what is left out
 * are its extension couplings and the rotary inertia of its walls. */
static void own_numbers(struct check_list *list)
{
    struct case_def def, numbers;
    struct model walls, again;
    fixture_paper_beam(-45.0, NULL, &def);
    def.kind = CASE_MODES;
    def.solver.modes = 5;
    built_model(&def, &walls);
    const struct section_summary *s = &walls.section_summary;
    const struct centres *c = &walls.centres;
    numbers = def;
    section_def_defaults(SECTION_PROPERTIES, &numbers.beam.section);
    numbers.beam.section.properties = (struct properties){.chord = 0.1,
                                                          .ei_flap = s->ei_flap,
                                                          .ei_lag = s->ei_lag,
                                                          .gj = s->gj,
                                                          .ea = c->ea,
                                                          .bend_twist = s->bend_twist,
                                                          .ei_warping = c->ei_warping,
                                                          .mass = c->mass,
                                                          .torsion_inertia = c->inertia_polar,
                                                          .inertia_axis = INERTIA_MASS_CENTRE,
                                                          .elastic_axis = 0.5,
                                                          .mass_axis = 0.5};
    built_model(&numbers, &again);
    for (int j = 0; j < 5; j++) {
        check_add(list, CHECK_RELATIVE, "Hz", built_hz(&again, j), built_hz(&walls, j), 2e-3,
                  "the beam with walls",
                  "paper beam, -45 deg, by the numbers of its section, mode %d", j + 1);
    }
    model_done(&again);
    model_done(&walls);
}

static void fill(struct check_list *list)
{
    uniform_cantilever(list);
    bend_twist(list);
    warping(list);
    taper(list);
    published(list);
    own_numbers(list);
}

const struct check_group group_axes = {
    .name = "axes",
    .title = "Wings given by stiffness numbers",
    .text = "Sections of type `properties`, 16 elements. The uniform wing: L 16 m, EI_flap 2e4, "
            "EI_lag 3e5, GJ 1e4 N m^2, 0.75 kg/m, 0.1 kg m. The Goland wing and the 16 m wing are "
            "the shipped example cases.",
    .fill = fill,
};
