#include "core/analysis/stability.h"

#include "core/analysis/branches.h"
#include "core/analysis/equilibrium.h"
#include "core/analysis/linear.h"
#include "core/coupling/apparent_mass.h"
#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { REFINEMENTS = 64, SUBSTEPS = 64 };
/* Damping ratios within this of zero are neither: a chordwise mode that no load of the model damps
 * would else flutter by rounding. */
static const double neutral = 1e-6;

/* One speed: what decides there. */
struct point {
    double speed;
    double growth;         /* largest -damping ratio of an oscillation, less `neutral` */
    int root;              /* its eigenvalue, -1 without */
    double divergence;     /* det(static stiffness)/det(Omega^2): negative beyond divergence */
    double q[LIMIT_MODES]; /* the equilibrium */
};

struct sweep {
    struct model at; /* the model with the speed of the moment; borrows everything */
    const struct sim_control *control;
    struct workspace w;
    struct linear linear;
    struct spectrum spectrum;
    double *scratch; /* static stiffness (n_mode x n_mode) */
    int pivot[LIMIT_MODES];
    struct branches branches;
    struct stability_result *out;
};

static enum status sweep_init(const struct model *m, const struct sim_control *control,
                              struct sweep *s)
{
    *s = (struct sweep){.at = *m, .control = control};
    enum status st = workspace_init(m, &s->w);
    if (st == ST_OK) {
        st = linear_init(m, &s->linear);
    }
    if (st != ST_OK) {
        return st;
    }
    const size_t n = (size_t)s->linear.n_state, nm = (size_t)m->n_mode;
    s->spectrum.n = s->linear.n_state;
    s->spectrum.re = malloc((2 * n + n * n + nm * nm) * sizeof *s->spectrum.re);
    if (s->spectrum.re == NULL) {
        return ST_NO_MEMORY;
    }
    s->spectrum.im = s->spectrum.re + n;
    s->spectrum.vector = s->spectrum.im + n;
    s->scratch = s->spectrum.vector + n * n;
    double omega[LIMIT_MODES];
    for (int j = 0; j < m->n_mode; j++) {
        omega[j] = sqrt(m->omega2[j]);
    }
    branches_start(m->n_mode, omega, &s->branches);
    return ST_OK;
}

static void sweep_done(struct sweep *s)
{
    workspace_done(&s->w);
    linear_done(&s->linear);
    free(s->spectrum.re);
}

/* The least damped oscillation of the spectrum. */
static void find_growth(const struct spectrum *s, struct point *p)
{
    p->growth = -1.0;
    p->root = -1;
    for (int j = 0; j < s->n; j++) {
        const double ratio = s->re[j] / hypot(s->re[j], s->im[j]) - neutral;
        if (s->im[j] > 0.0 && ratio > p->growth) {
            p->growth = ratio;
            p->root = j;
        }
    }
}

/* Equilibrium, linearisation and spectrum at a speed; the search starts from the equilibrium of
 * `near`, or from the undeformed beam without it. ST_NOT_CONVERGED when none is found. */
static enum status solve_at(struct sweep *s, double speed, const struct point *near,
                            struct point *p)
{
    const int n = s->at.n_mode;
    const size_t bytes = (size_t)n * sizeof *s->w.q;
    if (sim_control_cancelled(s->control)) {
        return ST_CANCELLED;
    }
    s->at.def.flow.speed = speed;
    s->at.dynamic_pressure = 0.5 * s->at.def.flow.density * num_sq(speed);
    if (near != NULL) {
        memcpy(s->w.q, near->q, bytes);
    }
    double residual = 0.0;
    enum status st = equilibrium_solve(&s->at, &s->w, &residual);
    if (st == ST_OK) {
        st = linear_fill(&s->at, &s->w, &s->linear);
    }
    if (st != ST_OK) {
        return st == ST_SINGULAR ? ST_NOT_CONVERGED : st;
    }
    *p = (struct point){.speed = speed};
    memcpy(p->q, s->w.q, bytes);
    memcpy(s->scratch, s->linear.static_stiffness, (size_t)n * (size_t)n * sizeof *s->scratch);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) {
            s->scratch[num_at(j, k, n)] /= s->at.omega2[j];
        }
    }
    p->divergence = la_determinant(n, s->scratch, s->pivot);
    st = la_eigen(s->spectrum.n, s->linear.a, s->spectrum.re, s->spectrum.im, s->spectrum.vector);
    s->out->solves++;
    if (st == ST_OK) {
        find_growth(&s->spectrum, p);
    }
    return st;
}

