#include "core/network/train_objective.h"

#include "core/num.h"

#include <math.h>

static int begin_of(const struct train_part *part, int group)
{
    return group > 0 ? part->end[group - 1] : 0;
}

static double group_error(const struct perceptron *s, const double *p,
                          const struct train_part *part, int group)
{
    const int first = begin_of(part, group);
    return perceptron_error(s, p, part->end[group] - first, part->x + num_at(0, first, s->n_in),
                            part->t + num_at(0, first, s->n_out),
                            part->w != NULL ? part->w + first : NULL);
}

/* What a group adds to the sum. */
static double term(const struct train_part *part, double tolerance, int group, double error)
{
    const double phi = tolerance > 0.0 ? tolerance * log1p(error / tolerance) : error;
    return (part->end[group] - begin_of(part, group)) * phi;
}

void train_group_errors(const struct perceptron *s, const double *p, const struct train_part *part,
                        int first, int last, double *error)
{
    for (int g = first; g < last; g++) {
        error[g] = group_error(s, p, part, g);
    }
}

double train_objective(const struct train_part *part, double tolerance, const double *error)
{
    double sum = 0.0;
    for (int g = 0; g < part->n_group; g++) {
        sum += term(part, tolerance, g, error[g]);
    }
    return sum / part->n;
}

double train_objective_at(const struct perceptron *s, const double *p,
                          const struct train_part *part, double tolerance)
{
    double sum = 0.0;
    for (int g = 0; g < part->n_group; g++) {
        sum += term(part, tolerance, g, group_error(s, p, part, g));
    }
    return sum / part->n;
}

void train_weights(const struct train_part *part, double tolerance, const double *error, double *w)
{
    for (int g = 0; g < part->n_group; g++) {
        const double factor = tolerance > 0.0 ? 1.0 / (1.0 + error[g] / tolerance) : 1.0;
        for (int k = begin_of(part, g); k < part->end[g]; k++) {
            w[k] = (part->w != NULL ? part->w[k] : 1.0) * factor;
        }
    }
}
