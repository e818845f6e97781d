/* cli/options.h
 * The options of all commands, read by one table. */
#ifndef AEROM_CLI_OPTIONS_H
#define AEROM_CLI_OPTIONS_H

#include <stdbool.h>

/* Borrows from argv. Options that were not given are NULL or false. */
struct options {
    const char *url;      /* -u: given, else of the environment, else the default */
    const char *state;    /* -s */
    const char *kind;     /* -k */
    const char *limit;    /* -n */
    const char *series;   /* -o: file for the series */
    const char *document; /* -d */
    const char *polar;    /* -P */
    const char *dynamic;  /* -D */
    const char *network;  /* -N */
    const char *motion;   /* -M */
    /* Numbers, NaN when not given. */
    double mean_deg;      /* -m */
    double amplitude_deg; /* -a */
    double frequency;     /* -f */
    double plunge;        /* -l */
    double phase_deg;     /* -p */
    double cycles;        /* -y */
    double steps;         /* -e */
    double timeout_s;     /* -t, infinite when not given */
    bool wait;            /* -w */
    bool csv;             /* -c */
    bool json;            /* -j */
    bool text;            /* -x */
    char **operand;       /* (n_operand) */
    int n_operand;
};

/* Reads argv of a command. `allowed` holds the letters above of the options the command has;
 * operands must number least..most (most < 0: any number). False when something does not fit, after
 * a line on stderr where the reason is not plain from the usage. */
bool options_parse(int argc, char **argv, const char *allowed, int least, int most,
                   struct options *out);

#endif