static double growth_of(const struct point *p)
{
    return p->growth;
}

static double instability_of(const struct point *p)
{
    return -p->divergence;
}

/* Speed between a (measure <= 0) and b (measure > 0) at which the measure changes its sign: false
 * position where it helps (Illinois), bisection where it does not. Leaves spectrum and equilibrium
 * at the upper end of the last bracket, *b. */
static enum status refine(struct sweep *s, double (*measure)(const struct point *), struct point *a,
                          struct point *b)
{
    const double tolerance = s->at.def.stability.tolerance;
    double fa = measure(a), fb = measure(b);
    int side = 0;
    for (int i = 0; i < REFINEMENTS && b->speed - a->speed > tolerance * b->speed; i++) {
        const double width = b->speed - a->speed;
        double guess = a->speed - fa * width / (fb - fa);
        /* Not closer to an end than a hundredth, and every third time the middle. */
        guess = num_clamp(guess, a->speed + fmin(0.01 * width, 0.4 * tolerance * b->speed),
                          b->speed - fmin(0.01 * width, 0.4 * tolerance * b->speed));
        struct point p;
        const enum status st = solve_at(s, i % 3 == 2 ? 0.5 * (a->speed + b->speed) : guess, a, &p);
        if (st != ST_OK) {
            return st;
        }
        const double f = measure(&p);
        if (f > 0.0) {
            *b = p;
            fb = f;
            fa *= side == 1 ? 0.5 : 1.0;
            side = 1;
        } else {
            *a = p;
            fa = f;
            fb *= side == -1 ? 0.5 : 1.0;
            side = -1;
        }
    }
    const struct point end = *b;
    return solve_at(s, end.speed, &end, b);
}

/* Shares of the natural modes in the energy of an eigenvector: of omega q, amplitudes in vacuo. */
static void find_shares(const struct model *m, const double complex *vacuo, struct flutter_point *f)
{
    double total = 0.0;
    int above = 0;
    for (int j = 0; j < m->n_mode; j++) {
        const double size = m->modes.omega[j] * cabs(vacuo[j]);
        f->share[j] = num_sq(size);
        total += f->share[j];
    }
    for (int j = 0; j < m->n_mode && total > 0.0; j++) {
        f->share[j] /= total;
        above += f->share[j] >= 0.1;
    }
    f->coupled = above > 1;
}

/* Amplitudes along the span of complex modal amplitudes in vacuo. */
static void find_shape(const struct model *m, const double complex *vacuo,
                       struct flutter_shape *shape)
{
    double largest = 0.0;
    const double chord = m->chord[0];
    for (int i = 0; i < STABILITY_SAMPLES; i++) {
        double complex plunge = 0.0, twist = 0.0;
        for (int j = 0; j < m->n_mode; j++) {
            const double *x = m->modes.shape + (size_t)j * (size_t)m->modes.n_dof;
            const double z = m->beam.length * i / (STABILITY_SAMPLES - 1);
            const struct beam_motion at = model_motion_at(m, x, z);
            plunge += vacuo[j] * at.v / chord;
            twist += vacuo[j] * at.theta;
        }
        shape->plunge_re[i] = creal(plunge);
        shape->plunge_im[i] = cimag(plunge);
        shape->twist_re[i] = creal(twist);
        shape->twist_im[i] = cimag(twist);
        largest = fmax(largest, fmax(cabs(plunge), cabs(twist)));
    }
    for (int i = 0; i < STABILITY_SAMPLES && largest > 0.0; i++) {
        shape->plunge_re[i] /= largest;
        shape->plunge_im[i] /= largest;
        shape->twist_re[i] /= largest;
        shape->twist_im[i] /= largest;
    }
}

