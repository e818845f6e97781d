/* Datasets by their name: the shipped one and those on the shelf. */
#include "api/dataset.h"
#include "api/embedded.h"
#include "api/hash.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum service_status expand(const void *packed, size_t size, struct dataset_entry *out)
{
    size_t n = 0;
    char *text = dataset_expand(packed, size, &n);
    struct failure_list *problems = calloc(1, sizeof *problems);
    const bool read =
        text != NULL && problems != NULL && dataset_read_csv(text, n, out, problems) == ST_OK;
    if (read) {
        hash_text(text, n, out->hash);
    }
    free(problems);
    free(text);
    return read ? SERVICE_OK : SERVICE_ERROR;
}

/* What pack_dataset has made of the shipped records. */
enum { PACKED, HEAD, HASH };

static const char *built_in(int part)
{
    assert(part < dataset_file_count);
    return dataset_files[part].data;
}

const char *dataset_built_in_head(void)
{
    return built_in(HEAD);
}

static enum service_status load_built_in(struct dataset_entry *out, struct shelf_entry *kept)
{
    kept->version = 1;
    kept->head = strdup(built_in(HEAD));
    return kept->head != NULL ? expand(built_in(PACKED), embedded_size(&dataset_files[PACKED]), out)
                              : SERVICE_ERROR;
}

static enum service_status load_kept(const struct shelf *shelf, int version,
                                     struct dataset_entry *out, struct shelf_entry *kept)
{
    if (shelf == NULL) {
        return SERVICE_NOT_FOUND;
    }
    const enum service_status st = shelf->get(shelf->ctx, SHELF_DATASET, out->name, version, kept);
    return st == SERVICE_OK ? expand(kept->data, kept->size, out) : st;
}

enum service_status dataset_load(const struct library *lib, const char *reference,
                                 struct dataset_entry *out, struct shelf_entry *kept)
{
    struct dataset_entry e = {.n_record = 0};
    struct shelf_entry found = {.version = 0};
    int version = 0;
    enum service_status st = SERVICE_NOT_FOUND;
    if (shelf_reference(reference, e.name, &version)) {
        const bool own = !dataset_is_built_in(e.name);
        st = own            ? load_kept(library_shelf(lib), version, &e, &found)
             : version <= 1 ? load_built_in(&e, &found)
                            : SERVICE_NOT_FOUND;
    }
    if (st == SERVICE_OK) {
        *out = e;
    } else {
        dataset_entry_done(&e);
    }
    if (st == SERVICE_OK && kept != NULL) {
        *kept = found;
    } else {
        shelf_entry_done(&found);
    }
    return st;
}

enum service_status dataset_find(const struct library *lib, const char *reference,
                                 char name[LIMIT_NAME], int *version, char hash[LIMIT_HASH])
{
    const struct shelf *shelf = library_shelf(lib);
    int wanted = 0;
    if (!shelf_reference(reference, name, &wanted)) {
        return SERVICE_NOT_FOUND;
    }
    if (dataset_is_built_in(name)) {
        *version = 1;
        (void)snprintf(hash, LIMIT_HASH, "%s", built_in(HASH));
        return wanted <= 1 ? SERVICE_OK : SERVICE_NOT_FOUND;
    }
    struct shelf_entry kept = {.version = 0};
    const enum service_status st = shelf != NULL
                                       ? shelf->get(shelf->ctx, SHELF_DATASET, name, wanted, &kept)
                                       : SERVICE_NOT_FOUND;
    if (st == SERVICE_OK) {
        *version = kept.version;
        memcpy(hash, kept.hash, sizeof kept.hash);
    }
    shelf_entry_done(&kept);
    return st;
}
