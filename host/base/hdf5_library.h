/* libhdf5, opened by dlopen by who first enters it and by nothing else; it stays open to the end of
 * the process. It is not made for several threads: one is in it at a time. */
#pragma once

#include "base/status.h"

#include <hdf5.h>

/* clang-format off */
/* Every function and every number of it that is used. */
#define OZ_HDF5_FUNCTIONS(F)                                                                       \
    F(H5open) F(H5Eset_auto2)                                                                      \
    F(H5Pcreate) F(H5Pset_fapl_core) F(H5Pset_file_image) F(H5Pset_create_intermediate_group)      \
    F(H5Idec_ref) F(H5Fcreate) F(H5Fopen) F(H5Fflush) F(H5Fget_file_image) F(H5Fclose)             \
    F(H5Gcreate2) F(H5Lcreate_hard)                                                    \
    F(H5Screate_simple) F(H5Screate) F(H5Sselect_hyperslab) F(H5Sget_simple_extent_npoints)        \
    F(H5Dset_extent) F(H5Pset_chunk) F(H5Dcreate2) F(H5Dopen2) F(H5Dwrite) F(H5Dread) F(H5Dget_space) F(H5Dget_type)               \
    F(H5Tcopy) F(H5Tset_size) F(H5Tget_size) F(H5Tequal)                                           \
    F(H5Acreate2) F(H5Awrite) F(H5Aopen) F(H5Aget_type) F(H5Aread)
#define OZ_HDF5_NUMBERS(N)                                                                         \
    N(H5P_CLS_FILE_ACCESS_ID_g) N(H5P_CLS_DATASET_CREATE_ID_g) N(H5P_CLS_LINK_CREATE_ID_g) N(H5T_C_S1_g) N(H5T_NATIVE_INT64_g)    \
    N(H5T_NATIVE_INT32_g) N(H5T_NATIVE_DOUBLE_g) N(H5T_NATIVE_FLOAT_g) N(H5T_NATIVE_UINT8_g)
/* clang-format on */

#define OZ_HDF5_FUNCTION(function) __typeof__(function) *function;
#define OZ_HDF5_NUMBER(number)     hid_t *number;
typedef struct OzHdf5 {
    OZ_HDF5_FUNCTIONS(OZ_HDF5_FUNCTION)
    OZ_HDF5_NUMBERS(OZ_HDF5_NUMBER)
} OzHdf5;

/* HDF5's own names for these two call into the library. */
enum { OZ_H5_READ = 0, OZ_H5_TRUNCATE = 2 };

/* Waits until nobody else is in it. Fails with OZ_ERR_FILE where it cannot be opened, *h5 NULL. */
OzStatus oz_hdf5_library_enter(const OzHdf5 **h5);

/* Lets others in, *h5 becomes NULL; without effect where it is NULL. */
void oz_hdf5_library_leave(const OzHdf5 **h5);

/* Closes what an identifier stands for, whatever it is; nothing for a negative one. */
void oz_hdf5_library_close(hid_t id);

/* OZ_OK for a code that is not negative; else fails with OZ_ERR_FILE, naming the call. */
OzStatus oz_hdf5_library_check(int64_t code, const char *call, const char *file, int line);

/* As OZ_TRY and OZ_PASS, for HDF5's own calls. */
#define OZ_H5_TRY(call)  OZ_TRY(oz_hdf5_library_check((call), #call, __FILE__, __LINE__))
#define OZ_H5_PASS(call) OZ_PASS(oz_hdf5_library_check((call), #call, __FILE__, __LINE__))
