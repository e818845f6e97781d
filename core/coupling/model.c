#include "core/coupling/model.h"

#include "core/coupling/apparent_mass.h"
#include "core/coupling/excitation.h"
#include "core/num.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOT_NODES = 8 }; /* extra ones at most next to the clamp */

struct beam_motion model_motion_at(const struct model *m, const double *x, double z)
{
    struct beam_motion at = beam_motion_at(&m->beam, x, z);
    const struct shape_point p = beam_def_mid_chord_at(&m->def.beam, z);
    at.u -= p.y * at.theta;
    at.v += p.x * at.theta;
    at.w += p.y * at.phi - p.x * at.psi;
    return at;
}

static enum status section_of_walls(const struct shape *shape, struct section *out)
{
    struct laminate *laminate = malloc(LIMIT_WALLS * sizeof *laminate);
    struct contour contour = {0};
    if (laminate == NULL) {
        return ST_NO_MEMORY;
    }
    enum status st = shape_build(shape, &contour, laminate);
    if (st == ST_OK) {
        st = section_build(&contour, laminate, out);
    }
    contour_done(&contour);
    free(laminate);
    return st;
}

static enum status section_of(const struct section_def *s, struct section *out)
{
    if (s->shape.type != SECTION_PROPERTIES) {
        return section_of_walls(&s->shape, out);
    }
    properties_build(&s->properties, out);
    return ST_OK;
}

static enum status build_section(struct model *m)
{
    const struct section_def *root = beam_def_root(&m->def.beam);
    m->thickness = section_def_height(root);
    enum status st = section_of(root, &m->section);
    if (st == ST_OK) {
        st = section_summarise(&m->section, &m->section_summary);
    }
    if (st == ST_OK) {
        st = centres_find(&m->section, &m->centres);
    }
    return st;
}

static enum status try_walls(const struct shape *given, const char *pointer,
                             struct failure_list *out)
{
    enum { COARSE = 2 }; /* elements a wall: regular there is regular in any mesh */
    struct section section;
    struct section_summary summary;
    struct centres centres;
    struct shape *shape = malloc(sizeof *shape);
    if (shape == NULL) {
        return ST_NO_MEMORY;
    }
    *shape = *given;
    shape->contour_elements = shape->contour_elements < COARSE ? shape->contour_elements : COARSE;
    enum status st = section_of_walls(shape, &section);
    if (st == ST_OK) {
        st = section_summarise(&section, &summary);
    }
    if (st == ST_OK) {
        st = centres_find(&section, &centres);
    }
    free(shape);
    if (st != ST_OK && st != ST_NO_MEMORY) {
        failure_set(failure_add(out), st, pointer, "cannot_carry_load",
                    "a section with stiffness against extension, bending and torsion", NULL,
                    "the section cannot carry load: %s", status_text(st));
        return ST_OK;
    }
    return st;
}

/* The check of properties has said all there is. */
static enum status try_section(const struct section_def *s, const char *pointer,
                               struct failure_list *out)
{
    return s->shape.type == SECTION_PROPERTIES ? ST_OK : try_walls(&s->shape, pointer, out);
}

enum status model_try_sections(const struct beam_def *b, struct failure_list *out)
{
    if (b->n_station == 0) {
        return try_section(&b->section, "/beam/section", out);
    }
    enum status st = ST_OK;
    for (int i = 0; i < b->n_station && st == ST_OK; i++) {
        char pointer[64];
        (void)snprintf(pointer, sizeof pointer, "/beam/stations/%d/section", i);
        st = try_section(&b->station[i].section, pointer, out);
    }
    return st;
}

/* Reach of a held warping along the span [m]. */
static double warping_reach(const struct model *m)
{
    return sqrt(fmax(m->centres.ei_warping, 0.0) / m->centres.gj);
}

/* A section without warping stiffness is free to warp at the clamp as well: what held it there
 * would come free at once. */
static enum root_warping root_of(const struct model *m)
{
    const double least = 1e-6 * m->def.beam.length;
    return warping_reach(m) > least ? m->def.beam.root_warping : ROOT_WARPING_FREE;
}

/* A clamp that holds the warping also holds theta', which a coupled beam needs for its bending;
 * both come free again over sqrt(EI_w/GJ), a few millimetres in a closed section. An element that
 * is longer than that layer spreads the clamp over its length: nodes in thirds towards the root.
 * Stresses at the clamp need the curvature of theta inside the layer, not only its reach: a ninth
 * of it leaves 0.1 %, where one element of its length leaves 2 to 6 %. */
static int root_layer(const struct model *m, double *z)
{
    const struct beam_def *b = &m->def.beam;
    const double reach = warping_reach(m);
    const double finest = m->def.kind == CASE_STATIC ? reach / 9.0 : reach;
    double at = b->length / b->elements / 3.0;
    int n = 0;
    while (root_of(m) == ROOT_WARPING_RESTRAINED && n < ROOT_NODES && at > finest) {
        z[n++] = at;
        at /= 3.0;
    }
    return n;
}

