/* Static aeroelasticity of an isotropic strip with linear thin-aerofoil loads: twist and lift below
 * divergence against the closed form, divergence above it. Everything through the facade. */
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

/* Twist of a clamped strip under c_m = (pi/2) alpha about mid-chord: GJ theta'' = -q c^2 (pi/2)
 * (alpha_0 + theta). A narrow strip, so that the warping stiffness does not matter (it would
 * stiffen by (pi b / 2 L)^2 / 24). */
static const double length = 1.2, chord = 0.02, thickness = 0.001;
static const double incidence = 1e-3;

static double divergence_pressure(const struct material *m)
{
    const double gj = m->g_lt * chord * thickness * thickness * thickness / 3.0;
    const double lever = chord / 4.0; /* from the quarter point to the elastic axis */
    return num_sq(NUM_PI / 2.0) * gj / (length * length * chord * lever * 2.0 * NUM_PI);
}

static void strip_case(double share, int elements, int modes, const struct polar_def *polar,
                       struct case_def *def)
{
    const struct material mat = fixture_isotropic(70e9, 0.0, 2700.0);
    fixture_strip(&mat, length, chord, thickness, def);
    def->kind = CASE_SIMULATION;
    def->beam.elements = elements;
    def->flow.speed = sqrt(2.0 * share * divergence_pressure(&mat) / def->flow.density);
    def->flow.incidence = incidence;
    def->aero.polar = polar;
    def->aero.lifting_line = false;
    def->solver.modes = modes;
    def->solver.duration = def->solver.time_step;
}

/* Tip twist / incidence and lift factor at equilibrium. */
static void equilibrium(double share, int elements, int modes, double *twist, double *lift)
{
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    struct case_def def;
    strip_case(share, elements, modes, &polar, &def);
    def.solver.start = START_EQUILIBRIUM;
    struct sim *sim = built_run(&def);
    *twist = sim_column(sim, 1)[0] / incidence;
    *lift = sim_column(sim, 2)[0] / (2.0 * NUM_PI * incidence);
    sim_destroy(sim);
    polar_def_done(&polar);
}

static const struct {
    double share, twist, lift;
} rows[] = {{0.10, 0.13747, 1.09126},
            {0.25, 0.41421, 1.27324},
            {0.50, 1.25217, 1.81683},
            {0.75, 3.78705, 3.44135},
            {0.90, 11.41915, 8.30688}};

static void below_divergence(struct check_list *list)
{
    static const char *const source = "closed form, validation data 3.1";
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double twist, lift;
        equilibrium(rows[i].share, 32, 60, &twist, &lift);
        check_add(list, CHECK_RELATIVE, "", twist, rows[i].twist, 0.002, source,
                  "q/q_D = %.2f: tip twist / incidence", rows[i].share);
        check_add(list, CHECK_RELATIVE, "", lift, rows[i].lift, 0.002, source,
                  "q/q_D = %.2f: lift factor", rows[i].share);
    }
    double twist, lift;
    equilibrium(0.5, 16, 60, &twist, &lift);
    check_add(list, CHECK_RELATIVE, "", twist, rows[2].twist, 0.002, source,
              "q/q_D = 0.50, 16 elements: tip twist / incidence");
}

/* The same closed form by the kind static: the 16 m wing, 16 elements. */
static void kind_static(struct check_list *list)
{
    static const char *const source = "closed form, validation data 3.1";
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    struct case_def def;
    struct static_result r;
    struct model m;
    const double pressure = num_sq(NUM_PI / 32.0) * 1e4 / (0.25 * 2.0 * NUM_PI);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        case_def_defaults(&def);
        def.kind = CASE_STATIC;
        def.beam.length = 16.0;
        section_def_defaults(SECTION_PROPERTIES, &def.beam.section);
        struct properties *p = &def.beam.section.properties;
        p->chord = 1.0;
        p->ei_flap = 2e4;
        p->ei_lag = 4e6;
        p->gj = 1e4;
        p->mass = 0.75;
        p->torsion_inertia = 0.1;
        properties_complete(p);
        def.flow.density = 0.0889;
        def.flow.speed = sqrt(2.0 * rows[i].share * pressure / def.flow.density);
        def.flow.incidence = incidence;
        def.aero.polar = &polar;
        def.aero.lifting_line = false;
        built_model(&def, &m);
        built_answer(&m, &r);
        check_add(list, CHECK_RELATIVE, "", r.tip.theta / incidence, rows[i].twist, 0.001, source,
                  "kind static, 16 m wing, q/q_D = %.2f: tip twist / incidence", rows[i].share);
        check_add(list, CHECK_RELATIVE, "", r.air.total.cl / (2.0 * NUM_PI * incidence),
                  rows[i].lift, 0.001, source, "kind static, 16 m wing, q/q_D = %.2f: lift factor",
                  rows[i].share);
        if (i == 0) {
            check_add(list, CHECK_RELATIVE, "m/s", r.air.divergence_speed, 37.154, 1e-4,
                      "[C], validation data 3.4", "kind static, 16 m wing: divergence speed");
        }
        statics_done(&r);
        model_done(&m);
    }
    polar_def_done(&polar);
}

/* From rest at 1.2 q_D: the twist runs away without swinging. */
static void above_divergence(struct check_list *list)
{
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    struct case_def def;
    strip_case(1.2, 32, 60, &polar, &def);
    def.solver.duration = 2.0;
    def.solver.twist_max = num_rad(20.0);
    def.solver.plunge_max = 10.0;
    struct sim *sim = built_run(&def);
    check_add(list, CHECK_ABSOLUTE, "", sim_result(sim)->verdict == VERDICT_DIVERGENCE, 1.0, 0.0,
              "property", "q/q_D = 1.20 from rest: verdict is divergence (1 = yes)");
    sim_destroy(sim);
    struct failure fail = {0};
    def.solver.start = START_EQUILIBRIUM;
    enum status st = sim_create(&def, &sim, &fail);
    if (st == ST_OK) {
        st = sim_run(sim, NULL, &fail);
        const double tip = st == ST_OK ? sim_column(sim, 1)[0] : 0.0;
        /* The linear equations have an unstable equilibrium above q_D: 1/cos - 1 < 0. */
        check_add(list, CHECK_RELATIVE, "", tip / incidence,
                  1.0 / cos(NUM_PI / 2.0 * sqrt(1.2)) - 1.0, 0.005, "closed form",
                  "q/q_D = 1.20: the unstable equilibrium, tip twist / incidence");
        sim_destroy(sim);
    }
    polar_def_done(&polar);
}

static void fill(struct check_list *list)
{
    below_divergence(list);
    above_divergence(list);
    kind_static(list);
}

const struct check_group group_static_aero = {
    .name = "static_aero",
    .title = "Static aeroelasticity",
    .text =
        "Isotropic strip (nu = 0, L 1.2 m, c 0.02 m, h 1 mm), c_l = 2 pi alpha, c_m = (pi/2) "
        "alpha about mid-chord, no lifting line, quasi-steady, 32 elements and 60 modes: start "
        "from equilibrium through the facade. The kind `static` answers with the flexibility of "
        "the whole beam and four stations of the air an element; there the wing is the 16 m wing.",
    .fill = fill,
};
