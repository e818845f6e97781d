/* Training against networks that are known, derivatives against differences. */
#include "core/network/train.h"
#include "core/network/train_adam.h"
#include "core/network/train_lm.h"
#include "core/num.h"
#include "core/simd.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

enum {
    IN = 3,
    HIDDEN = 9,
    OUT = 2,
    SAMPLES = 600,
    GROUPS = 4,
    COUNT = IN * HIDDEN + HIDDEN + OUT * HIDDEN + OUT
};

static const struct perceptron shape = {.n_in = IN, .n_hidden = HIDDEN, .n_out = OUT};

static void random_vector(int n, uint64_t seed, double *x)
{
    for (int i = 0; i < n; i++) {
        x[i] = fixture_normal(&seed);
    }
}

enum { FEW = 5, ROWS_MOST = ((IN + 2) * HIDDEN + 1 + OUT + LANES - 1) / LANES * LANES };

static const struct perceptron pairs = {
    .n_in = IN, .n_hidden = HIDDEN, .n_out = OUT, .paired = true};
static const double weight[FEW] = {1.0, 0.25, 2.25, 1.0, 0.5};

/* J'J and J'e of a few samples, by way of the basis. */
static void normal(const struct perceptron *s, const double *p, const double *x, const double *t,
                   const double *w, double *gram, double *slope)
{
    const int rows = perceptron_basis_rows(s);
    double z[ROWS_MOST * FEW];
    double *zz = calloc((size_t)rows * (size_t)rows, sizeof *zz);
    assert_in_range(rows, 1, ROWS_MOST);
    perceptron_basis(s, p, FEW, x, t, w, z);
    for (int k = 0; k < FEW; k++) {
        for (int c = 0; c < rows; c++) {
            const double *row = z + num_at(0, k, rows);
            for (int r = c; r < rows; r++) {
                zz[num_at(r, c, rows)] += row[r] * row[c];
            }
        }
    }
    perceptron_normal(s, p, zz, gram);
    perceptron_slope(s, p, rows, zz + perceptron_residual_row(s), slope);
    free(zz);
}

/* The outputs at one sample, as perceptron.h has them, with the library's tanh. */
static void plain(const struct perceptron *s, const double *p, const double *x, double *y)
{
    const double *b1 = p + s->n_in * s->n_hidden, *w2 = b1 + s->n_hidden;
    const double *b2 = w2 + s->n_hidden * s->n_out;
    for (int o = 0; o < s->n_out; o++) {
        y[o] = s->paired ? 0.0 : b2[o];
    }
    for (int k = 0; k < s->n_hidden; k++) {
        double sum = 0.0;
        for (int i = 0; i < s->n_in; i++) {
            sum += p[num_at(i, k, s->n_in)] * x[i];
        }
        const double value = tanh(sum + b1[k]) + (s->paired ? tanh(sum - b1[k]) : 0.0);
        for (int o = 0; o < s->n_out; o++) {
            y[o] += w2[num_at(k, o, s->n_hidden)] * value;
        }
    }
}

/* y - t of all samples and outputs, times the roots of the weights. */
static void residuals(const struct perceptron *s, const double *p, const double *x, const double *t,
                      const double *w, double *e)
{
    for (int k = 0; k < FEW; k++) {
        plain(s, p, x + num_at(0, k, IN), e + num_at(0, k, OUT));
        for (int o = 0; o < OUT; o++) {
            e[num_at(o, k, OUT)] -= t[num_at(o, k, OUT)];
            e[num_at(o, k, OUT)] *= w != NULL ? sqrt(w[k]) : 1.0;
        }
    }
}

