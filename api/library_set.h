/* api/library_set.h
 * The entries behind a struct library, for the codecs. Inside api only. */
#ifndef AEROM_API_LIBRARY_SET_H
#define AEROM_API_LIBRARY_SET_H

#include "api/entry.h"
#include "api/library.h"

/* Borrowed; lives as long as the library. */
const struct entry_set *library_entries(const struct library *lib);

#endif
