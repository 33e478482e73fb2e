#include "curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace wavebalance::ll10 {
namespace {

const std::vector<std::string> columns{"formulation", "energy_ratio", "frequency_ratio",
                                       "rayleigh_frequency_ratio"};

/// The linear branch and the accepted points.
void add_backbone(Table& table, const std::string& formulation, const app::ModeStudy& study,
                  const app::Backbone& curve) {
  const double linear = study.mode().linear_omega();
  for (const double energy : {0.0, 1.0}) table.append_row({formulation, energy, 1.0, 1.0});
  for (const auto& point : curve.points)
    if (point.accepted())
      table.append_row(
          {formulation, point.energy_ratio, point.omega / linear, std::sqrt(point.rayleigh) / linear});
}

}  // namespace

solvers::ModePoint accepted_at(const app::ModeStudy& study, const app::Backbone& curve, double energy_ratio) {
  auto point = study.at_energy(curve, energy_ratio);
  if (!point.accepted())
    throw report::NotConverged(
        fmt::format("energy ratio {}: {}", report::number(energy_ratio), to_string(point.status)));
  return point;
}

Table backbones_table(const app::ModeStudy& study, const app::Backbone& curve,
                      const std::vector<LagrangianPoint>& published) {
  Table table(columns);
  table.append_row({"published", 0.0, 1.0, 1.0});
  for (const auto& point : published) {
    const double root = std::sqrt(point.rayleigh) / study.mode().linear_omega();
    if (point.accepted()) table.append_row({"published", point.prescribed_ratio, root, root});
  }
  add_backbone(table, "consistent", study, curve);
  return table;
}

LagrangianModeOptions lagrangian_options(const app::Scene& scene, int harmonics) {
  LagrangianModeOptions options;
  options.mode = scene.analysis.mode;
  options.harmonics = harmonics;
  options.samples = scene.analysis.samples;
  options.cosine_only = scene.analysis.cosine_only;
  return options;
}

contact::MultiplierUpdate lagrangian_strategy(const LagrangianMode& mode) {
  return contact::MultiplierUpdate(
      std::vector<double>(static_cast<std::size_t>(mode.constraints()), first_penalty), {first_penalty});
}

std::vector<LagrangianPoint> published_branch(const app::ModeStudy& study) {
  const auto& analysis = study.scene().analysis;
  LagrangianModeOptions options = lagrangian_options(study.scene(), analysis.harmonics);
  options.formulation = ModeFormulation::published;
  options.eigenvalue = EigenvalueUpdate::sequential;
  const LagrangianMode mode(study.mode().model(), options);
  const Eigen::VectorXd energies = Eigen::VectorXd::LinSpaced(analysis.points, 1.0, analysis.largest_energy);
  return mode.branch(std::span(energies.data(), static_cast<std::size_t>(energies.size())),
                     lagrangian_strategy(mode), mode.linear_start(1.0));
}

Distance exact_distance(const app::ModeStudy& study, const app::Backbone& curve) {
  std::vector<double> errors;
  for (const auto& point : curve.points) {
    if (!point.accepted() || point.energy_ratio < 1.2 || point.energy_ratio > 10.0) continue;
    const double exact = exact_mode(study.scene(), point.energy_ratio).frequency_ratio();
    errors.push_back(std::abs(point.omega / study.mode().linear_omega() / exact - 1.0));
  }
  if (errors.empty()) throw report::NotConverged("no accepted points at energy ratios 1.2 to 10");
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors.back(), static_cast<int>(errors.size())};
}

Table backbones_table(const RodCurves& curves) {
  Table table = backbones_table(curves.study, curves.backbone, curves.published);
  add_backbone(table, "consistent_half_lumped", curves.remedy, curves.remedy_backbone);
  for (const double energy : {0.0, 1.0}) table.append_row({"exact", energy, 1.0, 1.0});
  const double onset = ExactBarMode::onset_energy(1, EnergyMeasure::modal);
  constexpr int points = 200;
  for (int i = 1; i <= points; ++i) {
    const double energy = onset * std::pow(10.0 / onset, static_cast<double>(i) / points);
    const auto mode = exact_mode(curves.study.scene(), energy);
    table.append_row({"exact", energy, mode.frequency_ratio(), mode.rayleigh_frequency_ratio()});
  }
  return table;
}

}  // namespace wavebalance::ll10
