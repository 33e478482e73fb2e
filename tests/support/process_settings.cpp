// Tests compute with one thread of OpenBLAS and keep the memory that they free, as the programs do
// (solvers/linalg/blas_threads.hpp, freed_memory.hpp), so that they have the numbers of the programs. Tests
// of modules below `solvers` do not link it.
#include <malloc.h>

extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace {

[[maybe_unused]] const bool settings_are_made = [] {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
  return true;
}();

}  // namespace
