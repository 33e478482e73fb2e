#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "problem.hpp"
#include "unlocked.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

/// Results of a response.
struct Stability {
  std::string status;
  int unstable = -1;
  std::vector<std::complex<double>> exponents, multipliers;
};

Stability stability_of(const Response& response, int count) {
  const std::lock_guard alone(response.problem->alone);
  if (!response.found.converged())
    return {std::string(to_string(solvers::StabilityStatus::no_response)), -1, {}, {}};
  solvers::ContactProblem& problem = response.problem->with(response.laws);
  const solvers::MotionStability found = problem.stability(response.found);
  const bool known = found.unstable >= 0;
  Stability result{known ? std::string(to_string(solvers::StabilityStatus::converged)) : found.status,
                   found.unstable,
                   {},
                   {}};
  if (!known || count < 1) return result;
  for (const solvers::FloquetExponent& one : problem.exponents(response.found, count).values) {
    result.exponents.push_back(one.exponent);
    result.multipliers.push_back(one.multiplier);
  }
  return result;
}

}  // namespace

void add_stability(py::module_& module) {
  py::class_<Stability>(module, "Stability")
      .def_readonly("status", &Stability::status)
      .def_readonly("unstable", &Stability::unstable)
      .def_readonly("_exponents", &Stability::exponents)
      .def_readonly("_multipliers", &Stability::multipliers);
  module.def("stability", [](const Response& response, int count) {
    return unlocked([&](const solvers::Observer&) { return stability_of(response, count); });
  });
}

}  // namespace wavebalance::python
