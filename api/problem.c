#include "api/problem.h"

#include "api/json_out.h"
#include "api/router.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *code;
    int status;
    const char *title;
} problem_table[PROBLEM_COUNT] = {
#define PROBLEM_ROW(id, code, status, title) [id] = {code, status, title},
    PROBLEM_LIST(PROBLEM_ROW)
#undef PROBLEM_ROW
};

const char *problem_code(enum problem p)
{
    assert((unsigned)p < PROBLEM_COUNT);
    return problem_table[p].code;
}

int problem_status(enum problem p)
{
    assert((unsigned)p < PROBLEM_COUNT);
    return problem_table[p].status;
}

static void write_head(struct json_out *out, int status, const char *code, const char *title,
                       const char *detail)
{
    char type[96];
    (void)snprintf(type, sizeof type, "urn:aeromd:problem:%s", code);
    json_object_begin(out);
    json_key_string(out, "type", type);
    json_key_string(out, "title", title);
    json_key_integer(out, "status", status);
    json_key_string(out, "code", code);
    json_key_string(out, "detail", detail);
}

static void write_errors(struct json_out *out, const struct failure_list *errors)
{
    json_key(out, "errors");
    json_array_begin(out);
    for (int i = 0; i < errors->count; i++) {
        const struct failure *f = &errors->item[i];
        json_object_begin(out);
        json_key_string(out, "pointer", f->pointer);
        json_key_string(out, "code", f->code);
        json_key_string(out, "detail", f->detail);
        json_key_string(out, "expected", f->expected[0] != '\0' ? f->expected : NULL);
        json_key_string(out, "got", f->got[0] != '\0' ? f->got : NULL);
        json_object_end(out);
    }
    json_array_end(out);
    json_key_integer(out, "errors_total", errors->total);
}

static void finish(struct json_out *out, struct api_response *res, int status)
{
    json_object_end(out);
    res->status = status;
    res->body_size = 0;
    res->body = json_out_take(out, &res->body_size);
    (void)snprintf(res->content_type, sizeof res->content_type, "%s",
                   res->body != NULL ? "application/problem+json" : "");
    api_response_header(res, "Cache-Control", "no-store");
}

void problem_response(struct api_response *res, enum problem p, const char *detail,
                      const struct failure_list *errors, const struct problem_member *member)
{
    struct json_out out = {0};
    assert((unsigned)p < PROBLEM_COUNT);
    const int status = problem_table[p].status;
    write_head(&out, status, problem_table[p].code, problem_table[p].title, detail);
    if (member != NULL) {
        json_key_string(&out, member->key, member->value);
    }
    if (errors != NULL) {
        write_errors(&out, errors);
    }
    finish(&out, res, status);
    if (p == PROBLEM_BUSY) {
        api_response_header(res, "Retry-After", "1");
    }
}

void router_problem(struct api_response *out, int http_status, const char *code, const char *detail)
{
    const char *title = "The request cannot be served";
    for (int i = 0; i < PROBLEM_COUNT; i++) {
        if (strcmp(problem_table[i].code, code) == 0) {
            title = problem_table[i].title;
        }
    }
    struct json_out text = {0};
    *out = (struct api_response){0};
    write_head(&text, http_status, code, title, detail);
    finish(&text, out, http_status);
}