static void normal_equations_are_those_of_differences(const struct perceptron *s, const double *w)
{
    enum { M = FEW * OUT };
    const int count = perceptron_count(s);
    double p[COUNT], x[IN * FEW], t[M], e[M], slope[COUNT], j[M * COUNT];
    double *gram = calloc((size_t)COUNT * COUNT, sizeof *gram);
    perceptron_start(s, 4, p);
    random_vector(IN * FEW, 1, x);
    random_vector(M, 2, t);
    residuals(s, p, x, t, w, e);
    for (int i = 0; i < count; i++) {
        const double h = 1e-6, keep = p[i];
        double up[M], down[M];
        p[i] = keep + h;
        residuals(s, p, x, t, w, up);
        p[i] = keep - h;
        residuals(s, p, x, t, w, down);
        p[i] = keep;
        for (int r = 0; r < M; r++) {
            j[num_at(r, i, M)] = (up[r] - down[r]) / (2.0 * h);
        }
    }
    normal(s, p, x, t, w, gram, slope);
    for (int c = 0; c < count; c++) {
        double sum = 0.0;
        for (int r = 0; r < M; r++) {
            sum += j[num_at(r, c, M)] * e[r];
        }
        assert_near_abs(slope[c], sum, 1e-7);
        for (int i = c; i < count; i++) {
            double product = 0.0;
            for (int r = 0; r < M; r++) {
                product += j[num_at(r, i, M)] * j[num_at(r, c, M)];
            }
            assert_near_abs(gram[num_at(i, c, count)], product, 1e-7);
        }
    }
    free(gram);
}

static void the_normal_equations_are_those_of_differences(void **state)
{
    (void)state;
    assert_int_equal(perceptron_count(&shape), COUNT);
    assert_int_equal(perceptron_count(&pairs), COUNT - OUT);
    normal_equations_are_those_of_differences(&shape, NULL);
    normal_equations_are_those_of_differences(&shape, weight);
    normal_equations_are_those_of_differences(&pairs, weight);
}

static void error_is_that_of_the_residuals(const struct perceptron *s, const double *w)
{
    double p[COUNT], x[IN * FEW], t[OUT * FEW], e[OUT * FEW], squares = 0.0;
    perceptron_start(s, 7, p);
    random_vector(IN * FEW, 3, x);
    random_vector(OUT * FEW, 5, t);
    residuals(s, p, x, t, w, e);
    for (int r = 0; r < OUT * FEW; r++) {
        squares += num_sq(e[r]) / (OUT * FEW);
    }
    assert_near_rel(perceptron_error(s, p, FEW, x, t, w), squares, 1e-13);
}

static void the_error_is_that_of_the_residuals(void **state)
{
    (void)state;
    error_is_that_of_the_residuals(&shape, NULL);
    error_is_that_of_the_residuals(&shape, weight);
    error_is_that_of_the_residuals(&pairs, weight);
}

/* Pairs are odd, whatever their weights: the residuals of t = 0 are the outputs. */
static void pairs_are_odd(void **state)
{
    (void)state;
    double p[COUNT], x[2 * IN], t[2 * OUT] = {0.0}, z[2 * ROWS_MOST];
    const int rows = perceptron_basis_rows(&pairs);
    perceptron_start(&pairs, 11, p);
    random_vector(IN, 12, x);
    for (int i = 0; i < IN; i++) {
        x[IN + i] = -x[i];
    }
    perceptron_basis(&pairs, p, 2, x, t, NULL, z);
    const double *y = z + perceptron_residual_row(&pairs);
    for (int o = 0; o < OUT; o++) {
        assert_true(fabs(y[o]) > 1e-3);
        assert_near_abs(y[rows + o], -y[o], 1e-15);
    }
}

/* Samples of a known network. */
struct known {
    double p[COUNT], x[IN * SAMPLES], t[OUT * SAMPLES];
    int end[2][GROUPS]; /* of the trained samples, of those held out */
    struct train_problem problem;
    struct train_curve curve;
};

/* n samples that weigh alike, in GROUPS groups of different size whose ends come into end. */
static struct train_part part_of(int n, const double *x, const double *t, int *end)
{
    for (int g = 0; g < GROUPS; g++) {
        end[g] = n * (g + 1) * (g + 1) / (GROUPS * GROUPS);
    }
    return (struct train_part){.n = n, .x = x, .t = t, .n_group = GROUPS, .end = end};
}

static struct known *known_new(int epochs)
{
    struct known *k = calloc(1, sizeof *k);
    perceptron_start(&shape, 99, k->p);
    random_vector(IN * SAMPLES, 6, k->x);
    for (int s = 0; s < SAMPLES; s++) {
        plain(&shape, k->p, k->x + num_at(0, s, IN), k->t + num_at(0, s, OUT));
    }
    const int n = SAMPLES * 4 / 5;
    k->problem = (struct train_problem){
        .shape = shape,
        .trained = part_of(n, k->x, k->t, k->end[0]),
        .held = part_of(SAMPLES - n, k->x + num_at(0, n, IN), k->t + num_at(0, n, OUT), k->end[1])};
    k->curve.trained = calloc((size_t)epochs + 1, sizeof(double));
    k->curve.held = calloc((size_t)epochs + 1, sizeof(double));
    return k;
}

