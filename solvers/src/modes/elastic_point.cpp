#include "modes/elastic_point.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

/// Quadratic forms of a motion, means over the period.
struct Forms {
  double mass = 0.0;       ///< of the velocities over omega, kg m^2
  double stiffness = 0.0;  ///< J
};

Forms forms_of(const ModeProblem& problem, const Eigen::MatrixXd& modes) {
  const PairTransform& transform = problem.transform;
  Forms forms;
  for (int row = 0; row < transform.rows(); ++row) {
    const Eigen::RowVectorXd squares = transform.mean_square[row] * modes.row(row).cwiseAbs2();
    forms.mass += transform.inertia[transform.order[static_cast<std::size_t>(row)]] * squares.sum();
    forms.stiffness += squares.dot(problem.model.omega_squared);
  }
  return forms;
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

/// The harmonic k >= 2 of a mode that has the largest share of the kinetic energy.
InternalResonance strongest_resonance(const ModeProblem& problem, const Eigen::MatrixXd& modes, double mass) {
  const PairTransform& transform = problem.transform;
  InternalResonance strongest;
  for (int k = 2; k <= transform.highest(); ++k)
    for (Index j = 0; j < modes.cols(); ++j) {
      double square = 0.0;
      const int row = transform.real_rows[static_cast<std::size_t>(k)];
      for (int part = 0; part < (transform.has_sines() ? 2 : 1); ++part)
        square += transform.mean_square[row + part] * modes(row + part, j) * modes(row + part, j);
      const double share = transform.inertia[k] * square / mass;
      if (share > strongest.share) strongest = {k, static_cast<int>(j + 1), share};
    }
  return strongest;
}

bool is_resonant(const ModeProblem& problem, const InternalResonance& resonance, double omega,
                 const ElasticModeOptions& options) {
  if (resonance.harmonic == 0 || resonance.share < options.resonance_share) return false;
  const double natural = std::sqrt(problem.model.omega_squared[resonance.mode - 1]);
  const double driven = std::sqrt(problem.transform.inertia[resonance.harmonic]) * omega;
  return std::abs(driven - natural) <= options.resonance_detuning * natural;
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

double grazing_energy(const ModeProblem& problem) {
  const double square = problem.transform.mean_square[problem.transform.real_rows[1]];
  return problem.model.omega_squared[problem.mode] * square * problem.amplitude * problem.amplitude;
}

ModePoint elastic_point(const ModeEquations& equations, const ElasticModeOptions& options, int iterations) {
  const ModeProblem& problem = equations.problem();
  const Eigen::MatrixXd modes = equations.modal_coefficients(), displacement = equations.displacement();
  const Forms forms = forms_of(problem, modes);
  const double omega = equations.omega(), square = omega * omega;
  const double linear_mass =
      problem.first_inertia() * grazing_energy(problem) / problem.model.omega_squared[problem.mode];
  ModePoint point;
  point.omega = omega;
  point.iterations = iterations;
  point.unknown = equations.unknowns();
  point.force = equations.force().transpose();
  set_amplitudes(problem, modes, point);
  const double energy = 0.5 * (square * forms.mass + forms.stiffness) +
                        stored_energy(problem, equations.displacement_of_laws());
  point.energy_ratio = energy / grazing_energy(problem);
  point.gamma_ratio = forms.mass / linear_mass;
  point.rayleigh = forms.stiffness / forms.mass;
  const double virial = displacement.cwiseProduct(equations.force()).sum() / double(displacement.rows());
  point.virial_residual = std::abs(square * forms.mass - forms.stiffness - virial) / (square * forms.mass);
  measure_contact(problem, displacement, point);
  point.residual = std::max(equations.relative_residual(), equations.imbalance());
  point.resonance = strongest_resonance(problem, modes, forms.mass);
  point.status = is_resonant(problem, point.resonance, omega, options) ? ModeStatus::internal_resonance
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
