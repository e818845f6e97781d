/* tests/support/near.h
 * Assertions on doubles that print both values and the difference (cmocka's own compare in single
 * precision). Include after <cmocka.h>. */
#ifndef AEROM_TESTS_SUPPORT_NEAR_H
#define AEROM_TESTS_SUPPORT_NEAR_H

#include <math.h>

#define assert_near_abs(actual, expected, tolerance)                                               \
    do {                                                                                           \
        const double near_a_ = (actual), near_e_ = (expected), near_t_ = (tolerance);              \
        if (!(fabs(near_a_ - near_e_) <= near_t_)) {                                               \
            print_error("%s = %.15g, expected %.15g, |difference| %.3g > %.3g\n", #actual,         \
                        near_a_, near_e_, fabs(near_a_ - near_e_), near_t_);                       \
            fail();                                                                                \
        }                                                                                          \
    } while (0)

#define assert_near_rel(actual, expected, tolerance)                                               \
    do {                                                                                           \
        const double near_a_ = (actual), near_e_ = (expected), near_t_ = (tolerance);              \
        if (!(fabs(near_a_ - near_e_) <= near_t_ * fabs(near_e_))) {                               \
            print_error("%s = %.15g, expected %.15g, relative difference %.3g > %.3g\n", #actual,  \
                        near_a_, near_e_, fabs(near_a_ / near_e_ - 1.0), near_t_);                 \
            fail();                                                                                \
        }                                                                                          \
    } while (0)

#endif
