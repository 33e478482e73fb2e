#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <unsupported/Eigen/AutoDiff>

#include "dense_algebra.hpp"
#include "period_oracle/shooting.hpp"
#include "support/jl14_bar.hpp"
#include "support/oscillator.hpp"
#include "wavebalance/solvers/period/first_order_system.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ExponentialLaw;
using testing::jl14_bar;
using testing::LinearContact;
using testing::Oscillator;

constexpr double bar_frequency = 150.0;
const ExponentialLaw law{1e8, 50.0, 1e-3};

/// The second-order equation, written once more for any scalar: du'/ds = T M^-1 (load cos - e f_c - C u' - K
/// u).
template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, 1> rate(const LinearStructure& bar, double periods,
                                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& state) {
  using std::cos, std::exp;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  const int n = bar.size();
  const double omega = 2.0 * std::numbers::pi * bar_frequency;
  const Eigen::MatrixXd inverse = oracle::inverse(Eigen::MatrixXd(bar.mass)) / bar_frequency;
  const Eigen::MatrixXd stiffness(bar.stiffness), damping(bar.damping);
  Vector displacement(n), force(n), result(2 * n);
  for (int i = 0; i < n; ++i) displacement[i] = state[i] / omega;
  for (int i = 0; i < n; ++i) {
    force[i] = Scalar(bar.load[i] * cos(2.0 * std::numbers::pi * periods));
    for (int j = 0; j < n; ++j)
      force[i] = force[i] - stiffness(i, j) * displacement[j] - damping(i, j) * state[n + j];
  }
  const Scalar tip = displacement[bar.selected_dof(0)];
  if (tip > law.start)
    force[bar.selected_dof(0)] =
        force[bar.selected_dof(0)] - law.constant * (exp(law.exponent * (tip - law.start)) - 1.0);
  for (int i = 0; i < n; ++i) {
    result[i] = state[n + i] * (omega / bar_frequency);
    result[n + i] = Scalar(0.0);
    for (int j = 0; j < n; ++j) result[n + i] = result[n + i] + inverse(i, j) * force[j];
  }
  return result;
}

/// A state with the tip at the given displacement and the rest drawn at random.
Eigen::VectorXd random_state(const LinearStructure& bar, double tip) {
  const int n = bar.size();
  const double omega = 2.0 * std::numbers::pi * bar_frequency;
  Eigen::VectorXd state(2 * n);
  for (double& value : state) value = 1e-3 * *rc::gen::inRange(-1500, 1500);
  state[bar.selected_dof(0)] = omega * tip;
  return state;
}

RC_GTEST_PROP(FirstOrderSystemProperty, DerivativeAndJacobianAgreeWithAutomaticDifferentiation, ()) {
  using Dual = Eigen::AutoDiffScalar<Eigen::VectorXd>;
  const LinearStructure bar = jl14_bar(4, 1e-4);
  const FirstOrderSystem system(bar, law, bar_frequency);
  const int size = system.states();
  const double periods = 1e-3 * *rc::gen::inRange(0, 5000);
  const bool contact = *rc::gen::arbitrary<bool>();
  const double depth = 1e-6 * *rc::gen::inRange(1, 2000);
  const Eigen::VectorXd state = random_state(bar, law.start + (contact ? depth : -depth));
  Eigen::Matrix<Dual, Eigen::Dynamic, 1> dual(size);
  for (int i = 0; i < size; ++i) dual[i] = Dual(state[i], size, i);
  const Eigen::Matrix<Dual, Eigen::Dynamic, 1> expected = rate<Dual>(bar, periods, dual);

  Eigen::VectorXd derivative(size), by_time(size);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_state(size, size);
  const std::span<const double> y(state.data(), state.size());
  system.derivative(periods, y, {derivative.data(), static_cast<std::size_t>(size)});
  system.jacobian(periods, y, {by_state.data(), static_cast<std::size_t>(size * size)},
                  {by_time.data(), static_cast<std::size_t>(size)});
  double rate_scale = 0.0, slope_scale = 0.0;
  for (int i = 0; i < size; ++i) {
    rate_scale = std::max(rate_scale, std::abs(expected[i].value()));
    slope_scale = std::max(slope_scale, expected[i].derivatives().cwiseAbs().maxCoeff());
  }
  for (int i = 0; i < size; ++i) {
    // Forces cancel in the sum, so the rate's error is relative to the largest term of it.
    RC_ASSERT(std::abs(derivative[i] - expected[i].value()) <=
              1e-13 * (rate_scale + slope_scale * state.cwiseAbs().maxCoeff()));
    RC_ASSERT((by_state.row(i).transpose() - expected[i].derivatives()).cwiseAbs().maxCoeff() <=
              1e-13 * slope_scale);
  }
}

RC_GTEST_PROP(ShootingProperty, MultipliersMultiplyToTheDecayOfPhaseSpaceVolume, ()) {
  // Liouville: the contact force does no change of volume, so det = exp(-c T / m) whatever the contact.
  Oscillator oscillator;
  oscillator.damping = *rc::gen::inRange(20, 400);
  oscillator.frequency = *rc::gen::inRange(10, 60);
  const LinearContact contact{1e5 * *rc::gen::inRange(1, 100), 1e-5 * *rc::gen::inRange(-20, 60)};
  oracle::ShootingOptions options;
  options.output_points = 16;
  const oracle::ShootingResult result =
      oracle::shoot(oscillator.structure(), contact, oscillator.frequency, options);
  const double expected = std::exp(-oscillator.damping / oscillator.mass / oscillator.frequency);
  RC_ASSERT(result.status != oracle::ShootingStatus::step_failure);
  RC_ASSERT(std::abs(result.floquet_multipliers.prod() - expected) <= 1e-9 * expected);
}

}  // namespace
}  // namespace wavebalance::solvers
