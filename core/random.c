#include "core/random.h"

double random_uniform(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

void random_shuffle(int n, uint64_t *state, int *order)
{
    for (int i = n - 1; i > 0; i--) {
        const int k = (int)(random_uniform(state) * (i + 1));
        const int keep = order[i];
        order[i] = order[k];
        order[k] = keep;
    }
}
