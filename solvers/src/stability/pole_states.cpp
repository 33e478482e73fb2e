#include "stability/pole_states.hpp"

#include <cmath>
#include <complex>

namespace wavebalance::solvers {

using Complex = std::complex<double>;

namespace detail {

Eigen::VectorXcd exponents_of(const ContactDynamics& dynamics) {
  Eigen::VectorXcd result(Index(dynamics.poles().size()));
  for (Index l = 0; l < result.size(); ++l) result[l] = dynamics.poles()[std::size_t(l)].exponent;
  return result;
}

Eigen::MatrixXcd shapes_of(const ContactDynamics& dynamics) {
  Eigen::MatrixXcd result(dynamics.contacts(), Index(dynamics.poles().size()));
  for (Index l = 0; l < result.cols(); ++l) {
    const ContactPole& pole = dynamics.poles()[std::size_t(l)];
    result.col(l) = (pole.exponent.imag() == 0.0 ? 1.0 : 2.0) * pole.residue * pole.shape;
  }
  return result;
}

Eigen::MatrixXcd inputs_of(const ContactDynamics& dynamics) {
  Eigen::MatrixXcd result(Index(dynamics.poles().size()), dynamics.contacts());
  for (Index l = 0; l < result.rows(); ++l) result.row(l) = dynamics.poles()[std::size_t(l)].left.transpose();
  return result;
}

RealStates::RealStates(const Eigen::VectorXcd& exponents) {
  for (const Complex exponent : exponents) {
    begins_.push_back(size_);
    pairs_.push_back(exponent.imag() != 0.0);
    size_ += pairs_.back() ? 2 : 1;
  }
}

Eigen::MatrixXd RealStates::real_of(const Eigen::MatrixXcd& states) const {
  Eigen::MatrixXd result(size_, states.cols());
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    result.row(begins_[l]) = states.row(Index(l)).real();
    if (pairs_[l]) result.row(begins_[l] + 1) = states.row(Index(l)).imag();
  }
  return result;
}

Eigen::MatrixXcd RealStates::complex_of(const Eigen::MatrixXd& states) const {
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(Index(begins_.size()), states.cols());
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    result.row(Index(l)).real() = states.row(begins_[l]);
    if (pairs_[l]) result.row(Index(l)).imag() = states.row(begins_[l] + 1);
  }
  return result;
}

Eigen::RowVectorXd RealStates::row_of(const Eigen::RowVectorXcd& weights) const {
  Eigen::RowVectorXd result(size_);
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    result[begins_[l]] = weights[Index(l)].real();
    if (pairs_[l]) result[begins_[l] + 1] = -weights[Index(l)].imag();
  }
  return result;
}

Eigen::MatrixXd RealStates::diagonal(const Eigen::VectorXcd& factors) const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size_, size_);
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    const Index i = begins_[l];
    const double re = factors[Index(l)].real(), im = factors[Index(l)].imag();
    matrix(i, i) = re;
    if (pairs_[l]) matrix.block(i, i, 2, 2) << re, -im, im, re;
  }
  return matrix;
}

void RealStates::multiply(const Eigen::VectorXcd& factors, Eigen::MatrixXd& states) const {
  for (std::size_t l = 0; l < begins_.size(); ++l) {
    const double real = factors[Index(l)].real(), imag = factors[Index(l)].imag();
    if (!pairs_[l]) {
      states.row(begins_[l]) *= real;
      continue;
    }
    const Eigen::RowVectorXd re = states.row(begins_[l]), im = states.row(begins_[l] + 1);
    states.row(begins_[l]) = real * re - imag * im;
    states.row(begins_[l] + 1) = imag * re + real * im;
  }
}

}  // namespace detail

PoleStates::PoleStates(const ContactDynamics& dynamics, double period)
    : RealStates(detail::exponents_of(dynamics)),
      period_(period),
      exponents_(detail::exponents_of(dynamics)),
      shapes_(detail::shapes_of(dynamics)),
      inputs_(detail::inputs_of(dynamics)) {}

std::vector<Eigen::Index> PoleStates::left_after(double time) const {
  constexpr double vanished = 1e-20;
  std::vector<Eigen::Index> left;
  for (std::size_t l = 0; l < std::size_t(exponents_.size()); ++l) {
    if (std::exp(exponents_[Index(l)].real() * time * period_) < vanished) continue;
    left.push_back(begin(l));
    if (is_pair(l)) left.push_back(begin(l) + 1);
  }
  return left;
}

Eigen::MatrixXd PoleStates::motion_of_contacts(const Eigen::VectorXcd& factors) const {
  Eigen::MatrixXd motion(shapes_.rows(), size());
  for (Index c = 0; c < motion.rows(); ++c)
    motion.row(c) = row_of(shapes_.row(c).cwiseProduct(factors.transpose()));
  return motion;
}

Eigen::MatrixXd PoleStates::generator() const { return diagonal(exponents_); }

Eigen::MatrixXd PoleStates::free_motion(double time) const { return motion_of_contacts(growth(time)); }

Eigen::MatrixXd PoleStates::free_velocity(double time) const {
  return motion_of_contacts(exponents_.cwiseProduct(growth(time)));
}

void PoleStates::advance(double time, Eigen::MatrixXd& states) const { multiply(growth(time), states); }

Eigen::VectorXcd PoleStates::growth(double time) const {
  Eigen::VectorXcd factors(exponents_.size());
  for (Index l = 0; l < factors.size(); ++l) factors[l] = std::exp(exponents_[l] * time * period_);
  return factors;
}

Eigen::MatrixXd PoleStates::after_impulses(const Eigen::VectorXcd& factors,
                                           const std::vector<int>& contacts) const {
  return real_of(factors.asDiagonal() * inputs_(Eigen::all, contacts));
}

Eigen::MatrixXd PoleStates::after_impulse(double time) const {
  return real_of(growth(time).asDiagonal() * inputs_);
}

}  // namespace wavebalance::solvers
