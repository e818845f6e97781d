/* The daemon: settings, signals, exit code. */
#include "core/sim.h"
#include "server/app.h"

#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* Blocked before any thread exists, so that only the main thread sees them. */
static void block_signals(sigset_t *wanted)
{
    (void)sigemptyset(wanted);
    (void)sigaddset(wanted, SIGTERM);
    (void)sigaddset(wanted, SIGINT);
    (void)pthread_sigmask(SIG_BLOCK, wanted, NULL);
    (void)signal(SIGPIPE, SIG_IGN);
    (void)signal(SIGXFSZ, SIG_IGN);
}

static int serve(const struct config *config)
{
    struct log log = {.fd = STDERR_FILENO};
    if (!log_level_parse(config->log_level, &log.level)) {
        (void)fprintf(stderr, "aeromd: log_level must be error, warn, info or debug\n");
        return APP_BAD_CONFIG;
    }
    sigset_t signals;
    block_signals(&signals);
    (void)umask(077); /* the database is nobody else's */
    sim_process_init();

    struct app *app = NULL;
    const enum app_exit code = app_start(config, &log, &app);
    if (code != APP_OK) {
        return code;
    }
    const struct timespec second = {.tv_sec = 1};
    int signal_number = -1;
    while (signal_number < 0) {
        signal_number = sigtimedwait(&signals, NULL, &second);
        app_tick(app);
    }
    LOG(&log, LOG_LEVEL_INFO, "stopping", log_i("signal", signal_number));
    app_stop(app);
    LOG(&log, LOG_LEVEL_INFO, "stopped", log_i("code", APP_OK));
    return APP_OK;
}

int main(int argc, char *argv[])
{
    struct config config;
    enum config_action action = CONFIG_RUN;
    char why[CONFIG_MESSAGE];
    if (!config_load(argc, argv, environ, &config, &action, why)) {
        (void)fprintf(stderr, "aeromd: %s\n", why);
        return APP_BAD_CONFIG;
    }
    switch (action) {
    case CONFIG_VERSION:
        (void)printf("aeromd %s (core %s)\n", AEROM_VERSION, AEROM_CORE_VERSION);
        return APP_OK;
    case CONFIG_HELP:
        config_help(stdout);
        return APP_OK;
    case CONFIG_PRINT:
        config_print(&config, stdout);
        return APP_OK;
    case CONFIG_RUN:
        break;
    }
    return serve(&config);
}
