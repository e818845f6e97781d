/* server/uri.h
 * Splits the target of a request into path and query. Pure functions, safe from any thread. */
#ifndef AEROM_SERVER_URI_H
#define AEROM_SERVER_URI_H

#include "api/http_msg.h"

enum uri_status { URI_OK, URI_BAD, URI_TOO_MANY };

/* Cuts `target` in place: req->path and the query items point into it, keys and values
 * percent-decoded ('+' is a space). URI_BAD: not starting with '/', a malformed or zero escape,
 * a control character. URI_TOO_MANY: more than API_QUERY_MAX items. */
enum uri_status uri_split(char *target, struct api_request *req);

#endif
