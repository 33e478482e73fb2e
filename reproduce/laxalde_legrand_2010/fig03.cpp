#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curves.hpp"
#include "figures.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using app::Dash;
using app::SeriesStyle;

namespace {

constexpr int published_harmonics = 2;

/// A column of one formulation as a curve, from its `first` row on.
app::Series curve(const std::string& label, const Table& table, const std::string& formulation,
                  const std::string& column, Colour colour, Dash dash, std::size_t first) {
  const auto rows = table.where("formulation", formulation);
  const auto energy = rows.numbers("energy_ratio"), value = rows.numbers(column);
  std::vector<double> x(energy.begin() + static_cast<std::ptrdiff_t>(first), energy.end());
  std::vector<double> y(value.begin() + static_cast<std::ptrdiff_t>(first), value.end());
  app::Series series(label, x, y);
  series.colour = colour;
  series.dash = dash;
  return series;
}

app::Figure drawn(const app::ModeStudy& study, const app::Backbone& backbone, const Table& table) {
  app::Figure figure;
  figure.panel_width = 760;
  figure.panel_height = 460;
  auto& panel = figure.add_panel("consistent: " + discretisation(study.scene()));
  panel.x = axis("Energy γ over its value at linear grazing", 0.0, 10.0);
  panel.y = axis("Frequency over the linear one", 0.98, 1.28);
  panel.legend = app::Legend::bottom_right;
  panel.add(curve("exact, ω", table, "exact", "frequency_ratio", Colour::black, Dash::solid, 2));
  panel.add(curve("exact, √r", table, "exact", "rayleigh_frequency_ratio", Colour::black, Dash::dashed, 2));
  auto points = curve("consistent, ω", table, "consistent", "frequency_ratio", Colour::blue, Dash::solid, 1);
  auto quotient = curve("consistent, √r", table, "consistent", "rayleigh_frequency_ratio", Colour::sky_blue,
                        Dash::solid, 1);
  points.style = quotient.style = SeriesStyle::points;
  panel.add(points).add(quotient);
  panel.add(curve("published: √r taken for ω, N = 2", table, "published", "frequency_ratio",
                  Colour::vermillion, Dash::dash_dotted, 0));
  std::vector<double> energy, ratio;
  for (const auto& point : backbone.points)
    if (point.status == solvers::ModeStatus::internal_resonance) {
      energy.push_back(point.energy_ratio);
      ratio.push_back(point.omega / study.mode().linear_omega());
    }
  app::Series resonances("internal resonances", energy, ratio, SeriesStyle::points);
  resonances.colour = Colour::grey;
  resonances.marker = 8;
  panel.add(resonances);
  panel.mark_x(1.0);
  panel.segments.push_back({0.0, 1.0, 1.0, 1.0, false, Dash::solid, Colour::black, 1.6});
  return figure;
}

void claim_linear(report::Artefact& artefact) {
  const app::ModeStudy paper(artefact.scene("rod_consistent_mass.toml"));
  const double frequency = paper.linear_frequency();
  artefact.check({"section 5.1",
                  "The natural frequency of its linear counterpart with clamped-free boundary conditions is "
                  "1297.5 Hz.",
                  "the first frequency of 20 elements with the mass matrix of eq. (28) rounds to 1297.5 Hz",
                  report::number(frequency, 7) + " Hz", std::abs(frequency - 1297.5) < 0.05});
}

void claim_onset(report::Artefact& artefact, const app::Backbone& backbone) {
  double least = 1e300;
  for (const auto& point : backbone.points)
    if (point.accepted()) least = std::min(least, point.energy_ratio);
  const double exact = contact::ExactBarMode::onset_energy(1, contact::EnergyMeasure::modal);
  artefact.check(
      {"section 5.1", "Contact occurs as soon as the modal energy reaches unity.",
       "no motion with contact has an energy below 1 (less 1 %)",
       fmt::format(
           "motions with contact from {} on; the exact branch starts at 8/π² = {}. The linear mode does "
           "reach the obstacle at 1.",
           report::number(least, 4), report::number(exact, 4)),
       least > 0.99});
}

void claim_hardening(report::Artefact& artefact, const app::ModeStudy& study, const app::Backbone& backbone) {
  bool rising = true;
  std::string measured;
  double before = 1.0;
  for (const double energy : {1.2, 1.8, 3.0, 5.0, 10.0}) {
    const double ratio = study.at_energy(backbone, energy).omega / study.mode().linear_omega();
    rising = rising && ratio > before;
    before = ratio;
    measured += (measured.empty() ? "" : ", ") + report::number(ratio, 5) + " at " + report::number(energy);
  }
  artefact.check(
      {"section 5.1", "Then, the natural frequency increases which denotes a hardening effect.",
       "omega over the linear frequency rises from one to the next of the energies 1.2, 1.8, 3, 5, 10",
       measured, rising});
}

void claim_identity(report::Artefact& artefact, const app::ModeStudy& study, const app::Backbone& backbone) {
  const auto point = study.at_energy(backbone, 10.0);
  const double linear = study.mode().linear_omega(), root = std::sqrt(point.rayleigh) / linear;
  const auto exact = exact_mode(study.scene(), 10.0);
  artefact.check(
      {"section 3.1",
       "Nonlinear eigenvectors are defined as critical points of this Rayleigh quotient and the associated "
       "eigenvalues are such that ω² = r(û).",
       "at energy ratio 10 the root of r is within 1 % of omega",
       fmt::format(
           "omega {}, root of r {} of the linear frequency; exact {} and {}. Stationarity gives omega² = r + "
           "<force> gap / m: met to {}.",
           report::number(point.omega / linear, 5), report::number(root, 5),
           report::number(exact.frequency_ratio(), 5), report::number(exact.rayleigh_frequency_ratio(), 5),
           report::number(point.virial_residual, 2)),
       std::abs(root * linear / point.omega - 1.0) < 0.01});
}

void claim_work(report::Artefact& artefact, const app::ModeStudy& study, const app::Backbone& backbone) {
  const auto motion = study.contact_motion(study.at_energy(backbone, 10.0), study.scene().analysis.samples);
  const auto mean = [&](const Eigen::MatrixXd& values) {
    return motion.force.cwiseProduct(values).mean() / (motion.force.mean() * values.cwiseAbs().maxCoeff());
  };
  artefact.check(
      {"section 3.2",
       "since nonlinear forces arise from contact boundary conditions, their work is identically zero; hence "
       "the use of an unmodified Rayleigh quotient to define the respective eigenvalues",
       "at energy ratio 10 the mean power of the contact force is below 1e-10 of mean force times largest "
       "velocity",
       fmt::format(
           "{}; but the mean of force times displacement, which is what enters the quotient, is {} of mean "
           "force times largest displacement",
           report::number(mean(motion.velocity), 2), report::number(mean(motion.displacement), 2)),
       std::abs(mean(motion.velocity)) < 1e-10});
}

void claim_published(report::Artefact& artefact, const std::vector<solvers::LagrangianPoint>& published) {
  const auto& last = published.back();
  double defect = 0.0;
  for (const auto& point : published)
    if (point.accepted()) defect = std::max(defect, point.equation_residual);
  artefact.check(
      {"section 5.1",
       "the mode normalization of Eq. (24c) through a prescribed kinetic energy controls the amplitude of "
       "the nonlinear mode",
       "with h as printed in (24c), without n², the energy of (12) is that prescribed to 1 %",
       fmt::format(
           "prescribed {}, found {} ({}, N = {}, Algorithm 2); the equation of motion is met to {} only, at "
           "no frequency",
           report::number(last.prescribed_ratio), report::number(last.energy_ratio, 4),
           to_string(last.status), published_harmonics, report::percent(defect, 2)),
       std::abs(last.energy_ratio / last.prescribed_ratio - 1.0) < 0.01});
}

void notes(report::Artefact& artefact, const app::ModeStudy& study, const app::Backbone& backbone) {
  const auto distance = exact_distance(study, backbone);
  std::string errors;
  for (const double energy : {1.2, 1.8, 3.0, 5.0, 10.0}) {
    const double exact = exact_mode(study.scene(), energy).frequency_ratio();
    const double ratio = study.at_energy(backbone, energy).omega / study.mode().linear_omega();
    errors += (errors.empty() ? "" : ", ") + report::percent(ratio / exact - 1.0, 2) + " at " +
              report::number(energy);
  }
  artefact.note(fmt::format(
      "Consistent against exact, omega: {}; over the {} accepted points at energy ratios 1.2 to 10 median "
      "{}, largest {}.",
      errors, distance.points, report::percent(distance.median, 2), report::percent(distance.largest, 2)));
  const auto agreement = lagrangian_agreement(study, backbone, {1.1, 1.2, 1.5, 1.8, 2.4, 3, 4, 5, 7, 10});
  artefact.note(fmt::format(
      "The augmented Lagrangian (consistent, Algorithm 1), started from the condensed solution, agrees with "
      "it to {} in omega at {} energies. From a cold start it runs with N <= 2.",
      report::number(agreement.largest, 2), agreement.points));
  double residual = 0.0, identity = 0.0, penetration = 0.0, force = 0.0;
  for (std::size_t i = 0; i < backbone.points.size(); ++i)
    if (const auto& point = backbone.points[i]; point.accepted()) {
      residual = std::max(residual, backbone.residuals[i]);
      identity = std::max(identity, point.virial_residual);
      penetration = std::max(penetration, point.max_penetration);
      force = std::min(force, point.min_force);
    }
  artefact.note(fmt::format(
      "Accepted points: equation of motion to {}, identity to {}, least force {} N, penetration between the "
      "samples up to {} of the gap. {} points in {} ms; {} on internal resonances, {} beside them unsolved "
      "(cycling).",
      report::number(residual, 2), report::number(identity, 2), report::number(force, 2),
      report::percent(penetration, 2), backbone.points.size(), report::number(1e3 * backbone.wall_seconds, 3),
      backbone.count(solvers::ModeStatus::internal_resonance), backbone.count(solvers::ModeStatus::cycling)));
  artefact.note(
      "Half consistent, half lumped mass instead of eq. (28): the consistent one puts omega_2/omega_1 at "
      "3.0062, and an internal resonance 3:1 just above omega_1 ends the branch near grazing. The mixture "
      "has 3.0000 exactly, so that this resonance coincides with grazing.");
}

}  // namespace

