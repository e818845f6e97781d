/* Health, readiness, and the OpenAPI document. */
#include "api/embedded.h"
#include "api/respond.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

void handle_health(const struct api_call *call, struct api_response *res)
{
    struct json_out out = {0};
    (void)call;
    json_object_begin(&out);
    json_key_string(&out, "status", "ok");
    json_key_string(&out, "version", AEROM_VERSION);
    json_key_string(&out, "core_version", AEROM_CORE_VERSION);
    json_object_end(&out);
    respond_json(res, 200, &out);
}

void handle_ready(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    const char *why = "";
    if (!s->ready(s->ctx, &why)) {
        problem_response(res, PROBLEM_BUSY, why, NULL, NULL);
        return;
    }
    struct json_out out = {0};
    json_object_begin(&out);
    json_key_string(&out, "status", "ready");
    json_object_end(&out);
    respond_json(res, 200, &out);
}

void handle_openapi(const struct api_call *call, struct api_response *res)
{
    assert(openapi_file_count == 1);
    const size_t size = embedded_size(&openapi_files[0]);
    char *body = malloc(size + 1);
    if (body != NULL) {
        memcpy(body, openapi_files[0].data, size + 1);
    }
    respond_tagged(call, res, "application/json", respond_revalidate, body, size);
}
