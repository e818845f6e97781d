/* tools/pack_dataset.c
 * pack_dataset FOLDER OUT HEAD HASH: the records of a folder (cli/records.h) as one compressed CSV
 * text, the form in which the daemon keeps a dataset; what a list shows of it; the hash of the
 * text. Run by the build for the dataset that is compiled in. */
#include "api/dataset.h"
#include "api/hash.h"
#include "api/pack.h"
#include "cli/file.h"
#include "cli/records.h"
#include "core/status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVEL = 12 };

static bool write_packed(const char *text, size_t size, const char *file)
{
    size_t packed_size = 0;
    void *packed = pack_text(text, size, LEVEL, &packed_size);
    const bool done = packed != NULL && file_write(file, packed, packed_size);
    free(packed);
    return done;
}

static bool write_head(const struct dataset_entry *e, const char *file)
{
    struct json_out out = {0};
    size_t size = 0;
    dataset_write_head(&out, e);
    char *head = json_out_take(&out, &size);
    const bool done = head != NULL && file_write(file, head, size);
    free(head);
    return done;
}

static bool write_all(const struct records *records, char **file)
{
    static char description[] = "\"Coefficients of the square-edged 4 % plate in pitch and plunge, "
                                "from flow computations\"";
    struct dataset_entry e = {
        .description = description, .n_record = records->n, .record = records->record};
    struct json_out out = {0};
    size_t size = 0;
    (void)snprintf(e.name, sizeof e.name, "%s", dataset_built_in);
    dataset_write_csv(&out, &e);
    char *text = json_out_take(&out, &size);
    bool done = text != NULL;
    if (done) {
        hash_text(text, size, e.hash);
        done = write_packed(text, size, file[0]) && write_head(&e, file[1]) &&
               file_write(file[2], e.hash, strlen(e.hash));
    }
    free(text);
    return done;
}

int main(int argc, char **argv)
{
    struct records records = {0};
    struct failure_list *problems = calloc(1, sizeof *problems);
    const bool done = argc == 5 && problems != NULL && records_read(argv[1], problems, &records) &&
                      write_all(&records, argv + 2);
    records_done(&records);
    free(problems);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
