#include "stability.hpp"

#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <complex>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "response.hpp"
#include "unlocked.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::python {

namespace py = pybind11;

solvers::StabilityOptions stability_options(const solvers::CondensedProblem& problem) {
  constexpr int most_harmonics = 255;
  solvers::StabilityOptions options;
  options.harmonics = std::clamp((problem.pair().functions() - 1) / 2, 1, most_harmonics);
  options.max_states = 120;
  options.max_operations = 3e10;
  return options;
}

namespace {

/// What is known of a response.
struct Stability {
  std::string status;
  int unstable = -1;
  std::vector<std::complex<double>> exponents, multipliers;
};

void add_exponents(Problem& problem, const Response& response, int count, Stability& result) {
  solvers::FloquetOptions options;
  options.stability = stability_options(problem.condensed());
  options.max_exponents = count;
  const auto found = solvers::floquet_exponents(problem.dynamics(), problem.condensed(), response.laws,
                                                response.found, options);
  if (found.status != solvers::StabilityStatus::converged) return;
  for (const auto& one : found.values) {
    result.exponents.push_back(one.exponent);
    result.multipliers.push_back(one.multiplier);
  }
}

Stability stability_of(const Response& response, int count) {
  Problem& problem = *response.problem;
  const std::lock_guard alone(problem.alone);
  if (!response.found.converged())
    return {std::string(to_string(solvers::StabilityStatus::no_response)), -1, {}, {}};
  problem.at(response.found.frequency, response.load_scale);
  const auto found = solvers::unstable_multipliers(problem.dynamics(), problem.condensed(), response.laws,
                                                   response.found, stability_options(problem.condensed()));
  Stability result{std::string(to_string(found.status)), found.count, {}, {}};
  if (found.status != solvers::StabilityStatus::converged) return result;
  if (count > 0) add_exponents(problem, response, count, result);
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
