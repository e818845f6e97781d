#include "core/structure/warping.h"

#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_STRAIN_COUNT };

const double contour_gauss_point[CONTOUR_GAUSS] = {-0.774596669241483377, 0.0,
                                                   0.774596669241483377};
const double contour_gauss_weight[CONTOUR_GAUSS] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

static double at_nodes(const struct contour_element *el, const double value[3],
                       const double *column)
{
    return value[0] * column[el->node[0]] + value[1] * column[el->node[1]] +
           value[2] * column[el->node[2]];
}

double warping_at(const struct warping *w, const struct contour_element *el,
                  const struct contour_point *p, int k)
{
    return at_nodes(el, p->shape, w->g + num_at(0, k, w->n_value));
}

/* Turns of the normals per unit of strain k, NULL with rigid walls. */
static const double *turn_of(const struct warping *w, int k)
{
    return w->n_value > w->n_node ? w->g + num_at(w->n_node, k, w->n_value) : NULL;
}

double warping_across(const struct warping *w, const struct contour_element *el,
                      const struct contour_point *p)
{
    /* The normal turns with the wall: r_t theta' less the shear gamma_nz of Eq. (A.7). */
    const double *turn = turn_of(w, WARPING_VLASOV);
    return p->r_t - w->twist_shear[0] * p->dy + w->twist_shear[1] * p->dx +
           (turn != NULL ? at_nodes(el, p->shape, turn) : 0.0);
}

double warping_bare_normal_shear(const struct contour_point *p, int k)
{
    return k == S_GXZ ? p->dy : (k == S_GYZ ? -p->dx : 0.0);
}

double warping_normal_shear(const struct warping *w, const struct contour_element *el,
                            const struct contour_point *p, int k)
{
    const double *turn = turn_of(w, k);
    return turn != NULL ? warping_bare_normal_shear(p, k) + at_nodes(el, p->shape, turn) : 0.0;
}

double warping_flow(const double *reduced, int row, const double e[WALL_STRAINS])
{
    double sum = 0.0;
    for (int j = 0; j < WALL_STRAINS; j++) {
        sum += reduced[row + WALL_STRAINS * j] * e[j];
    }
    return sum;
}

void warping_bare_strain(const struct contour_point *p, int k, double stretched, double across,
                         double e[WALL_STRAINS])
{
    memset(e, 0, WALL_STRAINS * sizeof *e);
    switch ((enum section_strain)k) {
    case S_W:
        e[W_EPS] = 1.0;
        break;
    case S_PSI:
        e[W_EPS] = -p->x;
        e[W_KAPPA] = -p->dy;
        break;
    case S_PHI:
        e[W_EPS] = p->y;
        e[W_KAPPA] = -p->dx;
        break;
    case S_THETA:
        e[W_GAMMA] = p->r_n;
        e[W_TWIST] = 2.0;
        break;
    case S_THETA2:
        e[W_EPS] = stretched;
        e[W_KAPPA] = across;
        break;
    case S_GXZ:
        e[W_GAMMA] = p->dx;
        break;
    case S_GYZ:
        e[W_GAMMA] = p->dy;
        break;
    case SECTION_STRAIN_COUNT:
        assert(false);
    }
}

void warping_strains(const struct warping *w, const struct contour_element *el,
                     const struct contour_point *p, double *e)
{
    const double stretched = warping_at(w, el, p, WARPING_VLASOV),
                 across = warping_across(w, el, p);
    for (int k = 0; k < N; k++) {
        const double *turn = turn_of(w, k);
        warping_bare_strain(p, k, stretched, across, e + WALL_STRAINS * (ptrdiff_t)k);
        e[W_GAMMA + WALL_STRAINS * k] += at_nodes(el, p->slope, w->g + num_at(0, k, w->n_value));
        e[W_TWIST + WALL_STRAINS * k] += turn != NULL ? at_nodes(el, p->slope, turn) : 0.0;
    }
}

void warping_stiffness(const struct contour *c, const struct laminate *laminate,
                       const struct warping *w, int n_strain, double *out)
{
    for (int a = 0; a < n_strain; a++) {
        for (int b = 0; b < n_strain; b++) {
            out[num_at(a, b, n_strain)] = w->wall_shear[num_at(a, b, N)];
        }
    }
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const struct laminate *l = &laminate[el->laminate];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight = contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian;
        double e[WALL_STRAINS * N], stress[WALL_STRAINS * N], normal[N];
        warping_strains(w, el, &p, e);
        for (int k = 0; k < n_strain; k++) {
            normal[k] = warping_normal_shear(w, el, &p, k);
            for (int r = 0; r < WALL_STRAINS; r++) {
                stress[num_at(r, k, WALL_STRAINS)] =
                    warping_flow(l->reduced, r, e + num_at(0, k, WALL_STRAINS));
            }
        }
        for (int b = 0; b < n_strain; b++) {
            for (int a = 0; a <= b; a++) {
                double sum = l->shear_zn * normal[a] * normal[b];
                for (int r = 0; r < WALL_STRAINS; r++) {
                    sum += e[num_at(r, a, WALL_STRAINS)] * stress[num_at(r, b, WALL_STRAINS)];
                }
                out[num_at(a, b, n_strain)] += weight * sum;
            }
        }
    }
    for (int b = 0; b < n_strain; b++) {
        for (int a = 0; a < b; a++) {
            out[num_at(b, a, n_strain)] = out[num_at(a, b, n_strain)];
        }
    }
}

void warping_done(struct warping *w)
{
    free(w->g);
    *w = (struct warping){0};
}
