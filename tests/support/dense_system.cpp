#include "dense_system.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include <numbers>

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

}  // namespace

DenseSystem::DenseSystem(solvers::LinearStructure structure, solvers::ContactLaws laws,
                         TimeDiscretisation time)
    : structure_(std::move(structure)), laws_(std::move(laws)), time_(std::move(time)), load_(unknowns()) {
  structure_.validate();
  laws_.require(contacts());
  load_.setZero();
  add_load(structure_.load, time_.load);
}

void DenseSystem::add_load(const Eigen::VectorXd& shape, const Eigen::VectorXd& projections) {
  for (Eigen::Index i = 0; i < shape.size(); ++i)
    load_.segment(i * projections.size(), projections.size()) += shape[i] * projections;
}

namespace {

// The circulant matrix that turns each harmonic k of the coefficients by a quarter of its period: eigenvalues
// i sign(k), and 0 for k = 0 and M/2.
Eigen::MatrixXd phase_shift(int functions) {
  return Eigen::MatrixXd::NullaryExpr(functions, functions, [&](Eigen::Index i, Eigen::Index j) {
    double sum = 0.0;
    for (int k = 1; 2 * k < functions; ++k)
      sum -= 2.0 / functions * std::sin(2.0 * std::numbers::pi * k * double(i - j) / functions);
    return sum;
  });
}

}  // namespace

void DenseSystem::set_frequency(double frequency_hz) {
  matrix_.setZero(unknowns(), unknowns());
  add_kronecker(matrix_, frequency_hz * frequency_hz, structure_.mass, time_.products[2]);
  add_kronecker(matrix_, frequency_hz, structure_.damping, time_.products[1]);
  add_kronecker(matrix_, 1.0, structure_.stiffness, time_.products[0]);
  if (structure_.loss_factor > 0.0)
    add_kronecker(matrix_, structure_.loss_factor, structure_.stiffness,
                  time_.products[0] * phase_shift(functions()));
}

Eigen::VectorXd DenseSystem::solve(const Eigen::VectorXd& r) const { return matrix_.partialPivLu().solve(r); }

Eigen::VectorXd DenseSystem::linear_response() const { return solve(load_); }

std::vector<DenseSystem::Entry> DenseSystem::direction(int contact) const {
  std::vector<Entry> entries;
  for (solvers::ContactDirections::InnerIterator entry(structure_.contact_directions, contact); entry;
       ++entry)
    entries.push_back({entry.value(), entry.col() * functions()});
  return entries;
}

Eigen::VectorXd DenseSystem::contact_displacement(const Eigen::VectorXd& coefficients) const {
  Eigen::VectorXd u(contacts() * points());
  u.setZero();
  for (int c = 0; c < contacts(); ++c)
    for (const auto& [factor, first] : direction(c))
      u.segment(c * points(), points()) += factor * time_.trial * coefficients.segment(first, functions());
  return u;
}

Eigen::VectorXd DenseSystem::project(const Eigen::VectorXd& force) const {
  Eigen::VectorXd projections = Eigen::VectorXd::Zero(unknowns());
  for (int c = 0; c < contacts(); ++c)
    for (const auto& [factor, first] : direction(c))
      projections.segment(first, functions()) +=
          factor * time_.weight.transpose() * force.segment(c * points(), points()) / double(points());
  return projections;
}

Eigen::VectorXd DenseSystem::forced_response(const Eigen::VectorXd& force) const {
  return solve(load_ - project(force));
}

Eigen::VectorXd DenseSystem::contact_force(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd u = contact_displacement(coefficients);
  Eigen::VectorXd force(u.size()), tangent(u.size());
  laws_.evaluate(contacts(), u, force, tangent);
  return project(force);
}

Eigen::VectorXd DenseSystem::residual(const Eigen::VectorXd& coefficients) const {
  return matrix_ * coefficients - load_ + contact_force(coefficients);
}

double DenseSystem::relative_residual(const Eigen::VectorXd& coefficients) const {
  const double scale = (matrix_ * coefficients).norm() + load_.norm() + contact_force(coefficients).norm();
  return residual(coefficients).norm() / scale;
}

Eigen::MatrixXd DenseSystem::jacobian(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd u = contact_displacement(coefficients);
  Eigen::VectorXd force(u.size()), tangent(u.size());
  laws_.evaluate(contacts(), u, force, tangent);
  Eigen::MatrixXd matrix = matrix_;
  for (int c = 0; c < contacts(); ++c) {
    const Eigen::MatrixXd stiffness = time_.weight.transpose() *
                                      tangent.segment(c * points(), points()).asDiagonal() * time_.trial /
                                      double(points());
    for (const auto& [left, row] : direction(c))
      for (const auto& [right, column] : direction(c))
        matrix.block(row, column, functions(), functions()) += left * right * stiffness;
  }
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
