#include "wavebalance/solvers/linalg/freed_memory.hpp"

#include <malloc.h>

namespace wavebalance::solvers {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int largest_kept = 32 << 20, kept = 512 << 20;  // the first is the maximum of glibc
  mallopt(M_MMAP_THRESHOLD, largest_kept);
  mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

}  // namespace wavebalance::solvers
