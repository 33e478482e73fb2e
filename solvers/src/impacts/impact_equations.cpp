#include "impacts/impact_equations.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Rounding errors of the sums of an equation, over the errors of their largest partial sums.
constexpr double rounding_of_sums = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

ImpactEquations::ImpactEquations(const ImpactModel& model, std::vector<int> contacts, double impulse_scale)
    : model_(model), contacts_(std::move(contacts)), impulse_scale_(impulse_scale) {}

// Between impact j before and i, in (0, 1]: the same impact is a period before.
double ImpactEquations::share(Index i, Index j) const {
  return unknowns_[i] - unknowns_[j] + (j >= i ? 1.0 : 0.0);
}

void ImpactEquations::add_free(Index i) {
  const Index k = impacts();
  const int c = contacts_[static_cast<std::size_t>(i)];
  const double length = model_.displacement_scale(), speed = model_.velocity_scale();
  const ContactsAt free = model_.free_motion(unknowns_[i]);
  residual_[i] = (free.displacement[c] - model_.gaps()[c]) / length;
  residual_[k + i] = -free.velocity[c] / speed;
  rounding_[i] = (model_.free_magnitude(c, 0) + std::abs(model_.gaps()[c])) / length;
  rounding_[k + i] = model_.free_magnitude(c, 1) / speed;
  matrix_(i, i) += model_.period() * free.velocity[c] / length;
  matrix_(k + i, i) -= model_.period() * free.acceleration[c] / speed;
}

void ImpactEquations::add_impact(Index i, Index j) {
  const Index k = impacts();
  const int c = contacts_[static_cast<std::size_t>(i)], d = contacts_[static_cast<std::size_t>(j)];
  const double length = model_.displacement_scale(), speed = model_.velocity_scale();
  const double impulse = impulse_scale_ * unknowns_[k + j], period = model_.period();
  const GreenValues green = model_.green(c, d, share(i, j));
  residual_[i] -= impulse * green.value / length;
  residual_[k + i] += impulse * green.rate / speed;
  rounding_[i] += std::abs(impulse) * green.magnitude / length;
  rounding_[k + i] += std::abs(impulse) * green.rate_magnitude / speed;
  matrix_(i, k + j) -= impulse_scale_ * green.value / length;
  matrix_(k + i, k + j) += impulse_scale_ * green.rate / speed;
  value_by_period_(i, j) = impulse * green.value_by_period / length;
  rate_by_period_(i, j) = impulse * green.rate_by_period / speed;
  if (i == j) return;
  matrix_(i, i) -= period * impulse * green.rate / length;
  matrix_(i, j) += period * impulse * green.rate / length;
  matrix_(k + i, i) += period * impulse * green.second / speed;
  matrix_(k + i, j) -= period * impulse * green.second / speed;
}

void ImpactEquations::evaluate(const Eigen::VectorXd& unknowns) {
  const Index k = impacts();
  unknowns_ = unknowns;
  residual_.setZero(2 * k);
  rounding_.setZero(2 * k);
  matrix_.setZero(2 * k, 2 * k);
  value_by_period_.setZero(k, k);
  rate_by_period_.setZero(k, k);
  for (Index i = 0; i < k; ++i) {
    const int c = contacts_[static_cast<std::size_t>(i)];
    add_free(i);
    for (Index j = 0; j < k; ++j) add_impact(i, j);
    const double by_impulse = impulse_scale_ * model_.inverse_mass()(c, c) /
                              ((1.0 + model_.restitution()[c]) * model_.velocity_scale());
    residual_[k + i] += by_impulse * unknowns_[k + i];
    rounding_[k + i] += by_impulse * std::abs(unknowns_[k + i]);
    matrix_(k + i, k + i) += by_impulse;
  }
  rounding_ *= rounding_of_sums;
  // Instants are known to their rounding, through which the motion passes.
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (Index i = 0; i < 2 * k; ++i)
    for (Index j = 0; j < k; ++j) rounding_[i] += 4.0 * eps * std::abs(matrix_(i, j));
}

Eigen::VectorXd ImpactEquations::by_parameter(const ParameterSlopes& slopes) const {
  constexpr double turn = 2.0 * std::numbers::pi;
  const Index k = impacts();
  const double length = model_.displacement_scale(), speed = model_.velocity_scale();
  const double frequency = model_.problem().frequency,
               period_slope = -slopes.frequency / (frequency * frequency);
  const Eigen::MatrixXcd& free = model_.problem().linear_motion;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(2 * k);
  for (Index i = 0; i < k; ++i) {
    const int c = contacts_[static_cast<std::size_t>(i)];
    for (Index n = 0; n < free.cols(); ++n) {
      const std::complex<double> phase = std::polar(1.0, turn * double(n) * unknowns_[i]);
      const std::complex<double> rate =
          turn * double(n) * (frequency * slopes.linear_motion(c, n) + slopes.frequency * free(c, n));
      slope[i] += (slopes.linear_motion(c, n) * phase).real() / length;
      slope[k + i] += (rate * phase).imag() / speed;
    }
    slope[i] -= period_slope * value_by_period_.row(i).sum();
    slope[k + i] += period_slope * rate_by_period_.row(i).sum();
  }
  return slope;
}

}  // namespace wavebalance::solvers::detail