/* Describes the oscillation p->root of the present spectrum. */
static void describe_flutter(const struct sweep *s, const struct point *p, enum onset onset,
                             struct flutter_point *f)
{
    const struct model *m = &s->at;
    const double re = s->spectrum.re[p->root], im = s->spectrum.im[p->root];
    double q_re[LIMIT_MODES], q_im[LIMIT_MODES], v_re[LIMIT_MODES], v_im[LIMIT_MODES];
    double complex vacuo[LIMIT_MODES];
    *f = (struct flutter_point){.onset = onset,
                                .speed = p->speed,
                                .frequency = im / (2.0 * NUM_PI),
                                .reduced_frequency = im * m->chord[0] / (2.0 * p->speed),
                                .damping = -re / hypot(re, im),
                                .stalled = s->w.any_stalled};
    for (int j = 0; j < m->n_mode; j++) {
        q_re[j] = creal(spectrum_entry(&s->spectrum, j, p->root));
        q_im[j] = cimag(spectrum_entry(&s->spectrum, j, p->root));
        f->mode = branches_likeness(&s->branches, j, &s->spectrum, p->root) >
                          branches_likeness(&s->branches, f->mode, &s->spectrum, p->root)
                      ? j
                      : f->mode;
    }
    apparent_mass_to_vacuo(m, q_re, v_re);
    apparent_mass_to_vacuo(m, q_im, v_im);
    for (int j = 0; j < m->n_mode; j++) {
        vacuo[j] = NUM_COMPLEX(v_re[j], v_im[j]);
    }
    find_shares(m, vacuo, f);
    if (m->modes.shape != NULL) {
        find_shape(m, vacuo, &f->shape);
    }
}

/* Looks for the first crossings between two neighbouring speeds. Equilibrium and spectrum are those
 * of b again afterwards. */
static enum status find_crossings(struct sweep *s, const struct point *a, const struct point *b)
{
    struct stability_result *r = s->out;
    enum status st = ST_OK;
    bool moved = false;
    if (r->flutter.onset == ONSET_NONE && a->growth <= 0.0 && b->growth > 0.0) {
        struct point low = *a, high = *b;
        st = refine(s, growth_of, &low, &high);
        moved = true;
        if (st == ST_OK) {
            describe_flutter(s, &high, ONSET_CROSSING, &r->flutter);
        }
    }
    if (st == ST_OK && r->divergence.onset == ONSET_NONE && a->divergence > 0.0 &&
        b->divergence <= 0.0) {
        struct point low = *a, high = *b;
        st = refine(s, instability_of, &low, &high);
        moved = true;
        r->divergence = (struct divergence_point){.onset = ONSET_CROSSING, .speed = high.speed};
    }
    if (st == ST_OK && moved) {
        struct point again;
        st = solve_at(s, b->speed, b, &again);
    }
    return st;
}

/* The equilibrium is there at a, not at `gone`: the speed at which it ends. */
static enum status find_limit_point(struct sweep *s, struct point *a, double gone)
{
    const double tolerance = s->at.def.stability.tolerance;
    while (gone - a->speed > tolerance * gone) {
        const double middle = 0.5 * (a->speed + gone);
        struct point p;
        enum status st = solve_at(s, middle, a, &p);
        if (st == ST_OK) {
            st = find_crossings(s, a, &p);
        }
        if (st == ST_OK) {
            *a = p;
        } else if (st == ST_NOT_CONVERGED) {
            gone = middle;
        } else {
            return st;
        }
    }
    if (s->out->divergence.onset == ONSET_NONE) {
        s->out->divergence =
            (struct divergence_point){.onset = ONSET_LIMIT_POINT, .speed = a->speed};
    }
    return ST_NOT_CONVERGED;
}

/* Follows the branches from a, where they are known, to a speed; smaller steps where it is not
 * clear which is which. ST_NOT_CONVERGED when the equilibrium ends on the way. */
static enum status follow(struct sweep *s, struct point *a, double speed)
{
    static const double sure = 0.5;
    const double least_step = (speed - a->speed) / SUBSTEPS;
    double step = speed - a->speed;
    while (a->speed < speed) {
        struct point p;
        const double next = speed - a->speed <= step * (1.0 + 1e-12) ? speed : a->speed + step;
        enum status st = solve_at(s, next, a, &p);
        if (st == ST_NOT_CONVERGED) {
            return find_limit_point(s, a, next);
        }
        if (st != ST_OK) {
            return st;
        }
        struct branches moved;
        if (branches_follow(&s->branches, &s->spectrum, &moved) < sure && step > least_step) {
            step *= 0.5;
            continue;
        }
        st = find_crossings(s, a, &p);
        if (st == ST_NOT_CONVERGED) {
            return find_limit_point(s, a, p.speed);
        }
        if (st != ST_OK) {
            return st;
        }
        s->branches = moved;
        *a = p;
        step *= 2.0;
    }
    return ST_OK;
}

