/* tests/server/cases.h
 * Small cases for tests that run the core. Include after <cmocka.h>. */
#ifndef AEROM_TESTS_SERVER_CASES_H
#define AEROM_TESTS_SERVER_CASES_H

#include "api/case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CASE_TEXT = 1024 };

#define PAPER_SECTION                                                                              \
    "\"section\":{\"type\":\"strip\",\"chord_m\":0.1,\"layup\":["                                  \
    "{\"material\":\"AS4/3501-6\",\"angle_deg\":-45,\"thickness_m\":0.00013},"                     \
    "{\"material\":\"foam\",\"thickness_m\":0.00387}]}"

static const char section_case[] =
    "{\"schema_version\":1,\"kind\":\"section\",\"beam\":{" PAPER_SECTION "}}";

/* The paper's beam at a speed [m/s] for a duration [s]; five recorded columns. */
static inline void case_text(char out[CASE_TEXT], double speed, double duration)
{
    (void)snprintf(out, CASE_TEXT,
                   "{\"schema_version\":1,\"kind\":\"simulation\",\"beam\":{\"length_m\":0.37,"
                   "\"elements\":8," PAPER_SECTION "},"
                   "\"flow\":{\"speed_m_s\":%.9g,\"incidence_deg\":5},"
                   "\"aerodynamics\":{\"polar\":\"flat-plate-linear\"},"
                   "\"solver\":{\"modes\":3,\"duration_s\":%.9g},"
                   "\"output\":{\"channels\":[\"tip_plunge_m\",\"tip_twist_deg\","
                   "\"modal_amplitude\"]}}",
                   speed, duration);
}

static inline struct api_case *parse_case(const struct library *lib, const char *text)
{
    struct failure_list *problems = calloc(1, sizeof *problems);
    struct api_case *c = NULL;
    assert_non_null(problems);
    if (api_case_parse(lib, text, strlen(text), "", &c, problems) != ST_OK) {
        print_error("%s: %s\n", problems->item[0].pointer, problems->item[0].detail);
        fail();
    }
    free(problems);
    return c;
}

#endif
