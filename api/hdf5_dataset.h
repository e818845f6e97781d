/* api/hdf5_dataset.h
 * Datasets out of an HDF5 file in memory: a group for each record with its columns as
 * one-dimensional arrays, `period_c_v` and `start_c_v` as its attributes. No state; any thread
 * (hdf5_lock.h).
 *
 * Nothing but the given bytes is read: links that are not to objects of the file, arrays kept in
 * other files and filters loaded at run time are refused. */
#ifndef AEROM_API_HDF5_DATASET_H
#define AEROM_API_HDF5_DATASET_H

#include "api/dataset.h"

/* Records by name of their group. ST_INVALID with *problems filled; on failure the caller still
 * frees *out. */
MUST_CHECK enum status hdf5_read_dataset(const void *bytes, size_t size, struct dataset_entry *out,
                                         struct failure_list *problems);

#endif
