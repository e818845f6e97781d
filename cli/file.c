#include "cli/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool read_all(FILE *in, const char *path, size_t max, char **text, size_t *size)
{
    size_t used = 0;
    size_t room = 0;
    char *buffer = NULL;
    for (;;) {
        if (used + 1 >= room) {
            room = room == 0 ? 65536 : 2 * room;
            char *larger = realloc(buffer, room);
            if (larger == NULL) {
                (void)fprintf(stderr, "aerom: %s: out of memory\n", path);
                goto out;
            }
            buffer = larger;
        }
        const size_t got = fread(buffer + used, 1, room - used - 1, in);
        used += got;
        if (used > max) {
            (void)fprintf(stderr, "aerom: %s: larger than %zu bytes\n", path, max);
            goto out;
        }
        if (got == 0) {
            break;
        }
    }
    if (ferror(in)) {
        (void)fprintf(stderr, "aerom: %s: %s\n", path, strerror(errno));
        goto out;
    }
    buffer[used] = '\0';
    *text = buffer;
    *size = used;
    return true;
out:
    free(buffer);
    return false;
}

bool file_read(const char *path, size_t max, char **text, size_t *size)
{
    if (strcmp(path, "-") == 0) {
        return read_all(stdin, "standard input", max, text, size);
    }
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        (void)fprintf(stderr, "aerom: %s: %s\n", path, strerror(errno));
        return false;
    }
    const bool done = read_all(in, path, max, text, size);
    (void)fclose(in);
    return done;
}

bool file_write(const char *path, const char *text, size_t size)
{
    const bool to_stdout = strcmp(path, "-") == 0;
    FILE *out = to_stdout ? stdout : fopen(path, "wb");
    bool done = out != NULL && fwrite(text, 1, size, out) == size;
    if (out != NULL) {
        /* A full disk shows at the flush. */
        done = (to_stdout ? fflush(out) : fclose(out)) == 0 && done;
    }
    if (!done) {
        (void)fprintf(stderr, "aerom: %s: %s\n", path, strerror(errno));
    }
    return done;
}
