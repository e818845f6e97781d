/* api/result_parts.h
 * What the result documents are put together from. Inside api only; values and borrowed pointers.
 *
 * `_members` functions print into an object already begun. */
#ifndef AEROM_API_RESULT_PARTS_H
#define AEROM_API_RESULT_PARTS_H

#include "api/json_out.h"
#include "api/result.h"
#include "core/coupling/model.h"

/* What a document is written from. */
struct result_view {
    const struct api_case *c;
    const struct case_def *def;
    const struct sim_result *r;
    const struct run_timing *timing;
};

/* Documents. */
void result_write_loads(struct json_out *out, const struct result_view *v);
void result_write_modes(struct json_out *out, const struct result_view *v);
void result_write_section(struct json_out *out, const struct result_view *v);
void result_write_static(struct json_out *out, const struct result_view *v);
void result_write_stability(struct json_out *out, const struct result_view *v);

/* The modes in full: "modes". */
void result_modes_members(struct json_out *out, const struct result_view *v);
/* Matrices and their orders. */
void result_matrix_members(struct json_out *out, const struct section_result *s);
/* The scalars that describe a section: stiffnesses, centres, couplings. */
void result_section_members(struct json_out *out, const struct section_result *s);
/* Verdict, divergence, flutter, least damped oscillation. */
void result_stability_members(struct json_out *out, const struct result_view *v);
/* Work, shares of the steps outside polar and hull, extremes of the coefficients. */
void result_loop_members(struct json_out *out, const struct result_view *v);
/* Motion of the tip, reactions, first-ply failure. */
void result_static_members(struct json_out *out, const struct result_view *v);

#endif
