#include "cli/source.h"

#include "cli/file.h"
#include "cli/report.h"

#include "api/case.h"
#include "api/router.h"

#include <stdlib.h>
#include <string.h>

static const char *const polar_default = "plate-4pct-channel";

bool sources_init(struct sources *s)
{
    struct failure fail = {0};
    *s = (struct sources){0};
    if (library_create_builtin(&s->library, &fail) != ST_OK) {
        (void)fprintf(stderr, "aerom: shipped library: %s: %s\n", fail.pointer, fail.detail);
        return false;
    }
    return true;
}

void sources_done(struct sources *s)
{
    entry_set_done(&s->own);
    library_destroy(s->library);
    *s = (struct sources){0};
}

static bool is_file(const char *name)
{
    const size_t length = strlen(name);
    return length > 5 && strcmp(name + length - 5, ".json") == 0;
}

static bool read_file(const char *file, entry_reader read_one, struct sources *s,
                      struct failure_list *problems)
{
    char *text = NULL;
    size_t size = 0;
    if (!file_read(file, router_body_max("POST", "/v1/jobs"), &text, &size)) {
        return false;
    }
    const enum status st = entry_parse(text, size, read_one, &s->own, problems);
    free(text);
    if (st != ST_OK) {
        report_failures(stderr, file, problems);
    }
    return st == ST_OK;
}

bool source_polar(const char *name, struct sources *s, struct failure_list *problems,
                  const struct polar_def **out)
{
    if (name != NULL && is_file(name)) {
        if (!read_file(name, entry_read_polar, s, problems)) {
            return false;
        }
        *out = &s->own.polar[0].def;
        return true;
    }
    *out = library_polar(s->library, name != NULL ? name : polar_default);
    if (*out == NULL) {
        (void)fprintf(stderr, "aerom: --polar: the library has no polar '%s'\n", name);
    }
    return *out != NULL;
}

bool source_network(const char *name, struct sources *s, struct failure_list *problems,
                    const struct network_def **out)
{
    if (is_file(name)) {
        if (!read_file(name, entry_read_network, s, problems)) {
            return false;
        }
        *out = &s->own.network[0].def;
        return true;
    }
    *out = library_network(s->library, name);
    if (*out == NULL) {
        (void)fprintf(stderr, "aerom: --network: the library has no network '%s'\n", name);
    }
    return *out != NULL;
}

bool source_dynamic(const char *dynamic, const char *network, bool force,
                    const struct polar_def *polar, struct sources *s, struct failure_list *problems,
                    enum dynamic_type *type, const struct network_def **out)
{
    static const char named[] = "network:"; /* short for both options */
    if (dynamic != NULL && network == NULL && strncmp(dynamic, named, sizeof named - 1) == 0) {
        network = dynamic + sizeof named - 1;
        dynamic = "network";
    }
    if (dynamic != NULL && !dynamic_type_parse(dynamic, type)) {
        (void)fprintf(stderr,
                      "aerom: --dynamic: '%s' is not one of none, network, network:NAME, "
                      "attached, dynamic_stall\n",
                      dynamic);
        return false;
    }
    if ((*type == DYNAMIC_NETWORK) != (network != NULL)) {
        (void)fprintf(stderr, "aerom: --network goes with, and only with, --dynamic network\n");
        return false;
    }
    if (network == NULL) {
        return true;
    }
    if (!source_network(network, s, problems, out)) {
        return false;
    }
    if (!force && network_def_is_of_other_polar(*out, polar->hash)) {
        (void)fprintf(stderr,
                      "aerom: --network: '%s' was trained on another polar than '%s'; --force "
                      "takes it nevertheless\n",
                      (*out)->name, polar->name);
        return false;
    }
    return true;
}
