#include "rayleigh_quotient.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::ll10 {
namespace {

FourierLayout checked(FourierLayout layout) {
  solvers::detail::require_at_least("RayleighQuotient", "harmonics", layout.harmonics, 1);
  return layout;
}

}  // namespace

HarmonicForm::HarmonicForm(Eigen::MatrixXd matrix, Eigen::VectorXd factors)
    : matrix_(std::move(matrix)), factors_(std::move(factors)) {
  if (matrix_.rows() != matrix_.cols() || matrix_.rows() < 1)
    throw std::invalid_argument("HarmonicForm: matrix is " + std::to_string(matrix_.rows()) + " x " +
                                std::to_string(matrix_.cols()) + "; it must be square and not empty");
}

Eigen::VectorXd HarmonicForm::apply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd result(x.size());
  const Eigen::Map<const Eigen::MatrixXd> blocks(x.data(), matrix_.rows(), factors_.size());
  Eigen::Map<Eigen::MatrixXd>(result.data(), matrix_.rows(), factors_.size()).noalias() =
      solvers::detail::product(matrix_, blocks) * factors_.asDiagonal();
  return result;
}

void HarmonicForm::add_to(Eigen::MatrixXd& target, double scale) const {
  const Eigen::Index n = matrix_.rows();
  for (Eigen::Index block = 0; block < factors_.size(); ++block)
    target.block(block * n, block * n, n, n) += scale * factors_[block] * matrix_;
}

Eigen::VectorXd FourierLayout::factors(int power) const {
  Eigen::VectorXd result(blocks());
  for (int block = 0; block < blocks(); ++block)
    result[block] = weight(block) * std::pow(double(harmonic(block)), power);
  return result;
}

RayleighQuotient::RayleighQuotient(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                                   FourierLayout layout)
    : layout_(checked(layout)), stiffness_(stiffness, layout.factors(0)), mass_(mass, layout.factors(2)) {
  if (stiffness.rows() != mass.rows())
    throw std::invalid_argument("RayleighQuotient: stiffness has " + std::to_string(stiffness.rows()) +
                                " rows, mass " + std::to_string(mass.rows()) + "; they must agree");
}

double RayleighQuotient::value(const Eigen::VectorXd& x) const {
  return stiffness_.value(x) / mass_.value(x);
}

Eigen::VectorXd RayleighQuotient::gradient(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd elastic = stiffness_.apply(x), inertia = mass_.apply(x);
  const double k = x.dot(elastic), m = x.dot(inertia);
  return 2.0 / m * (elastic - k / m * inertia);
}

Eigen::MatrixXd RayleighQuotient::hessian(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd inertia = mass_.apply(x), slope = gradient(x);
  const double factor = 2.0 / x.dot(inertia);
  Eigen::MatrixXd result = -factor * (slope * inertia.transpose() + inertia * slope.transpose());
  stiffness_.add_to(result, factor);
  mass_.add_to(result, -factor * value(x));
  return result;
}

}  // namespace wavebalance::ll10
