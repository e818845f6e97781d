/* api/embedded.h
 * Files compiled into the program (cmake/embed.cmake): shipped library data, the OpenAPI document,
 * migrations. The bytes end with an extra zero, so text can be read as a string. */
#ifndef AEROM_API_EMBEDDED_H
#define AEROM_API_EMBEDDED_H

#include <stddef.h>

struct embedded_file {
    const char *path; /* relative to the root the build named */
    const char *data;
    const char *end; /* one past the last byte; *end is zero */
};

static inline size_t embedded_size(const struct embedded_file *f)
{
    return (size_t)(f->end - f->data);
}

extern const struct embedded_file data_files[];
extern const int data_file_count;
extern const struct embedded_file dataset_files[];
extern const int dataset_file_count;
extern const struct embedded_file openapi_files[];
extern const int openapi_file_count;
extern const struct embedded_file migrations_files[];
extern const int migrations_file_count;

#endif
