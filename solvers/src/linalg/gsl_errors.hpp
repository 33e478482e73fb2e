#pragma once
#include <gsl/gsl_errno.h>

namespace wavebalance::solvers::detail {

/// While it lives, GSL returns its errors in place of ending the program. The handler is one per process.
class SilencedGslErrors {
 public:
  SilencedGslErrors() : previous_(gsl_set_error_handler_off()) {}
  ~SilencedGslErrors() { gsl_set_error_handler(previous_); }
  SilencedGslErrors(const SilencedGslErrors&) = delete;
  SilencedGslErrors& operator=(const SilencedGslErrors&) = delete;

 private:
  gsl_error_handler_t* previous_;
};

}  // namespace wavebalance::solvers::detail
