/* core/aero/downwash.h
 * Downwash of horseshoe vortices with a constant circulation over each of n equal elements,
 * trailing from the element borders, and of their images in the walls.
 *
 * Plain values and borrowed arrays; stateless. */
#ifndef AEROM_CORE_AERO_DOWNWASH_H
#define AEROM_CORE_AERO_DOWNWASH_H

/* Which walls act as mirrors: none (a free wing tip at the root), the clamped root, or the root and
 * the far side wall of a channel. */
enum wall_images { WALLS_NONE, WALLS_ROOT, WALLS_ROOT_AND_FAR };

/* Where the vortex of a free tip trails: inside the tip by downwash_inset, or at the border. */
enum tip_correction { TIP_INSET, TIP_NONE };

struct wing {
    int n;               /* elements */
    double length;       /* [m] */
    const double *chord; /* of each element [m] (n) */
    enum wall_images walls;
    double width; /* distance of the far wall from the root [m], > length; WALLS_ROOT_AND_FAR */
    enum tip_correction tip;
};

/* Distance from a free tip at which its vortex must trail, in elements, for a wall `gap` elements
 * beyond the tip (INFINITY without one): sqrt(g (g + 1/4)) - g, which is 1/8 far from walls.
 *
 * Next to the tip the borders j and the mid-points i + 1/2 make a Cauchy system whose solution is
 * known: with the vortices at 0, 1, 2, ... its circulation is that of a wing whose tip stands a
 * quarter of an element too far out. Moving the first vortex by d moves that edge by 2 d; with a
 * wall at -g the same holds in (y + g)^2. */
double downwash_inset(double gap);

/* b (rows x n, column-major): induced angle w_i/V [rad] at the middle of element i per unit c_l of
 * element j, Gamma = V c c_l / 2. Rows beyond n are not touched. */
void downwash_matrix(const struct wing *wing, int rows, double *b);

#endif
