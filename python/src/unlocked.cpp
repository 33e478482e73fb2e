#include "unlocked.hpp"

#include <mutex>

// Not declared by every BLAS; a weak symbol is null where it is missing.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace wavebalance::python {
namespace {

std::mutex counting;
int solves = 0;   // that are under way
int threads = 1;  // of the BLAS without them

}  // namespace

OneBlasThread::OneBlasThread() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  const std::lock_guard alone(counting);
  if (solves++ > 0) return;
  threads = openblas_get_num_threads();
  if (threads > 1) openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  const std::lock_guard alone(counting);
  if (--solves == 0 && threads > 1) openblas_set_num_threads(threads);
}

}  // namespace wavebalance::python
