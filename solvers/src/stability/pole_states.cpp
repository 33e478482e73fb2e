#include "stability/pole_states.hpp"

#include <cmath>
#include <complex>
#include <numeric>

namespace wavebalance::solvers {

using Complex = std::complex<double>;

PoleStates::PoleStates(const ContactDynamics& dynamics, double period)
    : dynamics_(dynamics), period_(period) {
  for (const ContactPole& pole : dynamics.poles()) {
    begins_.push_back(size_);
    size_ += pole.exponent.imag() == 0.0 ? 1 : 2;
  }
}

std::vector<Eigen::Index> PoleStates::left_after(double time) const {
  constexpr double vanished = 1e-20;
  std::vector<Eigen::Index> left;
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    const Complex exponent = dynamics_.poles()[l].exponent;
    if (std::exp(exponent.real() * time * period_) < vanished) continue;
    left.push_back(begins_[l]);
    if (exponent.imag() != 0.0) left.push_back(begins_[l] + 1);
  }
  return left;
}

Eigen::MatrixXd PoleStates::motion_of_contacts(double time, int derivative) const {
  Eigen::MatrixXd motion(dynamics_.contacts(), size_);
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    const ContactPole& pole = dynamics_.poles()[l];
    const Complex rate = derivative == 0 ? 1.0 : pole.exponent;
    const Eigen::VectorXcd shape =
        rate * pole.residue * std::exp(pole.exponent * time * period_) * pole.shape;
    if (pole.exponent.imag() == 0.0) {
      motion.col(begins_[l]) = shape.real();
    } else {
      motion.col(begins_[l]) = 2.0 * shape.real();
      motion.col(begins_[l] + 1) = -2.0 * shape.imag();
    }
  }
  return motion;
}

Eigen::MatrixXd PoleStates::generator() const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size_, size_);
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    const Index i = begins_[l];
    const double re = dynamics_.poles()[l].exponent.real(), im = dynamics_.poles()[l].exponent.imag();
    matrix(i, i) = re;
    if (im != 0.0) matrix.block(i, i, 2, 2) << re, -im, im, re;
  }
  return matrix;
}

Eigen::MatrixXd PoleStates::free_motion(double time) const { return motion_of_contacts(time, 0); }

Eigen::MatrixXd PoleStates::free_velocity(double time) const { return motion_of_contacts(time, 1); }

void PoleStates::advance(double time, Eigen::MatrixXd& states) const {
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    const Complex growth = std::exp(dynamics_.poles()[l].exponent * time * period_);
    if (dynamics_.poles()[l].exponent.imag() == 0.0) {
      states.row(begins_[l]) *= growth.real();
      continue;
    }
    const Eigen::RowVectorXd re = states.row(begins_[l]), im = states.row(begins_[l] + 1);
    states.row(begins_[l]) = growth.real() * re - growth.imag() * im;
    states.row(begins_[l] + 1) = growth.imag() * re + growth.real() * im;
  }
}

Eigen::VectorXcd PoleStates::growth(double time) const {
  Eigen::VectorXcd factors(Index(begins_.size()));
  for (Index l = 0; l < factors.size(); ++l)
    factors[l] = std::exp(dynamics_.poles()[std::size_t(l)].exponent * time * period_);
  return factors;
}

Eigen::MatrixXd PoleStates::after_impulses(const Eigen::VectorXcd& factors,
                                           const std::vector<int>& contacts) const {
  Eigen::MatrixXd states(size_, Index(contacts.size()));
  for (Index c = 0; c < states.cols(); ++c)
    for (std::size_t l = 0; l < begins_.size(); ++l) {
      const ContactPole& pole = dynamics_.poles()[l];
      const Complex state = factors[Index(l)] * pole.left[contacts[std::size_t(c)]];
      states(begins_[l], c) = state.real();
      if (pole.exponent.imag() != 0.0) states(begins_[l] + 1, c) = state.imag();
    }
  return states;
}

Eigen::MatrixXd PoleStates::after_impulse(double time) const {
  std::vector<int> all(static_cast<std::size_t>(dynamics_.contacts()));
  std::iota(all.begin(), all.end(), 0);
  return after_impulses(growth(time), all);
}

}  // namespace wavebalance::solvers
