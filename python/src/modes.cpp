#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <numbers>

#include "arrays.hpp"
#include "bindings.hpp"
#include "problem.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::python {

namespace py = pybind11;
using solvers::ModePoint;

namespace {

/// A nonlinear mode over its energy.
struct Backbone {
  std::string status;
  double linear_frequency = 0.0;  // Hz
  std::vector<ModePoint> points;
  std::vector<solvers::ModeStability> stability;
  Eigen::MatrixXd shapes = {};  // n x r, of the linear modes

  std::size_t size() const { return points.size(); }
  const ModePoint& at(int index) const { return point_at(points, index); }
};

app::StructureModes modes_of(const solvers::LinearStructure& structure, const solvers::ContactLaws& laws,
                             const std::vector<double>& gaps) {
  app::StructureModel model;
  model.structure = structure;
  model.gaps = gaps.empty() ? laws.gaps(structure.contacts())
                            : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                                  gaps.data(), static_cast<Eigen::Index>(gaps.size())));
  model.unknowns = structure.size();
  return app::make_modes(model);
}

Backbone rigid_backbone(const solvers::ModalModel& model, const app::Analysis& of,
                        const solvers::Observer& observer) {
  solvers::NonlinearModeOptions options;
  options.mode = of.mode;
  options.harmonics = of.harmonics;
  options.samples = of.samples;
  options.cosine_only = of.cosine_only;
  const solvers::NonlinearMode mode(model, options);
  Backbone result{"no_contact", mode.linear_omega() / (2.0 * std::numbers::pi), {}, {}};
  result.points = app::rigid_backbone(mode, of.points, of.largest_energy, of.last_frequency_ratio, observer);
  if (std::ranges::any_of(result.points, [](const ModePoint& point) {
        return point.status == solvers::ModeStatus::converged;
      }))
    result.status =
        result.points.back().energy_ratio >= of.largest_energy ? "reached_energy" : "reached_frequency";
  return result;
}

Backbone elastic_backbone(const solvers::ModalModel& model, const solvers::TimePair& pair,
                          const solvers::ContactLaws& laws, const app::Analysis& of,
                          const solvers::Observer& observer) {
  solvers::ElasticModeOptions options;
  options.mode = of.mode;
  options.cosine_only = of.cosine_only;
  const solvers::ElasticMode mode(model, pair, laws, options);
  solvers::ElasticBackboneOptions curve = app::elastic_options(of, of.largest_energy);
  curve.observer = observer;
  const solvers::ElasticBackbone found = mode.backbone(curve);
  Backbone result{
      std::string(to_string(found.status)), mode.linear_omega() / (2.0 * std::numbers::pi), found.points, {}};
  if (!of.stability || found.status == solvers::BackboneStatus::cancelled) return result;
  solvers::ModeStabilityOptions stability;
  stability.observer = observer;
  result.stability = solvers::backbone_stability(mode, found, stability).points;
  return result;
}

Backbone backbone(const Structure& structure, const py::object& laws, const solvers::TimePair& pair,
                  const std::vector<double>& gaps, const app::Analysis& of) {
  const solvers::ContactLaws all = laws_of(laws);
  all.require(structure.contacts());
  return unlocked([&](const solvers::Observer& observer) {
    const app::StructureModes modes = modes_of(structure, all, gaps);
    Backbone found = all.have_finite_force() ? elastic_backbone(modes.model, pair, all, of, observer)
                                             : rigid_backbone(modes.model, of, observer);
    found.shapes = modes.shapes;
    return found;
  });
}

/// Motion of the whole structure at a point.
solvers::Motion structure_motion(const Backbone& one, int index, int points) {
  const ModePoint& point = one.at(index);
  if (point.amplitudes.size() == 0)
    throw std::invalid_argument("index is " + std::to_string(index) + ": no motion was found there (" +
                                std::string(to_string(point.status)) + "); expected a point with a motion");
  return app::synthesised_motion(one.shapes * point.amplitudes, point.omega, points);
}

/// A nonlinear mode of a structure that loses energy, over its amplitude.
struct DampedCurve {
  double linear_frequency = 0.0, linear_damping_ratio = 0.0, linear_amplitude = 0.0;  // Hz, 1, m
  solvers::DampedMode mode;
  int dofs;  // of the structure
  solvers::DampedBackbone curve;

  std::size_t size() const { return curve.points.size(); }
  const solvers::DampedPoint& at(int index) const { return point_at(curve.points, index); }
};

/// Motion of the whole structure at a point.
solvers::Motion structure_motion(const DampedCurve& one, int index, int points) {
  const solvers::DampedPoint& point = one.at(index);
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(one.dofs, one.dofs);
  return app::synthesised_motion(one.mode.amplitudes(point, all), point.omega, points);
}

