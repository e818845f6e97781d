#include "core/aero/downwash.h"

#include "core/num.h"

#include <assert.h>

double downwash_inset(double gap)
{
    assert(gap >= 0.0);
    if (isinf(gap)) {
        return 0.125;
    }
    /* sqrt(g (g + 1/4)) - g without the difference of large numbers. */
    return gap > 0.0 ? 0.25 * gap / (sqrt(gap * (gap + 0.25)) + gap) : 0.0;
}

/* Downwash at y of a semi-infinite trailing vortex at y0, with all the images of one sign the walls
 * give it, times 4 pi. A vortex row of period p sums to (pi/p) cot(pi (y - y0)/p). */
static double trailing(double y, double y0, double period)
{
    if (period > 0.0) {
        return NUM_PI / period / tan(NUM_PI * (y - y0) / period);
    }
    return 1.0 / (y - y0);
}

/* Place of the vortex that trails from border j. */
static double border(const struct wing *wing, int j)
{
    const double h = wing->length / wing->n;
    if (wing->tip == TIP_INSET && j == wing->n) {
        const bool far = wing->walls == WALLS_ROOT_AND_FAR;
        const double gap = far ? (wing->width - wing->length) / h : (double)INFINITY;
        return wing->length - h * downwash_inset(gap);
    }
    if (wing->tip == TIP_INSET && j == 0 && wing->walls == WALLS_NONE) {
        return h * downwash_inset((double)INFINITY);
    }
    return j * h;
}

void downwash_matrix(const struct wing *wing, int rows, double *b)
{
    const double h = wing->length / wing->n;
    /* Two mirrors at distance W repeat the wing and its root image with the period 2 W. */
    const double period = wing->walls == WALLS_ROOT_AND_FAR ? 2.0 * wing->width : 0.0;
    for (int j = 0; j < wing->n; j++) {
        const double left = border(wing, j), right = border(wing, j + 1);
        for (int i = 0; i < wing->n; i++) {
            const double y = (i + 0.5) * h;
            double sum = trailing(y, left, period) - trailing(y, right, period);
            if (wing->walls != WALLS_NONE) {
                sum += trailing(y, -right, period) - trailing(y, -left, period);
            }
            /* w/V = Gamma/(4 pi V) sum with Gamma = V c c_l / 2 of element j. */
            b[num_at(i, j, rows)] = wing->chord[j] * sum / (8.0 * NUM_PI);
        }
    }
}
