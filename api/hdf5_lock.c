#include "api/hdf5_lock.h"

#include <hdf5.h>
#include <pthread.h>

/* The one global of this folder: it guards the globals of a library. */
static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER;

void hdf5_lock(void)
{
    (void)pthread_mutex_lock(&turn);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

void hdf5_unlock(void)
{
    (void)pthread_mutex_unlock(&turn);
}
