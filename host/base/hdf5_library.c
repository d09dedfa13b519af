/* Opening libhdf5. */
#include "base/hdf5_library.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdbool.h>
#include <string.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static OzHdf5 library; /* written once, under the lock */

OzStatus oz_hdf5_library_check(int64_t code, const char *call, const char *file, int line)
{
    return code >= 0 ? OZ_OK
                     : oz_status_fail(OZ_ERR_FILE, "libhdf5: %s failed (%s:%d)", call, file, line);
}

void oz_hdf5_library_close(hid_t id)
{
    if (id >= 0) {
        library.H5Idec_ref(id);
    }
}

/* ISO C has no cast from an object to a function pointer. */
static OzStatus find(void *handle, const char *name, void *into)
{
    void *address = dlsym(handle, name);
    memcpy(into, &address, sizeof address);
    return address ? OZ_OK : oz_status_fail(OZ_ERR_FILE, "libhdf5 lacks %s", name);
}

#define STRINGIFY_(x) #x
#define STRINGIFY(x)  STRINGIFY_(x)
#define FIND(name)    OZ_PASS(find(handle, STRINGIFY(name), &library.name));

static OzStatus load(void)
{
    static bool loaded;
    if (loaded) {
        return OZ_OK;
    }
    void *handle = dlopen("libhdf5_serial.so.103", RTLD_NOW | RTLD_LOCAL);
    handle = handle ? handle : dlopen("libhdf5.so.103", RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        return oz_status_fail(OZ_ERR_FILE, "cannot open libhdf5: %s; install it", dlerror());
    }
    OZ_HDF5_FUNCTIONS(FIND)
    OZ_HDF5_NUMBERS(FIND)
    OZ_H5_PASS(library.H5open());
    OZ_H5_PASS(library.H5Eset_auto2(H5E_DEFAULT, NULL, NULL)); /* what fails is told by us */
    loaded = true;
    return OZ_OK;
}

OzStatus oz_hdf5_library_enter(const OzHdf5 **h5)
{
    pthread_mutex_lock(&lock);
    OzStatus status = load();
    *h5 = status == OZ_OK ? &library : NULL;
    if (status != OZ_OK) {
        pthread_mutex_unlock(&lock);
    }
    return status;
}

void oz_hdf5_library_leave(const OzHdf5 **h5)
{
    if (*h5) {
        *h5 = NULL;
        pthread_mutex_unlock(&lock);
    }
}