/// Amplitudes of 0: half the amplitude of first slip, and ten times it.
DampedCurve damped_curve(const Structure& structure, const py::object& laws, const solvers::TimePair& pair,
                         int mode, double first, double last, int points) {
  const solvers::ContactLaws all = laws_of(laws);
  all.require(structure.contacts());
  return unlocked([&](const solvers::Observer& observer) {
    const solvers::DampedMode damped(structure, pair, all, mode);
    DampedCurve result{damped.linear_omega() / (2.0 * std::numbers::pi),
                       damped.linear_damping_ratio(),
                       damped.linear_amplitude(),
                       damped,
                       structure.size(),
                       {}};
    const bool slips = std::isfinite(result.linear_amplitude) && result.linear_amplitude > 0.0;
    if (!slips && !(first > 0.0 && last > 0.0))
      throw std::invalid_argument(
          "amplitudes: no contact begins to slip at a known amplitude; expected two in m");
    solvers::DampedBackboneOptions options;
    options.first_amplitude = first > 0.0 ? first : 0.5 * result.linear_amplitude;
    options.last_amplitude = last > 0.0 ? last : 10.0 * result.linear_amplitude;
    if (options.last_amplitude > options.first_amplitude)
      options.max_step = std::log(options.last_amplitude / options.first_amplitude) / points;
    options.initial_step = std::min(options.initial_step, options.max_step);
    options.max_points = 1000 + 20 * points;
    options.observer = observer;
    result.curve = damped.backbone(options);
    return result;
  });
}

template <class Member>
auto damped_view(Member member) {
  return column_of<DampedCurve>(
      [](const DampedCurve& one) -> auto& { return one.curve.points; }, member);
}

template <class Member>
auto points_view(Member member) {
  return column_of<Backbone>(
      [](const Backbone& one) -> auto& { return one.points; }, member);
}

/// A number of each point of a curve.
template <class One, class Number>
auto each(Number number) {
  return [number](const One& one) {
    std::vector<double> values;
    for (std::size_t i = 0; i < one.size(); ++i) values.push_back(number(one.at(int(i))));
    return owned(std::move(values));
  };
}

double hertz(double omega) { return omega / (2.0 * std::numbers::pi); }

}  // namespace

void add_modes(py::module_& module) {
  py::class_<Backbone>(module, "Backbone")
      .def(py::init([](Backbone& one) { return std::move(one); }))
      .def_readonly("status", &Backbone::status)
      .def_readonly("linear_frequency", &Backbone::linear_frequency)
      .def_property_readonly("point_status", [](const Backbone& one) { return statuses_of(one.points); })
      .def_property_readonly("frequency",
                             each<Backbone>([](const ModePoint& point) { return hertz(point.omega); }))
      .def_property_readonly("energy_ratio", points_view(&ModePoint::energy_ratio))
      .def_property_readonly("contact_fraction", points_view(&ModePoint::contact_fraction))
      .def_property_readonly("virial_residual", points_view(&ModePoint::virial_residual))
      .def_property_readonly("unstable",
                             column_of<Backbone>(&Backbone::stability, &solvers::ModeStability::unstable))
      .def("__len__", &Backbone::size)
      .def("_structure_motion", py::overload_cast<const Backbone&, int, int>(&structure_motion))
      .def("amplitudes", [](const Backbone& one, int index) { return one.at(index).amplitudes; });
  py::class_<app::Analysis>(module, "BackboneArguments")
      .def(py::init([](int mode, double energy, double ratio, int points, int harmonics, int samples,
                       bool cosine_only, bool stability) {
        return app::Analysis{.stability = stability,
                             .mode = mode,
                             .harmonics = harmonics,
                             .samples = samples,
                             .cosine_only = cosine_only,
                             .largest_energy = energy,
                             .last_frequency_ratio = ratio,
                             .points = points};
      }));
  module.def("backbone", &backbone);
  py::class_<DampedCurve>(module, "DampedCurve")
      .def(py::init([](DampedCurve& one) { return std::move(one); }))
      .def_property_readonly("status",
                             [](const DampedCurve& one) { return std::string(to_string(one.curve.status)); })
      .def_readonly("linear_frequency", &DampedCurve::linear_frequency)
      .def_readonly("linear_damping_ratio", &DampedCurve::linear_damping_ratio)
      .def_readonly("slip_amplitude", &DampedCurve::linear_amplitude)
      .def_property_readonly("frequency", each<DampedCurve>([](const solvers::DampedPoint& point) {
                               return hertz(point.omega);
                             }))
      .def_property_readonly("amplitude", damped_view(&solvers::DampedPoint::amplitude))
      .def_property_readonly("damping_ratio", each<DampedCurve>([](const solvers::DampedPoint& point) {
                               return point.damping_ratio();
                             }))
      .def("__len__", &DampedCurve::size)
      .def("_structure_motion", py::overload_cast<const DampedCurve&, int, int>(&structure_motion))
      .def("displacement", [](const DampedCurve& one, int index) { return one.at(index).displacement; })
      .def("force", [](const DampedCurve& one, int index) { return one.at(index).force; });
  module.def("damped_curve", &damped_curve);
}

}  // namespace wavebalance::python
