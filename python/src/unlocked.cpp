#include "unlocked.hpp"

#include <mutex>
#include <string>
#include <utility>

// Not declared by every BLAS; a weak symbol is null where it is missing.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace wavebalance::python {
namespace {

std::mutex counting;
int solves = 0;   // that are under way
int threads = 1;  // of the BLAS without them

/// Never destroyed, since the interpreter may end before the module does.
pybind11::object& progress_callback() {
  static auto* callback = new pybind11::object(pybind11::none());
  return *callback;
}

}  // namespace

pybind11::object exchange_progress(pybind11::object callback) {
  return std::exchange(progress_callback(), std::move(callback));
}

bool tell_progress(const solvers::Progress& progress) {
  const pybind11::object callback = progress_callback();
  if (callback.is_none()) return true;
  try {
    callback(std::string(progress.phase), progress.step, progress.value, std::string(progress.measure),
             progress.done);
    return true;
  } catch (pybind11::error_already_set& raised) {
    raised.restore();
    return false;
  }
}

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
