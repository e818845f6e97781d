/* api/result.h
 * Results of a run as JSON documents (contract, "The summary of a simulation"). */
#ifndef AEROM_API_RESULT_H
#define AEROM_API_RESULT_H

#include "api/case.h"
#include "core/sim.h"

/* What only the caller can measure: the core has no clock. */
struct run_timing {
    double cpu_s; /* processor time of sim_create + sim_run on the running thread */
};

/* Documents a kind of case produces, as a NULL-terminated list: simulation: "summary" "damping"
 * "loads" "modes" "section"; modes: "summary" "modes" "section"; section: "summary" "section";
 * static: "summary" "static" "section"; stability: "summary" "stability" "modes" "section";
 * loop: "summary"; training: "summary" "training" "network", which training_out.h makes. */
const char *const *result_documents(enum case_kind kind);

/* One document as malloc'ed JSON text; NULL only when out of memory. */
char *result_document(const char *document, const struct api_case *c, const struct sim_result *r,
                      const struct run_timing *timing);

#endif
