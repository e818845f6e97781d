/* Result documents of real runs: against the schemas, and against the numbers of the core. */
#include "api/embedded.h"
#include "api/json.h"
#include "api/result.h"
#include "core/num.h"
#include "tests/api/schema_check.h"

#include <cjson/cJSON.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/near.h"

#define SECTION                                                                                    \
    "\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["                                  \
    "{\"material\":\"AS4/3501-6\",\"angle_deg\":-45,\"thickness_m\":0.00013},"                     \
    "{\"material\":\"foam\",\"thickness_m\":0.00387}]}"
static const char *const cases[] = {
    [CASE_SIMULATION] =
        "{\"schema_version\":1,\"kind\":\"simulation\",\"name\":\"s\",\"beam\":{\"length_m\":0.37,"
        "\"elements\":6," SECTION "},\"flow\":{\"speed_m_s\":6,\"incidence_deg\":5},"
        "\"aerodynamics\":{\"polar\":\"plate-4pct-channel\"},\"solver\":{\"duration_s\":0.5}}",
    [CASE_MODES] = "{\"schema_version\":1,\"kind\":\"modes\",\"beam\":{\"length_m\":0.37," SECTION
                   "},\"solver\":{\"modes\":3}}",
    [CASE_STATIC] =
        "{\"schema_version\":1,\"kind\":\"static\",\"beam\":{\"length_m\":0.37," SECTION
        "},\"loads\":{\"tip\":{\"force_y_n\":0.1}},\"output\":{\"stress_at_m\":[0,0.2]}}",
    [CASE_STABILITY] =
        "{\"schema_version\":1,\"kind\":\"stability\",\"beam\":{\"length_m\":0.37," SECTION
        "},\"aerodynamics\":{\"polar\":\"flat-plate-linear\",\"dynamic\":{\"type\":\"attached\"}},"
        "\"stability\":{\"from_m_s\":2,\"to_m_s\":25,\"count\":24}}",
    [CASE_LOOP] =
        "{\"schema_version\":1,\"kind\":\"loop\",\"aerodynamics\":{\"polar\":"
        "\"plate-4pct-channel\",\"dynamic\":{\"type\":\"attached\"}},\"motion\":{\"type\":\"sine\","
        "\"amplitude_deg\":3,\"plunge_c\":0.1,\"phase_deg\":90,\"frequency_c_v\":0.1,\"cycles\":2}"
        "}",
    [CASE_SECTION] = "{\"schema_version\":1,\"kind\":\"section\",\"beam\":{" SECTION "}}",
};

struct fixture {
    struct library *lib;
    cJSON *doc;
    struct api_case *c;
    struct sim *sim;
};

static int setup(void **state)
{
    struct failure fail;
    struct fixture *f = calloc(1, sizeof *f);
    *state = f;
    return library_create_builtin(&f->lib, &fail) == ST_OK &&
                   json_parse(openapi_files[0].data, embedded_size(&openapi_files[0]), &f->doc,
                              &fail) == ST_OK
               ? 0
               : -1;
}

static int teardown(void **state)
{
    struct fixture *f = *state;
    sim_destroy(f->sim);
    api_case_destroy(f->c);
    json_free(f->doc);
    library_destroy(f->lib);
    free(f);
    return 0;
}

static const struct sim_result *run_case(struct fixture *f, const char *json)
{
    struct failure_list *problems = calloc(1, sizeof *problems);
    struct failure fail = {.detail = ""};
    assert_int_equal(api_case_parse(f->lib, json, strlen(json), "", &f->c, problems), ST_OK);
    if (sim_create(api_case_def(f->c), &f->sim, &fail) != ST_OK ||
        sim_run(f->sim, &(const struct sim_control){.cancel = NULL}, &fail) != ST_OK) {
        fail_msg("%s", fail.detail);
    }
    free(problems);
    return sim_result(f->sim);
}

static const struct sim_result *run(struct fixture *f, enum case_kind kind)
{
    return run_case(f, cases[kind]);
}

