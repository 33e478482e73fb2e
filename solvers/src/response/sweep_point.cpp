#include <algorithm>
#include <cmath>
#include <limits>

#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::solvers {

Vibration largest_vibration(const Eigen::MatrixXd& displacements) {
  Vibration most;
  for (Eigen::Index row = 0; row < displacements.rows(); ++row) {
    const auto u = displacements.row(row);
    const double rms = (u.array() - u.mean()).matrix().stableNorm() / std::sqrt(double(u.size()));
    most.half_peak_to_peak = std::max(most.half_peak_to_peak, 0.5 * (u.maxCoeff() - u.minCoeff()));
    most.rms = std::max(most.rms, rms);
  }
  return most;
}

SweepPoint sweep_point(ContactSystem& system, TrialEvaluator& evaluator, const CurvePoint& point,
                       SweepParameter parameter) {
  CondensedProblem& problem = system.problem();
  curve_parameter(parameter).set(system, point.parameter);
  system.evaluate(point.displacement);
  const Eigen::MatrixXcd coefficients = problem.coefficients(system.force_on_held_structure());
  SweepPoint measured;
  measured.frequency = problem.load_frequency();
  measured.load_scale = problem.load_scale();
  measured.max_displacement = -std::numeric_limits<double>::infinity();
  measured.min_displacement = std::numeric_limits<double>::infinity();
  measured.max_force = system.laws().largest_force(by_contact(system.force(), problem.contacts()));
  measured.residual = point.residual;
  measured.grazing = point.grazing;
  measured.unknown = point.displacement;
  for (int c = 0; c < problem.contacts(); ++c) {
    const Eigen::VectorXd u = evaluator(coefficients.col(c));
    measured.max_displacement = std::max(measured.max_displacement, u.maxCoeff());
    measured.rms_displacement = std::max(measured.rms_displacement, u.norm() / std::sqrt(double(u.size())));
    measured.max_abs_displacement = std::max(measured.max_abs_displacement, u.cwiseAbs().maxCoeff());
    measured.min_displacement = std::min(measured.min_displacement, u.minCoeff());
    const Vibration vibration = largest_vibration(u.transpose());
    measured.vibration = std::max(measured.vibration, vibration.half_peak_to_peak);
    measured.rms_vibration = std::max(measured.rms_vibration, vibration.rms);
    const auto force = system.force().segment(c * problem.points(), problem.points());
    measured.contact_fraction =
        std::max(measured.contact_fraction, (force.array() != 0.0).cast<double>().mean());
  }
  return measured;
}

}  // namespace wavebalance::solvers
