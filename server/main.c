/* The daemon: settings, signals, exit code. */
#include "core/sim.h"
#include "server/app.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

extern char **environ;

/* Write end of the pipe that wakes the main thread. A handler and not sigwait, since the BLAS
 * library starts a thread before main, which does not block the signals and may be the one to get
 * them. */
static int signal_pipe = -1;

static void on_signal(int number)
{
    const int keep = errno;
    const unsigned char byte = (unsigned char)number;
    (void)!write(signal_pipe, &byte, 1); /* full: a signal is waiting already */
    errno = keep;
}

/* Read end of the pipe, -1 when it cannot be had. */
static int catch_signals(void)
{
    int fd[2];
    if (pipe(fd) != 0) {
        return -1;
    }
    (void)fcntl(fd[1], F_SETFL, O_NONBLOCK);
    (void)fcntl(fd[0], F_SETFD, FD_CLOEXEC);
    (void)fcntl(fd[1], F_SETFD, FD_CLOEXEC);
    signal_pipe = fd[1];
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    (void)sigemptyset(&action.sa_mask);
    (void)sigaction(SIGTERM, &action, NULL);
    (void)sigaction(SIGINT, &action, NULL);
    (void)signal(SIGPIPE, SIG_IGN);
    (void)signal(SIGXFSZ, SIG_IGN);
    return fd[0];
}

/* Ticks once a second until a signal comes; returns its number. */
static int wait_for_signal(struct app *app, int fd)
{
    for (;;) {
        struct pollfd p = {.fd = fd, .events = POLLIN};
        unsigned char number = 0;
        if (poll(&p, 1, 1000) == 1 && read(fd, &number, 1) == 1) {
            return number;
        }
        app_tick(app);
    }
}

static int serve(const struct config *config)
{
    struct log log = {.fd = STDERR_FILENO};
    if (!log_level_parse(config->log_level, &log.level)) {
        (void)fprintf(stderr, "aeromd: log_level must be error, warn, info or debug\n");
        return APP_BAD_CONFIG;
    }
    const int signals = catch_signals();
    if (signals < 0) {
        (void)fprintf(stderr, "aeromd: no pipe for signals\n");
        return APP_FAILURE;
    }
    (void)umask(077); /* the database is nobody else's */
    sim_process_init();

    struct app *app = NULL;
    const enum app_exit code = app_start(config, &log, &app);
    if (code != APP_OK) {
        return code;
    }
    const int signal_number = wait_for_signal(app, signals);
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
