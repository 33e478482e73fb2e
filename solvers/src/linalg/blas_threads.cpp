#include "wavebalance/solvers/linalg/blas_threads.hpp"

// Not declared by every BLAS; a weak symbol is null where it is missing.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace wavebalance::solvers {

void use_one_blas_thread() {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

}  // namespace wavebalance::solvers
