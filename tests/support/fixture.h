/* tests/support/fixture.h
 * Materials, cases, polars and networks that several tests of the core share.
 *
 * Polars and networks own their arrays: free them with polar_def_done, network_def_done. The cases
 * are plain values that borrow what they are given. */
#ifndef AEROM_TESTS_SUPPORT_FIXTURE_H
#define AEROM_TESTS_SUPPORT_FIXTURE_H

#include "core/case_def.h"

#include <stdint.h>

/* Table 1 of the paper, and the beam of its Table 2 (validation page, 1.4). */
struct material fixture_skin(void);
struct material fixture_foam(void);
struct material fixture_minguet(void);
/* G = E / (2 (1 + nu)). */
struct material fixture_isotropic(double e, double nu, double density);

/* The paper's beam [angle/foam], 16 elements; a simulation of 1 s at 6 m/s and 5 degrees from rest
 * with the lifting line, without dynamic part. Angle in degrees. */
void fixture_paper_beam(double degrees, const struct polar_def *polar, struct case_def *out);
/* One homogeneous ply; kind CASE_MODES, 16 elements, root warping free. */
void fixture_strip(const struct material *m, double length, double chord, double thickness,
                   struct case_def *out);
/* [45/0]s of the Table-2 beam, kind CASE_MODES, 5 modes, root warping free. */
void fixture_minguet_strip(struct case_def *out);

/* c_l = lift_slope a, c_m = moment_slope a, c_d = drag, between -limit and limit [rad]. */
struct polar_def fixture_linear_polar(double lift_slope, double moment_slope, double drag,
                                      double limit);
/* Four inputs of the contract, two outputs, random weights; increments of about `size`. The hull is
 * wide. */
struct network_def fixture_network(int hidden, double size, uint64_t seed);

/* Standard normal numbers from those of core/random.h. */
double fixture_normal(uint64_t *state);

/* y (n) = a (n x n, column-major) x (n). */
void fixture_multiply(int n, const double *a, const double *x, double *y);

#endif
