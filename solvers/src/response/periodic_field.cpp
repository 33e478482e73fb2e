#include "wavebalance/solvers/response/periodic_field.hpp"

#include <cmath>

namespace wavebalance::solvers {

MotionEvaluator::MotionEvaluator(const AnyTimeBasis& trial, int points)
    : functions_(trial.functions()), points_(points), values_(trial, points, 0) {
  if (trial.pointwise_derivatives() >= 1) {
    rates_.emplace(trial, points, 1);
  } else {
    cells_.emplace(trial, functions_, 0);
  }
}

Eigen::VectorXd MotionEvaluator::displacement(const Eigen::VectorXcd& coefficients) {
  return values_(coefficients);
}

Eigen::VectorXd MotionEvaluator::velocity(const Eigen::VectorXcd& coefficients, double frequency) {
  if (rates_) return (*rates_)(coefficients)*frequency;
  return jump_velocity(coefficients, frequency);
}

Eigen::MatrixXd MotionEvaluator::displacement(const Eigen::MatrixXcd& coefficients) {
  Eigen::MatrixXd values(points_, coefficients.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c)
    values.col(c) = displacement(Eigen::VectorXcd(coefficients.col(c)));
  return values;
}

Eigen::MatrixXd MotionEvaluator::velocity(const Eigen::MatrixXcd& coefficients, double frequency) {
  Eigen::MatrixXd values(points_, coefficients.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c)
    values.col(c) = velocity(Eigen::VectorXcd(coefficients.col(c)), frequency);
  return values;
}

Eigen::VectorXd MotionEvaluator::jump_velocity(const Eigen::VectorXcd& coefficients, double frequency) {
  const Eigen::VectorXd cell = (*cells_)(coefficients);
  Eigen::VectorXd velocity(points_);
  for (int l = 0; l < points_; ++l) {
    const long long scaled = static_cast<long long>(l) * functions_;
    const int edge = static_cast<int>((scaled + points_ / 2) / points_) % functions_;
    const int before = edge == 0 ? functions_ - 1 : edge - 1;
    velocity[l] = (cell[edge] - cell[before]) * functions_ * frequency;
  }
  return velocity;
}

PeriodicField periodic_field(CondensedProblem& problem, const Eigen::VectorXd& contact_force, int points) {
  const Eigen::MatrixXcd spectra = problem.full_coefficients(contact_force);
  MotionEvaluator motion(problem.pair().trial(), points);
  PeriodicField field{Eigen::MatrixXd(spectra.rows(), points), Eigen::MatrixXd(spectra.rows(), points)};
  for (Eigen::Index dof = 0; dof < spectra.rows(); ++dof) {
    const Eigen::VectorXcd coefficients = spectra.row(dof);
    field.displacement.row(dof) = motion.displacement(coefficients);
    field.velocity.row(dof) = motion.velocity(coefficients, problem.frequency());
  }
  return field;
}

Eigen::VectorXd system_energy(const LinearStructure& structure, const ContactLaws& laws,
                              const PeriodicField& field) {
  laws.require(structure.contacts());
  const Eigen::MatrixXd momentum = structure.mass * field.velocity;
  const Eigen::MatrixXd elastic = structure.stiffness * field.displacement;
  Eigen::VectorXd energy = 0.5 * (momentum.cwiseProduct(field.velocity).colwise().sum() +
                                  elastic.cwiseProduct(field.displacement).colwise().sum())
                                     .transpose();
  for (int c = 0; c < structure.contacts(); ++c) {
    const int dof = structure.contact_dofs[static_cast<std::size_t>(c)];
    for (Eigen::Index l = 0; l < energy.size(); ++l)
      energy[l] += laws[c].potential(field.displacement(dof, l));
  }
  return energy;
}

double energy_norm(const LinearStructure& structure, const ContactLaws& laws, const PeriodicField& field) {
  const Eigen::VectorXd energy = system_energy(structure, laws, field);
  return energy.norm() / std::sqrt(double(energy.size()));
}

}  // namespace wavebalance::solvers
