#include "cli/options.h"

#include <getopt.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct option long_options[] = {
    {"url", required_argument, NULL, 'u'},     {"state", required_argument, NULL, 's'},
    {"kind", required_argument, NULL, 'k'},    {"limit", required_argument, NULL, 'n'},
    {"series", required_argument, NULL, 'o'},  {"document", required_argument, NULL, 'd'},
    {"timeout", required_argument, NULL, 't'}, {"wait", no_argument, NULL, 'w'},
    {"csv", no_argument, NULL, 'c'},           {"json", no_argument, NULL, 'j'},
    {"text", no_argument, NULL, 'x'},          {NULL, 0, NULL, 0},
};

static bool parse_seconds(const char *text, double *out)
{
    char *end = NULL;
    errno = 0;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || errno != 0 || !(value >= 0.0) || isinf(value)) {
        (void)fprintf(stderr, "aerom: '%s' is no number of seconds\n", text);
        return false;
    }
    *out = value;
    return true;
}

static bool take(int letter, const char *value, struct options *o)
{
    switch (letter) {
    case 'u':
        o->url = value;
        break;
    case 's':
        o->state = value;
        break;
    case 'k':
        o->kind = value;
        break;
    case 'n':
        o->limit = value;
        break;
    case 'o':
        o->series = value;
        break;
    case 'd':
        o->document = value;
        break;
    case 't':
        return parse_seconds(value, &o->timeout_s);
    case 'w':
        o->wait = true;
        break;
    case 'c':
        o->csv = true;
        break;
    case 'j':
        o->json = true;
        break;
    case 'x':
        o->text = true;
        break;
    default:
        return false;
    }
    return true;
}

bool options_parse(int argc, char **argv, const char *allowed, int least, int most,
                   struct options *out)
{
    const char *environment = getenv("AEROM_URL");
    struct options o = {.url = environment != NULL ? environment : "http://127.0.0.1:8080",
                        .timeout_s = INFINITY};
    int letter = 0;
    while ((letter = getopt_long(argc, argv, "", long_options, NULL)) != -1) {
        if (letter == '?' || strchr(allowed, letter) == NULL || !take(letter, optarg, &o)) {
            return false;
        }
    }
    o.operand = argv + optind;
    o.n_operand = argc - optind;
    if (o.n_operand < least || (most >= 0 && o.n_operand > most)) {
        return false;
    }
    *out = o;
    return true;
}
