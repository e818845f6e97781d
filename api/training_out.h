/* api/training_out.h
 * A case of kind training from its dataset to what it leaves: result documents, and the network as
 * an entry of the library.
 *
 * One thread a run. The library is only read. */
#ifndef AEROM_API_TRAINING_OUT_H
#define AEROM_API_TRAINING_OUT_H

#include "api/case.h"
#include "api/result.h"
#include "api/shelf.h"
#include "core/control.h"

struct training_out;

/* Trains. ST_CANCELLED when the flag was raised; otherwise *fail says why. */
MUST_CHECK enum status training_compute(const struct api_case *c, const struct sim_control *control,
                                        struct training_out **out, struct failure *fail);
/* "summary" "training" "network" as malloc'ed JSON text; NULL only when out of memory. */
char *training_document(const char *document, const struct training_out *t,
                        const struct run_timing *timing);
/* The network for the shelf; its texts live as long as the result. */
struct shelf_item training_item(const struct training_out *t);
/* Accepts NULL. */
void training_out_destroy(struct training_out *t);

#endif
