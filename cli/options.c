#include "cli/options.h"

#include <getopt.h>

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct option long_options[] = {
    {"url", required_argument, NULL, 'u'},
    {"state", required_argument, NULL, 's'},
    {"kind", required_argument, NULL, 'k'},
    {"limit", required_argument, NULL, 'n'},
    {"series", required_argument, NULL, 'o'},
    {"document", required_argument, NULL, 'd'},
    {"polar", required_argument, NULL, 'P'},
    {"dynamic", required_argument, NULL, 'D'},
    {"network", required_argument, NULL, 'N'},
    {"force", no_argument, NULL, 'F'},
    {"motion", required_argument, NULL, 'M'},
    {"mean-deg", required_argument, NULL, 'm'},
    {"amplitude-deg", required_argument, NULL, 'a'},
    {"frequency", required_argument, NULL, 'f'},
    {"plunge", required_argument, NULL, 'l'},
    {"phase-deg", required_argument, NULL, 'p'},
    {"cycles", required_argument, NULL, 'y'},
    {"steps", required_argument, NULL, 'e'},
    {"output", required_argument, NULL, 'W'},
    {"name", required_argument, NULL, 'A'},
    {"description", required_argument, NULL, 'X'},
    {"inputs", required_argument, NULL, 'I'},
    {"base", required_argument, NULL, 'B'},
    {"lags", required_argument, NULL, 'L'},
    {"oscillators", required_argument, NULL, 'C'},
    {"members", required_argument, NULL, 'K'},
    {"folds", required_argument, NULL, 'Z'},
    {"samples", required_argument, NULL, 'Q'},
    {"anchors", required_argument, NULL, 'U'},
    {"balance", required_argument, NULL, 'G'},
    {"tolerance", required_argument, NULL, 'T'},
    {"symmetric", no_argument, NULL, 'R'},
    {"optimiser", required_argument, NULL, 'O'},
    {"value", required_argument, NULL, 'V'},
    {"hidden", required_argument, NULL, 'H'},
    {"epochs", required_argument, NULL, 'E'},
    {"decay", required_argument, NULL, 'Y'},
    {"seed", required_argument, NULL, 'S'},
    {"timeout", required_argument, NULL, 't'},
    {"wait", no_argument, NULL, 'w'},
    {"csv", no_argument, NULL, 'c'},
    {"json", no_argument, NULL, 'j'},
    {"text", no_argument, NULL, 'x'},
    {NULL, 0, NULL, 0},
};

/* Where an option goes. */
struct target {
    int letter;
    enum { TEXT, NUMBER, SECONDS, FLAG } kind;
    size_t offset;
};
#define TARGET(letter_, kind_, member_)                                                            \
    {                                                                                              \
        .letter = (letter_), .kind = (kind_), .offset = offsetof(struct options, member_)          \
    }
static const struct target targets[] = {
    TARGET('u', TEXT, url),         TARGET('s', TEXT, state),
    TARGET('k', TEXT, kind),        TARGET('n', TEXT, limit),
    TARGET('o', TEXT, series),      TARGET('d', TEXT, document),
    TARGET('P', TEXT, polar),       TARGET('D', TEXT, dynamic),
    TARGET('N', TEXT, network),     TARGET('M', TEXT, motion),
    TARGET('m', NUMBER, mean_deg),  TARGET('a', NUMBER, amplitude_deg),
    TARGET('f', NUMBER, frequency), TARGET('l', NUMBER, plunge),
    TARGET('p', NUMBER, phase_deg), TARGET('y', NUMBER, cycles),
    TARGET('e', NUMBER, steps),     TARGET('t', SECONDS, timeout_s),
    TARGET('W', TEXT, output),      TARGET('A', TEXT, name),
    TARGET('X', TEXT, description), TARGET('I', TEXT, inputs),
    TARGET('O', TEXT, optimiser),   TARGET('H', NUMBER, hidden),
    TARGET('E', NUMBER, epochs),    TARGET('Y', NUMBER, decay),
    TARGET('S', NUMBER, seed),      TARGET('w', FLAG, wait),
    TARGET('c', FLAG, csv),         TARGET('j', FLAG, json),
    TARGET('V', TEXT, value),       TARGET('x', FLAG, text),
    TARGET('F', FLAG, force),       TARGET('B', TEXT, base),
    TARGET('L', TEXT, lags),        TARGET('K', NUMBER, members),
    TARGET('Z', NUMBER, folds),     TARGET('Q', NUMBER, samples),
    TARGET('U', NUMBER, anchors),   TARGET('G', NUMBER, balance),
    TARGET('T', NUMBER, tolerance), TARGET('R', FLAG, symmetric),
    TARGET('C', TEXT, oscillators),
};

static bool parse_number(const char *text, bool seconds, double *out)
{
    char *end = NULL;
    errno = 0;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || errno != 0 || !isfinite(value) || (seconds && value < 0.0)) {
        (void)fprintf(stderr, "aerom: '%s' is no number%s\n", text, seconds ? " of seconds" : "");
        return false;
    }
    *out = value;
    return true;
}

static bool take(int letter, const char *value, struct options *o)
{
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++) {
        if (targets[i].letter != letter) {
            continue;
        }
        void *place = (char *)o + targets[i].offset;
        switch (targets[i].kind) {
        case TEXT:
            *(const char **)place = value;
            return true;
        case FLAG:
            *(bool *)place = true;
            return true;
        case NUMBER:
        case SECONDS:
        default:
            return parse_number(value, targets[i].kind == SECONDS, place);
        }
    }
    return false;
}

bool options_parse(int argc, char **argv, const char *allowed, int least, int most,
                   struct options *out)
{
    const char *environment = getenv("AEROM_URL");
    struct options o = {.url = environment != NULL ? environment : "http://127.0.0.1:8080",
                        .mean_deg = NAN,
                        .amplitude_deg = NAN,
                        .frequency = NAN,
                        .plunge = NAN,
                        .phase_deg = NAN,
                        .cycles = NAN,
                        .steps = NAN,
                        .hidden = NAN,
                        .epochs = NAN,
                        .decay = NAN,
                        .seed = NAN,
                        .members = NAN,
                        .folds = NAN,
                        .samples = NAN,
                        .anchors = NAN,
                        .balance = NAN,
                        .tolerance = NAN,
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
