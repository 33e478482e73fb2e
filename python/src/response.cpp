#include "problem.hpp"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

/// The status of a dynamic stiffness that is singular, as of a record.
solvers::PeriodicResponse singular_response(int samples, double frequency) {
  solvers::PeriodicResponse response;
  response.status = solvers::SolveStatus::singular;
  response.frequency = frequency;
  response.residual = solvers::missing;
  response.displacement = Eigen::VectorXd::Constant(samples, response.residual);
  response.contact_force = response.displacement;
  response.force_on_held_structure = response.displacement;
  return response;
}

/// Samples of contacts x points, contact-major.
Eigen::VectorXd samples_of(const py::array_t<double, py::array::c_style | py::array::forcecast>& array) {
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

Response respond(const std::shared_ptr<Problem>& problem, const py::object& laws, double frequency,
                 const py::object& guess, bool stay_near_guess, const std::string& form, double tolerance,
                 int max_iterations) {
  solvers::ContactLaws all = laws_of(laws, problem->condensed().structure());
  solvers::ForcedResponseOptions options;
  options.form = named<solvers::ContactForm>("form", form);
  options.stay_near_guess = stay_near_guess;
  options.newton.tolerance = tolerance;
  options.newton.max_iterations = max_iterations;
  Eigen::VectorXd start, force;
  if (py::isinstance<Response>(guess)) {
    start = guess.cast<const Response&>().found.displacement;
    force = guess.cast<const Response&>().found.contact_force;
  } else if (!guess.is_none()) {
    start = samples_of(guess.cast<py::array_t<double, py::array::c_style | py::array::forcecast>>());
  }
  return unlocked([&](const solvers::Observer& observer) {
    options.observer = observer;
    return solve(problem, std::move(all), frequency, options, start, force);
  });
}

solvers::Motion contact_motion(const Response& response, int points) {
  return unlocked([&](const solvers::Observer&) {
    const std::lock_guard alone(response.problem->alone);
    return response.problem->with(response.laws).motion(response.found, points);
  });
}

solvers::Motion structure_motion(const Response& response, int points) {
  return unlocked([&](const solvers::Observer&) {
    const std::lock_guard alone(response.problem->alone);
    solvers::Motion motion = response.problem->with(response.laws).structure_motion(response.found, points);
    motion.displacement = response.problem->recovered(motion.displacement);
    motion.velocity = response.problem->recovered(motion.velocity);
    return motion;
  });
}

py::array displacement_view(const py::object& self) {
  const auto& one = self.cast<const Response&>();
  return samples_view(one.found.displacement, one.problem->condensed().contacts(), self);
}

py::array force_view(const py::object& self) {
  const auto& one = self.cast<const Response&>();
  return samples_view(one.found.contact_force, one.problem->condensed().contacts(), self);
}

void add_motion(py::module_& module) {
  using solvers::Motion;
  py::class_<Motion>(module, "Motion")
      .def_readonly("displacement", &Motion::displacement)
      .def_readonly("velocity", &Motion::velocity)
      .def_readonly("force", &Motion::force);
}

}  // namespace

Response solve(const std::shared_ptr<Problem>& problem, solvers::ContactLaws laws, double frequency,
               const solvers::ForcedResponseOptions& options, const Eigen::VectorXd& guess,
               const Eigen::VectorXd& guess_force) {
  solvers::PeriodicResponse found;
  const std::lock_guard alone(problem->alone);
  const app::WallClock clock;
  try {
    found = problem->with(laws).respond(frequency, options, {guess, guess_force});
  } catch (const solvers::SingularSystem&) {
    found = singular_response(problem->condensed().samples(), frequency);
  }
  return {problem, std::move(laws), std::move(found), clock.seconds()};
}

void add_response(py::module_& module) {
  add_motion(module);
  py::class_<Response>(module, "Response")
      .def(py::init([](Response& one) { return std::move(one); }))
      .def_property_readonly("converged", [](const Response& one) { return one.found.converged(); })
      .def_property_readonly("status", [](const Response& one) { return to_string(one.found.status); })
      .def_property_readonly("frequency", [](const Response& one) { return one.found.frequency; })
      .def_property_readonly("residual", [](const Response& one) { return one.found.residual; })
      .def_property_readonly("iterations", [](const Response& one) { return one.found.iterations; })
      .def_property_readonly("strategy", [](const Response& one) { return to_string(one.found.strategy); })
      .def_property_readonly("residual_history",
                             [](const Response& one) { return one.found.residual_history; })
      .def_property_readonly("condition", [](const Response& one) { return one.found.condition; })
      .def_property_readonly("rounding_error", [](const Response& one) { return one.found.rounding_error; })
      .def_readonly("wall_seconds", &Response::wall_seconds)
      .def_property_readonly("displacement", &displacement_view)
      .def_property_readonly("contact_force", &force_view)
      .def_property_readonly(
          "first_sample", [](const Response& one) { return one.problem->condensed().pair().first_sample(); })
      .def_property_readonly("coefficients", [](const Response& one) { return one.found.coefficients; })
      .def("_motion", &contact_motion)
      .def("_structure_motion", &structure_motion);
  module.def("forced_response", &respond);
}

}  // namespace wavebalance::python
