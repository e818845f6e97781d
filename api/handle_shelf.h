/* api/handle_shelf.h
 * What the handlers of library entries share. Inside api only. */
#ifndef AEROM_API_HANDLE_SHELF_H
#define AEROM_API_HANDLE_SHELF_H

#include "api/route.h"
#include "api/shelf.h"

/* A checked entry for the shelf; head and data are malloc'ed, NULL when memory ran out. */
struct shelf_new {
    const char *name;
    char hash[LIMIT_HASH];
    char *head;
    void *data;
    size_t size;
};

/* Puts it, taking head and data; the answer is 201, or 200 when its content was there. */
void shelf_put_new(const struct api_call *call, struct api_response *res, enum shelf_kind kind,
                   const struct shelf_new *entry);
/* Deletes the version, or all versions, that path and query name. */
void shelf_remove(const struct api_call *call, struct api_response *res, enum shelf_kind kind,
                  bool built_in);

/* Answers that there is no such entry. */
void shelf_unknown(struct api_response *res, enum shelf_kind kind, const char *name);
/* Whether a user may give this name; otherwise the answer is given. */
bool shelf_name_is_free(struct api_response *res, bool built_in, const char *name);
/* version=N of the query, 0 when absent; false when the answer is given. */
bool shelf_query_version(const struct api_call *call, struct api_response *res, int *version);

#endif
