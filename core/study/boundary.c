#include "core/study/boundary.h"

#include "core/range.h"

#include <assert.h>
#include <math.h>

const char *boundary_sweep_name(enum boundary_sweep s)
{
    static const char *const name[] = {
        [BOUNDARY_ALONE] = "alone", [BOUNDARY_UP] = "up", [BOUNDARY_DOWN] = "down"};
    return (unsigned)s < BOUNDARY_SWEEPS ? name[s] : "";
}

const char *boundary_outcome_name(enum boundary_outcome o)
{
    static const char *const name[] = {[BOUNDARY_FOUND] = "found",
                                       [BOUNDARY_NOT_BRACKETED] = "not_bracketed",
                                       [BOUNDARY_FAILED] = "failed",
                                       [BOUNDARY_EXHAUSTED] = "exhausted"};
    return (unsigned)o < BOUNDARY_OUTCOMES ? name[o] : "";
}

void boundary_def_defaults(struct boundary_def *def)
{
    *def = (struct boundary_def){.scan = 5, .evaluations_max = 64};
}

void boundary_def_check(const struct boundary_def *def, struct failure_list *out)
{
    const double width = def->to - def->from;
    const struct range rules[] = {
        {"/field/from", def->from, -HUGE_VAL, HUGE_VAL, false, false},
        {"/field/to", def->to, def->from, HUGE_VAL, true, false},
        {"/field/tolerance", def->tolerance, BOUNDARY_TOLERANCE_LEAST * width, width, false, true},
        {"/field/scan", def->scan, 2.0, BOUNDARY_SCAN_MAX, false, false},
        {"/field/evaluations_max", def->evaluations_max, def->scan, BOUNDARY_SAMPLES_MAX, false,
         false},
    };
    /* The tolerance is measured by the range: a bad range is named alone. */
    const bool ranged = isfinite(width) && width > 0.0;
    range_check(ranged ? sizeof rules / sizeof rules[0] : 2, rules, out);
}

struct search {
    const struct boundary_def *def;
    enum boundary_sweep sweep;
    boundary_evaluate evaluate;
    void *context;
    struct boundary_result *out;
};

/* Evaluates at x; *index receives the place of the new sample. The caller has made sure that one
 * is left. */
static enum status ask(struct search *s, double x, int before, int *index)
{
    struct boundary_result *r = s->out;
    struct boundary_sample sample = {.x = x, .status = ST_OK, .value = NAN};
    assert(r->n < s->def->evaluations_max);
    const enum status st =
        s->evaluate(s->context, x, s->sweep, s->sweep == BOUNDARY_ALONE ? -1 : before, &sample);
    if (st != ST_OK) {
        return st;
    }
    sample.x = x;
    if (sample.status != ST_OK) {
        sample.side = 0;
        sample.value = NAN;
        r->n_failed++;
    }
    assert(sample.status != ST_OK || sample.side == 1 || sample.side == -1);
    assert(!(sample.value * sample.side < 0.0));
    *index = r->n;
    r->sample[r->n++] = sample;
    return ST_OK;
}

/* The ends of the bracket as places of samples: low has the smaller field. -1: none. */
struct bracket {
    int low, high;
};

/* Equidistant points in the direction of the sweep; the first change of side met is the bracket. */
static enum status scan(struct search *s, struct bracket *out)
{
    const struct boundary_def *d = s->def;
    const bool down = s->sweep == BOUNDARY_DOWN;
    int last = -1; /* the last that did not fail */
    *out = (struct bracket){-1, -1};
    for (int i = 0; i < d->scan; i++) {
        const int k = down ? d->scan - 1 - i : i;
        const double x = k == d->scan - 1 ? d->to : d->from + (d->to - d->from) * k / (d->scan - 1);
        int now = -1;
        const enum status st = ask(s, x, last, &now);
        if (st != ST_OK) {
            return st;
        }
        if (s->out->sample[now].side == 0) {
            continue;
        }
        if (last >= 0 && s->out->sample[now].side != s->out->sample[last].side) {
            if (s->out->changes++ == 0) {
                *out = down ? (struct bracket){now, last} : (struct bracket){last, now};
            }
        }
        last = now;
    }
    s->out->side_below = last >= 0 ? s->out->sample[last].side : 0;
    return ST_OK;
}

/* Where the straight line through both ends crosses zero; their middle where one has no value. */
static double secant(const struct boundary_sample *low, const struct boundary_sample *high)
{
    const double share = fabs(low->value) / (fabs(low->value) + fabs(high->value));
    return isfinite(share) ? low->x + share * (high->x - low->x) : 0.5 * (low->x + high->x);
}

