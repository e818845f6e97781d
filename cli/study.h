/* cli/study.h
 * aerom run of a study: its cells computed in this process, on all cores. */
#ifndef AEROM_CLI_STUDY_H
#define AEROM_CLI_STUDY_H

#include "api/library.h"
#include "cli/options.h"

/* Whether a text is a study; one that is no JSON is none. */
bool study_text(const char *text, size_t size);

/* Computes the study and prints the map of --value as GET /v1/studies/{id}/map gives it. Cells that
 * fail are named on stderr and do not fail the study. On failure a line has gone to stderr. */
bool study_run(const struct options *o, const struct library *lib, const char *text, size_t size);

#endif
