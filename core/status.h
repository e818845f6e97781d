/* core/status.h
 * Every status code of the core, in one list, and the report of a failure.
 *
 * A function that can fail returns `enum status` and is MUST_CHECK; zero is success and outputs
 * are unchanged on failure. Border functions (sim.h, case_def.h) also fill a `struct failure`. */
#ifndef AEROM_CORE_STATUS_H
#define AEROM_CORE_STATUS_H

#define MUST_CHECK __attribute__((warn_unused_result))

/* X(code, stable text used on the wire, sentence for people) */
#define STATUS_LIST(X)                                                                             \
    X(ST_OK, "ok", "no error")                                                                     \
    X(ST_INVALID, "invalid", "the input is not admissible")                                        \
    X(ST_NO_MEMORY, "no_memory", "memory could not be allocated")                                  \
    X(ST_SINGULAR, "singular", "a matrix that must be regular is singular")                        \
    X(ST_NOT_CONVERGED, "not_converged", "an iteration did not converge")                          \
    X(ST_NOT_FINITE, "not_finite", "a result is not a finite number")                              \
    X(ST_CANCELLED, "cancelled", "the run was cancelled")                                          \
    X(ST_LIMIT, "limit", "a limit of the program was exceeded")                                    \
    X(ST_CORRUPT, "corrupt", "stored data fail their check")                                       \
    X(ST_INTERNAL, "internal", "an internal error")

#define STATUS_ENUM(code, name, text) code,
enum status { STATUS_LIST(STATUS_ENUM) STATUS_COUNT };
#undef STATUS_ENUM

/* Stable lower-case name, e.g. "not_finite". */
const char *status_name(enum status st);
/* One sentence for people. */
const char *status_text(enum status st);

/* One thing that is wrong, and where. `pointer` is the JSON pointer of the field of the case
 * ("" when the failure belongs to no field), `code` a stable word for programs. */
struct failure {
    enum status status;
    char pointer[160];
    char code[40];
    char detail[256];
    char expected[128];
    char got[96];
};

enum { FAILURE_LIST_MAX = 100 };

/* All that is wrong with one input; items beyond the maximum are counted, not kept. */
struct failure_list {
    int count; /* kept items, <= FAILURE_LIST_MAX */
    int total; /* found items */
    struct failure item[FAILURE_LIST_MAX];
};

/* Fills one failure; expected and got may be NULL. detail is a printf format. */
void failure_set(struct failure *f, enum status st, const char *pointer, const char *code,
                 const char *expected, const char *got, const char *detail, ...)
    __attribute__((format(printf, 7, 8)));

/* Returns the next free item of the list to be filled, or a scratch item once it is full.
 * Never NULL. */
struct failure *failure_add(struct failure_list *list);

#endif
