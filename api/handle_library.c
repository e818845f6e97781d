/* GET /v1/materials, /v1/polars, /v1/networks and their entries. */
#include "api/respond.h"

#include <stdio.h>
#include <string.h>

/* The list when the path has no name, otherwise one entry. */
static void answer(const struct api_call *call, struct api_response *res, const char *what,
                   bool known, char *(*json)(const struct library *lib, const char *name))
{
    const char *name = call->param[0] != '\0' ? call->param : NULL;
    if (name != NULL && !known) {
        char detail[160 + sizeof call->param];
        (void)snprintf(detail, sizeof detail, "the library has no %s \"%s\"; /v1/%ss lists them",
                       what, name, what);
        problem_response(res, PROBLEM_UNKNOWN_NAME, detail, NULL, NULL);
        return;
    }
    char *body = json(call->api->library, name);
    respond_tagged(call, res, "application/json", respond_revalidate, body,
                   body != NULL ? strlen(body) : 0);
}

void handle_materials(const struct api_call *call, struct api_response *res)
{
    answer(call, res, "material", library_material(call->api->library, call->param) != NULL,
           library_materials_json);
}

void handle_polars(const struct api_call *call, struct api_response *res)
{
    answer(call, res, "polar", library_polar(call->api->library, call->param) != NULL,
           library_polars_json);
}

void handle_networks(const struct api_call *call, struct api_response *res)
{
    answer(call, res, "network", library_network(call->api->library, call->param) != NULL,
           library_networks_json);
}
