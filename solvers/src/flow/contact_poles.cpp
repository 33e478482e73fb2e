#include "flow/contact_poles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// Zeros of moments that masses make, up to rounding.
void clear_rounding(Eigen::MatrixXd& moment, const Eigen::MatrixXd& magnitude) {
  constexpr double rounding = 1e-11;
  for (Index i = 0; i < moment.size(); ++i)
    if (std::abs(moment.data()[i]) < rounding * magnitude.data()[i]) moment.data()[i] = 0.0;
}

// Poles that decay within a radian make no ripple, and those without a share in the flexibility a small one.
double fastest_turn(const Eigen::VectorXcd& exponents, const Eigen::MatrixXcd& outputs,
                    const Eigen::MatrixXcd& inputs) {
  constexpr double negligible = 1e-7;
  const Eigen::ArrayXd share = outputs.cwiseAbs().colwise().maxCoeff().transpose().array() *
                               inputs.cwiseAbs().rowwise().maxCoeff().array() /
                               exponents.array().abs().max(1e-300);
  double fastest = 0.0;
  for (Index j = 0; j < exponents.size(); ++j)
    if (share[j] > negligible * share.sum() && std::abs(exponents[j].imag()) > -exponents[j].real())
      fastest = std::max(fastest, exponents[j].imag());
  return fastest;
}

}  // namespace

ContactPoles::ContactPoles(const ContactDynamics& dynamics, const Eigen::MatrixXcd& linear_motion,
                           double frequency)
    : RealStates(exponents_of(dynamics)),
      period_(1.0 / frequency),
      holding_(dynamics.holding()),
      exponents_(exponents_of(dynamics)),
      inputs_(inputs_of(dynamics)),
      constant_(dynamics.constant()) {
  if (dynamics.structurally_damped())
    throw std::invalid_argument(
        "ContactPoles: the structure has structural damping, which has no equation in time; the damping must "
        "be viscous");
  const Index rows = dynamics.contacts();
  constexpr Index few = 64;  // harmonics, which are summed at once for all contacts
  for (Index n = 0; n < linear_motion.cols(); ++n)
    if (!linear_motion.col(n).isZero(0.0)) harmonics_.push_back(n);
  if (Index(harmonics_.size()) <= few) keep_harmonics(linear_motion);
  for (Index row = 0; row < (Index(harmonics_.size()) > few ? rows : 0); ++row)
    free_.emplace_back(linear_motion.row(row).transpose(), 2.0 * std::numbers::pi * frequency);
  if (linear_motion.size() > 0) free_scale_ = linear_motion.rowwise().norm().maxCoeff();
  outputs_[0] = shapes_of(dynamics);
  for (std::size_t d = 1; d < levels; ++d) outputs_[d] = outputs_[d - 1] * exponents_.asDiagonal();
  for (std::size_t i = 0; i < levels; ++i) {
    moments_[i] = (outputs_[i] * inputs_).real();
    clear_rounding(moments_[i], outputs_[i].cwiseAbs() * inputs_.cwiseAbs());
  }
  for (std::size_t d = 0; d < levels; ++d) {
    real_outputs_[d].resize(rows, states());
    for (Index i = 0; i < rows; ++i) real_outputs_[d].row(i) = row_of(outputs_[d].row(i));
  }
  fastest_ = fastest_turn(exponents_, outputs_[0], inputs_);
}

const Eigen::MatrixXd& ContactPoles::feed(int level, int k) const {
  return k == level ? constant_ : moments_[std::size_t(level - 1 - k)];
}

// Amplitudes of all derivatives, real and imaginary parts in adjacent columns.
void ContactPoles::keep_harmonics(const Eigen::MatrixXcd& linear_motion) {
  const auto count = Index(harmonics_.size());
  for (std::size_t d = 0; d < levels; ++d) {
    amplitudes_[d].resize(linear_motion.rows(), 2 * count);
    for (Index i = 0; i < count; ++i) {
      const double n = double(harmonics_[std::size_t(i)]);
      const Eigen::VectorXcd own = linear_motion.col(harmonics_[std::size_t(i)]) *
                                   std::pow(Complex(0.0, 2.0 * std::numbers::pi * n / period_), int(d));
      amplitudes_[d].col(2 * i) = own.real();
      amplitudes_[d].col(2 * i + 1) = -own.imag();
    }
  }
}

std::array<Eigen::MatrixXd, levels> ContactPoles::linear_motion(const Eigen::VectorXd& times) const {
  std::array<Eigen::MatrixXd, levels> result;
  if (free_.empty()) {
    Eigen::MatrixXd waves(2 * Index(harmonics_.size()), times.size());
    for (Index k = 0; k < times.size(); ++k)
      for (std::size_t i = 0; i < harmonics_.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi / period_ * double(harmonics_[i]) * times[k];
        waves(2 * Index(i), k) = std::cos(angle);
        waves(2 * Index(i) + 1, k) = std::sin(angle);
      }
    for (std::size_t d = 0; d < levels; ++d) result[d] = product(amplitudes_[d], waves);
    return result;
  }
  result.fill(Eigen::MatrixXd(rows(), times.size()));
  for (Index row = 0; row < rows(); ++row)
    for (Index k = 0; k < times.size(); ++k) {
      const auto now = free_[std::size_t(row)].at(times[k] / period_);
      for (std::size_t d = 0; d < levels; ++d) result[d](row, k) = now[d];
    }
  return result;
}

}  // namespace wavebalance::solvers::detail
