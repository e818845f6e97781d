#include "server/config.h"

#include <ctype.h>
#include <errno.h>
#include <ini.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum kind { KIND_TEXT, KIND_INT };

/* The one list of settings. `fallback` is the default as text; NULL: computed (defaults()). */
static const struct key {
    const char *name; /* in the file; upper case in the environment, '-' for '_' in flags */
    enum kind kind;
    size_t offset;
    const char *fallback;
    int min, max;
    const char *help;
} keys[] = {
    {"listen", KIND_TEXT, offsetof(struct config, listen), "127.0.0.1:8080", 0, 0,
     "ADDRESS:PORT to serve HTTP on; port 0 takes a free one"},
    {"store", KIND_TEXT, offsetof(struct config, store), NULL, 0, 0,
     "database as sqlite:PATH; default in the user's state directory"},
    {"workers", KIND_INT, offsetof(struct config, workers), NULL, 0, 1024,
     "simulations at a time; 0 only serves; default one per core"},
    {"http_threads", KIND_INT, offsetof(struct config, http_threads), NULL, 1, 64,
     "threads that serve HTTP; default one per core, at most 4"},
    {"queue_limit", KIND_INT, offsetof(struct config, queue_limit), "1000000", 1, 100000000,
     "most jobs waiting or running; further ones are refused"},
    {"attempts", KIND_INT, offsetof(struct config, attempts), "100", 1, 10000,
     "times a job may be lost with its process before it fails"},
    {"disk_reserve_mb", KIND_INT, offsetof(struct config, disk_reserve_mb), "1024", 0, 1000000000,
     "free space below which new jobs are refused"},
    {"log_level", KIND_TEXT, offsetof(struct config, log_level), "info", 0, 0,
     "error, warn, info or debug"},
};

enum { N_KEY = sizeof keys / sizeof keys[0] };

static const struct key *find_key(const char *name)
{
    for (int i = 0; i < N_KEY; i++) {
        if (strcmp(keys[i].name, name) == 0) {
            return &keys[i];
        }
    }
    return NULL;
}

/* Sets one key from text; `origin` names the place in messages. */
static bool set(struct config *c, const struct key *key, const char *text, const char *origin,
                char why[CONFIG_MESSAGE])
{
    char *field = (char *)c + key->offset;
    if (key->kind == KIND_TEXT) {
        if (text[0] == '\0' || strlen(text) >= CONFIG_TEXT) {
            (void)snprintf(why, CONFIG_MESSAGE, "%s: %s must have 1 to %d characters", origin,
                           key->name, CONFIG_TEXT - 1);
            return false;
        }
        (void)snprintf(field, CONFIG_TEXT, "%s", text);
        return true;
    }
    char *end = NULL;
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (errno != 0 || end == text || *end != '\0' || value < key->min || value > key->max) {
        (void)snprintf(why, CONFIG_MESSAGE,
                       "%s: %s must be a whole number from %d to %d, not '%.60s'", origin,
                       key->name, key->min, key->max, text);
        return false;
    }
    const int number = (int)value;
    memcpy(field, &number, sizeof number);
    return true;
}

/* -- defaults --------------------------------------------------------------------------- */

static const char *lookup(char *const environment[], const char *name)
{
    const size_t n = strlen(name);
    for (; *environment != NULL; environment++) {
        if (strncmp(*environment, name, n) == 0 && (*environment)[n] == '=') {
            return *environment + n + 1;
        }
    }
    return NULL;
}

static bool defaults(struct config *c, char *const environment[], char why[CONFIG_MESSAGE])
{
    *c = (struct config){.workers = 1};
    for (int i = 0; i < N_KEY; i++) {
        if (keys[i].fallback != NULL && !set(c, &keys[i], keys[i].fallback, "default", why)) {
            return false;
        }
    }
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    c->workers = cores < 1 ? 1 : cores > 1024 ? 1024 : (int)cores;
    c->http_threads = c->workers < 4 ? c->workers : 4;
    const char *state = lookup(environment, "XDG_STATE_HOME");
    const char *home = lookup(environment, "HOME");
    if (state != NULL && state[0] == '/') {
        (void)snprintf(c->store, sizeof c->store, "sqlite:%.400s/aeromd/aeromd.db", state);
    } else if (home != NULL && home[0] == '/') {
        (void)snprintf(c->store, sizeof c->store, "sqlite:%.400s/.local/state/aeromd/aeromd.db",
                       home);
    } else {
        (void)snprintf(c->store, sizeof c->store, "sqlite:aeromd.db");
    }
    return true;
}

