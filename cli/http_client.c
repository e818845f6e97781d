#include "cli/http_client.h"

#include <curl/curl.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CONNECT_TIMEOUT_S = 10,
    STALL_S = 60, /* an answer that does not move for so long is given up */
    URL_MAX = 2048
};

struct http_client {
    CURL *curl;
    struct curl_slist *json_headers;
    char url[URL_MAX];
    char error[CURL_ERROR_SIZE];
};

struct http_client *http_client_create(const char *url)
{
    if (strlen(url) >= URL_MAX / 2 || curl_global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK) {
        return NULL;
    }
    struct http_client *client = calloc(1, sizeof *client);
    if (client == NULL) {
        goto out;
    }
    (void)snprintf(client->url, sizeof client->url, "%s", url);
    for (size_t n = strlen(client->url); n > 0 && client->url[n - 1] == '/'; n--) {
        client->url[n - 1] = '\0';
    }
    client->curl = curl_easy_init();
    client->json_headers = curl_slist_append(NULL, "Content-Type: application/json");
    if (client->curl != NULL && client->json_headers != NULL) {
        return client;
    }
out:
    http_client_destroy(client);
    return NULL;
}

void http_client_destroy(struct http_client *client)
{
    if (client != NULL) {
        curl_easy_cleanup(client->curl);
        curl_slist_free_all(client->json_headers);
        free(client);
    }
    curl_global_cleanup();
}

static size_t append(char *data, size_t unit, size_t count, void *arg)
{
    struct http_answer *answer = arg;
    const size_t size = unit * count;
    char *larger = realloc(answer->body, answer->size + size + 1);
    if (larger == NULL) {
        return 0;
    }
    memcpy(larger + answer->size, data, size);
    answer->body = larger;
    answer->size += size;
    answer->body[answer->size] = '\0';
    return size;
}

static void prepare(struct http_client *client, const char *method, const char *url,
                    const char *body, size_t size, struct http_answer *answer)
{
    CURL *curl = client->curl;
    curl_easy_reset(curl);
    client->error[0] = '\0';
    (void)curl_easy_setopt(curl, CURLOPT_URL, url);
    (void)curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
    (void)curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
    (void)curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, (long)CONNECT_TIMEOUT_S);
    (void)curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1L);
    (void)curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, (long)STALL_S);
    (void)curl_easy_setopt(curl, CURLOPT_ACCEPT_ENCODING, "");
    (void)curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, client->error);
    (void)curl_easy_setopt(curl, CURLOPT_USERAGENT, "aerom/" AEROM_VERSION);
    (void)curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, append);
    (void)curl_easy_setopt(curl, CURLOPT_WRITEDATA, answer);
    if (body != NULL) {
        (void)curl_easy_setopt(curl, CURLOPT_POST, 1L);
        (void)curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body);
        (void)curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, (curl_off_t)size);
        (void)curl_easy_setopt(curl, CURLOPT_HTTPHEADER, client->json_headers);
    }
    (void)curl_easy_setopt(curl, CURLOPT_CUSTOMREQUEST, method);
}

bool http_client_request(struct http_client *client, const char *method, const char *path,
                         const char *body, size_t size, struct http_answer *answer)
{
    struct http_answer received = {.body = calloc(1, 1)};
    char url[2 * URL_MAX];
    const int length = snprintf(url, sizeof url, "%s%s", client->url, path);
    if (received.body == NULL || length < 0 || (size_t)length >= sizeof url) {
        (void)fprintf(stderr, "aerom: the request is too long\n");
        goto out;
    }
    prepare(client, method, url, body, size, &received);
    const CURLcode code = curl_easy_perform(client->curl);
    if (code != CURLE_OK) {
        (void)fprintf(stderr, "aerom: %s: %s\n", client->url,
                      client->error[0] != '\0' ? client->error : curl_easy_strerror(code));
        goto out;
    }
    (void)curl_easy_getinfo(client->curl, CURLINFO_RESPONSE_CODE, &received.status);
    *answer = received;
    return true;
out:
    http_answer_done(&received);
    return false;
}

void http_answer_done(struct http_answer *answer)
{
    free(answer->body);
    *answer = (struct http_answer){0};
}