static void known_free(struct known *k)
{
    train_curve_done(&k->curve);
    free(k);
}

/* Without noise the samples of a network of the same size are met to rounding, also those that were
 * not trained; twice, to the same bits. */
static void lm_recovers_a_known_network(void **state)
{
    (void)state;
    struct train_def def;
    double p[2][COUNT], best[2][COUNT];
    train_def_defaults(TRAIN_LM, &def);
    def.decay = 0.0;
    def.epochs = 500;
    def.patience = 500;
    for (int run = 0; run < 2; run++) {
        struct known *k = known_new(def.epochs);
        perceptron_start(&shape, 3, p[run]);
        assert_ok(train_lm(&k->problem, &def, NULL, p[run], best[run], &k->curve));
        print_message("lm: %.3g after %d epochs\n", k->curve.held[k->curve.best], k->curve.n - 1);
        assert_true(k->curve.held[0] > 0.1);
        assert_true(k->curve.held[k->curve.best] < 1e-16);
        for (int i = 1; i < k->curve.n; i++) {
            assert_true(k->curve.trained[i] <= k->curve.trained[i - 1]);
        }
        known_free(k);
    }
    assert_memory_equal(best[0], best[1], sizeof best[0]);
}

static int calls_of_both;

static void both_backwards(void (*work)(void *), void *first, void *second)
{
    calls_of_both++;
    work(second);
    work(first);
}

/* The halves of the samples may be summed in any order, or at the same time. */
static void lm_gives_the_same_bits_with_its_work_in_halves(void **state)
{
    (void)state;
    const struct sim_control control = {.both = both_backwards};
    struct train_def def;
    double p[2][COUNT], best[2][COUNT];
    train_def_defaults(TRAIN_LM, &def);
    def.epochs = 20;
    for (int run = 0; run < 2; run++) {
        struct known *k = known_new(def.epochs);
        perceptron_start(&shape, 3, p[run]);
        assert_ok(
            train_lm(&k->problem, &def, run == 0 ? NULL : &control, p[run], best[run], &k->curve));
        known_free(k);
    }
    assert_true(calls_of_both >= 2 * def.epochs);
    assert_memory_equal(best[0], best[1], sizeof best[0]);
}

/* A linear least-squares problem in b2 alone has its answer after one undamped step; the decay then
 * draws it to zero by the factor 1/(1 + weight). */
static void the_decay_is_a_ridge(void **state)
{
    (void)state;
    enum { N = 32 };
    const struct perceptron one = {.n_in = 1, .n_hidden = 1, .n_out = 1};
    double x[N] = {0.0}, t[N], p[4] = {0.0}, best[4], trained[51], held[51];
    for (int i = 0; i < N; i++) {
        t[i] = 2.0;
    }
    int end[GROUPS];
    const struct train_part all = part_of(N, x, t, end);
    const struct train_problem problem = {.shape = one, .trained = all, .held = all};
    struct train_def def;
    struct train_curve curve = {.trained = trained, .held = held};
    train_def_defaults(TRAIN_LM, &def);
    def.decay = 1.0; /* a quarter for each of the four parameters */
    def.epochs = 50;
    assert_ok(train_lm(&problem, &def, NULL, p, best, &curve));
    /* w1, b1 and w2 stay zero: their gradients are products with one another. */
    assert_near_abs(p[3], 2.0 / 1.25, 1e-9);
    assert_near_abs(p[0], 0.0, 1e-12);
}

/* Mean square errors of the groups by hand, weights and all. */
static void plain_errors(const struct train_part *part, const double *p, double *error)
{
    for (int g = 0, k = 0; g < part->n_group; g++) {
        const int first = k;
        error[g] = 0.0;
        for (; k < part->end[g]; k++) {
            double y[OUT];
            plain(&shape, p, part->x + num_at(0, k, IN), y);
            for (int o = 0; o < OUT; o++) {
                error[g] += (part->w != NULL ? part->w[k] : 1.0) *
                            num_sq(y[o] - part->t[num_at(o, k, OUT)]) / OUT;
            }
        }
        error[g] /= k - first;
    }
}

