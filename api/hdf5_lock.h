/* api/hdf5_lock.h
 * One thread at a time in libhdf5, whose usual build keeps its state in globals without guarding
 * them. Everything that calls it stands between the two. */
#ifndef AEROM_API_HDF5_LOCK_H
#define AEROM_API_HDF5_LOCK_H

/* Waits for its turn, and silences the library's own reports of errors. */
void hdf5_lock(void);
void hdf5_unlock(void);

#endif
