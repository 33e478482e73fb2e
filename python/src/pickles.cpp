#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <complex>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "laws.hpp"
#include "response.hpp"
#include "sweeps.hpp"

/// What responses and curves hold beside their problem and laws, as tuples of plain values that can be
/// pickled.
namespace wavebalance::python {

namespace py = pybind11;

namespace {

py::tuple state_of(const Response& one) {
  const solvers::PeriodicResponse& found = one.found;
  return py::make_tuple(int(found.status), found.frequency, found.load_scale, found.residual,
                        found.iterations, int(found.strategy), found.attractor_periods,
                        found.residual_history, found.condition, found.rounding_error, found.displacement,
                        found.contact_force, found.force_on_held_structure, found.coefficients,
                        found.series_flexibility, found.unknown, found.unknown_coefficients,
                        one.wall_seconds);
}

Response restored_response(const std::shared_ptr<Problem>& problem, const py::object& laws,
                           const py::tuple& state) {
  std::size_t next = 0;
  const auto take = [&](auto& member) {
    member = state[next++].cast<std::remove_reference_t<decltype(member)>>();
  };
  Response one{problem, laws_of(laws, problem->condensed().structure()), {}, 0.0};
  solvers::PeriodicResponse& found = one.found;
  found.status = solvers::SolveStatus(state[next++].cast<int>());
  take(found.frequency), take(found.load_scale), take(found.residual), take(found.iterations);
  found.strategy = solvers::Strategy(state[next++].cast<int>());
  take(found.attractor_periods), take(found.residual_history), take(found.condition),
      take(found.rounding_error);
  take(found.displacement), take(found.contact_force), take(found.force_on_held_structure);
  take(found.coefficients), take(found.series_flexibility), take(found.unknown),
      take(found.unknown_coefficients);
  take(one.wall_seconds);
  return one;
}

using PointState = std::tuple<std::vector<double>, bool, Eigen::VectorXd>;

PointState state_of(const solvers::SweepPoint& point) {
  return {{point.frequency, point.max_displacement, point.rms_displacement, point.max_abs_displacement,
           point.min_displacement, point.max_force, point.contact_fraction, point.residual, point.load_scale},
          point.grazing,
          point.unknown};
}

solvers::SweepPoint point_of(const PointState& state) {
  const auto& [numbers, grazing, unknown] = state;
  return {.frequency = numbers.at(0),
          .max_displacement = numbers.at(1),
          .rms_displacement = numbers.at(2),
          .max_abs_displacement = numbers.at(3),
          .min_displacement = numbers.at(4),
          .max_force = numbers.at(5),
          .contact_fraction = numbers.at(6),
          .residual = numbers.at(7),
          .grazing = grazing,
          .unknown = unknown,
          .load_scale = numbers.at(8)};
}

using SpecialState =
    std::tuple<int, std::vector<double>, std::complex<double>, bool, Eigen::VectorXd, std::size_t>;

SpecialState state_of(const solvers::SpecialPoint& point) {
  return {int(point.type),
          {point.frequency, point.bracket, point.max_displacement, point.max_abs_displacement,
           point.unknown_parameter, point.load_scale},
          point.multiplier,
          point.located,
          point.unknown,
          point.next_point};
}

solvers::SpecialPoint special_point_of(const SpecialState& state) {
  const auto& [type, numbers, multiplier, located, unknown, next] = state;
  solvers::SpecialPoint point;
  point.type = solvers::SpecialPointType(type);
  point.frequency = numbers.at(0);
  point.bracket = numbers.at(1);
  point.max_displacement = numbers.at(2);
  point.max_abs_displacement = numbers.at(3);
  point.unknown_parameter = numbers.at(4);
  point.load_scale = numbers.at(5);
  point.multiplier = multiplier;
  point.located = located;
  point.unknown = unknown;
  point.next_point = next;
  return point;
}

using TurnState = std::vector<double>;

TurnState state_of(const solvers::TurningPoint& turn) {
  return {turn.frequency, turn.max_displacement, turn.max_abs_displacement, double(turn.grazing),
          turn.load_scale};
}

using StabilityState = std::vector<int>;

StabilityState state_of(const solvers::PointStability& point) {
  return {int(point.status), point.unstable, point.contacts, point.fold, point.flip};
}

template <class Item>
auto states_of(const std::vector<Item>& items) {
  std::vector<decltype(state_of(items.front()))> states;
  for (const Item& one : items) states.push_back(state_of(one));
  return states;
}

py::tuple state_of(const Curve& one) {
  const solvers::FrequencySweep& curve = one.curve;
  return py::make_tuple(int(curve.status), curve.closed_at_start, int(curve.parameter), int(curve.form),
                        curve.series_flexibility, curve.condition, curve.rounding_error,
                        states_of(curve.points), states_of(one.stability.points),
                        states_of(one.stability.special_points), one.wall_seconds,
                        states_of(curve.turning_points));
}

std::shared_ptr<Curve> restored_curve(const std::shared_ptr<Problem>& problem, const py::object& laws,
                                      const py::tuple& state) {
  auto one = std::make_shared<Curve>(Curve{problem, laws_of(laws, problem->condensed().structure()), {}, {}});
  one->curve.status = solvers::SweepStatus(state[0].cast<int>());
  one->curve.closed_at_start = state[1].cast<bool>();
  one->curve.parameter = solvers::SweepParameter(state[2].cast<int>());
  one->curve.form = solvers::ContactForm(state[3].cast<int>());
  one->curve.series_flexibility = state[4].cast<Eigen::VectorXd>();
  one->curve.condition = state[5].cast<double>();
  one->curve.rounding_error = state[6].cast<double>();
  for (const PointState& point : state[7].cast<std::vector<PointState>>())
    one->curve.points.push_back(point_of(point));
  for (const StabilityState& point : state[8].cast<std::vector<StabilityState>>())
    one->stability.points.push_back(
        {solvers::StabilityStatus(point.at(0)), point.at(1), point.at(2), point.at(3), point.at(4)});
  for (const SpecialState& point : state[9].cast<std::vector<SpecialState>>())
    one->stability.special_points.push_back(special_point_of(point));
  one->wall_seconds = state[10].cast<double>();
  for (const TurnState& turn : state[11].cast<std::vector<TurnState>>())
    one->curve.turning_points.push_back({turn.at(0), turn.at(1), turn.at(2), turn.at(3) != 0.0, turn.at(4)});
  return one;
}

}  // namespace

void add_pickles(py::module_& module) {
  module.def("response_state", [](const Response& one) { return state_of(one); });
  module.def("restored_response", &restored_response);
  module.def("curve_state", [](const Curve& one) { return state_of(one); });
  module.def("restored_curve", &restored_curve);
}

}  // namespace wavebalance::python