/* Without a tolerance the mean square; with one the sum of the logarithms, and its slope is that of
 * the squares with the weights of train_weights. */
static void the_objective_counts_records_by_their_logarithm(void **state)
{
    (void)state;
    const double tolerance = 0.05, step = 1e-6;
    double p[COUNT], w[SAMPLES], error[GROUPS], wanted[GROUPS], own[SAMPLES];
    struct known *k = known_new(1);
    struct train_part part = k->problem.trained;
    for (int i = 0; i < part.n; i++) {
        own[i] = 0.5 + i % 3;
    }
    part.w = own;
    perceptron_start(&shape, 3, p);
    plain_errors(&part, p, wanted);
    train_group_errors(&shape, p, &part, 0, GROUPS, error);
    double squares = 0.0, logarithms = 0.0;
    for (int g = 0; g < GROUPS; g++) {
        const double share = (double)(part.end[g] - (g > 0 ? part.end[g - 1] : 0)) / part.n;
        assert_near_rel(error[g], wanted[g], 1e-13);
        squares += share * wanted[g];
        logarithms += share * tolerance * log(1.0 + wanted[g] / tolerance);
    }
    assert_near_rel(train_objective(&part, 0.0, error), squares, 1e-13);
    assert_near_rel(train_objective(&part, tolerance, error), logarithms, 1e-13);
    assert_near_rel(train_objective_at(&shape, p, &part, tolerance), logarithms, 1e-13);
    train_weights(&part, tolerance, error, w);
    for (int i = 0; i < COUNT; i += 5) {
        const double at = p[i];
        double side[2][2];
        for (int s = 0; s < 2; s++) {
            p[i] = at + (s == 0 ? -step : step);
            side[s][0] = train_objective_at(&shape, p, &part, tolerance);
            side[s][1] = perceptron_error(&shape, p, part.n, part.x, part.t, w);
        }
        p[i] = at;
        assert_near_abs((side[1][0] - side[0][0]) / (2.0 * step),
                        (side[1][1] - side[0][1]) / (2.0 * step), 1e-8);
    }
    known_free(k);
}

/* A record that nothing explains beside others that are exact, the largest of the groups: with
 * squares it spoils the network, with a tolerance hardly. The objective never rises. */
static void a_tolerance_keeps_what_can_be_learnt(void **state)
{
    (void)state;
    double error[2];
    for (int robust = 0; robust < 2; robust++) {
        struct train_def def;
        double p[COUNT], best[COUNT], wild[OUT * SAMPLES];
        train_def_defaults(TRAIN_LM, &def);
        def.decay = 0.0;
        def.epochs = def.patience = 200;
        struct known *k = known_new(def.epochs);
        k->problem.tolerance = robust ? 1e-4 : 0.0;
        random_vector(OUT * SAMPLES, 11, wild);
        for (int i = OUT * k->end[0][GROUPS - 2]; i < OUT * k->problem.trained.n; i++) {
            k->t[i] += wild[i];
        }
        perceptron_start(&shape, 3, p);
        assert_ok(train_lm(&k->problem, &def, NULL, p, best, &k->curve));
        for (int i = 1; i < k->curve.n; i++) {
            assert_true(k->curve.trained[i] <= k->curve.trained[i - 1]);
        }
        error[robust] = train_objective_at(&shape, best, &k->problem.held, 0.0);
        known_free(k);
    }
    assert_true(error[0] > 1e-2);
    assert_true(error[1] < 1e-3 * error[0]);
}

static void adam_learns_and_repeats_itself(void **state)
{
    (void)state;
    struct train_def def;
    double p[2][COUNT], best[2][COUNT];
    train_def_defaults(TRAIN_ADAM, &def);
    def.decay = 0.0;
    def.epochs = 400;
    def.rate = 5e-3;
    for (int run = 0; run < 2; run++) {
        struct known *k = known_new(def.epochs);
        perceptron_start(&shape, 3, p[run]);
        assert_ok(train_adam(&k->problem, &def, NULL, p[run], best[run], &k->curve));
        print_message("adam: %.3g from %.3g\n", k->curve.held[k->curve.best], k->curve.held[0]);
        assert_true(k->curve.held[k->curve.best] < 0.01 * k->curve.held[0]);
        known_free(k);
    }
    assert_memory_equal(best[0], best[1], sizeof best[0]);
}

