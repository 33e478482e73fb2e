#include "results/analyses.hpp"

#include <numbers>

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

std::string status_of(const DampedStudy& study, const solvers::DampedBackbone& curve, double largest) {
  using solvers::DampedBackboneStatus;
  if (curve.status == DampedBackboneStatus::reached_amplitude) return "converged";
  const std::string reason(to_string(curve.status));
  if (curve.points.empty()) return reason;
  return fmt::format(
      "ended at {:.4g} times the amplitude at which a contact first acts, before the {:.4g} asked for: {}",
      curve.points.back().amplitude / study.slip_amplitude(), largest, reason);
}

void append_setting(Summary& summary, const DampedStudy& study, const StructureModel& model) {
  const Scene& scene = study.scene();
  summary.emplace_back(quantities::analysis, name_of(scene.analysis.type));
  summary.emplace_back(quantities::mode, scene.analysis.mode);
  append_discretisation(summary, mode_time(scene));
  summary.emplace_back(quantities::linear_frequency, study.mode().linear_omega() / (2.0 * std::numbers::pi));
  summary.emplace_back(quantities::linear_damping_ratio, study.mode().linear_damping_ratio());
  summary.emplace_back(quantities::slip_amplitude, study.slip_amplitude());
  append_structure(summary, scene, model);
}

Record solution_record(const DampedStudy& study, const solvers::DampedBackbone& curve, double asked,
                       double wall_seconds) {
  Record record;
  record.converged = curve.status == solvers::DampedBackboneStatus::reached_amplitude;
  record.interrupted = curve.status == solvers::DampedBackboneStatus::cancelled;
  record.status = record.interrupted ? "interrupted" : status_of(study, curve, asked);
  int iterations = 0;
  for (const solvers::DampedPoint& point : curve.points) iterations += point.iterations;
  begin_summary(record, largest_of(curve.points, [](const auto& one) { return one.residual; }), iterations,
                study.mode().unknowns(), wall_seconds);
  return record;
}

Record curve_record(const DampedStudy& study, const StructureModel& model, const Observer& observer) {
  const WallClock clock;
  const double asked = study.scene().analysis.largest_amplitude;
  const solvers::DampedBackbone curve = study.curve(asked, observer);
  Record record = solution_record(study, curve, asked, clock.seconds());
  record.add(quantities::max_displacement,
             largest_of(curve.points, [](const auto& point) { return point.displacement.maxCoeff(); }));
  append_setting(record.summary, study, model);
  record.add(quantities::points, curve.points.size());
  record.add(quantities::largest_damping_ratio,
             largest_of(curve.points, [](const auto& point) { return point.damping_ratio(); }));
  const auto ratio = [&](const auto& point) { return point.omega / study.mode().linear_omega(); };
  record.add(quantities::least_frequency_ratio, least_of(curve.points, ratio));
  record.add(quantities::largest_frequency_ratio, largest_of(curve.points, ratio));
  record.backbone = damped_table(study, curve);
  const std::vector<ModeOutput> outputs =
      append_outputs(record, study.scene(), measure_outputs(study, curve, observer));
  record.figure = damped_figure(study.scene(), record.backbone, leading_of(outputs, study.scene()));
  draw_outputs(record, study.scene(), outputs);
  if (!record.converged) record.figure.title += " (INCOMPLETE: " + plain(record.status) + ")";
  return record;
}

Record motion_record(const DampedStudy& study, const StructureModel& model, const Observer& observer) {
  const WallClock clock;
  const Scene& scene = study.scene();
  const double asked = scene.analysis.amplitude_ratio;
  const solvers::DampedBackbone curve = study.curve(asked, observer);
  Record record = solution_record(study, curve, asked, clock.seconds());
  Response response;
  response.converged = response.moves = record.converged;
  const solvers::DampedPoint* point = record.converged ? &curve.points.back() : nullptr;
  if (point != nullptr) response.contacts = study.contact_motion(*point, scene.analysis.output_points);
  response.contact = leading_contact(scene, response.contacts, model.gaps);
  append_motion(record.summary, scene, point != nullptr ? response.contacts : solvers::Motion{},
                response.contact);
  append_setting(record.summary, study, model);
  const auto value = [&](auto number) { return point != nullptr ? number(*point) : missing; };
  const double frequency = value([](const auto& one) { return one.omega / (2.0 * std::numbers::pi); });
  record.add(quantities::frequency, frequency);
  record.add(quantities::frequency_ratio,
             value([&](const auto& one) { return one.omega / study.mode().linear_omega(); }));
  record.add(quantities::damping_ratio, value([](const auto& one) { return one.damping_ratio(); }));
  append_friction(record, scene, response, frequency);
  if (point == nullptr) return record;
  append_free_motion(record, scene, model, response, frequency, frequency, [&](int points) {
    return study.motion_of(Eigen::MatrixXd::Identity(model.size(), model.size()), *point, points);
  });
  return record;
}

}  // namespace

Record damped_mode_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  const Observer& observer = how.observer;
  goes_on(observer, {"linear modes"});
  const DampedStudy study(scene, model);
  goes_on(observer, {"backbone"});
  return scene.analysis.amplitude_ratio > 0.0 ? motion_record(study, model, observer)
                                              : curve_record(study, model, observer);
}

}  // namespace wavebalance::app
