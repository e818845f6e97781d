/* cli/source.h
 * Polars and networks named by options: of the shipped library, or of a file.
 *
 * A struct sources owns what it read; entries are valid until sources_done. */
#ifndef AEROM_CLI_SOURCE_H
#define AEROM_CLI_SOURCE_H

#include "api/entry.h"
#include "api/library.h"
#include "core/case_def.h"

struct sources {
    struct library *library;
    struct entry_set own; /* at most one polar and one network */
};

/* On failure a line has gone to stderr. */
bool sources_init(struct sources *s);
/* Accepts a zeroed struct. */
void sources_done(struct sources *s);

/* NAME of the library or FILE.json; NULL the default polar. On failure lines have gone to stderr.
 */
bool source_polar(const char *name, struct sources *s, struct failure_list *problems,
                  const struct polar_def **out);
bool source_network(const char *name, struct sources *s, struct failure_list *problems,
                    const struct network_def **out);
/* The dynamic model of --dynamic and --network, either of them NULL when not given, on a polar;
 * "network:NAME" says both at once; with `force` also a network that was trained on another one. On
 * failure lines have gone to stderr. */
bool source_dynamic(const char *dynamic, const char *network, bool force,
                    const struct polar_def *polar, struct sources *s, struct failure_list *problems,
                    enum dynamic_type *type, const struct network_def **out);

#endif