/* Samples held out that contradict what is learnt: the error of theirs rises, the patience ends the
 * training, and what is kept is the best, not the last. */
static void patience_ends_the_training(void **state)
{
    (void)state;
    for (int o = 0; o < TRAIN_OPTIMISERS; o++) {
        struct train_def def;
        double p[COUNT], best[COUNT];
        train_def_defaults((enum train_optimiser)o, &def);
        def.epochs = 200;
        def.patience = 5;
        struct known *k = known_new(def.epochs);
        for (int i = OUT * k->problem.trained.n; i < OUT * SAMPLES; i++) {
            k->t[i] = -k->t[i];
        }
        perceptron_start(&shape, 3, p);
        assert_ok(o == TRAIN_LM ? train_lm(&k->problem, &def, NULL, p, best, &k->curve)
                                : train_adam(&k->problem, &def, NULL, p, best, &k->curve));
        assert_true(k->curve.n < def.epochs);
        assert_int_equal(k->curve.n - 1 - k->curve.best, 5);
        const struct train_part *held = &k->problem.held;
        assert_near_rel(perceptron_error(&shape, best, held->n, held->x, held->t, NULL),
                        k->curve.held[k->curve.best], 1e-14);
        known_free(k);
    }
}

static void a_raised_flag_cancels(void **state)
{
    (void)state;
    atomic_bool cancel = true;
    _Atomic double progress = -1.0;
    const struct sim_control control = {.cancel = &cancel, .progress = &progress};
    for (int o = 0; o < TRAIN_OPTIMISERS; o++) {
        struct train_def def;
        double p[COUNT], best[COUNT];
        train_def_defaults((enum train_optimiser)o, &def);
        struct known *k = known_new(def.epochs);
        perceptron_start(&shape, 3, p);
        assert_int_equal(o == TRAIN_LM
                             ? train_lm(&k->problem, &def, &control, p, best, &k->curve)
                             : train_adam(&k->problem, &def, &control, p, best, &k->curve),
                         ST_CANCELLED);
        assert_near_abs(atomic_load(&progress), 0.0, 0.0);
        known_free(k);
    }
}

static void ranges_are_checked(void **state)
{
    (void)state;
    struct failure_list *list = calloc(1, sizeof *list);
    struct train_def def;
    train_def_defaults(TRAIN_LM, &def);
    train_def_check(&def, 50, list);
    assert_int_equal(list->count, 0);
    def.epochs = 0;
    def.decay = (double)NAN;
    def.tolerance = -1.0;
    train_def_check(&def, LIMIT_NET_HIDDEN + 1, list);
    assert_int_equal(list->count, 4);
    assert_string_equal(list->item[0].pointer, "--hidden");
    assert_string_equal(list->item[1].pointer, "--epochs");
    assert_string_equal(list->item[2].pointer, "--decay");
    assert_string_equal(list->item[3].pointer, "--tolerance");
    assert_int_equal(train_optimiser_of("adam"), TRAIN_ADAM);
    assert_int_equal(train_optimiser_of("newton"), TRAIN_OPTIMISERS);
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_normal_equations_are_those_of_differences),
        cmocka_unit_test(the_error_is_that_of_the_residuals),
        cmocka_unit_test(pairs_are_odd),
        cmocka_unit_test(lm_recovers_a_known_network),
        cmocka_unit_test(lm_gives_the_same_bits_with_its_work_in_halves),
        cmocka_unit_test(the_decay_is_a_ridge),
        cmocka_unit_test(the_objective_counts_records_by_their_logarithm),
        cmocka_unit_test(a_tolerance_keeps_what_can_be_learnt),
        cmocka_unit_test(adam_learns_and_repeats_itself),
        cmocka_unit_test(patience_ends_the_training),
        cmocka_unit_test(a_raised_flag_cancels),
        cmocka_unit_test(ranges_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