void fig03(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("rod.toml"));
  const auto backbone = study.backbone();
  if (!backbone.converged()) throw report::NotConverged("backbone: " + backbone.status());
  const auto published = app::ModeStudy(artefact.scene("rod_published.toml")).published_branch(10.0);
  const auto table = backbones_table(study, backbone, published);
  artefact.data(
      table, "ratios to the linear mode; energy_ratio is gamma over its value at linear grazing",
      {"consistent: " + discretisation(study.scene()) + ", half-lumped mass",
       "published: eqs. (24) as printed, Algorithm 2, N = 2, m = 20; frequency_ratio is the root of r",
       "exact: d'Alembert; below contact the linear mode"});
  artefact.picture(drawn(study, backbone, table));
  artefact.caption(
      "First nonlinear mode of the rod: exact, computed from consistent equations, and as published. "
      "Published is the augmented Lagrangian of the printed equations, which runs with N = 2; the paper does "
      "not state its N. Stability is not drawn: "
      "where contacts have mass, no motion beside that of a rigid obstacle is determined without a law of impact.");
  claim_linear(artefact);
  claim_onset(artefact, backbone);
  claim_hardening(artefact, study, backbone);
  claim_identity(artefact, study, backbone);
  claim_work(artefact, study, backbone);
  claim_published(artefact, published);
  notes(artefact, study, backbone);
}

}  // namespace wavebalance::ll10
