/* tests/support/unit.h
 * cmocka with what it needs, assertions on doubles, and on status codes. */
#ifndef AEROM_TESTS_SUPPORT_UNIT_H
#define AEROM_TESTS_SUPPORT_UNIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/near.h"

/* The call succeeds. */
#define assert_ok(call) assert_int_equal((call), ST_OK)

#endif