/* The document, checked against the schema of the answer it is served in. */
static cJSON *document(struct fixture *f, const char *name, const struct sim_result *r)
{
    static const struct {
        const char *name, *schema;
    } schemas[] = {
        {"summary", "#/components/schemas/Summary"},
        {"damping", "#/components/schemas/Damping"},
        {"loads", "#/components/schemas/SpanLoads"},
        {"modes", "#/components/schemas/Modes"},
        {"section", "#/components/schemas/SectionResult"},
        {"static", "#/components/schemas/StaticResult"},
        {"stability", "#/components/schemas/StabilityResult"},
    };
    struct cJSON *tree = NULL;
    struct failure fail;
    char why[256] = "no schema";
    char *text = result_document(name, f->c, r, &(const struct run_timing){.cpu_s = 0.25});
    assert_int_equal(json_parse(text, strlen(text), &tree, &fail), ST_OK);
    bool ok = false;
    for (size_t i = 0; i < sizeof schemas / sizeof schemas[0]; i++) {
        if (strcmp(schemas[i].name, name) == 0) {
            ok = schema_check(f->doc, schema_node(f->doc, schemas[i].schema), tree, why);
        }
    }
    if (!ok) {
        fail_msg("%s: %s in %.400s", name, why, text);
    }
    free(text);
    return tree;
}

/* Number at a path of keys and indices: "means/cl", "modes/0/frequency_hz". */
static double number(const cJSON *tree, const char *path)
{
    char reference[128];
    const cJSON *node = tree;
    (void)snprintf(reference, sizeof reference, "%s", path);
    char *at = reference;
    while (at != NULL && node != NULL) {
        char *slash = strchr(at, '/');
        if (slash != NULL) {
            *slash = '\0';
        }
        node = cJSON_IsArray(node) ? cJSON_GetArrayItem(node, (int)strtol(at, NULL, 10))
                                   : cJSON_GetObjectItemCaseSensitive(node, at);
        at = slash != NULL ? slash + 1 : NULL;
    }
    if (!cJSON_IsNumber(node)) {
        fail_msg("%s is not a number", path);
    }
    return node != NULL ? node->valuedouble : (double)NAN;
}

static const char *string(const cJSON *tree, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(tree, key)->valuestring;
}

static void test_simulation(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run(f, CASE_SIMULATION);
    cJSON *s = document(f, "summary", r);
    assert_string_equal(string(s, "verdict"), verdict_name(r->verdict));
    assert_string_equal(string(s, "verdict_reason"), r->verdict_reason);
    assert_near_abs(number(s, "e_star"), r->e_star, 0.0);
    assert_near_rel(number(s, "reynolds"), 6.0 * 0.1 / 1.5e-5, 1e-12);
    assert_near_abs(number(s, "modes/0/frequency_hz"), r->mode[0].frequency_hz, 0.0);
    assert_near_abs(number(s, "means/tip_twist_deg"), num_deg(r->means.tip_twist), 1e-12);
    assert_near_abs(number(s, "means/tip_plunge_m"), r->means.tip_plunge, 0.0);
    assert_near_abs(number(s, "timing/us_per_step"), 0.25e6 / (double)r->steps, 1e-9);
    assert_int_equal((int)number(s, "timing/steps"), 2500);
    assert_true(r->tip_twist.n_root > 0);
    assert_near_rel(number(s, "damping/tip_twist/roots/0/amplitude"),
                    num_deg(r->tip_twist.root[0].amplitude), 1e-12);
    assert_near_abs(number(s, "damping/tip_plunge/roots/0/amplitude"),
                    r->tip_plunge.root[0].amplitude, 0.0);
    assert_string_equal(string(s, "wash"), "wash_out"); /* -45 deg, model section 1 */
    const cJSON *identity = cJSON_GetObjectItemCaseSensitive(s, "identity");
    assert_string_equal(string(identity, "content_hash"), api_case_hash(f->c));
    assert_string_equal(string(identity, "core_version"), AEROM_CORE_VERSION);
    assert_string_equal(string(cJSON_GetObjectItemCaseSensitive(identity, "polar"), "hash"),
                        api_case_def(f->c)->aero.polar->hash);
    cJSON *d = document(f, "damping", r);
    assert_true(cJSON_Compare(d, cJSON_GetObjectItemCaseSensitive(s, "damping"), true));
    json_free(d);
    d = document(f, "loads", r);
    assert_near_abs(number(d, "window_s/1"), 0.5, 1e-12);
    assert_near_rel(number(d, "z_m/5"), 0.37 * 5.5 / 6.0, 1e-12);
    assert_near_abs(number(d, "cl/0"), r->loads.cl[0], 0.0);
    assert_near_abs(number(d, "alpha_deg/3"), num_deg(r->loads.alpha[3]), 1e-12);
    double lift = 0.0, drag = 0.0, moment = 0.0;
    for (int i = 0; i < 6; i++) {
        lift += r->loads.lift[i] * 0.37 / 6.0;
        drag += r->loads.drag[i] * 0.37 / 6.0;
        moment += r->loads.moment[i] * 0.37 / 6.0;
    }
    assert_near_rel(number(s, "means/lift_n"), lift, 1e-12);
    assert_near_rel(number(s, "means/drag_n"), drag, 1e-12);
    assert_near_rel(number(s, "means/moment_n_m"), moment, 1e-12);
    assert_near_rel(number(s, "means/efficiency"), lift / drag, 1e-12);
    json_free(d);
    json_free(s);
    json_free(document(f, "modes", r));
    json_free(document(f, "section", r));
}

