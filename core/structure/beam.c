#include "core/structure/beam.h"

#include "core/num.h"
#include "core/structure/beam_element.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum {
    NODE = BEAM_NODE_MOST,
    OUTER = BEAM_OUTER,
    STRAIN = SECTION_WIDE_COUNT,
    MOTION = SECTION_WIDE_MOTION
};

int beam_index(const struct beam *b, int node, enum beam_freedom freedom)
{
    const int slot = b->slot[freedom];
    if (slot < 0) {
        return -1;
    }
    if (node > 0) {
        return b->node_freedoms * (node - 1) + slot;
    }
    const int last = b->node_freedoms * b->mesh.n_element;
    switch (b->root) {
    case ROOT_WARPING_RESTRAINED:
        return -1;
    case ROOT_WARPING_FREE: /* theta' and what follows it */
        return slot >= D_DTHETA ? last + slot - D_DTHETA : -1;
    case ROOT_FREE:
        return last + slot;
    }
    assert(false);
    return -1;
}

enum beam_freedom beam_freedom_at(const struct beam *b, int index)
{
    const int last = b->node_freedoms * b->mesh.n_element;
    const bool warping = b->root == ROOT_WARPING_FREE && index >= last;
    const int slot = warping ? D_DTHETA + index - last : index % b->node_freedoms;
    return (enum beam_freedom)b->freedom[slot];
}

/* Index of local freedom i of element e. */
static int element_index(const struct beam *b, int e, int i)
{
    return beam_index(b, e + i / NODE, (enum beam_freedom)(i % NODE));
}

/* Adds a local matrix of n freedoms from node `node` on. */
static void scatter(const struct beam *b, int node, int n, const double *local, double *global)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            const int row = element_index(b, node, i), column = element_index(b, node, j);
            if (row >= 0 && column >= 0) {
                global[num_at(row, column, b->n_dof)] += local[num_at(i, j, n)];
            }
        }
    }
}

/* Value of a node's freedom in a unit rigid motion. */
static double rigid_at(const struct beam *b, int node, enum beam_freedom freedom,
                       enum beam_rigid motion)
{
    static const enum beam_freedom direction[BEAM_RIGID] = {D_U, D_V, D_W, D_THETA, D_DV};
    if (motion == RIGID_FLAP && freedom == D_V) {
        return b->mesh.z[node];
    }
    return freedom == direction[motion] ? 1.0 : 0.0;
}

/* Adds m r for unit accelerations of the rigid beam. */
static void scatter_inertia(struct beam *b, int node, int n, const double *m)
{
    for (int i = 0; i < n; i++) {
        const int row = element_index(b, node, i);
        const bool at_root = node == 0 && i < NODE;
        for (int d = 0; d < BEAM_RIGID; d++) {
            double sum = 0.0;
            for (int j = 0; j < n; j++) {
                sum +=
                    m[num_at(i, j, n)] *
                    rigid_at(b, node + j / NODE, (enum beam_freedom)(j % NODE), (enum beam_rigid)d);
            }
            if (row >= 0) {
                b->inertia[num_at(row, d, b->n_dof)] += sum;
            }
            if (at_root && i < BEAM_NODE_FREEDOMS) {
                b->root_inertia[num_at(i, d, BEAM_NODE_FREEDOMS)] += sum;
            }
        }
    }
}

double beam_rigid_inertia(const struct beam *b, enum beam_rigid motion,
                          enum beam_rigid acceleration)
{
    double sum = 0.0;
    for (int node = 0; node <= b->mesh.n_element; node++) {
        for (int k = 0; k < BEAM_NODE_FREEDOMS; k++) {
            const int row = beam_index(b, node, (enum beam_freedom)k);
            const int a = (int)acceleration;
            const double load = node == 0 ? b->root_inertia[num_at(k, a, BEAM_NODE_FREEDOMS)]
                                          : b->inertia[num_at(row, a, b->n_dof)];
            sum += load * rigid_at(b, node, (enum beam_freedom)k, motion);
        }
    }
    return sum;
}

/* Mass matrix of a lumped mass on its node: velocities of its centre are u - y theta, v + x theta,
 * w - x psi + y phi. */
static void mass_matrix(const struct beam_mass *a, double m[NODE * NODE])
{
    const double row[6][NODE] = {{[D_U] = 1.0, [D_THETA] = -a->y},
                                 {[D_V] = 1.0, [D_THETA] = a->x},
                                 {[D_W] = 1.0, [D_DU] = -a->x, [D_DV] = -a->y},
                                 {[D_DV] = -1.0},
                                 {[D_DU] = 1.0},
                                 {[D_THETA] = 1.0}};
    const double weight[6] = {a->mass,       a->mass,       a->mass,
                              a->inertia[0], a->inertia[1], a->inertia[2]};
    for (int i = 0; i < NODE; i++) {
        for (int j = 0; j < NODE; j++) {
            double sum = 0.0;
            for (int r = 0; r < 6; r++) {
                sum += weight[r] * row[r][i] * row[r][j];
            }
            m[num_at(i, j, NODE)] = sum;
        }
    }
}

