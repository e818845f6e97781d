/* cli/options.h
 * The options of all commands, read by one table. */
#ifndef AEROM_CLI_OPTIONS_H
#define AEROM_CLI_OPTIONS_H

#include <math.h>
#include <stdbool.h>

/* Borrows from argv. Options that were not given are NULL or false. */
struct options {
    const char *url;         /* -u: given, else of the environment, else the default */
    const char *state;       /* -s */
    const char *kind;        /* -k */
    const char *limit;       /* -n */
    const char *series;      /* -o: file for the series */
    const char *document;    /* -d */
    const char *polar;       /* -P */
    const char *dynamic;     /* -D */
    const char *network;     /* -N */
    const char *motion;      /* -M */
    const char *output;      /* -W: file */
    const char *name;        /* -A */
    const char *description; /* -X */
    const char *inputs;      /* -I */
    const char *base;        /* -B */
    const char *lags;        /* -L */
    const char *oscillators; /* -C */
    const char *optimiser;   /* -O */
    const char *value;       /* -V */
    /* Numbers, NaN when not given. */
    double mean_deg;      /* -m */
    double amplitude_deg; /* -a */
    double frequency;     /* -f */
    double plunge;        /* -l */
    double phase_deg;     /* -p */
    double cycles;        /* -y */
    double steps;         /* -e */
    double hidden;        /* -H */
    double epochs;        /* -E */
    double decay;         /* -Y */
    double seed;          /* -S */
    double members;       /* -K */
    double folds;         /* -Z */
    double samples;       /* -Q */
    double anchors;       /* -U */
    double balance;       /* -G */
    double tolerance;     /* -T */
    double timeout_s;     /* -t, infinite when not given */
    bool wait;            /* -w */
    bool csv;             /* -c */
    bool json;            /* -j */
    bool text;            /* -x */
    bool force;           /* -F */
    bool symmetric;       /* -R */
    char **operand;       /* (n_operand) */
    int n_operand;
};

/* Reads argv of a command. `allowed` holds the letters above of the options the command has;
 * operands must number least..most (most < 0: any number). False when something does not fit, after
 * a line on stderr where the reason is not plain from the usage. */
bool options_parse(int argc, char **argv, const char *allowed, int least, int most,
                   struct options *out);

/* The number, or `otherwise` when it was not given. */
static inline double options_given(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}
/* The same for a count: one that is no whole number becomes -1, which is out of every range. */
static inline int options_whole(double value, int otherwise)
{
    const double v = options_given(value, otherwise);
    return fabs(v) <= 1e6 && fabs(v - nearbyint(v)) < 1e-9 ? (int)lround(v) : -1;
}

#endif