static int nodes_of(const cJSON *modes, int mode, const char *key)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(modes, "modes");
    const cJSON *nodes = cJSON_GetObjectItemCaseSensitive(cJSON_GetArrayItem(list, mode), "nodes");
    return cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(nodes, key));
}

static void test_modes(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run(f, CASE_MODES);
    cJSON *m = document(f, "modes", r);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(m, "modes")), 3);
    assert_near_abs(number(m, "modes/2/frequency_hz"), r->mode[2].frequency_hz, 0.0);
    assert_near_abs(number(m, "modes/1/shape/z_m/32"), 0.37, 0.0);
    assert_near_abs(number(m, "modes/1/shape/z_m/16"), 0.185, 1e-15);
    assert_near_abs(number(m, "modes/1/shape/plunge/0"), 0.0, 1e-12); /* clamped */
    double total = 0.0;
    static const char *const parts[] = {"bending", "lag", "torsion", "axial"};
    for (int i = 0; i < 4; i++) {
        char path[64];
        (void)snprintf(path, sizeof path, "modes/0/energy_share/%s", parts[i]);
        total += number(m, path);
    }
    assert_near_abs(total, 1.0, 1e-9);
    json_free(m);
    cJSON *s = document(f, "summary", r);
    assert_string_equal(string(s, "kind"), "modes");
    assert_null(cJSON_GetObjectItemCaseSensitive(s, "e_star"));
    assert_near_abs(number(s, "modes/2/modal_mass"), r->mode[2].modal_mass, 0.0);
    /* The second bending mode has one node, the first none. */
    assert_int_equal(r->mode[0].label, MODE_BENDING);
    assert_int_equal(nodes_of(s, 0, "plunge_z_m"), 0);
    int second = 1;
    while (second < r->n_mode && r->mode[second].label != MODE_BENDING) {
        second++;
    }
    assert_true(second < r->n_mode);
    assert_int_equal(nodes_of(s, second, "plunge_z_m"), 1);
    char path[64];
    (void)snprintf(path, sizeof path, "modes/%d/nodes/plunge_z_m/0", second);
    assert_near_rel(number(s, path), 0.783 * 0.37, 0.01); /* of a uniform cantilever */
    json_free(s);
    json_free(document(f, "section", r));
}

