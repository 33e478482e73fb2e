#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <tuple>
#include <type_traits>

#include "bindings.hpp"
#include "problem.hpp"

/// Data of responses and curves in addition to their problem and laws, as tuples of plain values that can
/// be pickled.
namespace wavebalance::python {

namespace py = pybind11;

namespace {

template <class One, class Plain>
concept Is = std::same_as<std::remove_const_t<One>, Plain>;

/// The members of each struct, in the order of its tuple.
auto members_of(Is<solvers::PeriodicResponse> auto& one) {
  return std::tie(one.status, one.frequency, one.load_scale, one.residual, one.iterations, one.strategy,
                  one.attractor_periods, one.residual_history, one.condition, one.rounding_error,
                  one.displacement, one.contact_force, one.force_on_held_structure, one.coefficients,
                  one.series_flexibility, one.unknown, one.unknown_coefficients);
}
auto members_of(Is<solvers::SweepPoint> auto& one) {
  return std::tie(one.frequency, one.max_displacement, one.rms_displacement, one.max_abs_displacement,
                  one.min_displacement, one.max_force, one.contact_fraction, one.residual, one.grazing,
                  one.unknown, one.load_scale, one.vibration, one.rms_vibration);
}
auto members_of(Is<solvers::TurningPoint> auto& one) {
  return std::tie(one.frequency, one.max_displacement, one.max_abs_displacement, one.grazing, one.load_scale);
}
auto members_of(Is<solvers::PointStability> auto& one) {
  return std::tie(one.status, one.unstable, one.contacts, one.fold, one.flip);
}
auto members_of(Is<solvers::SpecialPoint> auto& one) {
  return std::tie(one.type, one.frequency, one.bracket, one.multiplier, one.max_displacement,
                  one.max_abs_displacement, one.located, one.unknown, one.unknown_parameter, one.load_scale,
                  one.next_point, one.vibration);
}
auto members_of(Is<solvers::FrequencySweep> auto& one) {
  return std::tie(one.status, one.closed_at_start, one.parameter, one.form, one.series_flexibility,
                  one.points, one.turning_points, one.condition, one.rounding_error);
}
auto members_of(Is<solvers::CurveStability> auto& one) {
  return std::tie(one.points, one.special_points, one.cancelled);
}
auto members_of(Is<Response> auto& one) { return std::tie(one.found, one.wall_seconds); }
auto members_of(Is<Curve> auto& one) { return std::tie(one.curve, one.stability, one.wall_seconds); }

template <class Value>
py::object state_of(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return py::int_(static_cast<int>(value));
  } else if constexpr (requires { members_of(value); }) {
    return std::apply([](const auto&... one) { return py::make_tuple(state_of(one)...); }, members_of(value));
  } else if constexpr (requires { members_of(value.front()); }) {
    py::list states;
    for (const auto& one : value) states.append(state_of(one));
    return states;
  } else {
    return py::cast(value);
  }
}

template <class Value>
void restore(Value& value, const py::handle& state) {
  if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>(state.cast<int>());
  } else if constexpr (requires { members_of(value); }) {
    const auto parts = py::reinterpret_borrow<py::tuple>(state);
    std::size_t next = 0;
    std::apply([&](auto&... one) { (restore(one, py::object(parts[next++])), ...); }, members_of(value));
  } else if constexpr (requires { members_of(value.front()); }) {
    for (const py::handle one : state) restore(value.emplace_back(), one);
  } else {
    value = state.cast<Value>();
  }
}

template <class One>
std::shared_ptr<One> restored(const std::shared_ptr<Problem>& problem, const py::object& laws,
                              const py::tuple& state) {
  auto one = std::make_shared<One>(One{problem, laws_of(laws, problem->condensed().structure()), {}, {}});
  restore(*one, state);
  return one;
}

}  // namespace

void add_pickles(py::module_& module) {
  module.def("response_state", [](const Response& one) { return state_of(one); });
  module.def("restored_response",
             [](const std::shared_ptr<Problem>& problem, const py::object& laws, const py::tuple& state) {
               return std::move(*restored<Response>(problem, laws, state));
             });
  module.def("curve_state", [](const Curve& one) { return state_of(one); });
  module.def("restored_curve", &restored<Curve>);
}

}  // namespace wavebalance::python
