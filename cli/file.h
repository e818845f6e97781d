/* cli/file.h
 * Whole files in and out. */
#ifndef AEROM_CLI_FILE_H
#define AEROM_CLI_FILE_H

#include <stdbool.h>
#include <stddef.h>

/* Reads a file, or standard input when path is "-", of at most `max` bytes. *text is malloc'ed and
 * ends with an extra zero. On failure nothing is changed and a line has gone to stderr. */
bool file_read(const char *path, size_t max, char **text, size_t *size);

/* Writes a whole file, or standard output when path is "-". On failure a line has gone to stderr.
 */
bool file_write(const char *path, const char *text, size_t size);

#endif