static void test_section(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run(f, CASE_SECTION);
    cJSON *s = document(f, "section", r);
    for (int i = 0; i < SECTION_STRAINS; i++) {
        for (int j = 0; j < SECTION_STRAINS; j++) {
            char path[48];
            (void)snprintf(path, sizeof path, "stiffness/%d/%d", i, j);
            assert_near_abs(number(s, path), r->section.stiffness[i + j * SECTION_STRAINS], 0.0);
        }
    }
    assert_near_rel(number(s, "mass_kg_m"), 0.1 * (0.00013 * 1445 + 0.00387 * 35), 1e-12);
    assert_near_rel(number(s, "thickness_m"), 0.004, 1e-12);
    assert_near_rel(number(s, "mass/0/0"), number(s, "mass_kg_m"), 1e-9);
    assert_near_rel(number(s, "ea_n"), r->section.centres.ea, 0.0);
    /* The strip warps by -x y + const: nothing on its middle line but what the laminate couples. */
    const cJSON *warping = cJSON_GetObjectItemCaseSensitive(s, "warping");
    assert_int_equal(cJSON_GetArraySize(warping), 33);
    assert_near_rel(number(s, "warping/0/x_m"), 0.05, 1e-12);
    assert_near_rel(number(s, "warping/32/x_m"), -0.05, 1e-12);
    /* The summary has the matrices on its first level: scripts rely on it. */
    cJSON *head = document(f, "summary", r);
    static const char *const same[] = {"stiffness", "stiffness_condensed", "mass", "order"};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        assert_true(cJSON_Compare(cJSON_GetObjectItemCaseSensitive(head, same[i]),
                                  cJSON_GetObjectItemCaseSensitive(s, same[i]), true));
    }
    json_free(head);
    json_free(s);
}

/* Of a strip of one isotropic ply: closed forms. */
static void test_static_closed_form(void **state)
{
    static const char strip[] =
        "{\"schema_version\":1,\"kind\":\"static\",\"materials\":[{\"name\":\"m\",\"e_l_pa\":70e9,"
        "\"e_t_pa\":70e9,\"g_lt_pa\":26e9,\"g_tt_pa\":26e9,\"nu_lt\":0.3,\"nu_tt\":0.3,"
        "\"density_kg_m3\":2700,\"x_tension_pa\":4e8,\"x_compression_pa\":4e8,\"y_tension_pa\":4e8,"
        "\"y_compression_pa\":4e8,\"s_shear_pa\":2e8}],\"beam\":{\"length_m\":2,\"section\":{"
        "\"type\":"
        "\"strip\",\"chord_m\":0.1,\"layup\":[{\"material\":\"m\",\"thickness_m\":0.01}]}},"
        "\"loads\":{\"tip\":{\"force_y_n\":3}},\"output\":{\"stress_at_m\":[0]}}";
    const double ei = 70e9 * 0.1 * 1e-6 / 12.0, stress = 3.0 * 2.0 * 0.005 / (0.1 * 1e-6 / 12.0);
    struct fixture *f = *state;
    const struct sim_result *r = run_case(f, strip);
    cJSON *s = document(f, "summary", r);
    assert_near_rel(number(s, "tip/plunge_m"), 3.0 * 8.0 / (3.0 * ei), 1e-6);
    assert_near_rel(number(s, "tip/slope_flap_deg"), num_deg(3.0 * 4.0 / (2.0 * ei)), 1e-6);
    assert_near_abs(number(s, "tip/twist_deg"), 0.0, 1e-9);
    assert_near_abs(number(s, "reactions/force_y_n"), -3.0, 1e-9);
    assert_near_abs(number(s, "reactions/moment_x_n_m"), 6.0, 1e-9); /* of -z F_y */
    /* Equal strengths and a uniaxial stress: the reserve is their quotient. */
    assert_near_rel(number(s, "first_ply_failure/reserve"), 4e8 / stress, 1e-3);
    assert_near_abs(number(s, "first_ply_failure/z_m"), 0.0, 0.0);
    json_free(s);
    s = document(f, "static", r);
    assert_near_rel(number(s, "span/plunge_m/32"), number(s, "tip/plunge_m"), 0.0);
    assert_near_rel(number(s, "span/plunge_m/16"), 3.0 * 1.0 * 5.0 / (6.0 * ei), 1e-6);
    assert_near_rel(fabs(number(s, "stress/0/plies/0/sigma_l_pa")), stress, 1e-3);
    assert_near_rel(number(s, "stress/0/strains/phi_rate_1_m"), -6.0 / ei, 1e-6);
    json_free(s);
}

