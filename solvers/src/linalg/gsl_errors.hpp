#pragma once
#include <gsl/gsl_errno.h>

#include <mutex>

namespace wavebalance::solvers::detail {

/// While one lives, in any thread, GSL returns its errors instead of ending the program. GSL has one
/// handler of errors per process: the first object replaces it and the last one puts it back.
class SilencedGslErrors {
 public:
  SilencedGslErrors() {
    const std::lock_guard alone(counting_);
    if (living_++ == 0) previous_ = gsl_set_error_handler_off();
  }
  ~SilencedGslErrors() {
    const std::lock_guard alone(counting_);
    if (--living_ == 0) gsl_set_error_handler(previous_);
  }
  SilencedGslErrors(const SilencedGslErrors&) = delete;
  SilencedGslErrors& operator=(const SilencedGslErrors&) = delete;

 private:
  inline static std::mutex counting_;
  inline static int living_ = 0;
  inline static gsl_error_handler_t* previous_ = nullptr;
};

}  // namespace wavebalance::solvers::detail
