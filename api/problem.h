/* api/problem.h
 * Problem documents (RFC 9457): one table of codes with status and title. */
#ifndef AEROM_API_PROBLEM_H
#define AEROM_API_PROBLEM_H

#include "api/http_msg.h"
#include "core/status.h"

/* X(code, name on the wire, HTTP status, title) */
#define PROBLEM_LIST(X)                                                                            \
    X(PROBLEM_MALFORMED_JSON, "malformed_json", 400, "The body is not JSON")                       \
    X(PROBLEM_BAD_FRAMING, "bad_framing", 400, "The HTTP message is ambiguous")                    \
    X(PROBLEM_BAD_TARGET, "bad_target", 400, "The query is not properly encoded")                  \
    X(PROBLEM_BAD_PATH, "bad_path", 400, "The path is not properly encoded")                       \
    X(PROBLEM_BAD_QUERY, "bad_query", 400, "A query parameter is not admissible")                  \
    X(PROBLEM_UNKNOWN_PATH, "unknown_path", 404, "There is no such resource")                      \
    X(PROBLEM_UNKNOWN_JOB, "unknown_job", 404, "There is no such job")                             \
    X(PROBLEM_NO_DOCUMENT, "no_document", 404, "The job has no such result")                       \
    X(PROBLEM_NO_CELL, "no_cell", 404, "The study has no such cell")                               \
    X(PROBLEM_UNKNOWN_NAME, "unknown_name", 404, "The library has no entry of this name")          \
    X(PROBLEM_METHOD, "method_not_allowed", 405, "The resource does not answer this method")       \
    X(PROBLEM_BUILT_IN, "built_in", 409, "The entry belongs to the program")                       \
    X(PROBLEM_IN_USE, "in_use", 409, "The entry is needed")                                        \
    X(PROBLEM_NOT_READY, "not_ready", 409, "The job has no result")                                \
    X(PROBLEM_TOO_LARGE, "body_too_large", 413, "The body is too large")                           \
    X(PROBLEM_MEDIA_TYPE, "unsupported_media_type", 415, "The body has another media type")        \
    X(PROBLEM_INVALID_CASE, "invalid_case", 422, "The case is not admissible")                     \
    X(PROBLEM_INVALID_ENTRY, "invalid_entry", 422, "The entry is not admissible")                  \
    X(PROBLEM_INTERNAL, "internal", 500, "The server failed")                                      \
    X(PROBLEM_BUSY, "busy", 503, "The server takes no work now")                                   \
    X(PROBLEM_DISK_FULL, "disk_full", 507, "The disk is full")

#define PROBLEM_ENUM(code, name, status, title) code,
enum problem { PROBLEM_LIST(PROBLEM_ENUM) PROBLEM_COUNT };
#undef PROBLEM_ENUM

const char *problem_code(enum problem p);
int problem_status(enum problem p);

/* One more member of the document, e.g. the state of a job. */
struct problem_member {
    const char *key;
    const char *value;
};

/* Fills the response. `errors` and `member` may be NULL. When even the document cannot be built
 * the response has the status and no body. */
void problem_response(struct api_response *res, enum problem p, const char *detail,
                      const struct failure_list *errors, const struct problem_member *member);

#endif
