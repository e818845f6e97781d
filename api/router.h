/* api/router.h
 * The whole contract as one function: request in, one reply out. */
#ifndef AEROM_API_ROUTER_H
#define AEROM_API_ROUTER_H

#include "api/http_msg.h"
#include "api/library.h"
#include "api/service.h"

struct api {
    const struct library *library;
    const struct service *service;
    const struct shelf *shelf; /* NULL: nothing can be added to the library */
};

/* Largest accepted body in bytes for a method and path: the adaptor refuses more with 413 before
 * it buffers it (router_problem makes the answer). */
size_t router_body_max(const char *method, const char *path);

/* Answers one request; reply->send is called exactly once, now or later. `req` is borrowed for the
 * call only. */
void router_handle(const struct api *api, const struct api_request *req, struct api_reply *reply);

/* A problem+json response (RFC 9457) for failures the adaptor itself finds: 413, 500, ... */
void router_problem(struct api_response *out, int http_status, const char *code,
                    const char *detail);

#endif