/* Nodes where stations and lumped masses are, and in the layer at the root. */
static enum status build_mesh(const struct model *m, struct beam_mesh *out)
{
    const struct beam_def *b = &m->def.beam;
    double extra[LIMIT_STATIONS + LIMIT_MASSES + ROOT_NODES];
    int n = root_layer(m, extra);
    for (int i = 0; i < b->n_station; i++) {
        extra[n++] = b->station[i].z;
    }
    for (int i = 0; i < b->n_mass; i++) {
        extra[n++] = b->mass[i].z;
    }
    return beam_mesh_build(b->length, b->elements, n, extra, out);
}

/* A static answer is of the whole beam: it keeps all modes there is room for. */
static int modes_kept(const struct model *m)
{
    if (m->def.kind != CASE_STATIC) {
        return m->def.solver.modes;
    }
    return m->beam.n_dof < LIMIT_MODES ? m->beam.n_dof : LIMIT_MODES;
}

/* Stations of the air: the elements, and in a static answer so many parts of each that a share of
 * 0.9 of the divergence pressure, where errors grow ten times, is still met within 0.1 %. */
static int stations_of(const struct model *m)
{
    enum { PARTS = 4 };
    const int elements = m->def.beam.elements;
    const bool fine = m->def.kind == CASE_STATIC && PARTS * elements <= LIMIT_ELEMENTS;
    return fine ? PARTS * elements : elements;
}

static enum status build_beam(struct model *m)
{
    const struct beam_def *b = &m->def.beam;
    struct beam_mesh mesh = {0};
    struct section *varying = NULL;
    struct section_def *at = NULL;
    enum status st = build_mesh(m, &mesh);
    if (st == ST_OK && b->n_station > 0) {
        varying = malloc((size_t)(BEAM_GAUSS * mesh.n_element) * sizeof *varying);
        at = malloc(sizeof *at);
        st = varying != NULL && at != NULL ? ST_OK : ST_NO_MEMORY;
        for (int i = 0; i < BEAM_GAUSS * mesh.n_element && st == ST_OK; i++) {
            beam_def_section_at(b, beam_mesh_gauss(&mesh, i / BEAM_GAUSS, i % BEAM_GAUSS), at);
            st = section_of(at, &varying[i]);
        }
    }
    if (st == ST_OK) {
        const struct beam_spec spec = {.mesh = &mesh,
                                       .section = varying != NULL ? varying : &m->section,
                                       .uniform = varying == NULL,
                                       .shear = beam_def_root(b)->shear,
                                       .root = root_of(m),
                                       .n_mass = b->n_mass,
                                       .mass = b->mass};
        st = beam_build(&spec, &m->beam);
    }
    free(at);
    free(varying);
    beam_mesh_done(&mesh);
    if (st == ST_OK && (m->def.kind != CASE_STATIC || case_def_flows(&m->def))) {
        st = modes_solve(&m->beam, section_def_chord(beam_def_root(b)), modes_kept(m), &m->modes);
    }
    return st;
}

/* Damping ratio of mode j: its own, or the one of all. */
static double damping_ratio(const struct solver_def *s, int j)
{
    return j < s->n_mode_damping ? s->mode_damping[j] : s->modal_damping;
}

/* Work of gravity on a mode. */
static double gravity_load(const struct beam *b, const double gravity[3], const double *shape)
{
    double sum = 0.0;
    for (int d = 0; d < 3; d++) {
        for (int i = 0; i < b->n_dof; i++) {
            sum += gravity[d] * b->inertia[num_at(i, d, b->n_dof)] * shape[i];
        }
    }
    return sum;
}

enum status model_allocate(struct model *m)
{
    const size_t nm = (size_t)m->n_mode, ns = (size_t)m->n_station, block = nm * ns;
    m->omega2 = calloc(3 * nm + ns + 3 * block, sizeof *m->omega2);
    m->tip = calloc(nm, sizeof *m->tip);
    if (m->omega2 == NULL || m->tip == NULL) {
        return ST_NO_MEMORY;
    }
    m->damping = m->omega2 + nm;
    m->gravity = m->damping + nm;
    m->chord = m->gravity + nm;
    m->station_u = m->chord + ns;
    m->station_v = m->station_u + block;
    m->station_theta = m->station_v + block;
    return ST_OK;
}

static enum status build_transfer(struct model *m)
{
    m->n_mode = m->modes.n_mode;
    m->n_station = stations_of(m);
    m->station_length = m->def.beam.length / m->n_station;
    const enum status st = model_allocate(m);
    if (st != ST_OK) {
        return st;
    }
    m->area = 0.0;
    for (int i = 0; i < m->n_station; i++) {
        m->chord[i] = beam_def_chord_at(&m->def.beam, (i + 0.5) * m->station_length);
        m->area += m->chord[i] * m->station_length;
    }
    for (int j = 0; j < m->n_mode; j++) {
        const double *shape = m->modes.shape + (size_t)j * (size_t)m->modes.n_dof;
        m->omega2[j] = num_sq(m->modes.omega[j]);
        m->damping[j] = 2.0 * damping_ratio(&m->def.solver, j) * m->modes.omega[j];
        m->gravity[j] = gravity_load(&m->beam, m->def.beam.gravity, shape);
        m->tip[j] = model_motion_at(m, shape, m->def.beam.length);
        for (int i = 0; i < m->n_station; i++) {
            const struct beam_motion at = model_motion_at(m, shape, (i + 0.5) * m->station_length);
            const ptrdiff_t k = num_at(i, j, m->n_station);
            m->station_u[k] = at.u;
            m->station_v[k] = at.v;
            m->station_theta[k] = at.theta;
        }
    }
    return ST_OK;
}

