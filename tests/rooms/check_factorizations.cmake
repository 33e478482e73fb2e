# Each factorization of Eigen takes the compiler seconds: only the files of this list include it, behind plain
# functions. cmake -D root=<project> -P check_factorizations.cmake
cmake_minimum_required(VERSION 3.25)
set(allowed
  solvers/src/linalg/ solvers/src/structure/condensation_sparse.cpp  # for sparse complex matrices
  app/src/compose/ app/src/matrices/ fem/src/simplicial_factor.cpp fem/src/hexahedron.cpp wavelets/src/refinable.cpp
  tests/support/dense_algebra.cpp tests/support/dense_system.cpp
  # Oracles of one suite each, and what bench compares with.
  bench/ contact/tests/quadratic_program.hpp reproduce/laxalde_legrand_2010/modes/tests/rayleigh_quotient_test.cpp
  tests/extremes/random_structures.cpp)
set(faults "")
foreach(module app bench contact fem python reproduce solvers spectral tests wavelets)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/${module}/*.cpp ${root}/${module}/*.hpp)
  foreach(file IN LISTS files)
    file(STRINGS ${root}/${file} found REGEX "^#include <(Eigen/(Cholesky|Dense|Eigenvalues|LU|QR|SVD|Sparse|SparseCholesky|SparseLU|SparseQR))>")
    set(known FALSE)
    foreach(one IN LISTS allowed)
      string(FIND ${file} ${one} at)
      if(at EQUAL 0)
        set(known TRUE)
      endif()
    endforeach()
    if(found AND NOT known)
      list(APPEND faults "${file}: ${found}")
    endif()
  endforeach()
endforeach()
if(faults)
  list(JOIN faults "\n  " text)
  message(FATAL_ERROR "factorizations beside linalg/dense.hpp and linalg/sparse.hpp, which have them compiled once:\n  ${text}")
endif()
