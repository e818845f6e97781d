/* Any request: "METHOD TARGET CONTENT-TYPE\nbody". Exactly one answer comes, with a status of the
 * contract, and a JSON body is JSON. */
#include "api/json.h"
#include "tests/api/fake_service.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { HEAD_MAX = 900 };

static struct fake *fake;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    fake = fake_create();
    return 0;
}

static void check_answer(void)
{
    static const int known[] = {200, 202, 204, 304, 400, 404, 405, 409, 413, 415, 422};
    const struct api_response *res = &fake->answer;
    bool ok = false;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        ok = ok || known[i] == res->status;
    }
    struct cJSON *tree = NULL;
    struct failure fail;
    if (res->body != NULL && strstr(res->content_type, "json") != NULL) {
        ok = ok && json_parse(res->body, res->body_size, &tree, &fail) == ST_OK;
        json_free(tree);
    }
    if (!ok) {
        (void)fprintf(stderr, "status %d, body %s\n", res->status, res->body);
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char head[HEAD_MAX + 1];
    const uint8_t *newline = size > 0 ? memchr(data, '\n', size) : NULL;
    const size_t n = newline != NULL ? (size_t)(newline - data) : size;
    if (n > HEAD_MAX) {
        return 0;
    }
    memcpy(head, data, n);
    head[n] = '\0';
    char *rest = head;
    const char *part[3] = {"", "", ""};
    for (int i = 0; i < 3 && rest != NULL; i++) {
        part[i] = rest;
        char *space = strchr(rest, ' ');
        if (space != NULL) {
            *space = '\0';
        }
        rest = space != NULL ? space + 1 : NULL;
    }
    fake_reset(fake);
    (void)fake_add(fake, CASE_SIMULATION, JOB_DONE, "a");
    (void)fake_add(fake, CASE_MODES, JOB_QUEUED, "b");
    const size_t body_size = newline != NULL ? size - n - 1 : 0;
    char *body = malloc(body_size > 0 ? body_size : 1);
    memcpy(body, newline != NULL ? newline + 1 : data, body_size);
    (void)fake_send(fake, part[0], part[1], part[2], body, body_size);
    check_answer();
    free(body);
    return 0;
}
