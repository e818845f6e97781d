/* tests/support/reference.h
 * Reads tests/reference/calculix.json: beams, and what three-dimensional elements say of them.
 * Anything missing or malformed ends the program: there is nothing to compare with then. */
#ifndef AEROM_TESTS_SUPPORT_REFERENCE_H
#define AEROM_TESTS_SUPPORT_REFERENCE_H

#include "core/case_def.h"

enum { REFERENCE_MODES = 8 };

struct reference_mode {
    double frequency; /* [Hz] */
    const char *label;
    double torsion; /* share of the kinetic energy */
};

struct reference;

/* Reads the file; free with reference_close. */
struct reference *reference_open(const char *path);
void reference_close(struct reference *r);

int reference_count(const struct reference *r);
const char *reference_name(const struct reference *r, int i);

/* The beam of a record as a case of kind `modes`. A taper needs two stations, which the case
 * borrows. */
void reference_case(const struct reference *r, int i, struct station_def station[2],
                    struct case_def *out);

/* Lowest modes, ascending; returns their number, at most REFERENCE_MODES. */
int reference_modes(const struct reference *r, int i, struct reference_mode *out);

/* Answer of the tip to a load of the record, e.g. "tip_torque", "twist_deg"; NaN when the
 * record has no such load. */
double reference_tip(const struct reference *r, int i, const char *load, const char *key);

#endif
