#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "linalg/bracket.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "modes/mode_option_checks.hpp"
#include "modes/mode_solver.hpp"

namespace wavebalance::solvers {

std::string_view to_string(ModeStatus status) {
  using enum ModeStatus;
  return detail::name_in<ModeStatus>({{converged, "converged"},
                                      {linear, "linear"},
                                      {no_contact, "no_contact"},
                                      {cycling, "cycling"},
                                      {singular, "singular"},
                                      {internal_resonance, "tongue"}},
                                     status);
}

void ModalModel::validate() const {
  const auto fail = [](const std::string& text) { throw std::invalid_argument("ModalModel: " + text); };
  if (modes() < 1 || contacts() < 1) fail("at least one mode and one contact degree of freedom are needed");
  if (contact_shapes.rows() != contacts() || contact_shapes.cols() != modes())
    fail("contact_shapes is " + std::to_string(contact_shapes.rows()) + " x " +
         std::to_string(contact_shapes.cols()) + "; " + std::to_string(contacts()) + " gaps and " +
         std::to_string(modes()) + " modes need it to be of that size");
  if (springs < 0 || springs >= modes())
    fail("springs is " + std::to_string(springs) + "; it must be in 0.." + std::to_string(modes() - 1));
  if (!(omega_squared.minCoeff() > 0.0)) fail("omega_squared must be positive; rigid-body modes have none");
  if (!(gaps.minCoeff() > 0.0))
    fail("gaps must be positive; the smallest is " + std::to_string(gaps.minCoeff()));
}

void NonlinearModeOptions::validate() const {
  constexpr const char* who = "NonlinearModeOptions";
  detail::require_mode_discretisation(who, mode, harmonics, samples);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_iterations", max_iterations, 1);
}

NonlinearMode::NonlinearMode(ModalModel model, NonlinearModeOptions options)
    : model_(std::move(model)), options_(options) {
  options_.validate();
  model_.validate();
  if (options_.mode > model_.modes())
    detail::reject("NonlinearMode", "mode", options_.mode,
                   ("in 1.." + std::to_string(model_.modes())).c_str());
  if (model_.contact_shapes.col(options_.mode - 1).isZero(0.0))
    throw std::invalid_argument("NonlinearMode: mode " + std::to_string(options_.mode) +
                                " does not move any contact point");
}

double NonlinearMode::linear_omega() const { return std::sqrt(model_.omega_squared[options_.mode - 1]); }

double NonlinearMode::grazing_energy() const {
  // Amplitude a of a mass-normalised shape in cos(omega t): m = 2 (a/2)^2, gamma = m/2. Both signs of the
  // shape are reached within a period.
  const Eigen::VectorXd shape = model_.contact_shapes.col(options_.mode - 1);
  const double amplitude = 1.0 / shape.cwiseAbs().cwiseQuotient(model_.gaps).maxCoeff();
  return 0.25 * amplitude * amplitude;
}

// The contact samples that the linear mode reaches first as it grows: at t = 0, the contact with the largest
// shape over gap, and those that graze with it, half a period later on the other side.
std::vector<int> NonlinearMode::grazing_samples() const {
  const Eigen::VectorXd reach = model_.contact_shapes.col(options_.mode - 1).cwiseQuotient(model_.gaps);
  constexpr double together = 1.0 - 1e-9;
  Eigen::Index first = 0;
  const double largest = reach.cwiseAbs().maxCoeff(&first);
  std::vector<int> grazing;
  for (int contact = 0; contact < model_.contacts(); ++contact) {
    if (std::abs(reach[contact]) < together * largest) continue;
    const bool later = reach[contact] * reach[first] < 0.0;
    if (!later || options_.samples % 2 == 0)
      grazing.push_back(contact * options_.samples + (later ? options_.samples / 2 : 0));
  }
  return grazing;
}

ModePoint NonlinearMode::at_frequency(double omega, const std::vector<int>& active) const {
  ModeSolver solver(*this, omega);
  return solver.solve(options_.harmonics, active.empty() ? grazing_samples() : active);
}

ModePoint NonlinearMode::at_frequency_by_harmonic_continuation(double omega) const {
  ModeSolver solver(*this, omega);
  std::vector<int> active = grazing_samples();
  int iterations = 0;
  for (int harmonics = std::min(2, options_.harmonics); harmonics < options_.harmonics; ++harmonics) {
    const ModePoint point = solver.solve(harmonics, active);
    iterations += point.iterations;
    active = point.active.empty() || point.status == ModeStatus::cycling ? grazing_samples() : point.active;
  }
  ModePoint point = solver.solve(options_.harmonics, active);
  point.iterations += iterations;
  return point;
}

ModePoint NonlinearMode::linear_mode(double energy_ratio) const {
  if (!(energy_ratio >= 0.0 && energy_ratio <= 1.0))
    throw std::invalid_argument("NonlinearMode: energy_ratio of a linear mode is " +
                                std::to_string(energy_ratio) + "; it must be in 0..1");
  ModePoint point;
  point.status = ModeStatus::linear;
  point.omega = linear_omega();
  point.force = Eigen::MatrixXd::Zero(model_.contacts(), options_.samples);
  point.amplitudes = Eigen::MatrixXcd::Zero(model_.modes(), options_.harmonics + 1);
  const Eigen::VectorXd shape = model_.contact_shapes.col(options_.mode - 1);
  Eigen::Index largest = 0;
  shape.cwiseQuotient(model_.gaps).cwiseAbs().maxCoeff(&largest);
  const double sign = shape[largest] > 0.0 ? 1.0 : -1.0;
  point.amplitudes(options_.mode - 1, 1) = sign * std::sqrt(energy_ratio * grazing_energy());
  point.energy_ratio = energy_ratio;
  point.max_penetration = std::sqrt(energy_ratio) - 1.0;
  point.rayleigh = point.omega * point.omega;
  return point;
}

void BackboneOptions::validate() const {
  if (points < 2 || !(first_ratio > 1.0 && last_ratio > first_ratio))
    throw std::invalid_argument("BackboneOptions: first_ratio " + std::to_string(first_ratio) +
                                ", last_ratio " + std::to_string(last_ratio) + ", points " +
                                std::to_string(points) +
                                "; 1 < first < last and at least 2 points are needed");
  detail::require_positive("BackboneOptions", "max_energy", max_energy);
}

std::vector<ModePoint> backbone(const NonlinearMode& mode, const BackboneOptions& options) {
  options.validate();
  std::vector<ModePoint> points;
  std::vector<int> active;
  double last_energy = 0.0;  // energy ratio of the last accepted point
  const double width = (options.last_ratio - options.first_ratio) / (options.points - 1);
  const auto close = [&](const ModePoint& point) {
    return last_energy == 0.0 || std::abs(std::log(point.energy_ratio / last_energy)) <= options.max_jump;
  };
  for (int i = 0; i < options.points; ++i) {
    const double ratio = options.first_ratio + i * width;
    if (!goes_on(options.observer, {"backbone", i, ratio, "frequency ratio", double(i) / options.points}))
      break;
    const double omega = mode.linear_omega() * ratio;
    ModePoint point =
        active.empty() ? mode.at_frequency_by_harmonic_continuation(omega) : mode.at_frequency(omega, active);
    if (!active.empty() && (point.status != ModeStatus::converged || !close(point))) {
      const int spent = point.iterations;
      point = mode.at_frequency_by_harmonic_continuation(omega);
      point.iterations += spent;
    }
    if (point.status == ModeStatus::converged && !close(point)) point.status = ModeStatus::internal_resonance;
    if (point.status == ModeStatus::converged) {
      active = point.active;
      last_energy = point.energy_ratio;
    }
    points.push_back(std::move(point));
    if (points.back().accepted() && points.back().energy_ratio > options.max_energy) break;
  }
  return points;
}

ModePoint at_energy(const NonlinearMode& mode, const std::vector<ModePoint>& points, double energy_ratio,
                    double tolerance) {
  if (energy_ratio <= 1.0) return mode.linear_mode(energy_ratio);
  const ModePoint* before = nullptr;
  const ModePoint* low = nullptr;
  const ModePoint* high = nullptr;
  for (const ModePoint& point : points) {
    if (!point.accepted()) continue;
    if (before && (before->energy_ratio - energy_ratio) * (point.energy_ratio - energy_ratio) <= 0.0) {
      low = before;
      high = &point;
      break;
    }
    before = &point;
  }
  if (!low) return {};
  constexpr int max_steps = 200;
  const auto miss = [&](const ModePoint& at) { return at.energy_ratio - energy_ratio; };
  ModePoint point = *high;
  if (std::abs(point.energy_ratio / energy_ratio - 1.0) <= tolerance) return point;
  detail::Bracket bracket{low->omega, high->omega, miss(*low), miss(*high)};
  const auto miss_at = [&](double omega) -> std::optional<double> {
    point = mode.at_frequency(omega, point.active);
    if (point.status != ModeStatus::converged) return std::nullopt;
    return miss(point);
  };
  const auto is_close = [&](const detail::Bracket&, double value) {
    return std::abs(value / energy_ratio) <= tolerance;
  };
  if (!detail::narrow(bracket, max_steps, miss_at, is_close)) return point;
  if (std::abs(point.energy_ratio / energy_ratio - 1.0) > tolerance)
    point.status = ModeStatus::internal_resonance;
  return point;
}

}  // namespace wavebalance::solvers