static void keep_point(struct sweep *s, int i, const struct point *p)
{
    struct stability_result *r = s->out;
    const int rows = s->at.def.stability.count;
    r->speed[i] = p->speed;
    r->tip_plunge[i] = r->tip_twist[i] = 0.0;
    for (int j = 0; j < r->n_mode; j++) {
        const double complex lambda = s->branches.branch[j].lambda;
        const double damping = -creal(lambda) / cabs(lambda);
        const double frequency = cimag(lambda) / (2.0 * NUM_PI);
        r->frequency[num_at(i, j, rows)] = frequency;
        r->damping[num_at(i, j, rows)] = damping;
        r->tip_plunge[i] += s->at.tip[j].v * s->w.q[j];
        r->tip_twist[i] += s->at.tip[j].theta * s->w.q[j];
        if (frequency > 0.0 && damping < r->least.damping) {
            r->least.mode = j;
            r->least.speed = p->speed;
            r->least.damping = damping;
            r->least.frequency = frequency;
        }
    }
    r->n_speed = i + 1;
    sim_control_tell(s->control, (double)(i + 1) / rows);
}

/* From still air to the lowest speed, to know the branches by their natural modes; and what becomes
 * unstable on the way. */
static enum status begin(struct sweep *s, struct point *p)
{
    static const double slow = 0.05; /* of the lowest speed: next to still air */
    const double from = s->at.def.stability.from;
    struct stability_result *r = s->out;
    enum status st = solve_at(s, slow * from, NULL, p);
    if (st != ST_OK) {
        return st;
    }
    const bool grows = p->growth > 0.0;
    (void)branches_follow(&s->branches, &s->spectrum, &s->branches);
    st = follow(s, p, from);
    if (r->flutter.onset != ONSET_NONE) {
        r->flutter.onset = ONSET_BELOW;
    } else if (st == ST_OK && grows && p->growth > 0.0) {
        describe_flutter(s, p, ONSET_BELOW, &r->flutter);
    }
    if (r->divergence.onset == ONSET_CROSSING) {
        r->divergence.onset = ONSET_BELOW;
    }
    return st;
}

static enum status allocate(const struct model *m, struct stability_result *r)
{
    const size_t count = (size_t)m->def.stability.count, n = (size_t)m->n_mode;
    *r = (struct stability_result){.n_mode = m->n_mode, .least = {.damping = HUGE_VAL}};
    r->speed = calloc(count * (3 + 2 * n), sizeof *r->speed);
    if (r->speed == NULL) {
        return ST_NO_MEMORY;
    }
    r->tip_plunge = r->speed + count;
    r->tip_twist = r->tip_plunge + count;
    r->frequency = r->tip_twist + count;
    r->damping = r->frequency + count * n;
    return ST_OK;
}

enum status stability_run(const struct model *m, const struct sim_control *control,
                          struct stability_result *out)
{
    const struct stability_def *d = &m->def.stability;
    struct stability_result r;
    struct sweep s;
    enum status st = allocate(m, &r);
    if (st != ST_OK) {
        return st;
    }
    st = sweep_init(m, control, &s);
    s.out = &r;
    struct point p = {0};
    if (st == ST_OK) {
        st = begin(&s, &p);
    }
    for (int i = 0; i < d->count && st == ST_OK; i++) {
        const double speed = d->from + (d->to - d->from) * i / (d->count - 1);
        if (i > 0) {
            st = follow(&s, &p, speed);
        }
        if (st == ST_OK) {
            keep_point(&s, i, &p);
        }
    }
    sweep_done(&s);
    if (st == ST_NOT_CONVERGED && r.divergence.onset != ONSET_NONE) {
        st = ST_OK; /* the equilibrium ended: said in r.divergence */
    }
    if (st != ST_OK) {
        stability_done(&r);
        return st;
    }
    *out = r;
    return ST_OK;
}

void stability_done(struct stability_result *r)
{
    free(r->speed);
    *r = (struct stability_result){0};
}
