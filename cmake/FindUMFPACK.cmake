# Sparse LU factorisations of SuiteSparse; the shared library brings AMD, CHOLMOD and BLAS.
find_path(UMFPACK_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse)
find_library(UMFPACK_LIBRARY umfpack)
mark_as_advanced(UMFPACK_INCLUDE_DIR UMFPACK_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(UMFPACK REQUIRED_VARS UMFPACK_LIBRARY UMFPACK_INCLUDE_DIR)
if(UMFPACK_FOUND AND NOT TARGET UMFPACK::umfpack)
  add_library(UMFPACK::umfpack UNKNOWN IMPORTED)
  set_target_properties(UMFPACK::umfpack PROPERTIES
    IMPORTED_LOCATION ${UMFPACK_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${UMFPACK_INCLUDE_DIR})
endif()
