/* server/config.h
 * Settings of the daemon: one table of keys, filled from defaults, then the configuration file
 * (INI, `key = value`), then the environment (AEROMD_KEY), then flags (--key). Later wins; unknown
 * keys and values out of range are refused with the place they came from. */
#ifndef AEROM_SERVER_CONFIG_H
#define AEROM_SERVER_CONFIG_H

#include <stdbool.h>
#include <stdio.h>

enum { CONFIG_TEXT = 512, CONFIG_MESSAGE = 512 };

struct config {
    char listen[CONFIG_TEXT];
    char store[CONFIG_TEXT];
    int workers;
    int http_threads;
    int queue_limit;
    int attempts;
    int disk_reserve_mb;
    char log_level[CONFIG_TEXT];
};

/* What the command line asks for. */
enum config_action { CONFIG_RUN, CONFIG_PRINT, CONFIG_VERSION, CONFIG_HELP };

/* Fills *out from all sources. `environment` is a NULL-terminated list "NAME=value". False: *why
 * says what is wrong and where; *out is unspecified. */
bool config_load(int argc, char *const argv[], char *const environment[], struct config *out,
                 enum config_action *action, char why[CONFIG_MESSAGE]);

/* The settings as a configuration file that gives the same settings. */
void config_print(const struct config *c, FILE *file);
void config_help(FILE *file);

#endif
