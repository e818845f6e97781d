/* core/random.h
 * Random numbers that a seed names bit for bit, the same on every machine. Stateless: the state is
 * the caller's. */
#ifndef AEROM_CORE_RANDOM_H
#define AEROM_CORE_RANDOM_H

#include <stdint.h>

/* Next of a sequence of uniform numbers in [0, 1) (splitmix64). */
double random_uniform(uint64_t *state);

/* Puts `order` (n) into another order; the same state gives the same one. */
void random_shuffle(int n, uint64_t *state, int *order);

#endif
