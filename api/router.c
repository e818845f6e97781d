#include "api/route.h"

#include "api/reader.h"
#include "api/text.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BODY_MAX = 1 << 20, BATCH_BODY_MAX = 16 << 20 };

static const char *const list_query[] = {"kind", "state", "name", "limit", "cursor", NULL};
static const char *const add_query[] = {"name", "description", NULL};
static const char *const dataset_query[] = {"version", "format", NULL};
static const char *const version_query[] = {"version", NULL};
static const char *const study_list_query[] = {"state", "name", "limit", "cursor", NULL};
static const char *const cells_query[] = {"from", "limit", NULL};
static const char *const map_query[] = {"value", "format", "boundary", NULL};
static const char *const series_query[] = {"channels", "from_s", "to_s", "points", "format", NULL};

const struct route route_table[] = {
    {"POST", "/v1/jobs", handle_submit, NULL, NULL},
    {"GET", "/v1/jobs", handle_list, list_query, NULL},
    {"GET", "/v1/jobs/{id}", handle_get, NULL, NULL},
    {"DELETE", "/v1/jobs/{id}", handle_cancel, NULL, NULL},
    {"GET", "/v1/jobs/{id}/case", handle_case, NULL, NULL},
    {"GET", "/v1/jobs/{id}/series", handle_series, series_query, NULL},
    {"GET", "/v1/jobs/{id}/damping", handle_document, NULL, "damping"},
    {"GET", "/v1/jobs/{id}/loads", handle_document, NULL, "loads"},
    {"GET", "/v1/jobs/{id}/modes", handle_document, NULL, "modes"},
    {"GET", "/v1/jobs/{id}/section", handle_document, NULL, "section"},
    {"GET", "/v1/jobs/{id}/stability", handle_document, NULL, "stability"},
    {"GET", "/v1/jobs/{id}/static", handle_document, NULL, "static"},
    {"GET", "/v1/jobs/{id}/network", handle_document, NULL, "network"},
    {"GET", "/v1/jobs/{id}/training", handle_document, NULL, "training"},
    {"GET", "/v1/jobs/{id}/summary", handle_document, NULL, "summary"},
    {"POST", "/v1/studies", handle_study_submit, NULL, NULL},
    {"GET", "/v1/studies", handle_study_list, study_list_query, NULL},
    {"GET", "/v1/studies/{id}", handle_study, NULL, NULL},
    {"DELETE", "/v1/studies/{id}", handle_cancel, NULL, NULL},
    {"GET", "/v1/studies/{id}/case", handle_case, NULL, NULL},
    {"GET", "/v1/studies/{id}/cells", handle_cells, cells_query, NULL},
    {"GET", "/v1/studies/{id}/cells/{cell}", handle_cell, NULL, NULL},
    {"GET", "/v1/studies/{id}/boundary", handle_search, NULL, "boundary"},
    {"GET", "/v1/studies/{id}/optimum", handle_search, NULL, "optimum"},
    {"GET", "/v1/studies/{id}/uncertainty", handle_search, NULL, "uncertainty"},
    {"GET", "/v1/studies/{id}/map", handle_map, map_query, NULL},
    {"GET", "/v1/materials", handle_materials, NULL, NULL},
    {"POST", "/v1/materials", handle_add_material, NULL, NULL},
    {"GET", "/v1/materials/{name}", handle_materials, version_query, NULL},
    {"DELETE", "/v1/materials/{name}", handle_remove_material, version_query, NULL},
    {"GET", "/v1/polars", handle_polars, NULL, NULL},
    {"POST", "/v1/polars", handle_add_polar, NULL, NULL},
    {"GET", "/v1/polars/{name}", handle_polars, version_query, NULL},
    {"DELETE", "/v1/polars/{name}", handle_remove_polar, version_query, NULL},
    {"GET", "/v1/networks", handle_networks, NULL, NULL},
    {"POST", "/v1/networks", handle_add_network, NULL, NULL},
    {"GET", "/v1/networks/{name}", handle_networks, version_query, NULL},
    {"DELETE", "/v1/networks/{name}", handle_remove_network, version_query, NULL},
    {"POST", "/v1/datasets", handle_add_dataset, add_query, NULL},
    {"GET", "/v1/datasets", handle_datasets, NULL, NULL},
    {"GET", "/v1/datasets/{dataset}", handle_dataset, dataset_query, NULL},
    {"GET", "/v1/datasets/{dataset}/records/{record}", handle_dataset, dataset_query, NULL},
    {"DELETE", "/v1/datasets/{dataset}", handle_remove_dataset, version_query, NULL},
    {"GET", "/healthz", handle_health, NULL, NULL},
    {"GET", "/readyz", handle_ready, NULL, NULL},
    {"GET", "/openapi.json", handle_openapi, NULL, NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

size_t router_body_max(const char *method, const char *path)
{
    static const char *const large[] = {"/v1/jobs", "/v1/studies", "/v1/datasets"};
    bool is_large = false;
    for (size_t i = 0; i < sizeof large / sizeof large[0]; i++) {
        is_large = is_large || strcmp(path, large[i]) == 0;
    }
    return is_large && strcmp(method, "POST") == 0 ? BATCH_BODY_MAX : BODY_MAX;
}

/* Where the parameters of a path are, still encoded. */
struct path_part {
    size_t at, n;
};
enum { PATH_PARAMS_MAX = 2 };

/* Whether a path has the shape of a pattern; *part are its parameters, empty when it has fewer. */
static bool path_matches(const char *pattern, const char *path,
                         struct path_part part[PATH_PARAMS_MAX])
{
    size_t p = 0, i = 0;
    int k = 0;
    memset(part, 0, PATH_PARAMS_MAX * sizeof *part);
    while (pattern[p] != '\0') {
        if (pattern[p] != '{') {
            if (pattern[p++] != path[i++]) {
                return false;
            }
            continue;
        }
        assert(k < PATH_PARAMS_MAX);
        const bool rest = strcmp(pattern + p, "{name}") == 0;
        part[k] = (struct path_part){i, rest ? strlen(path + i) : strcspn(path + i, "/")};
        if (part[k].n == 0) {
            return false;
        }
        i += part[k++].n;
        p += strcspn(pattern + p, "}") + 1;
    }
    return path[i] == '\0';
}

static bool method_is(const struct route *route, const char *method)
{
    return strcmp(route->method, method) == 0 ||
           (strcmp(method, "HEAD") == 0 && strcmp(route->method, "GET") == 0);
}

/* "GET, HEAD, POST, OPTIONS": what the routes with this path answer. "" for an unknown path. */
static void allowed_methods(const char *path, size_t size, char *out)
{
    struct path_part part[PATH_PARAMS_MAX];
    size_t used = 0;
    out[0] = '\0';
    for (const struct route *t = route_table; t->method != NULL; t++) {
        if (path_matches(t->path, path, part)) {
            const bool get = strcmp(t->method, "GET") == 0;
            used +=
                (size_t)snprintf(out + used, size - used, "%s, %s", t->method, get ? "HEAD, " : "");
        }
    }
    if (used > 0) {
        (void)snprintf(out + used, size - used, "OPTIONS");
    }
}

static bool is_listed(const char *const *names, const char *name)
{
    for (int i = 0; names != NULL && names[i] != NULL; i++) {
        if (strcmp(names[i], name) == 0) {
            return true;
        }
    }
    return false;
}

/* Reports a key nobody knows, and a key given twice. */
static void check_key(const struct api_call *call, int index, struct failure_list *errors)
{
    const struct api_query *query = call->req->query;
    const char *const *known = call->route->query;
    bool twin = false;
    for (int j = 0; j < index; j++) {
        twin = twin || strcmp(query[j].key, query[index].key) == 0;
    }
    const bool is_known = is_listed(known, query[index].key);
    if (is_known && !twin) {
        return;
    }
    char pointer[160];
    char expected[128] = "no parameters";
    (void)snprintf(pointer, sizeof pointer, "?%s", query[index].key);
    if (known != NULL) {
        reader_join(known, sizeof expected, expected);
    }
    failure_set(failure_add(errors), ST_INVALID, pointer,
                is_known ? "duplicate_key" : "unknown_key", expected, NULL,
                is_known ? "the parameter is given twice" : "there is no such parameter");
}

static bool query_is_known(const struct api_call *call, struct api_response *res)
{
    if (call->req->n_query == 0) {
        return true;
    }
    struct failure_list *errors = calloc(1, sizeof *errors);
    if (errors == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return false;
    }
    for (int i = 0; i < call->req->n_query; i++) {
        check_key(call, i, errors);
    }
    const bool ok = errors->total == 0;
    if (!ok) {
        problem_response(res, PROBLEM_BAD_QUERY, errors->item[0].detail, errors, NULL);
    }
    free(errors);
    return ok;
}

static void answer(struct api_call *call, struct api_response *res)
{
    const struct api_request *req = call->req;
    char allow[96];
    char detail[400];
    struct path_part part[PATH_PARAMS_MAX];
    for (const struct route *t = route_table; t->method != NULL; t++) {
        if (!method_is(t, req->method) || !path_matches(t->path, req->path, part)) {
            continue;
        }
        call->route = t;
        if (!text_percent_decode(req->path + part[0].at, part[0].n, sizeof call->param,
                                 call->param) ||
            !text_percent_decode(req->path + part[1].at, part[1].n, sizeof call->tail,
                                 call->tail)) {
            problem_response(res, PROBLEM_BAD_PATH, "broken percent-encoding or name too long",
                             NULL, NULL);
        } else if (query_is_known(call, res)) {
            t->handler(call, res);
        }
        return;
    }
    allowed_methods(req->path, sizeof allow, allow);
    if (allow[0] == '\0') {
        (void)snprintf(detail, sizeof detail,
                       "there is nothing at \"%.200s\"; /openapi.json lists what there is",
                       req->path);
        problem_response(res, PROBLEM_UNKNOWN_PATH, detail, NULL, NULL);
        return;
    }
    if (strcmp(req->method, "OPTIONS") == 0) {
        res->status = 204;
    } else {
        (void)snprintf(detail, sizeof detail, "%.20s is not among: %s", req->method, allow);
        problem_response(res, PROBLEM_METHOD, detail, NULL, NULL);
    }
    api_response_header(res, "Allow", "%s", allow);
}

void router_handle(const struct api *api, const struct api_request *req, struct api_reply *reply)
{
    assert(api != NULL && req != NULL && reply != NULL);
    struct api_call call = {.api = api, .req = req, .reply = reply};
    struct api_response res = {0};
    if (req->body_size > router_body_max(req->method, req->path)) {
        problem_response(&res, PROBLEM_TOO_LARGE, "the body is over the limit", NULL, NULL);
    } else {
        answer(&call, &res);
    }
    if (res.status != 0) {
        reply->send(reply, &res);
    }
}