/* What the case adds to the polar. */
static enum status build_dynamic(struct model *m)
{
    const struct aero_def *a = &m->def.aero;
    const double speed = m->def.flow.speed, dt = m->def.solver.time_step;
    const struct network_frame frame = network_frame_under(a->dynamic, a->network);
    enum status st = ST_OK;
    if (a->dynamic == DYNAMIC_NETWORK) {
        st = network_create(a->network, &m->network);
        st = st == ST_OK ? network_memory_init(m->n_station, m->chord, speed, dt, &frame,
                                               &m->network_memory)
                         : st;
    }
    if (st == ST_OK && frame.base == NETWORK_ON_STALL) {
        st = dynamic_stall_init(m->n_station, m->chord, speed, dt, m->polar, &a->polar->stall,
                                &m->stall);
    }
    if (st == ST_OK && frame.base != NETWORK_ON_POLAR) {
        st = attached_init(m->n_station, m->chord, speed, dt, &m->attached);
        st = st == ST_OK ? apparent_mass_apply(m) : st;
    }
    return st;
}

enum status model_build_aero(struct model *m)
{
    const struct aero_def *a = &m->def.aero;
    const struct beam_def *b = &m->def.beam;
    if (m->def.kind == CASE_STABILITY) {
        m->def.flow.speed = m->def.stability.from;
    }
    m->dynamic_pressure = 0.5 * m->def.flow.density * num_sq(m->def.flow.speed);
    enum status st = polar_create(a->polar, &m->polar);
    if (st == ST_OK && a->lifting_line) {
        const struct wing wing = {.n = m->n_station,
                                  .length = b->length,
                                  .chord = m->chord,
                                  .walls = a->walls,
                                  .width = a->width,
                                  .tip = a->tip};
        st = lifting_line_init(&wing, a->tolerance, a->iterations_max, &m->lifting_line);
    }
    return st == ST_OK ? build_dynamic(m) : st;
}

/* Sections, beam and modes, solved or taken over; *part and *pointer name what could not be. */
static enum status build_structure(struct model *m, const struct model *like, const char **part,
                                   const char **pointer)
{
    if (like != NULL) {
        m->section = like->section;
        m->section_summary = like->section_summary;
        m->centres = like->centres;
        m->thickness = like->thickness;
        m->beam = like->beam;
        m->modes = like->modes;
        m->borrows_structure = true;
        return ST_OK;
    }
    *part = "section";
    *pointer = "/beam/section";
    enum status st = build_section(m);
    if (st == ST_OK && m->def.kind != CASE_SECTION) {
        *part = "beam and its modes";
        *pointer = "/beam";
        st = build_beam(m);
    }
    return st;
}

enum status model_build_like(const struct case_def *def, const struct model *like,
                             struct model *out, struct failure *fail)
{
    struct model m = {.def = *def};
    if (def->kind == CASE_STATIC) {
        m.def.aero.dynamic = DYNAMIC_NONE; /* nothing moves */
    }
    const char *part = "", *pointer = "";
    enum status st = build_structure(&m, like, &part, &pointer);
    if (st == ST_OK && case_def_flows(def)) {
        part = "transfer between modes and stations";
        st = build_transfer(&m);
    }
    if (st == ST_OK && case_def_flows(def)) {
        part = "aerodynamic model";
        pointer = "/aerodynamics";
        st = model_build_aero(&m);
    }
    if (st == ST_OK && def->kind == CASE_SIMULATION) {
        part = "gust and motion of the root";
        st = excitation_build(&m);
    }
    if (st != ST_OK) {
        failure_set(fail, st, pointer, status_name(st), NULL, NULL, "the %s could not be built: %s",
                    part, status_text(st));
        model_done(&m);
        return st;
    }
    *out = m;
    return ST_OK;
}

enum status model_build(const struct case_def *def, struct model *out, struct failure *fail)
{
    return model_build_like(def, NULL, out, fail);
}

void model_done(struct model *m)
{
    if (!m->borrows_structure) {
        beam_done(&m->beam);
        modes_done(&m->modes);
    }
    polar_destroy(m->polar);
    network_destroy(m->network);
    network_memory_done(&m->network_memory);
    lifting_line_done(&m->lifting_line);
    attached_done(&m->attached);
    dynamic_stall_done(&m->stall);
    free(m->omega2);
    free(m->tip);
    free(m->to_vacuo);
    free(m->excitation.mid_chord);
    kuessner_done(&m->excitation.kuessner);
    *m = (struct model){0};
}
