#include "linalg/root.hpp"

#include <gsl/gsl_roots.h>

#include <cmath>
#include <exception>
#include <limits>
#include <memory>

#include "linalg/gsl_errors.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Called by GSL: no exception passes through it.
struct Called {
  const std::function<double(double)>* function;
  std::exception_ptr thrown;
  bool finite = true;
};

double call(double at, void* parameters) {
  auto& called = *static_cast<Called*>(parameters);
  double value = std::numeric_limits<double>::quiet_NaN();
  if (!called.thrown) try {
      value = (*called.function)(at);
    } catch (...) {
      called.thrown = std::current_exception();
    }
  called.finite = called.finite && std::isfinite(value);
  return value;
}

}  // namespace

std::optional<double> root(const std::function<double(double)>& function, Sample a, Sample b,
                           double tolerance) {
  constexpr int most = 100;
  if (a.value == 0.0) return a.at;
  if (b.value == 0.0) return b.at;
  if (!((a.value < 0.0) != (b.value < 0.0)) || !std::isfinite(a.value) || !std::isfinite(b.value))
    return std::nullopt;
  const SilencedGslErrors silenced;
  Called called{&function, nullptr};
  gsl_function wrapped{&call, &called};
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  int status = gsl_root_fsolver_set(solver.get(), &wrapped, std::min(a.at, b.at), std::max(a.at, b.at));
  for (int i = 0; i < most && status == GSL_SUCCESS; ++i) {
    status = gsl_root_fsolver_iterate(solver.get());
    if (called.thrown || !called.finite) break;
    const double from = gsl_root_fsolver_x_lower(solver.get()), to = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(from, to, tolerance * std::abs(b.at - a.at), 0.0) == GSL_SUCCESS) break;
  }
  if (called.thrown) std::rethrow_exception(called.thrown);
  if (!called.finite || status != GSL_SUCCESS) return std::nullopt;
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace wavebalance::solvers::detail
