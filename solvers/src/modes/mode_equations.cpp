#include "modes/mode_equations.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {

double ModeProblem::omega() const { return std::sqrt(model.omega_squared[mode]); }

double ModeProblem::linear_omega() const { return omega() / std::sqrt(first_inertia()); }

ModeEquations::ModeEquations(const ModeProblem& problem)
    : problem_(problem),
      laws_(problem.flexibility.size() > 0 ? problem.laws.resolvents(problem.flexibility) : problem.laws),
      highest_(problem.transform.highest()) {}

double ModeEquations::gain(int k, int mode) const {
  if (k == 1 && mode == problem_.mode) return 0.0;
  return 1.0 / (problem_.model.omega_squared[mode] - problem_.transform.inertia[k] * omega_ * omega_);
}

void ModeEquations::set_compliance(double omega) {
  omega_ = omega;
  const int contacts = problem_.contacts(), modes = problem_.model.modes();
  const Eigen::MatrixXd& shapes = problem_.model.contact_shapes;
  compliance_.setZero(problem_.transform.highest() + 1, contacts * contacts);
  slope_ = compliance_;
  Eigen::VectorXd gains(modes), slopes(modes);
  for (int k = 0; k <= highest_; ++k) {
    for (int j = 0; j < modes; ++j) {
      gains[j] = gain(k, j);
      slopes[j] = 2.0 * problem_.transform.inertia[k] * omega_ * problem_.omega() * gains[j] * gains[j];
    }
    Eigen::MatrixXd both = detail::product_transposed(shapes * gains.asDiagonal(), shapes);
    if (problem_.flexibility.size() > 0) both.diagonal() -= problem_.flexibility;
    compliance_.row(k) = both.reshaped().transpose();
    both = detail::product_transposed(shapes * slopes.asDiagonal(), shapes);
    slope_.row(k) = both.reshaped().transpose();
  }
}

void ModeEquations::set_forces() {
  const int contacts = problem_.contacts(), rows = problem_.rows();
  const Eigen::Map<const Eigen::MatrixXd> coefficients(y_.data(), rows, contacts);
  samples_ = problem_.unit * detail::product(problem_.transform.synthesis, coefficients);
  const Index points = samples_.rows();
  Eigen::VectorXd force(points * contacts), tangent(points * contacts);
  laws_.evaluate(contacts, samples_.reshaped(), force, tangent);
  force_ = force.reshaped(points, contacts);
  tangent_ = tangent.reshaped(points, contacts);
  psi_ = detail::product(problem_.transform.projection, force_);
}

// Factor of Re s^T psi(1) in the last equation, 1/N.
double ModeEquations::last_scale() const {
  return 1.0 / (problem_.model.omega_squared[problem_.mode] * problem_.amplitude);
}

void ModeEquations::evaluate(const Eigen::VectorXd& y) {
  y_ = y;
  const int contacts = problem_.contacts(), rows = problem_.rows(), last = contacts * rows;
  const PairTransform& transform = problem_.transform;
  set_compliance(y[last + 1] * problem_.omega());
  set_forces();
  residual_.resize(last + 1);
  for (int c = 0; c < contacts; ++c)
    for (int row = 0; row < rows; ++row) {
      const int k = transform.order[static_cast<std::size_t>(row)];
      double value = y[c * rows + row];
      for (int d = 0; d < contacts; ++d)
        value += compliance_(k, c + contacts * d) * psi_(row, d) / problem_.unit;
      residual_[c * rows + row] = value;
    }
  const int first = transform.real_rows[1];
  const double q = y[last], ratio = y[last + 1];
  const Eigen::VectorXd shape = problem_.model.contact_shapes.col(problem_.mode);
  for (int c = 0; c < contacts; ++c)
    residual_[c * rows + first] -= shape[c] * problem_.amplitude / problem_.unit * q;
  residual_[last] =
      (1.0 - problem_.first_inertia() * ratio * ratio) * q + last_scale() * psi_.row(first).dot(shape);
}

