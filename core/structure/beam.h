/* core/structure/beam.h
 * Finite elements of the thin-walled beam: stiffness and mass of the clamped cantilever.
 *
 * Seven freedoms a node, in this order: w, u, u', v, v', theta, theta'. Cubic Hermite for u, v and
 * theta. DEVIATION: w is linear plus two internal modes condensed in the element; linear alone
 * cannot follow the axial strain that bending of a one-sided laminate asks for (N = 0) and locks.
 * The struct owns its arrays; beam_done accepts a zeroed struct. Immutable after beam_build. */
#ifndef AEROM_CORE_STRUCTURE_BEAM_H
#define AEROM_CORE_STRUCTURE_BEAM_H

#include "core/structure/section.h"

enum beam_freedom { D_W, D_U, D_DU, D_V, D_DV, D_THETA, D_DTHETA, BEAM_NODE_FREEDOMS };

/* The clamp holds w, u, u', v, v', theta; it may or may not hold the warping, theta'. */
enum root_warping { ROOT_WARPING_RESTRAINED, ROOT_WARPING_FREE };

struct beam {
    double length; /* [m] */
    int n_element; /* equal lengths, root first */
    int n_dof;     /* free ones: BEAM_NODE_FREEDOMS x n_element; a free root warping comes last */
    enum root_warping root_warping;
    double *k; /* stiffness (n_dof x n_dof) */
    double *m; /* mass      (n_dof x n_dof) */
};

MUST_CHECK enum status beam_build(const struct section *section, double length, int n_element,
                                  enum root_warping root_warping, struct beam *out);
void beam_done(struct beam *b);

/* Index of a node's freedom (node 0 is the root) in the freedom vector, -1 where it is clamped. */
int beam_index(const struct beam *b, int node, enum beam_freedom freedom);
/* The kind of freedom at an index. */
enum beam_freedom beam_freedom_at(const struct beam *b, int index);

/* Displacements (u, v, theta) at spanwise position z in [0, length] of a freedom vector x (n_dof).
 */
struct beam_motion {
    double u, v, theta;
};
struct beam_motion beam_motion_at(const struct beam *b, const double *x, double z);

/* Consistent load vector f (n_dof), added to, of a load uniform over element e: force per length
 * along x and y [N/m] and moment per length about z [N]. */
void beam_add_uniform_load(const struct beam *b, int e, double fx, double fy, double moment,
                           double *f);

#endif