static void test_stability(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run(f, CASE_STABILITY);
    const struct stability_result *s = &r->stability;
    cJSON *d = document(f, "summary", r);
    assert_string_equal(string(d, "verdict"), "divergence");
    assert_near_abs(number(d, "divergence/speed_m_s"), s->divergence.speed, 0.0);
    assert_near_abs(number(d, "flutter/mode"), s->flutter.mode + 1, 0.0);
    assert_true(s->flutter.speed > s->divergence.speed);
    json_free(d);
    d = document(f, "stability", r);
    assert_near_abs(number(d, "speeds_m_s/23"), 25.0, 1e-12);
    /* V-g: a branch changes its sign between the neighbours of the flutter speed. */
    const int mode = s->flutter.mode;
    int i = 0;
    while (s->speed[i + 1] < s->flutter.speed) {
        i++;
    }
    char path[64];
    (void)snprintf(path, sizeof path, "branches/%d/damping_ratio/%d", mode, i);
    assert_true(number(d, path) > 0.0);
    (void)snprintf(path, sizeof path, "branches/%d/damping_ratio/%d", mode, i + 1);
    assert_true(number(d, path) < 0.0);
    assert_near_abs(number(d, "flutter_shape/z_m/32"), 0.37, 1e-15);
    assert_near_abs(number(d, "flutter_shape/plunge_re_chords/0"), 0.0, 1e-12); /* clamped */
    json_free(d);
}

/* A range without instability is an answer, with the least damped mode. */
static void test_no_instability(void **state)
{
    static const char *const calm =
        "{\"schema_version\":1,\"kind\":\"stability\",\"beam\":{\"length_m\":0.37," SECTION
        "},\"aerodynamics\":{\"polar\":\"flat-plate-linear\",\"dynamic\":{\"type\":\"attached\"}},"
        "\"stability\":{\"from_m_s\":2,\"to_m_s\":5}}";
    struct fixture *f = *state;
    const struct sim_result *r = run_case(f, calm);
    cJSON *d = document(f, "summary", r);
    assert_string_equal(string(d, "verdict"), "stable");
    assert_string_equal(string(d, "flutter"), "none_in_range");
    assert_string_equal(string(d, "divergence"), "none_in_range");
    assert_true(number(d, "least_damped/damping_ratio") > 0.0);
    json_free(d);
    d = document(f, "stability", r);
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(d, "flutter_shape")));
    json_free(d);
}

/* The record has time in c/V; the work is the integral over its last cycle. */
static void test_loop(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run(f, CASE_LOOP);
    cJSON *s = document(f, "summary", r);
    assert_int_equal(r->n_sample, 801);
    assert_int_equal(r->n_column, 5);
    assert_near_rel(number(s, "step_c_v"), 1.0 / (0.1 * 400), 1e-15);
    const double *alpha = sim_column(f->sim, 0), *w = sim_column(f->sim, 1);
    const double *cl = sim_column(f->sim, 2), *cm = sim_column(f->sim, 3);
    double pitch = 0.0, plunge = 0.0, most = -1.0;
    for (int i = 0; i < 800; i++) {
        most = fmax(most, cl[i]);
        if (i >= 400) {
            pitch += 0.5 * (cm[i] + cm[i + 1]) * (alpha[i + 1] - alpha[i]);
            plunge += 0.5 * (cl[i] + cl[i + 1]) * (w[i + 1] - w[i]);
        }
    }
    assert_near_rel(number(s, "work/pitch"), pitch, 1e-3);
    assert_near_rel(number(s, "work/plunge"), plunge, 1e-3);
    assert_near_rel(number(s, "work/total"), r->loop.work_pitch + r->loop.work_plunge, 1e-15);
    assert_near_abs(number(s, "cl/max"), most, 0.0);
    assert_near_abs(number(s, "outside_hull"), 0.0, 0.0);
    json_free(s);
}

