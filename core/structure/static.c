#include "core/structure/static.h"

#include "core/la.h"
#include "core/num.h"
#include "core/structure/camber.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum status static_solve(const struct beam *b, const double *f, double *x)
{
    const size_t n = (size_t)b->n_dof;
    double *k = malloc(n * n * sizeof *k);
    if (k == NULL) {
        return ST_NO_MEMORY;
    }
    memcpy(k, b->k, n * n * sizeof *k);
    const enum status st = la_cholesky(b->n_dof, k);
    if (st == ST_OK) {
        memcpy(x, f, n * sizeof *x);
        la_cholesky_solve(b->n_dof, k, 1, x);
    }
    free(k);
    return st;
}

bool static_tsai_wu(const struct material *m, const struct ply_stress *s, double *index,
                    double *reserve)
{
    *index = *reserve = (double)NAN;
    if (!material_has_strength(m)) {
        return false;
    }
    const double f1 = 1.0 / m->x_tension - 1.0 / m->x_compression;
    const double f2 = 1.0 / m->y_tension - 1.0 / m->y_compression;
    const double f11 = 1.0 / (m->x_tension * m->x_compression);
    const double f22 = 1.0 / (m->y_tension * m->y_compression);
    const double f66 = 1.0 / num_sq(m->s_shear), f12 = -0.5 * sqrt(f11 * f22);
    const double linear = f1 * s->l + f2 * s->t;
    const double square =
        f11 * s->l * s->l + f22 * s->t * s->t + f66 * s->lt * s->lt + 2.0 * f12 * s->l * s->t;
    *index = linear + square;
    /* square R^2 + linear R = 1, positive root; no stress, no limit. */
    *reserve =
        square > 0.0 ? 2.0 / (linear + sqrt(linear * linear + 4.0 * square)) : (double)INFINITY;
    return true;
}

/* Wall strains of the section strains at a point. */
static void combine(const double *unit, const double *strain, double e[WALL_STRAINS])
{
    for (int r = 0; r < WALL_STRAINS; r++) {
        e[r] = 0.0;
        for (int k = 0; k < SECTION_WIDE_COUNT; k++) {
            e[r] += unit[r + WALL_STRAINS * k] * strain[k];
        }
    }
}

/* State of a ply at height n of the wall. */
static struct ply_state state_at(const struct ply *ply, const struct laminate_cross *cross,
                                 const double e[WALL_STRAINS], double n)
{
    const double strain[3] = {e[W_EPS] + n * e[W_KAPPA], cross->eps_ss + n * cross->kappa_ss,
                              e[W_GAMMA] + n * e[W_TWIST]};
    const double c = cos(ply->angle), s = sin(ply->angle);
    struct ply_state out = {
        .n = n,
        .stress = ply_stress_of(ply, strain),
        .strain_l = c * c * strain[0] + s * s * strain[1] + c * s * strain[2],
        .strain_t = s * s * strain[0] + c * c * strain[1] - c * s * strain[2],
        .strain_lt = 2.0 * c * s * (strain[1] - strain[0]) + (c * c - s * s) * strain[2],
    };
    (void)static_tsai_wu(&ply->material, &out.stress, &out.index, &out.reserve);
    return out;
}

/* How close to failure a state is: by its reserve, or, without strengths, by its strain energy. */
static double severity(const struct ply_state *s)
{
    return isnan(s->reserve)
               ? s->stress.l * s->strain_l + s->stress.t * s->strain_t + s->stress.lt * s->strain_lt
               : 1.0 / s->reserve;
}

/* What static_ply_states works on. */
struct search {
    const struct shape *shape;
    const struct contour *contour;
    const struct laminate *laminate;
    const struct warping *warping;
    const double *strain;
    double excess;           /* of the mean curvature across over that of a free wall [1/m] */
    int first[LIMIT_LAYUPS]; /* number of the first ply of each layup in out */
    double *worst;           /* severity kept so far, per state */
    struct ply_state *out;
};

static void search_point(const struct search *s, const struct contour_element *el, double xi)
{
    const struct contour_point p = contour_at(el, xi);
    const int layup = shape_wall_layup(s->shape, el->laminate);
    const struct layup *l = &s->shape->layup[layup];
    const struct laminate *lam = &s->laminate[el->laminate];
    double unit[WALL_STRAINS * SECTION_WIDE_COUNT], normal[SECTION_WIDE_COUNT], e[WALL_STRAINS];
    warping_wide_strains(s->warping, el, &p, unit, normal);
    combine(unit, s->strain, e);
    struct laminate_cross cross = laminate_cross_strain(lam, s->shape->chordwise, e);
    cross.kappa_ss += s->excess;
    cross.eps_ss -= s->contour->camber.axis * s->excess;
    double lower = lam->lower;
    for (int i = 0; i < l->n_ply; i++) {
        const int number = s->first[layup] + i;
        for (int face = 0; face < 2; face++) {
            struct ply_state state =
                state_at(&l->ply[i], &cross, e, lower + (face == 0 ? 0.0 : l->ply[i].thickness));
            const double how = severity(&state);
            if (how > s->worst[number]) {
                s->worst[number] = how;
                state.layup = layup;
                state.ply = i;
                state.wall = el->laminate;
                state.x = p.x;
                state.y = p.y;
                s->out[number] = state;
            }
        }
        lower += l->ply[i].thickness;
    }
}

static double excess_camber(const struct search *s)
{
    double natural[SECTION_WIDE_COUNT], sum = s->strain[S_CAMBER];
    if (!s->contour->camber.on) {
        return 0.0;
    }
    camber_natural(s->contour, s->laminate, s->warping, SECTION_WIDE_COUNT, natural);
    for (int k = 0; k < SECTION_WIDE_COUNT; k++) {
        sum -= natural[k] * s->strain[k];
    }
    return sum;
}

enum status static_ply_states(const struct shape *shape, enum shear_model shear,
                              const double strain[SECTION_WIDE_COUNT], struct ply_state *out,
                              int *n)
{
    static const double place[3] = {-1.0, 0.0, 1.0}; /* ends and middle of an element */
    struct contour contour = {0};
    struct warping classic = {0}, retained = {0};
    double worst[LIMIT_LAYUPS * LIMIT_PLIES];
    struct laminate *laminate = malloc(LIMIT_WALLS * sizeof *laminate);
    enum status st = laminate != NULL ? shape_build(shape, &contour, laminate) : ST_NO_MEMORY;
    if (st == ST_OK) {
        st = warping_solve(&contour, laminate, &classic, &retained);
    }
    if (st == ST_OK) {
        struct search s = {.shape = shape,
                           .contour = &contour,
                           .laminate = laminate,
                           .warping = shear == SHEAR_RETAINED ? &retained : &classic,
                           .strain = strain,
                           .worst = worst,
                           .out = out};
        s.excess = excess_camber(&s);
        int count = 0;
        for (int l = 0; l < shape->n_layup; l++) {
            s.first[l] = count;
            count += shape->layup[l].n_ply;
        }
        for (int i = 0; i < count; i++) {
            worst[i] = -HUGE_VAL;
        }
        for (int e = 0; e < contour.n_element; e++) {
            for (int q = 0; q < 3; q++) {
                search_point(&s, &contour.element[e], place[q]);
            }
        }
        *n = count;
    }
    warping_done(&classic);
    warping_done(&retained);
    contour_done(&contour);
    free(laminate);
    return st;
}
