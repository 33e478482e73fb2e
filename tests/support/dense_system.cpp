#include "dense_system.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

namespace wavebalance::dense {
namespace {

// matrix += factor * left (x) right.
void add_kronecker(Eigen::MatrixXd& matrix, double factor, const Eigen::SparseMatrix<double>& left,
                   const Eigen::MatrixXd& right) {
  const Eigen::Index size = right.rows();
  for (int column = 0; column < left.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(left, column); entry; ++entry)
      matrix.block(entry.row() * size, entry.col() * size, size, size) += factor * entry.value() * right;
}

std::span<const double> span_of(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}
std::span<double> span_of(Eigen::VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace

DenseSystem::DenseSystem(solvers::LinearStructure structure, solvers::AnyContactLaw law,
                         TimeDiscretisation time)
    : structure_(std::move(structure)), law_(std::move(law)), time_(std::move(time)), load_(unknowns()) {
  structure_.validate();
  const Eigen::Index size = time_.load.size();
  for (Eigen::Index i = 0; i < structure_.load.size(); ++i)
    load_.segment(i * size, size) = structure_.load[i] * time_.load;
}

void DenseSystem::set_frequency(double frequency_hz) {
  matrix_.setZero(unknowns(), unknowns());
  add_kronecker(matrix_, frequency_hz * frequency_hz, structure_.mass, time_.products[2]);
  add_kronecker(matrix_, frequency_hz, structure_.damping, time_.products[1]);
  add_kronecker(matrix_, 1.0, structure_.stiffness, time_.products[0]);
}

Eigen::VectorXd DenseSystem::solve(const Eigen::VectorXd& r) const { return matrix_.partialPivLu().solve(r); }

Eigen::VectorXd DenseSystem::linear_response() const { return solve(load_); }

Eigen::VectorXd DenseSystem::contact_displacement(const Eigen::VectorXd& coefficients) const {
  return time_.trial * coefficients.segment(structure_.contact_dof * functions(), functions());
}

Eigen::VectorXd DenseSystem::contact_force(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd u = contact_displacement(coefficients);
  Eigen::VectorXd force(u.size());
  law_.evaluate(span_of(u), span_of(force));
  return time_.weight.transpose() * force / double(u.size());
}

Eigen::VectorXd DenseSystem::residual(const Eigen::VectorXd& coefficients) const {
  Eigen::VectorXd r = matrix_ * coefficients - load_;
  r.segment(structure_.contact_dof * functions(), functions()) += contact_force(coefficients);
  return r;
}

double DenseSystem::relative_residual(const Eigen::VectorXd& coefficients) const {
  const double scale = (matrix_ * coefficients).norm() + load_.norm() + contact_force(coefficients).norm();
  return residual(coefficients).norm() / scale;
}

Eigen::MatrixXd DenseSystem::jacobian(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd u = contact_displacement(coefficients);
  Eigen::VectorXd force(u.size()), tangent(u.size());
  law_.evaluate(span_of(u), span_of(force), span_of(tangent));
  Eigen::MatrixXd matrix = matrix_;
  const int first = structure_.contact_dof * functions();
  matrix.block(first, first, functions(), functions()) +=
      time_.weight.transpose() * tangent.asDiagonal() * time_.trial / double(u.size());
  return matrix;
}

Solution DenseSystem::newton(const Eigen::VectorXd& start, const NewtonOptions& options) const {
  Solution solution;
  solution.coefficients = start;
  Eigen::VectorXd r = residual(start);
  for (;; ++solution.iterations) {
    solution.residual = relative_residual(solution.coefficients);
    solution.converged = solution.residual <= options.tolerance;
    if (solution.converged || solution.iterations >= options.max_iterations ||
        !std::isfinite(solution.residual))
      return solution;
    const Eigen::VectorXd direction = jacobian(solution.coefficients).partialPivLu().solve(r);
    double step = 1.0;
    Eigen::VectorXd candidate = solution.coefficients - direction;
    Eigen::VectorXd reached = residual(candidate);
    while (!(reached.norm() < r.norm()) && step > options.smallest_step) {
      step *= 0.5;
      candidate = solution.coefficients - step * direction;
      reached = residual(candidate);
    }
    if (!(reached.norm() < r.norm()) && options.smallest_step < 1.0) return solution;
    solution.coefficients = candidate;
    r = reached;
  }
}

}  // namespace wavebalance::dense
