#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "problem.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::python {

namespace py = pybind11;
using solvers::FrequencySweep, solvers::SweepPoint, solvers::PointStability;

namespace {

/// The keyword arguments of a sweep.
struct Steps {
  double first_step, largest_step;  // of the parameter; 0: a default
  int max_points, output_points;
  bool stability;
  std::string form;
};

solvers::FrequencySweepOptions options_of(double from, double to, const Steps& steps) {
  solvers::FrequencySweepOptions options;
  options.from = from;
  options.to = to;
  options.output_points = steps.output_points;
  options.max_points = steps.max_points;
  options.keep_unknowns = true;
  options.start.form = named<solvers::ContactForm>("form", steps.form);
  auto& arc = options.arc_length;
  const double scale = std::abs(to - from) / 20.0;
  arc.parameter_scale = scale;
  if (steps.first_step > 0.0) arc.initial_step = steps.first_step / scale;
  if (steps.largest_step > 0.0) arc.max_step = steps.largest_step / scale;
  arc.initial_step = std::min(arc.initial_step, arc.max_step);
  arc.min_step = std::min(arc.min_step, arc.initial_step / 20.0);
  return options;
}

/// `frequency`: of all points of an amplitude sweep; NaN for a frequency sweep.
std::shared_ptr<Curve> sweep(const std::shared_ptr<Problem>& problem, const py::object& laws,
                             double frequency, double from, double to, const Steps& steps) {
  auto one = std::make_shared<Curve>(Curve{problem, laws_of(laws, problem->condensed().structure()), {}, {}});
  solvers::FrequencySweepOptions options = options_of(from, to, steps);
  return unlocked([&](const solvers::Observer& observer) {
    const std::lock_guard alone(problem->alone);
    const app::WallClock clock;
    options.observer = observer;
    options.start.observer = observer;
    solvers::ContactProblem& with = problem->with(one->laws);
    one->curve = std::isfinite(frequency) ? with.amplitude_sweep(frequency, options) : with.sweep(options);
    if (steps.stability && one->curve.status != solvers::SweepStatus::cancelled)
      one->stability = with.stability(one->curve, steps.output_points, observer);
    one->wall_seconds = clock.seconds();
    return one;
  });
}

Response response_of(const Curve& one, int index) {
  const SweepPoint& point = point_at(one.curve.points, index);
  return unlocked([&](const solvers::Observer&) {
    const std::lock_guard alone(one.problem->alone);
    const double value = parameter_of(point, one.curve.parameter);
    return Response{one.problem, one.laws,
                    one.problem->with(one.laws).response(one.curve, value, point.unknown)};
  });
}

py::dict dictionary_of(const solvers::SpecialPoint& point) {
  py::dict values;
  values["type"] = to_string(point.type);
  values["frequency"] = point.frequency;
  values["amplitude"] = point.load_scale;
  values["bracket"] = point.bracket;
  values["multiplier"] = point.multiplier;
  values["max_displacement"] = point.max_displacement;
  values["located"] = point.located;
  return values;
}

template <class Member>
auto points_view(Member member) {
  return column_of<Curve>(
      [](const Curve& one) -> auto& { return one.curve.points; }, member);
}

template <class Member>
auto stability_view(Member member) {
  return column_of<Curve>(
      [](const Curve& one) -> auto& { return one.stability.points; }, member);
}

py::list special_points(const Curve& one) {
  py::list points;
  for (const auto& point : one.stability.special_points) points.append(dictionary_of(point));
  return points;
}

py::list turning_points(const Curve& one) {
  py::list points;
  for (const solvers::TurningPoint& point : one.curve.turning_points) {
    py::dict values;
    values["frequency"] = point.frequency;
    values["amplitude"] = point.load_scale;
    values["max_displacement"] = point.max_displacement;
    values["grazing"] = point.grazing;
    points.append(values);
  }
  return points;
}

}  // namespace

void add_sweeps(py::module_& module) {
  py::class_<Steps>(module, "Steps")
      .def(py::init(
          [](double first, double largest, int points, int output, bool stability, std::string form) {
            return Steps{first, largest, points, output, stability, std::move(form)};
          }));
  py::class_<Curve, std::shared_ptr<Curve>>(module, "Curve")
      .def(py::init([](Curve& one) { return std::make_shared<Curve>(std::move(one)); }))
      .def_property_readonly("status", [](const Curve& one) { return to_string(one.curve.status); })
      .def_property_readonly("form", [](const Curve& one) { return to_string(one.curve.form); })
      .def_property_readonly(
          "over_amplitude",
          [](const Curve& one) { return one.curve.parameter == solvers::SweepParameter::load_scale; })
      .def_property_readonly("rounding_error", [](const Curve& one) { return one.curve.rounding_error; })
      .def_readonly("wall_seconds", &Curve::wall_seconds)
      .def_property_readonly("frequency", points_view(&SweepPoint::frequency))
      .def_property_readonly("amplitude", points_view(&SweepPoint::load_scale))
      .def_property_readonly("max_displacement", points_view(&SweepPoint::max_displacement))
      .def_property_readonly("min_displacement", points_view(&SweepPoint::min_displacement))
      .def_property_readonly("max_abs_displacement", points_view(&SweepPoint::max_abs_displacement))
      .def_property_readonly("rms_displacement", points_view(&SweepPoint::rms_displacement))
      .def_property_readonly("max_force", points_view(&SweepPoint::max_force))
      .def_property_readonly("contact_fraction", points_view(&SweepPoint::contact_fraction))
      .def_property_readonly("residual", points_view(&SweepPoint::residual))
      .def_property_readonly("unstable", stability_view(&PointStability::unstable))
      .def_property_readonly("contacts", stability_view(&PointStability::contacts))
      .def_property_readonly("stability_status",
                             [](const Curve& one) { return statuses_of(one.stability.points); })
      .def_property_readonly("special_points", &special_points)
      .def_property_readonly("turning_points", &turning_points)
      .def("__len__", &Curve::size)
      .def("_response", &response_of);
  module.def("sweep", &sweep);
}

}  // namespace wavebalance::python