static int nearest_node(const struct beam_mesh *mesh, double z)
{
    int best = 0;
    for (int i = 1; i <= mesh->n_element; i++) {
        best = fabs(mesh->z[i] - z) < fabs(mesh->z[best] - z) ? i : best;
    }
    return best;
}

static enum status assemble(const struct beam_spec *spec, struct beam *b)
{
    for (int e = 0; e < b->mesh.n_element; e++) {
        const struct section *section[BEAM_GAUSS];
        for (int g = 0; g < BEAM_GAUSS; g++) {
            section[g] = spec->uniform ? spec->section : spec->section + BEAM_GAUSS * e + g;
        }
        struct element el;
        const enum status st =
            element_build(section, b->mesh.z[e + 1] - b->mesh.z[e], spec->shear, &el);
        if (st != ST_OK) {
            return st;
        }
        scatter(b, e, OUTER, el.k, b->k);
        scatter(b, e, OUTER, el.m, b->m);
        scatter_inertia(b, e, OUTER, el.m);
        memcpy(b->inner + num_at(0, e, BEAM_INNER * OUTER), el.inner, sizeof el.inner);
        if (b->inner_inertia != NULL) {
            b->inner_inertia[e] = el.inertia;
        }
    }
    for (int i = 0; i < spec->n_mass; i++) {
        double m[NODE * NODE];
        const int node = nearest_node(&b->mesh, spec->mass[i].z);
        mass_matrix(&spec->mass[i], m);
        scatter(b, node, NODE, m, b->m);
        scatter_inertia(b, node, NODE, m);
    }
    return ST_OK;
}

/* The freedoms of a node: those of any beam, and what its sections have beyond. */
static void choose_freedoms(const struct beam_spec *spec, struct beam *b)
{
    for (int f = 0; f < BEAM_NODE_MOST; f++) {
        const bool has = element_has(spec->section, spec->shear, (enum beam_freedom)f);
        b->slot[f] = has ? b->node_freedoms : -1;
        if (has) {
            b->freedom[b->node_freedoms++] = f;
        }
    }
}

enum status beam_build(const struct beam_spec *spec, struct beam *out)
{
    const struct beam_mesh *mesh = spec->mesh;
    const int n_element = mesh->n_element;
    struct beam b = {.length = mesh->z[n_element], .shear = spec->shear, .root = spec->root};
    choose_freedoms(spec, &b);
    const int root_freedoms[] = {[ROOT_WARPING_RESTRAINED] = 0,
                                 [ROOT_WARPING_FREE] = b.node_freedoms - D_DTHETA,
                                 [ROOT_FREE] = b.node_freedoms};
    const int n = b.n_dof = b.node_freedoms * n_element + root_freedoms[spec->root];
    const size_t size = (size_t)n * (size_t)n, nodes = (size_t)n_element + 1;
    b.k = calloc(2 * size + BEAM_RIGID * (size_t)n, sizeof *b.k);
    b.inner = malloc((size_t)(BEAM_INNER * OUTER) * (size_t)n_element * sizeof *b.inner);
    if (spec->shear == SHEAR_RETAINED) {
        b.inner_inertia = malloc((size_t)n_element * sizeof *b.inner_inertia);
    }
    b.mesh = (struct beam_mesh){.n_element = n_element, .z = malloc(nodes * sizeof *b.mesh.z)};
    if (b.k == NULL || b.inner == NULL || b.mesh.z == NULL ||
        (spec->shear == SHEAR_RETAINED && b.inner_inertia == NULL)) {
        beam_done(&b);
        return ST_NO_MEMORY;
    }
    b.m = b.k + size;
    b.inertia = b.m + size;
    memcpy(b.mesh.z, mesh->z, nodes * sizeof *b.mesh.z);
    const enum status st = assemble(spec, &b);
    if (st != ST_OK) {
        beam_done(&b);
        return st;
    }
    *out = b;
    return ST_OK;
}

void beam_done(struct beam *b)
{
    free(b->k);
    free(b->inner);
    free(b->inner_inertia);
    beam_mesh_done(&b->mesh);
    *b = (struct beam){0};
}

void beam_inner_inertia(const struct beam *b, const double *x, double *stiffness, double *mass)
{
    *stiffness = *mass = 0.0;
    for (int e = 0; b->inner_inertia != NULL && e < b->mesh.n_element; e++) {
        const struct inner_inertia *a = &b->inner_inertia[e];
        double local[OUTER];
        for (int i = 0; i < OUTER; i++) {
            const int index = element_index(b, e, i);
            local[i] = index >= 0 ? x[index] : 0.0;
        }
        for (int k = 0; k < OUTER * OUTER; k++) {
            const double both = local[k % OUTER] * local[k / OUTER];
            *stiffness += both * a->stiffness[k];
            *mass += both * a->mass[k];
        }
    }
}