/* -- file ------------------------------------------------------------------------------- */

struct file_read {
    struct config *config;
    FILE *file;
    const char *path;
    char *why;
    int line;
    bool seen[N_KEY];
    bool refused;
};

/* libinih in Debian is built without line numbers in the handler: the reader counts them. */
static char *read_line(char *buffer, int size, void *stream)
{
    struct file_read *r = stream;
    r->line++;
    return fgets(buffer, size, r->file);
}

static int on_key(void *user, const char *section, const char *name, const char *value)
{
    struct file_read *r = user;
    if (r->refused) {
        return 0;
    }
    char origin[CONFIG_MESSAGE / 2];
    (void)snprintf(origin, sizeof origin, "%.200s:%d", r->path, r->line);
    const struct key *key = section[0] == '\0' ? find_key(name) : NULL;
    r->refused = true;
    if (key == NULL) {
        (void)snprintf(r->why, CONFIG_MESSAGE, "%s: unknown key '%.30s%s%.60s'", origin, section,
                       section[0] != '\0' ? "." : "", name);
    } else if (r->seen[key - keys]) {
        (void)snprintf(r->why, CONFIG_MESSAGE, "%s: %s is given twice", origin, name);
    } else {
        r->seen[key - keys] = true;
        r->refused = !set(r->config, key, value, origin, r->why);
    }
    return r->refused ? 0 : 1;
}

static bool read_file(struct config *c, const char *path, char why[CONFIG_MESSAGE])
{
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        char reason[128] = "";
        (void)strerror_r(errno, reason, sizeof reason);
        (void)snprintf(why, CONFIG_MESSAGE, "%.200s: %s", path, reason);
        return false;
    }
    struct file_read read = {.config = c, .file = file, .path = path, .why = why};
    const int rc = ini_parse_stream(read_line, &read, on_key, &read);
    (void)fclose(file);
    if (rc != 0 && !read.refused) {
        (void)snprintf(why, CONFIG_MESSAGE, "%.200s:%d: not of the form key = value", path, rc);
    }
    return rc == 0;
}

/* -- environment and flags -------------------------------------------------------------- */

static const char prefix[] = "AEROMD_";

static bool read_environment(struct config *c, char *const environment[], char why[CONFIG_MESSAGE])
{
    for (; *environment != NULL; environment++) {
        const char *text = *environment;
        if (strncmp(text, prefix, sizeof prefix - 1) != 0) {
            continue;
        }
        char name[64] = "";
        const char *value = strchr(text, '=');
        const size_t n = value != NULL ? (size_t)(value - text) - (sizeof prefix - 1) : 0;
        for (size_t i = 0; i < n && i < sizeof name - 1; i++) {
            name[i] = (char)tolower((unsigned char)text[sizeof prefix - 1 + i]);
        }
        if (strcmp(name, "config") == 0) {
            continue; /* read before the file */
        }
        const struct key *key = find_key(name);
        if (key == NULL) {
            (void)snprintf(why, CONFIG_MESSAGE, "environment: unknown key '%s%.60s'", prefix, name);
            return false;
        }
        if (!set(c, key, value + 1, "environment", why)) {
            return false;
        }
    }
    return true;
}

static const struct {
    const char *flag;
    enum config_action action;
} actions[] = {
    {"--print-config", CONFIG_PRINT},
    {"--version", CONFIG_VERSION},
    {"--help", CONFIG_HELP},
};

