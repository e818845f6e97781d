/* cli/report.h
 * Documents of the contract as text for people. */
#ifndef AEROM_CLI_REPORT_H
#define AEROM_CLI_REPORT_H

#include "core/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Everything that is wrong with one case: one line each, with its place, what was expected and
 * what was got. `source` names the file. */
void report_failures(FILE *out, const char *source, const struct failure_list *list);

/* A problem+json answer in the same form; any other text is shown as it is. */
void report_problem(FILE *out, const char *source, long http_status, const char *body, size_t size);

/* A summary document as a short table: verdict, modes, means, damping. False (with a line on
 * stderr) when the text is no summary. */
bool report_summary(FILE *out, const char *json, size_t size);

#endif
