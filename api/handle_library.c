/* GET /v1/materials, /v1/polars, /v1/networks and their entries. */
#include "api/respond.h"

#include <stdio.h>
#include <string.h>

/* The list when the path has no name, otherwise one entry. */
static void answer(const struct api_call *call, struct api_response *res, const char *what,
                   char *(*json)(const struct library *lib, const char *name))
{
    const char *name = call->param[0] != '\0' ? call->param : NULL;
    char *body = json(call->api->library, name);
    if (body == NULL && name != NULL) {
        char detail[160 + sizeof call->param];
        (void)snprintf(detail, sizeof detail, "the library has no %s \"%s\"; /v1/%ss lists them",
                       what, name, what);
        problem_response(res, PROBLEM_UNKNOWN_NAME, detail, NULL, NULL);
        return;
    }
    respond_tagged(call, res, "application/json", respond_revalidate, body,
                   body != NULL ? strlen(body) : 0);
}

void handle_materials(const struct api_call *call, struct api_response *res)
{
    answer(call, res, "material", library_materials_json);
}

void handle_polars(const struct api_call *call, struct api_response *res)
{
    answer(call, res, "polar", library_polars_json);
}

void handle_networks(const struct api_call *call, struct api_response *res)
{
    answer(call, res, "network", library_networks_json);
}
