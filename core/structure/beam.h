/* core/structure/beam.h
 * Finite elements of the thin-walled beam: stiffness and mass of the cantilever, any variation of
 * the section along the span, lumped masses.
 *
 * Seven freedoms a node, in this order: w, u, psi, v, -phi, theta, theta'. With condensed shear psi
 * is u' and -phi is v'. Cubic Hermite for u, v and theta. DEVIATION: w is linear plus two internal
 * modes condensed in the element; linear alone cannot follow the axial strain that bending of a
 * one-sided laminate asks for (N = 0) and locks. With retained shear each element also has linear
 * shear strains inside, condensed as well; with flexible walls besides the nodes have sigma, the
 * surplus of the warping (warping.h), interpolated like w, and those of a flat section whose
 * shape the clamp holds the amplitudes of camber.h. A struct beam owns its arrays; beam_done
 * accepts a zeroed struct. Immutable after beam_build. */
#ifndef AEROM_CORE_STRUCTURE_BEAM_H
#define AEROM_CORE_STRUCTURE_BEAM_H

#include "core/structure/section.h"

#include <stdbool.h>

enum beam_freedom {
    D_W,
    D_U,
    D_DU,
    D_V,
    D_DV,
    D_THETA,
    D_DTHETA,
    D_SURPLUS,
    D_LAG,
    D_TURN,
    D_CAMBER,
    BEAM_NODE_MOST
};
enum { BEAM_NODE_FREEDOMS = D_SURPLUS }; /* those of any beam */
/* Rigid motions: along x, y, z, about the axis (nose-up), and about x at the root, tip up. */
enum beam_rigid { RIGID_U, RIGID_V, RIGID_W, RIGID_TWIST, RIGID_FLAP, BEAM_RIGID };
enum { BEAM_GAUSS = 4 }; /* points of an element at which its section is asked for */

/* Are the transverse shears condensed (zero shear force strain energy) or kept (Timoshenko)? */
enum shear_model { SHEAR_CONDENSED, SHEAR_RETAINED };
/* The clamp holds w, u, psi, v, phi, theta; it may or may not hold the warping, theta', and with
 * it the shape of a flat section (camber.h). A free root holds nothing (rigid-body tests). */
enum root_warping { ROOT_WARPING_RESTRAINED, ROOT_WARPING_FREE, ROOT_FREE };

struct beam_mass {
    double z, x, y;    /* position of its centre [m] */
    double mass;       /* [kg] */
    double inertia[3]; /* about its own centre, axes x, y, z [kg m^2] */
};

struct beam_mesh {
    int n_element;
    double *z; /* nodes, ascending, root first (n_element + 1), owned */
};

/* n_uniform equal elements over the length plus nodes at the extra positions (jumps of the section,
 * lumped masses); positions closer than a millionth of the length to a node are not repeated. */
MUST_CHECK enum status beam_mesh_build(double length, int n_uniform, int n_extra,
                                       const double *extra, struct beam_mesh *out);
void beam_mesh_done(struct beam_mesh *m);
/* Spanwise position of Gauss point g of element e. */
double beam_mesh_gauss(const struct beam_mesh *m, int e, int g);

struct beam_spec {
    const struct beam_mesh *mesh;
    /* One section for the whole beam, or one for each Gauss point (BEAM_GAUSS x n_element). */
    const struct section *section;
    bool uniform;
    enum shear_model shear;
    enum root_warping root;
    int n_mass;
    const struct beam_mass *mass; /* each at a node of the mesh */
};

enum { BEAM_OUTER = 2 * BEAM_NODE_MOST, BEAM_INNER = 16 };

/* In k and m the internal freedoms of an element follow its nodes statically. Their own inertia
 * adds w^2 r x to them in a motion x of angular frequency w, r = K_ii^-1 (M_io + M_ii inner). */
struct inner_inertia {
    double stiffness[BEAM_OUTER * BEAM_OUTER]; /* r' K_ii r = r' (M_io + M_ii inner) */
    double mass[BEAM_OUTER * BEAM_OUTER];      /* r' M_ii r */
};

struct beam {
    double length; /* [m] */
    struct beam_mesh mesh;
    enum shear_model shear;
    enum root_warping root;
    int node_freedoms;           /* BEAM_NODE_FREEDOMS to BEAM_NODE_MOST */
    int slot[BEAM_NODE_MOST];    /* place of a freedom among those of a node, -1: there is none */
    int freedom[BEAM_NODE_MOST]; /* freedom at a place (node_freedoms) */
    int n_dof;                   /* free ones; a free root warping or root comes last */
    double *k;                   /* stiffness (n_dof x n_dof) */
    double *m;                   /* mass      (n_dof x n_dof) */
    double
        *inertia; /* inertial load of unit accelerations of the rigid beam (n_dof x BEAM_RIGID) */
    /* The same on the freedoms of the root node, clamped or not: what of the weight goes straight
     * into the clamp. */
    double root_inertia[BEAM_NODE_FREEDOMS * BEAM_RIGID];
    double *inner; /* internal modes of each element per unit of its node freedoms
                      (BEAM_INNER x BEAM_OUTER x n_element) */
    struct inner_inertia *inner_inertia; /* (n_element) with retained shear, else NULL */
};

MUST_CHECK enum status beam_build(const struct beam_spec *spec, struct beam *out);
void beam_done(struct beam *b);

/* Index of a node's freedom (node 0 is the root) in the freedom vector, -1 where it is clamped. */
int beam_index(const struct beam *b, int node, enum beam_freedom freedom);
/* Inertial load on unit motion a of unit acceleration b, the clamped root included: m, its static
 * moment, its moments of inertia. */
double beam_rigid_inertia(const struct beam *b, enum beam_rigid motion,
                          enum beam_rigid acceleration);
/* The kind of freedom at an index. */
enum beam_freedom beam_freedom_at(const struct beam *b, int index);

/* Products x' stiffness x and x' mass x of the inertia of all internal freedoms, zero with
 * condensed shear: what is left out there, that of w, is below 1e-6. */
void beam_inner_inertia(const struct beam *b, const double *x, double *stiffness, double *mass);

/* Motion of the section at z in [0, length] for a freedom vector x (n_dof). */
struct beam_motion {
    double u, v, w;         /* [m] */
    double psi, phi, theta; /* rotations about y, x, z [rad]; phi = -v' without shear */
    double theta_rate;      /* theta'; with flexible walls the amplitude of the warping [rad/m] */
};
struct beam_motion beam_motion_at(const struct beam *b, const double *x, double z);

/* Strains of the section at z (order of enum section_strain, then that of warping.h); the shears
 * are zero when condensed. The strain S_THETA is chi, the twist rate less S_ETA. */
void beam_strain_at(const struct beam *b, const double *x, double z,
                    double strain[SECTION_WIDE_COUNT]);

/* A force along x, y, z [N] and a moment about x, y, z [N m], or both per length. */
struct beam_load {
    double force[3];
    double moment[3];
};
/* Adds the consistent load of a point load at z to f (n_dof). */
void beam_add_point_load(const struct beam *b, double z, const struct beam_load *load, double *f);
/* Adds the consistent load of a load per length, constant from z0 to z1. */
void beam_add_line_load(const struct beam *b, double z0, double z1, const struct beam_load *load,
                        double *f);

#endif