/* Element that holds z, its place in it, and the rows there. */
static int rows_at(const struct beam *b, double z, struct element_rows *rows)
{
    int e = 0;
    while (e + 1 < b->mesh.n_element && z >= b->mesh.z[e + 1]) {
        e++;
    }
    const double h = b->mesh.z[e + 1] - b->mesh.z[e];
    element_rows((z - b->mesh.z[e]) / h, h, rows);
    return e;
}

/* All freedoms of element e: nodes, then inner. */
static void gather(const struct beam *b, const double *x, int e, double all[ELEMENT_ALL])
{
    const double *t = b->inner + num_at(0, e, BEAM_INNER * OUTER);
    for (int i = 0; i < OUTER; i++) {
        const int index = element_index(b, e, i);
        all[i] = index >= 0 ? x[index] : 0.0;
    }
    for (int p = 0; p < BEAM_INNER; p++) {
        double sum = 0.0;
        for (int i = 0; i < OUTER; i++) {
            sum += t[num_at(p, i, BEAM_INNER)] * all[i];
        }
        all[OUTER + p] = sum;
    }
}

static double row_times(const double *rows, int n_row, int row, const double all[ELEMENT_ALL])
{
    double sum = 0.0;
    for (int i = 0; i < ELEMENT_ALL; i++) {
        sum += rows[row + n_row * i] * all[i];
    }
    return sum;
}

struct beam_motion beam_motion_at(const struct beam *b, const double *x, double z)
{
    struct element_rows rows;
    double all[ELEMENT_ALL], value[MOTION];
    const int e = rows_at(b, z, &rows);
    gather(b, x, e, all);
    for (int r = 0; r < MOTION; r++) {
        value[r] = row_times(rows.motion, MOTION, r, all);
    }
    return (struct beam_motion){.u = value[M_U],
                                .v = value[M_V],
                                .w = value[M_W],
                                .psi = value[M_DU],
                                .phi = -value[M_DV],
                                .theta = value[M_THETA],
                                .theta_rate = value[M_DTHETA]};
}

void beam_strain_at(const struct beam *b, const double *x, double z,
                    double strain[SECTION_WIDE_COUNT])
{
    struct element_rows rows;
    double all[ELEMENT_ALL];
    const int e = rows_at(b, z, &rows);
    gather(b, x, e, all);
    for (int r = 0; r < STRAIN; r++) {
        strain[r] = row_times(rows.strain, STRAIN, r, all);
    }
}

/* Adds weight * rows' load to f, the internal freedoms' share passed on to the nodes. */
static void add_load(const struct beam *b, int e, const struct element_rows *rows, double weight,
                     const struct beam_load *load, double *f)
{
    const double work[MOTION] = {
        [M_U] = load->force[0],    [M_V] = load->force[1],   [M_W] = load->force[2],
        [M_DV] = -load->moment[0], [M_DU] = load->moment[1], [M_THETA] = load->moment[2]};
    const double *t = b->inner + num_at(0, e, BEAM_INNER * OUTER);
    double local[ELEMENT_ALL] = {0};
    for (int i = 0; i < ELEMENT_ALL; i++) {
        for (int r = 0; r < MOTION; r++) {
            local[i] += weight * rows->motion[r + MOTION * i] * work[r];
        }
    }
    for (int i = 0; i < OUTER; i++) {
        const int index = element_index(b, e, i);
        for (int p = 0; p < BEAM_INNER && index >= 0; p++) {
            local[i] += t[num_at(p, i, BEAM_INNER)] * local[OUTER + p];
        }
        if (index >= 0) {
            f[index] += local[i];
        }
    }
}

void beam_add_point_load(const struct beam *b, double z, const struct beam_load *load, double *f)
{
    struct element_rows rows;
    const int e = rows_at(b, z, &rows);
    add_load(b, e, &rows, 1.0, load, f);
}

void beam_add_line_load(const struct beam *b, double z0, double z1, const struct beam_load *load,
                        double *f)
{
    static const double point[2] = {-0.577350269189625765, 0.577350269189625765}; /* cubics */
    for (int e = 0; e < b->mesh.n_element; e++) {
        const double start = b->mesh.z[e], h = b->mesh.z[e + 1] - start;
        const double from = fmax(z0, start), to = fmin(z1, start + h);
        for (int q = 0; q < 2 && to > from; q++) {
            struct element_rows rows;
            const double z = from + 0.5 * (1.0 + point[q]) * (to - from);
            element_rows((z - start) / h, h, &rows);
            add_load(b, e, &rows, 0.5 * (to - from), load, f);
        }
    }
}
