/* Any bytes as a case: refused with a reason, or taken with a canonical text that is stable. What
 * the scan takes, cJSON must take. */
#include "api/case.h"
#include "api/json.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static struct library *library;
static struct failure_list problems;

#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            (void)fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                  \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    struct failure fail;
    (void)argc;
    (void)argv;
    REQUIRE(library_create_builtin(&library, &fail) == ST_OK);
    return 0;
}

static struct api_case *parse(const char *text, size_t size)
{
    struct api_case *c = NULL;
    problems.count = problems.total = 0;
    const enum status st = api_case_parse(library, text, size, "", &c, &problems);
    REQUIRE((st == ST_OK) == (c != NULL));
    REQUIRE((st == ST_OK) == (problems.total == 0));
    for (int i = 0; i < problems.count; i++) {
        REQUIRE(problems.item[i].code[0] != '\0');
        REQUIRE(problems.item[i].detail[0] != '\0');
    }
    return c;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* A copy of the exact size, so that reading past its end is seen. */
    char *text = malloc(size > 0 ? size : 1);
    struct cJSON *tree = NULL;
    struct failure fail;
    memcpy(text, data, size);
    if (json_scan(text, size, &fail) == ST_OK) {
        REQUIRE(json_parse(text, size, &tree, &fail) == ST_OK);
        json_free(tree);
    }
    struct api_case *first = parse(text, size);
    free(text);
    if (first != NULL) {
        struct api_case *second =
            parse(api_case_canonical(first), strlen(api_case_canonical(first)));
        REQUIRE(second != NULL);
        REQUIRE(strcmp(api_case_canonical(first), api_case_canonical(second)) == 0);
        REQUIRE(strcmp(api_case_hash(first), api_case_hash(second)) == 0);
        api_case_destroy(second);
    }
    api_case_destroy(first);
    return 0;
}
