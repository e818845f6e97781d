/* api/route.h
 * The route table and what a handler gets. Inside api only. */
#ifndef AEROM_API_ROUTE_H
#define AEROM_API_ROUTE_H

#include "api/problem.h"
#include "api/router.h"

enum { ROUTE_PARAM_SIZE = 256 };

struct api_call {
    const struct api *api;
    const struct api_request *req;
    struct api_reply *reply;
    const struct route *route;
    char param[ROUTE_PARAM_SIZE]; /* decoded {id} or {name}, "" when the path has none */
    char tail[ROUTE_PARAM_SIZE];  /* the second parameter of a path that has two, else "" */
};

/* Fills *res, which the router sends; or leaves res->status 0 and sends its own answer to
 * call->reply later. `call` and `res` live only until the handler returns. */
typedef void (*route_handler)(const struct api_call *call, struct api_response *res);

struct route {
    const char *method;
    const char *path; /* as in the OpenAPI document: {name} is the rest, others one segment */
    route_handler handler;
    const char *const *query; /* keys the route knows; NULL = none; ends with NULL */
    const char *document;     /* result routes: the document they show */
};

extern const struct route route_table[]; /* ends with a NULL method */

/* handle_submit.c */
void handle_submit(const struct api_call *call, struct api_response *res);
void handle_study_submit(const struct api_call *call, struct api_response *res);
/* handle_study.c; the study is the caller's */
struct study;
void study_submit(const struct api_call *call, struct study *study, struct api_response *res);
bool study_find(const struct api_call *call, struct api_response *res, struct job_record *job,
                struct service_study *study);
struct study *study_of_job(const struct api_call *call, struct api_response *res, const char *id);
/* Shows every finished cell with its summary, NULL when it has none, or with what of it the n paths
 * lead to (study_value_parse; n 0: all); `visit` keeps a summary by setting it to NULL.
 * SERVICE_ERROR: one could not be read, or the store failed. */
typedef void (*study_visit)(void *arg, const struct service_cell *c, struct cJSON **summary);
enum service_status study_each_cell(const struct service *s, const char *id, int n,
                                    const char *const *path, study_visit visit, void *arg);
void handle_study(const struct api_call *call, struct api_response *res);
void handle_cells(const struct api_call *call, struct api_response *res);
void handle_cell(const struct api_call *call, struct api_response *res);
/* handle_search.c */
void handle_search(const struct api_call *call, struct api_response *res);
/* handle_map.c */
void handle_map(const struct api_call *call, struct api_response *res);
/* handle_jobs.c */
void handle_list(const struct api_call *call, struct api_response *res);
void handle_study_list(const struct api_call *call, struct api_response *res);
void handle_get(const struct api_call *call, struct api_response *res);
void handle_cancel(const struct api_call *call, struct api_response *res);
/* handle_result.c */
void handle_case(const struct api_call *call, struct api_response *res);
void handle_document(const struct api_call *call, struct api_response *res);
/* handle_series.c */
void handle_series(const struct api_call *call, struct api_response *res);
/* handle_library.c */
void handle_materials(const struct api_call *call, struct api_response *res);
void handle_polars(const struct api_call *call, struct api_response *res);
void handle_networks(const struct api_call *call, struct api_response *res);
void handle_add_material(const struct api_call *call, struct api_response *res);
void handle_add_polar(const struct api_call *call, struct api_response *res);
void handle_add_network(const struct api_call *call, struct api_response *res);
void handle_remove_material(const struct api_call *call, struct api_response *res);
void handle_remove_polar(const struct api_call *call, struct api_response *res);
void handle_remove_network(const struct api_call *call, struct api_response *res);
/* handle_datasets.c */
void handle_datasets(const struct api_call *call, struct api_response *res);
void handle_dataset(const struct api_call *call, struct api_response *res);
void handle_add_dataset(const struct api_call *call, struct api_response *res);
void handle_remove_dataset(const struct api_call *call, struct api_response *res);
/* handle_meta.c */
void handle_health(const struct api_call *call, struct api_response *res);
void handle_ready(const struct api_call *call, struct api_response *res);
void handle_openapi(const struct api_call *call, struct api_response *res);

#endif