/* Splits "--key value" or "--key=value" at argv[*i]; advances *i over a separate value. */
static bool split_flag(int argc, char *const argv[], int *i, char name[64], const char **value)
{
    const char *flag = argv[*i];
    if (strncmp(flag, "--", 2) != 0) {
        return false;
    }
    const char *equals = strchr(flag, '=');
    const size_t n = equals != NULL ? (size_t)(equals - flag) - 2 : strlen(flag) - 2;
    if (n == 0 || n >= 64 || (equals == NULL && *i + 1 >= argc)) {
        return false;
    }
    for (size_t k = 0; k < n; k++) {
        name[k] = flag[2 + k];
        if (name[k] == '-') {
            name[k] = '_';
        }
    }
    name[n] = '\0';
    *value = equals != NULL ? equals + 1 : argv[++*i];
    return true;
}

/* With c NULL only --config and the actions are taken up: the file comes before the flags. */
static bool read_flags(struct config *c, int argc, char *const argv[], const char **path,
                       enum config_action *action, char why[CONFIG_MESSAGE])
{
    for (int i = 1; i < argc; i++) {
        bool is_action = false;
        for (size_t k = 0; k < sizeof actions / sizeof actions[0]; k++) {
            if (strcmp(argv[i], actions[k].flag) == 0) {
                *action = actions[k].action;
                is_action = true;
            }
        }
        if (is_action) {
            continue;
        }
        char name[64];
        const char *value = NULL;
        const char *flag = argv[i];
        const bool ok = split_flag(argc, argv, &i, name, &value);
        const struct key *key = ok ? find_key(name) : NULL;
        if (ok && strcmp(name, "config") == 0) {
            *path = value;
        } else if (key == NULL) {
            (void)snprintf(why, CONFIG_MESSAGE, "unknown or incomplete flag '%.100s' (see --help)",
                           flag);
            return false;
        } else if (c != NULL && !set(c, key, value, "command line", why)) {
            return false;
        }
    }
    return true;
}

bool config_load(int argc, char *const argv[], char *const environment[], struct config *out,
                 enum config_action *action, char why[CONFIG_MESSAGE])
{
    const char *path = lookup(environment, "AEROMD_CONFIG");
    *action = CONFIG_RUN;
    if (!read_flags(NULL, argc, argv, &path, action, why)) {
        return false;
    }
    if (*action == CONFIG_VERSION || *action == CONFIG_HELP) {
        return true;
    }
    return defaults(out, environment, why) && (path == NULL || read_file(out, path, why)) &&
           read_environment(out, environment, why) &&
           read_flags(out, argc, argv, &path, action, why);
}

void config_print(const struct config *c, FILE *file)
{
    for (int i = 0; i < N_KEY; i++) {
        const char *field = (const char *)c + keys[i].offset;
        if (keys[i].kind == KIND_TEXT) {
            (void)fprintf(file, "%s = %s\n", keys[i].name, field);
        } else {
            int number = 0;
            memcpy(&number, field, sizeof number);
            (void)fprintf(file, "%s = %d\n", keys[i].name, number);
        }
    }
}

void config_help(FILE *file)
{
    (void)fputs(
        "usage: aeromd [--KEY VALUE]... [--config FILE]\n"
        "       aeromd --print-config | --version | --help\n\n"
        "Serves aeroelastic simulations over HTTP. Settings, by rising precedence: defaults,\n"
        "the file, environment variables AEROMD_KEY, flags.\n\n",
        file);
    for (int i = 0; i < N_KEY; i++) {
        char flag[64];
        (void)snprintf(flag, sizeof flag, "%s", keys[i].name);
        for (char *p = flag; *p != '\0'; p++) {
            if (*p == '_') {
                *p = '-';
            }
        }
        (void)fprintf(
            file, "  --%-18s %s%s%s%s\n", flag, keys[i].help, keys[i].fallback != NULL ? " [" : "",
            keys[i].fallback != NULL ? keys[i].fallback : "", keys[i].fallback != NULL ? "]" : "");
    }
    (void)fputs("  --config             file of lines `key = value`\n"
                "\nExit codes: 0 stopped in order, 1 failure, 2 bad settings, 3 the database is in "
                "use.\n",
                file);
}
