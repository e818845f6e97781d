#include "core/analysis/branches.h"

#include "core/num.h"

#include <assert.h>
#include <string.h>

double complex spectrum_entry(const struct spectrum *s, int i, int j)
{
    const double imaginary = s->im[j] > 0.0 ? s->vector[num_at(i, j + 1, s->n)] : 0.0;
    return NUM_COMPLEX(s->vector[num_at(i, j, s->n)], imaginary);
}

void branches_start(int n, const double *omega, struct branches *out)
{
    assert(n <= LIMIT_MODES);
    memset(out, 0, sizeof *out);
    out->n = n;
    for (int k = 0; k < n; k++) {
        out->omega[k] = omega[k];
        out->branch[k].lambda = NUM_COMPLEX(0.0, omega[k]);
        out->branch[k].part[k] = sqrt(0.5);
        out->branch[k].part[n + k] = NUM_COMPLEX(0.0, sqrt(0.5));
    }
}

/* Modal part of eigenvector j, of unit length. */
static void modal_part(const struct branches *b, const struct spectrum *s, int j,
                       double complex *part)
{
    double size = 0.0;
    for (int k = 0; k < 2 * b->n; k++) {
        part[k] = spectrum_entry(s, k, j) * (k < b->n ? b->omega[k] : 1.0);
        size += num_sq(creal(part[k])) + num_sq(cimag(part[k]));
    }
    for (int k = 0; k < 2 * b->n && size > 0.0; k++) {
        part[k] /= sqrt(size);
    }
}

double branches_likeness(const struct branches *b, int branch, const struct spectrum *s, int j)
{
    double complex part[2 * LIMIT_MODES], product = 0.0;
    const struct branch *known = &b->branch[branch];
    modal_part(b, s, j, part);
    for (int k = 0; k < 2 * b->n; k++) {
        product += conj(known->part[k]) * part[k];
    }
    const double mac = num_sq(creal(product)) + num_sq(cimag(product));
    /* A step of a tenth of the eigenvalue halves the likeness: larger ones want a smaller step. */
    const double moved =
        cabs(NUM_COMPLEX(s->re[j], s->im[j]) - known->lambda) / (0.1 * cabs(known->lambda));
    return mac / (1.0 + num_sq(moved));
}

double branches_follow(const struct branches *b, const struct spectrum *s, struct branches *out)
{
    bool taken[LIMIT_MODES] = {false};
    bool used[LIMIT_STATES] = {false};
    assert(s->n <= LIMIT_STATES);
    struct branches next = *b;
    double least = 1.0;
    for (int round = 0; round < b->n; round++) {
        double best = -1.0;
        int branch = 0, root = 0;
        for (int k = 0; k < b->n; k++) {
            for (int j = 0; j < s->n && !taken[k]; j++) {
                if (used[j] || s->im[j] < 0.0) {
                    continue;
                }
                const double like = branches_likeness(b, k, s, j);
                if (like > best) {
                    best = like;
                    branch = k;
                    root = j;
                }
            }
        }
        taken[branch] = true;
        used[root] = true;
        next.branch[branch].lambda = NUM_COMPLEX(s->re[root], s->im[root]);
        modal_part(b, s, root, next.branch[branch].part);
        least = fmin(least, best);
    }
    *out = next;
    return least;
}
