#include "multiplier_strategies.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::ll10 {
namespace {

constexpr double tolerance = 1e-10;
constexpr double stiffening = 10.0;

}  // namespace

bool StrategyStep::converged() const {
  return inequality_measure < tolerance && equality_measure < tolerance;
}

MultipliersOnly::MultipliersOnly(int inequalities, double step)
    : step_(step), multipliers_(static_cast<std::size_t>(inequalities), 0.0) {}

void MultipliersOnly::inequality_force(std::span<const double>, std::span<double> force,
                                       std::span<double> tangent) const {
  std::copy(multipliers_.begin(), multipliers_.end(), force.begin());
  std::fill(tangent.begin(), tangent.end(), 0.0);
}

void MultipliersOnly::equality_force(std::span<const double>, std::span<double> force) const {
  force[0] = equality_;
}

double MultipliersOnly::inequality_term(std::span<const double> g) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) sum += multipliers_[i] * g[i];
  return sum;
}

double MultipliersOnly::equality_term(std::span<const double> h) const { return equality_ * h[0]; }

void MultipliersOnly::restart(std::span<const double> inequality, std::span<const double> equality) {
  if (!inequality.empty()) multipliers_.assign(inequality.begin(), inequality.end());
  if (!equality.empty()) equality_ = equality[0];
}

StrategyStep MultipliersOnly::update(std::span<const double> g, std::span<const double> h) {
  StrategyStep step{0.0, std::abs(h[0])};
  for (std::size_t i = 0; i < g.size(); ++i) {
    step.inequality_measure =
        std::max(step.inequality_measure, std::abs(std::max(g[i], -multipliers_[i] / step_)));
    multipliers_[i] = std::max(0.0, multipliers_[i] + step_ * g[i]);
  }
  equality_ += step_ * h[0];
  return step;
}

void PenaltiesOnly::inequality_force(std::span<const double> g, std::span<double> force,
                                     std::span<double> tangent) const {
  for (std::size_t i = 0; i < g.size(); ++i) {
    force[i] = penalty_ * std::max(0.0, g[i]);
    tangent[i] = g[i] >= 0.0 ? penalty_ : 0.0;
  }
}

void PenaltiesOnly::equality_force(std::span<const double> h, std::span<double> force) const {
  force[0] = penalty_ * h[0];
}

double PenaltiesOnly::inequality_term(std::span<const double> g) const {
  double sum = 0.0;
  for (const double one : g) sum += 0.5 * penalty_ * std::pow(std::max(0.0, one), 2);
  return sum;
}

double PenaltiesOnly::equality_term(std::span<const double> h) const { return 0.5 * penalty_ * h[0] * h[0]; }

StrategyStep PenaltiesOnly::update(std::span<const double> g, std::span<const double> h) {
  StrategyStep step{0.0, std::abs(h[0])};
  for (const double one : g) step.inequality_measure = std::max(step.inequality_measure, one);
  penalty_ *= stiffening;
  return step;
}

}  // namespace wavebalance::ll10
