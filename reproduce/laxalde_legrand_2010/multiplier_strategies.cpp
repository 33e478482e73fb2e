#include "multiplier_strategies.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::ll10 {
namespace {

constexpr double tolerance = 1e-10;
constexpr double stiffening = 10.0;

MultiplierReport reported(double inequality_measure, double equality_measure) {
  return {inequality_measure < tolerance && equality_measure < tolerance, false, inequality_measure,
          equality_measure};
}

}  // namespace

void MultipliersOnly::inequality_force(std::span<const double>, std::span<double> force,
                                       std::span<double> tangent) const {
  std::copy(multipliers_.begin(), multipliers_.end(), force.begin());
  std::fill(tangent.begin(), tangent.end(), 0.0);
}

void MultipliersOnly::restart(std::span<const double> inequality, double equality) {
  multipliers_.assign(inequality.begin(), inequality.end());
  equality_ = equality;
}

MultiplierReport MultipliersOnly::update(std::span<const double> g, double h) {
  double measure = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    measure = std::max(measure, std::abs(std::max(g[i], -multipliers_[i] / step_)));
    multipliers_[i] = std::max(0.0, multipliers_[i] + step_ * g[i]);
  }
  equality_ += step_ * h;
  return reported(measure, std::abs(h));
}

void PenaltiesOnly::inequality_force(std::span<const double> g, std::span<double> force,
                                     std::span<double> tangent) const {
  for (std::size_t i = 0; i < g.size(); ++i) {
    force[i] = penalty_ * std::max(0.0, g[i]);
    tangent[i] = g[i] >= 0.0 ? penalty_ : 0.0;
  }
}

MultiplierReport PenaltiesOnly::update(std::span<const double> g, double h) {
  double measure = 0.0;
  for (const double one : g) measure = std::max(measure, one);
  penalty_ *= stiffening;
  return reported(measure, std::abs(h));
}

}  // namespace wavebalance::ll10