static void test_static(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run(f, CASE_STATIC);
    cJSON *s = document(f, "summary", r);
    assert_near_abs(number(s, "tip/plunge_m"), r->statics.tip.v, 0.0);
    assert_near_abs(number(s, "tip/twist_deg"), num_deg(r->statics.tip.theta), 1e-15);
    json_free(s);
    s = document(f, "static", r);
    const cJSON *foam = cJSON_GetObjectItemCaseSensitive(s, "stress")->child;
    foam = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(foam, "plies"), 1);
    assert_string_equal(string(foam, "material"), "foam"); /* no strengths: no index */
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(foam, "index")));
    assert_true(number(s, "stress/0/plies/0/reserve") > 1.0);
    json_free(s);
    json_free(document(f, "section", r));
}

#define WING(speed_)                                                                               \
    "{\"schema_version\":1,\"kind\":\"static\",\"beam\":{\"length_m\":16,\"section\":{\"type\":"   \
    "\"properties\",\"chord_m\":1,\"ei_flap_n_m2\":2e4,\"gj_n_m2\":1e4,\"mass_kg_m\":0.75,"        \
    "\"torsion_inertia_kg_m\":0.1}},\"flow\":{\"speed_m_s\":" speed_                               \
    ",\"density_kg_m3\":0.0889,\"incidence_deg\":1},\"aerodynamics\":{\"polar\":"                  \
    "\"flat-plate-linear\",\"lifting_line\":null}}"

/* Below divergence the loads of the air, beyond it the speed; no walls, so some numbers are null.
 */
static void test_static_in_a_stream(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run_case(f, WING("25"));
    cJSON *s = document(f, "summary", r);
    assert_near_rel(number(s, "aeroelastic/divergence_speed_m_s"), 37.1539, 1e-5);
    assert_near_rel(number(s, "aeroelastic/lift_n"), r->statics.air.total.lift, 1e-15);
    const cJSON *section = cJSON_GetObjectItemCaseSensitive(s, "section");
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(section, "thickness_m")));
    json_free(s);
    s = document(f, "static", r);
    assert_near_rel(number(s, "air/lift_n_m/63"), r->statics.air.station[63].lift, 1e-15);
    assert_near_abs(number(s, "air/alpha_deg/0"), 1.0, 0.05); /* at the root the rigid angle */
    json_free(s);
    json_free(document(f, "section", r));
}

static void test_static_beyond_divergence(void **state)
{
    struct fixture *f = *state;
    const struct sim_result *r = run_case(f, WING("40"));
    cJSON *s = document(f, "summary", r);
    const cJSON *air = cJSON_GetObjectItemCaseSensitive(s, "aeroelastic");
    assert_string_equal(string(air, "state"), "divergence");
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(air, "lift_n")));
    json_free(s);
    json_free(document(f, "static", r));
}

/* A number that is not finite is null, never text that is no JSON. */
static void test_not_finite(void **state)
{
    struct fixture *f = *state;
    struct sim_result r = *run(f, CASE_SIMULATION);
    r.e_star = (double)INFINITY;
    r.means.cl = (double)NAN;
    r.tip_twist.hilbert_ratio = (double)NAN;
    r.tip_twist.torsion = -1;
    r.tip_twist.least_stable = -1;
    r.steps = 0;
    cJSON *s = document(f, "summary", &r);
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(s, "e_star")));
    const cJSON *timing = cJSON_GetObjectItemCaseSensitive(s, "timing");
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(timing, "us_per_step")));
    json_free(s);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_simulation),
        TEST(test_modes),
        TEST(test_section),
        TEST(test_loop),
        TEST(test_static),
        TEST(test_stability),
        TEST(test_no_instability),
        TEST(test_static_closed_form),
        TEST(test_not_finite),
        TEST(test_static_in_a_stream),
        TEST(test_static_beyond_divergence),
    };
    sim_process_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
