/* tools/pack_dataset.c
 * pack_dataset FOLDER OUT: the records of a folder (cli/records.h) as one compressed CSV text, the
 * form in which the daemon keeps a dataset. Run by the build for the dataset that is compiled in.
 */
#include "api/dataset.h"
#include "cli/file.h"
#include "cli/records.h"
#include "core/status.h"

#include <stdio.h>
#include <stdlib.h>
#include <zstd.h>

enum { LEVEL = 12 };

static bool pack(const struct records *records, const char *file)
{
    const struct dataset_entry e = {.n_record = records->n, .record = records->record};
    struct json_out out = {0};
    size_t size = 0;
    dataset_write_csv(&out, &e);
    char *text = json_out_take(&out, &size);
    const size_t bound = ZSTD_compressBound(size);
    char *packed = malloc(bound);
    bool done = text != NULL && packed != NULL;
    if (done) {
        const size_t n = ZSTD_compress(packed, bound, text, size, LEVEL);
        done = !ZSTD_isError(n) && file_write(file, packed, n);
    }
    free(packed);
    free(text);
    return done;
}

int main(int argc, char **argv)
{
    struct records records = {0};
    struct failure_list *problems = calloc(1, sizeof *problems);
    const bool done = argc == 3 && problems != NULL && records_read(argv[1], problems, &records) &&
                      pack(&records, argv[2]);
    records_done(&records);
    free(problems);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