/* What the interpolation-truncation-projection method needs of the first bracket. */
struct itp {
    double kappa;   /* of the truncation: kappa (b - a)^2 */
    double closing; /* least truncation */
    double
        reach; /* how far from the middle the next point may lie, before (b - a)/2 is taken off */
};

static struct itp itp_of(double width, double tolerance)
{
    const double rounding = 1.0 - 1e-6; /* so that the last bracket is not too wide by a bit */
    const double halvings = fmax(ceil(log2(width / tolerance)), 0.0);
    return (struct itp){.kappa = 0.1 / width,
                        .closing = 0.45 * tolerance,
                        .reach = rounding * 0.5 * tolerance * exp2(halvings + 1.0)};
}

/* Next point: the secant's, moved towards the middle so that the far end follows, and never so far
 * from it that bisection would be faster by more than one evaluation (Oliveira and Takahashi, ACM
 * Trans. Math. Softw. 47, 2020, n_0 = 1, kappa_2 = 2). */
static double itp_point(struct itp *itp, const struct boundary_sample *low,
                        const struct boundary_sample *high)
{
    const double width = high->x - low->x, middle = low->x + 0.5 * width;
    const double line = secant(low, high), sign = line < middle ? 1.0 : -1.0;
    /* At least nearly half the tolerance: two points about a root then end the search. */
    const double truncation = fmax(itp->kappa * width * width, itp->closing);
    const double reach = fmax(itp->reach - 0.5 * width, 0.0);
    const double near = truncation <= fabs(middle - line) ? line + sign * truncation : middle;
    itp->reach *= 0.5;
    return fabs(near - middle) <= reach ? near : middle - sign * reach;
}

/* Evaluates inside the bracket, at x or, where that fails, at other places. *index is -1 when all
 * fail or no evaluation is left. */
static enum status ask_inside(struct search *s, const struct bracket *b, double x, int *index)
{
    static const double instead[] = {0.5, 0.25, 0.75};
    const double low = s->out->sample[b->low].x, high = s->out->sample[b->high].x;
    const int before = s->sweep == BOUNDARY_DOWN ? b->high : b->low;
    enum { TRIES = 1 + sizeof instead / sizeof instead[0] };
    for (int i = 0; i < TRIES && s->out->n < s->def->evaluations_max; i++) {
        const double at = i == 0 ? x : low + instead[i - 1] * (high - low);
        if (i == 1 && fabs(at - x) < 0.01 * (high - low)) {
            continue; /* the middle was the first */
        }
        int now = -1;
        const enum status st = ask(s, at, before, &now);
        if (st != ST_OK) {
            return st;
        }
        if (s->out->sample[now].side != 0) {
            *index = now;
            return ST_OK;
        }
    }
    *index = -1;
    return ST_OK;
}

static void note_bracket(struct boundary_result *r, const struct bracket *b)
{
    r->lower = r->sample[b->low].x;
    r->upper = r->sample[b->high].x;
    r->side_below = r->sample[b->low].side;
}

static enum status narrow(struct search *s, struct bracket b)
{
    struct boundary_result *r = s->out;
    note_bracket(r, &b);
    struct itp itp = itp_of(r->upper - r->lower, s->def->tolerance);
    while (r->upper - r->lower > s->def->tolerance) {
        int now = -1;
        const double x = itp_point(&itp, &r->sample[b.low], &r->sample[b.high]);
        const enum status st = ask_inside(s, &b, x, &now);
        if (st != ST_OK) {
            return st;
        }
        if (now < 0) {
            r->outcome = r->n < s->def->evaluations_max ? BOUNDARY_FAILED : BOUNDARY_EXHAUSTED;
            return ST_OK;
        }
        *(r->sample[now].side == r->side_below ? &b.low : &b.high) = now;
        note_bracket(r, &b);
    }
    r->outcome = BOUNDARY_FOUND;
    r->x = secant(&r->sample[b.low], &r->sample[b.high]);
    return ST_OK;
}

enum status boundary_search(const struct boundary_def *def, enum boundary_sweep sweep,
                            boundary_evaluate evaluate, void *context, struct boundary_result *out)
{
    struct search s = {def, sweep, evaluate, context, out};
    struct bracket bracket;
    *out = (struct boundary_result){
        .outcome = BOUNDARY_NOT_BRACKETED, .x = NAN, .lower = def->from, .upper = def->to};
    const enum status st = scan(&s, &bracket);
    if (st != ST_OK) {
        return st;
    }
    if (bracket.low >= 0) {
        return narrow(&s, bracket);
    }
    /* Neighbours on one side with a hole of failed points between them are no answer either. */
    out->outcome = out->n_failed > 0 ? BOUNDARY_FAILED : BOUNDARY_NOT_BRACKETED;
    return ST_OK;
}
