/* GET /v1/jobs/{id}/series. */
#include "api/respond.h"
#include "api/series_out.h"
#include "api/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    POINTS_MIN = 2,
    POINTS_MAX = 100000,
    CHANNELS_MAX = LIMIT_CHANNEL_COLUMNS,
    VALUES_MAX = 4000000 /* numbers of one answer: about 80 MB of text */
};

struct series_query {
    char *names; /* owned: the list of channels, cut at its commas */
    int n_channel;
    const char *channel[CHANNELS_MAX];
    double from, to; /* [s] */
    int points;      /* 0 = every sample */
    bool csv;
};

static void refuse_parameter(struct failure_list *errors, const char *key, const char *code,
                             const char *expected, const char *got)
{
    char pointer[64];
    char text[96];
    (void)snprintf(pointer, sizeof pointer, "?%s", key);
    (void)snprintf(text, sizeof text, "\"%.80s\"", got);
    failure_set(failure_add(errors), ST_INVALID, pointer, code, expected, text,
                "the parameter \"%s\" must be %s", key, expected);
}

/* Cuts "a,b" at its commas; an empty name is refused. False when out of memory. */
static bool read_channels(const char *list, struct series_query *q, struct failure_list *errors)
{
    if (list == NULL) {
        return true;
    }
    q->names = strdup(list);
    if (q->names == NULL) {
        return false;
    }
    char *name = q->names;
    bool ok = true;
    while (ok && name != NULL) {
        char *comma = strchr(name, ',');
        if (comma != NULL) {
            *comma = '\0';
        }
        ok = *name != '\0' && q->n_channel < CHANNELS_MAX;
        if (ok) {
            q->channel[q->n_channel++] = name;
        }
        name = comma != NULL ? comma + 1 : NULL;
    }
    if (!ok) {
        refuse_parameter(errors, "channels", list[0] == '\0' ? "empty_list" : "out_of_range",
                         "names with commas between them", list);
    }
    return true;
}

static double read_number(const struct api_request *req, const char *key, double value,
                          struct failure_list *errors)
{
    const char *text = api_query_get(req, key);
    if (text != NULL && !text_number(text, &value)) {
        refuse_parameter(errors, key, "out_of_range", "a number", text);
    }
    return value;
}

/* False when out of memory; what is wrong goes to the list. */
static bool read_query(const struct api_request *req, struct series_query *q,
                       struct failure_list *errors)
{
    const char *format = api_query_get(req, "format");
    const char *points = api_query_get(req, "points");
    q->n_channel = 0;
    q->names = NULL;
    if (!read_channels(api_query_get(req, "channels"), q, errors)) {
        return false;
    }
    q->from = read_number(req, "from_s", (double)-INFINITY, errors);
    q->to = read_number(req, "to_s", (double)INFINITY, errors);
    if (q->from > q->to) {
        refuse_parameter(errors, "to_s", "out_of_range", "at least from_s",
                         api_query_get(req, "to_s"));
    }
    double n = 0.0;
    if (points != NULL &&
        (!text_number(points, &n) || n != floor(n) || n < POINTS_MIN || n > POINTS_MAX)) {
        refuse_parameter(errors, "points", "out_of_range", "an integer from 2 to 100000", points);
        n = 0.0;
    }
    q->points = (int)n;
    q->csv = format != NULL ? strcmp(format, "csv") == 0
                            : text_accept_weight(req->accept, "text/csv") >
                                  text_accept_weight(req->accept, "application/json");
    if (format != NULL && !q->csv && strcmp(format, "json") != 0) {
        refuse_parameter(errors, "format", "unknown_value", "json or csv", format);
    }
    return true;
}

/* An unknown channel: the answer lists what was recorded. */
static void refuse_channel(const struct api_call *call, struct api_response *res, const char *id,
                           const char *name, struct failure_list *errors)
{
    const struct service *s = call->api->service;
    char(*column)[64] = NULL;
    int n = 0;
    char expected[256] = "";
    size_t used = 0;
    if (s->get_columns(s->ctx, id, &column, &n) == SERVICE_OK) {
        for (int i = 0; i < n && used + 70 < sizeof expected; i++) {
            used += (size_t)snprintf(expected + used, sizeof expected - used, "%s%.63s",
                                     i > 0 ? " " : "", column[i]);
        }
    }
    free(column);
    char got[96];
    (void)snprintf(got, sizeof got, "\"%.80s\"", name);
    failure_set(failure_add(errors), ST_INVALID, "?channels", "unknown_channel",
                "a recorded channel", got, "%s is not recorded; recorded are: %.120s", got,
                expected);
    problem_response(res, PROBLEM_BAD_QUERY, errors->item[0].detail, errors, NULL);
}

static void fill_series(const struct api_call *call, struct api_response *res,
                        const struct series_query *q, const struct series_data *data)
{
    const int rows = q->points > 0 && data->n > q->points ? q->points : data->n;
    struct json_out out = {0};
    if ((long long)rows * data->n_column > VALUES_MAX) {
        char detail[160];
        (void)snprintf(detail, sizeof detail,
                       "%d samples of %d columns are too many for one answer (%d values): use "
                       "points, channels, from_s and to_s",
                       rows, data->n_column, VALUES_MAX);
        problem_response(res, PROBLEM_BAD_QUERY, detail, NULL, NULL);
        return;
    }
    if (q->csv) {
        series_out_csv(&out, data, q->points);
    } else {
        series_out_json(&out, data, q->points);
    }
    size_t size = 0;
    char *body = json_out_take(&out, &size);
    api_response_header(res, "Vary", "Accept");
    respond_tagged(call, res,
                   q->csv ? "text/csv; charset=utf-8; header=present" : "application/json",
                   respond_immutable, body, size);
}

static void answer(const struct api_call *call, struct api_response *res,
                   const struct job_record *job, const struct series_query *q,
                   struct failure_list *errors)
{
    const struct service *s = call->api->service;
    struct series_data data = {0};
    int bad = -1;
    const enum service_status st =
        s->get_series(s->ctx, job->id, q->n_channel, q->channel, q->from, q->to, &data, &bad);
    if (st == SERVICE_OK) {
        fill_series(call, res, q, &data);
        series_data_done(&data);
    } else if (st == SERVICE_NOT_FOUND && bad >= 0 && bad < q->n_channel) {
        refuse_channel(call, res, job->id, q->channel[bad], errors);
    } else {
        respond_service(res, st, job->id);
    }
}

void handle_series(const struct api_call *call, struct api_response *res)
{
    struct job_record job;
    if (!respond_find_job(call, res, &job)) {
        return;
    }
    if (!case_kind_records(job.kind)) {
        problem_response(res, PROBLEM_NO_DOCUMENT, "jobs of this kind record no series", NULL,
                         NULL);
        return;
    }
    if (!respond_require_done(res, &job)) {
        return;
    }
    struct failure_list *errors = calloc(1, sizeof *errors);
    struct series_query *query = calloc(1, sizeof *query);
    if (errors == NULL || query == NULL || !read_query(call->req, query, errors)) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
    } else if (errors->total > 0) {
        problem_response(res, PROBLEM_BAD_QUERY, errors->item[0].detail, errors, NULL);
    } else {
        answer(call, res, &job, query, errors);
    }
    if (query != NULL) {
        free(query->names);
    }
    free(query);
    free(errors);
}
