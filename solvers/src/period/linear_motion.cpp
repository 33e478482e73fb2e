#include "period/linear_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "structure/held_structure.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
constexpr double whole_turn = 2.0 * std::numbers::pi;

// The amplitudes of a load (n x harmonics) that is `start` periods ahead, so that the first harmonic of
// `series` is at its maximum.
Eigen::MatrixXcd from_maximum(Eigen::MatrixXcd amplitudes, const Eigen::VectorXcd& series, double& start) {
  start = 0.0;
  Index first = 1;
  while (first < series.size() && series[first] == 0.0) ++first;
  if (first >= series.size()) return amplitudes;
  start = -std::arg(series[first]) / (whole_turn * double(first));
  for (Index n = 0; n < amplitudes.cols(); ++n)
    amplitudes.col(n) *= std::polar(1.0, whole_turn * double(n) * start);
  return amplitudes;
}

// The part of a static load that accelerates a structure which is free to move; the rest deforms it.
Eigen::VectorXd accelerating(const LinearStructure& structure, const Eigen::VectorXd& load) {
  if (!structure.is_free()) return Eigen::VectorXd::Zero(load.size());
  const Eigen::VectorXd rigid = structure.rigid_modes.transpose() * load;
  return structure.mass * (structure.rigid_modes * rigid);
}

// For a free structure under a load that balances.
Eigen::VectorXcd static_response(const LinearStructure& structure, const Eigen::VectorXcd& load,
                                 double frequency) {
  const HeldStructure held = hold(structure);
  return linear_response(held.with_springs(held.spring_stiffness(frequency)), load, frequency);
}

}  // namespace

Eigen::MatrixXcd linear_response(const LinearStructure& structure, const Eigen::MatrixXcd& amplitudes,
                                 double frequency) {
  Eigen::MatrixXcd responses = Eigen::MatrixXcd::Zero(structure.size(), amplitudes.cols());
  for (Index n = 0; n < amplitudes.cols(); ++n) {
    if (amplitudes.col(n).isZero(0.0)) continue;
    const Complex rate(0.0, whole_turn * frequency * double(n));
    const Complex elastic(1.0, n > 0 ? structure.loss_factor : 0.0);
    const Eigen::MatrixXcd impedance = elastic * Eigen::MatrixXcd(structure.stiffness.cast<Complex>()) +
                                       rate * Eigen::MatrixXcd(structure.damping.cast<Complex>()) +
                                       rate * rate * Eigen::MatrixXcd(structure.mass.cast<Complex>());
    responses.col(n) = detail::Lu<Complex>(impedance).solve(Eigen::VectorXcd(amplitudes.col(n)));
  }
  return responses;
}

LinearMotion::LinearMotion(const CondensedProblem& problem, int samples)
    : repeats_(solvers::load_periods(problem)), frequency_(repeats_ * problem.frequency()) {
  const LinearStructure& structure = problem.structure();
  const bool forces_alone = structure.load.isZero(0.0) && !structure.forces.empty();
  const Eigen::MatrixXcd loads =
      structure.load_series(problem.load_harmonics(), repeats_, problem.frequency());
  Eigen::MatrixXcd amplitudes =
      from_maximum(structure.load_shapes() * loads, loads.row(forces_alone ? 1 : 0).transpose(), start_);
  amplitudes.rightCols(loads.cols() - 1) *= problem.load_factor();
  left_out_ = accelerating(structure, amplitudes.col(0).real());
  amplitudes.col(0) -= left_out_;
  const Eigen::VectorXcd at_rest = amplitudes.col(0);
  if (structure.is_free()) amplitudes.col(0).setZero();
  Eigen::MatrixXcd responses = linear_response(structure, amplitudes, frequency_);
  if (structure.is_free()) responses.col(0) = static_response(structure, at_rest, frequency_);
  responses_[0] = structure.contact_directions * responses;
  responses_[1] = responses_[0];
  initial_displacement_ = responses.real().rowwise().sum();
  initial_velocity_ = Eigen::VectorXd::Zero(structure.size());
  for (Index n = 0; n < responses.cols(); ++n) {
    const double rate = whole_turn * frequency_ * double(n);
    responses_[1].col(n) *= Complex(0.0, rate);
    initial_velocity_ -= rate * responses.col(n).imag();
  }
  for (int derivative = 0; derivative < 2; ++derivative) {
    Eigen::MatrixXd& values = samples_[std::size_t(derivative)];
    values.resize(structure.contacts(), samples);
    for (int k = 0; k < samples; ++k) values.col(k) = at(derivative, double(k) / samples);
  }
}

Eigen::VectorXd LinearMotion::at(int derivative, double periods) const {
  const Eigen::MatrixXcd& responses = responses_[std::size_t(derivative)];
  const Complex turn = std::polar(1.0, whole_turn * periods);
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(responses.rows());
  Complex phase(1.0, 0.0);
  for (Index n = 0; n < responses.cols(); ++n, phase *= turn)
    motion += phase.real() * responses.col(n).real() - phase.imag() * responses.col(n).imag();
  return motion;
}

}  // namespace wavebalance::solvers
