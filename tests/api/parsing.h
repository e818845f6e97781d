/* tests/api/parsing.h
 * Set-up of the tests that read case documents: the built-in library, and room for problems.
 * For the thread of the test only. */
#ifndef AEROM_TESTS_API_PARSING_H
#define AEROM_TESTS_API_PARSING_H

#include "api/case.h"
#include "tests/support/unit.h"

struct fixture {
    struct library *lib;
    struct failure_list *problems; /* of the last document */
};

/* Group set-up and tear-down; *state is the struct fixture. */
int parsing_setup(void **state);
int parsing_teardown(void **state);

/* The case of a document, or NULL with at least one problem. */
struct api_case *parse(struct fixture *f, const char *json);
/* The same for a document that must be right. */
struct api_case *parse_good(struct fixture *f, const char *json);

/* Canonical text parsed again gives the same text and the same identity. */
void assert_stable(struct fixture *f, const char *json);

/* A document that has exactly one problem, and where. */
struct bad_case {
    const char *json, *pointer, *code;
};
void assert_all_refused(struct fixture *f, size_t n, const struct bad_case *bad);

#endif