double ModeEquations::relative_residual() const {
  const int contacts = problem_.contacts(), rows = problem_.rows();
  const Eigen::VectorXd& weight = problem_.transform.mean_square;
  double square = weight[problem_.transform.real_rows[1]] * std::pow(residual_[contacts * rows], 2);
  double scale = 0.0;
  for (int c = 0; c < contacts; ++c) {
    square += weight.dot(residual_.segment(c * rows, rows).cwiseAbs2());
    scale += weight.dot(y_.segment(c * rows, rows).cwiseAbs2());
  }
  const double relative = std::sqrt(square / scale);
  return std::isfinite(relative) ? relative : std::numeric_limits<double>::infinity();
}

double ModeEquations::imbalance() const {
  if (!problem_.transform.has_sines()) return 0.0;
  const Eigen::VectorXd shape = problem_.model.contact_shapes.col(problem_.mode);
  const double scale = problem_.model.omega_squared[problem_.mode] * std::abs(problem_.amplitude);
  return std::abs(psi_.row(problem_.transform.real_rows[1] + 1).dot(shape)) / scale;
}

// R x R: coefficients of the force of a contact from its own.
Eigen::MatrixXd ModeEquations::force_slope(int contact) const {
  std::vector<Index> active;
  for (Index l = 0; l < tangent_.rows(); ++l)
    if (tangent_(l, contact) != 0.0) active.push_back(l);
  const Eigen::VectorXd slopes = tangent_.col(contact)(active);
  const PairTransform& transform = problem_.transform;
  return detail::product(transform.projection(Eigen::all, active) * slopes.asDiagonal(),
                         transform.synthesis(active, Eigen::all));
}

Eigen::MatrixXd ModeEquations::jacobian() const {
  const int contacts = problem_.contacts(), rows = problem_.rows(), last = contacts * rows;
  const PairTransform& transform = problem_.transform;
  const int first = transform.real_rows[1];
  const Eigen::VectorXd shape = problem_.model.contact_shapes.col(problem_.mode);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(last + 1, last + 2);
  matrix.diagonal().head(last).setOnes();
  for (int d = 0; d < contacts; ++d) {
    const Eigen::MatrixXd slope = force_slope(d);
    for (int c = 0; c < contacts; ++c)
      for (int row = 0; row < rows; ++row) {
        const int k = transform.order[static_cast<std::size_t>(row)], place = c + contacts * d;
        matrix.row(c * rows + row).segment(d * rows, rows) += compliance_(k, place) * slope.row(row);
        matrix(c * rows + row, last + 1) += slope_(k, place) * psi_(row, d) / problem_.unit;
      }
    matrix.row(last).segment(d * rows, rows) = shape[d] * problem_.unit * last_scale() * slope.row(first);
    matrix(d * rows + first, last) = -shape[d] * problem_.amplitude / problem_.unit;
  }
  const double q = y_[last], ratio = y_[last + 1];
  matrix(last, last) = 1.0 - problem_.first_inertia() * ratio * ratio;
  matrix(last, last + 1) = -2.0 * problem_.first_inertia() * ratio * q;
  return matrix;
}

Eigen::MatrixXd ModeEquations::displacement() const {
  if (problem_.flexibility.size() == 0) return samples_;
  return samples_ - detail::product(problem_.transform.synthesis, psi_) * problem_.flexibility.asDiagonal();
}

Eigen::MatrixXd ModeEquations::displacement_of_laws() const {
  if (problem_.flexibility.size() == 0) return samples_;
  return samples_ - force_ * problem_.flexibility.asDiagonal();
}

Eigen::MatrixXd ModeEquations::modal_coefficients() const {
  const PairTransform& transform = problem_.transform;
  Eigen::MatrixXd result = detail::product(psi_, problem_.model.contact_shapes);
  for (int row = 0; row < problem_.rows(); ++row)
    for (int j = 0; j < problem_.model.modes(); ++j)
      result(row, j) *= -gain(transform.order[static_cast<std::size_t>(row)], j);
  result(transform.real_rows[1], problem_.mode) =
      y_[problem_.contacts() * problem_.rows()] * problem_.amplitude;
  return result;
}

}  // namespace wavebalance::solvers
