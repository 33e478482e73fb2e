#include "modes/elastic_point.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

// Products of the velocities over omega, means over the period, modes x (K + 1), kg m^2.
Eigen::MatrixXd kinetic_of(const ModeProblem& problem, const Eigen::MatrixXd& modes) {
  const PairTransform& transform = problem.transform;
  Eigen::MatrixXd kinetic = Eigen::MatrixXd::Zero(modes.cols(), transform.highest() + 1);
  for (int row = 0; row < transform.rows(); ++row) {
    const int k = transform.order[static_cast<std::size_t>(row)];
    kinetic.col(k) +=
        transform.inertia[k] * transform.mean_square[row] * modes.row(row).cwiseAbs2().transpose();
  }
  return kinetic;
}

/// Mean over the period of the laws' potential; a rigid obstacle stores none.
double stored_energy(const ModeProblem& problem, const Eigen::MatrixXd& displacement) {
  double stored = 0.0;
  for (int c = 0; c < problem.contacts(); ++c) {
    if (problem.laws[c].is_rigid()) continue;
    for (Index l = 0; l < displacement.rows(); ++l) stored += problem.laws[c].potential(displacement(l, c));
  }
  return stored / static_cast<double>(displacement.rows());
}

void set_amplitudes(const ModeProblem& problem, const Eigen::MatrixXd& modes, ModePoint& point) {
  const PairTransform& transform = problem.transform;
  point.amplitudes.resize(modes.cols(), transform.harmonics.rows());
  for (Index j = 0; j < modes.cols(); ++j) {
    const Eigen::VectorXcd spectrum = transform.spectrum(modes.col(j));
    point.amplitudes.row(j) =
        (transform.harmonics * spectrum + transform.conjugated * spectrum.conjugate()).transpose();
  }
}

void measure_contact(const ModeProblem& problem, const Eigen::MatrixXd& displacement, ModePoint& point) {
  const auto samples = static_cast<int>(displacement.rows());
  const Eigen::RowVectorXd highest = displacement.colwise().maxCoeff();
  point.max_penetration = (highest.transpose().array() / problem.model.gaps.array()).maxCoeff() - 1.0;
  point.min_force = point.force.minCoeff();
  point.contact_fraction = (point.force.array() != 0.0).colwise().any().cast<double>().mean();
  for (int c = 0; c < problem.contacts(); ++c)
    for (int l = 0; l < samples; ++l)
      if (point.force(c, l) != 0.0) point.active.push_back(c * samples + l);
}

}  // namespace

InternalResonance strongest_resonance(const Eigen::MatrixXd& kinetic) {
  InternalResonance strongest;
  const double mass = kinetic.sum();
  for (Index k = 2; k < kinetic.cols(); ++k)
    for (Index j = 0; j < kinetic.rows(); ++j)
      if (const double share = kinetic(j, k) / mass; share > strongest.share)
        strongest = {static_cast<int>(k), static_cast<int>(j + 1), share};
  return strongest;
}

bool is_resonant(const InternalResonance& resonance, const ModalModel& model, double driven) {
  if (resonance.harmonic == 0 || resonance.share < resonance_share) return false;
  const double natural = std::sqrt(model.omega_squared[resonance.mode - 1]);
  return std::abs(driven - natural) <= resonance_detuning * natural;
}

double grazing_energy(const ModeProblem& problem) {
  const double square = problem.transform.mean_square[problem.transform.real_rows[1]];
  return problem.model.omega_squared[problem.mode] * square * problem.amplitude * problem.amplitude;
}

ModePoint elastic_point(const ModeEquations& equations, int iterations) {
  const ModeProblem& problem = equations.problem();
  const Eigen::MatrixXd modes = equations.modal_coefficients(), displacement = equations.displacement();
  const Eigen::MatrixXd kinetic = kinetic_of(problem, modes);
  const double mass = kinetic.sum(),
               stiffness = problem.transform.mean_square.dot(modes.cwiseAbs2() * problem.model.omega_squared);
  const double omega = equations.omega(), square = omega * omega;
  const double linear_mass =
      problem.first_inertia() * grazing_energy(problem) / problem.model.omega_squared[problem.mode];
  ModePoint point;
  point.omega = omega;
  point.iterations = iterations;
  point.unknown = equations.unknowns();
  point.force = equations.force().transpose();
  set_amplitudes(problem, modes, point);
  const double energy =
      0.5 * (square * mass + stiffness) + stored_energy(problem, equations.displacement_of_laws());
  point.energy_ratio = energy / grazing_energy(problem);
  point.gamma_ratio = mass / linear_mass;
  point.rayleigh = stiffness / mass;
  const double virial = displacement.cwiseProduct(equations.force()).sum() / double(displacement.rows());
  point.virial_residual = std::abs(square * mass - stiffness - virial) / (square * mass);
  measure_contact(problem, displacement, point);
  point.residual = std::max(equations.relative_residual(), equations.imbalance());
  point.resonance = strongest_resonance(kinetic);
  const double driven = std::sqrt(problem.transform.inertia[point.resonance.harmonic]) * omega;
  point.status = is_resonant(point.resonance, problem.model, driven) ? ModeStatus::internal_resonance
                                                                     : ModeStatus::converged;
  return point;
}

ModePoint linear_point(const ModeProblem& problem, double energy_ratio) {
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(problem.rows(), problem.model.modes());
  modes(problem.transform.real_rows[1], problem.mode) = std::sqrt(energy_ratio) * problem.amplitude;
  ModePoint point;
  point.status = ModeStatus::linear;
  point.omega = problem.linear_omega();
  point.force = Eigen::MatrixXd::Zero(problem.contacts(), problem.transform.synthesis.rows());
  set_amplitudes(problem, modes, point);
  point.energy_ratio = point.gamma_ratio = energy_ratio;
  point.max_penetration = std::sqrt(energy_ratio) - 1.0;
  point.rayleigh = point.omega * point.omega * problem.first_inertia();
  return point;
}

}  // namespace wavebalance::solvers
