#include "balance/structure_compliance.hpp"

#include <utility>

namespace wavebalance::solvers {
namespace {

// `first` above the rows of `matrix`.
template <class Matrix, class Row>
void prepend(const Row& first, Matrix& matrix) {
  Matrix joined(matrix.rows() + 1, matrix.cols());
  joined << first.reshaped().transpose(), matrix;
  matrix = std::move(joined);
}

// The coefficient at rest above the others.
void prepend(const CondensedPoint& rest, CondensedSpectrum& result) {
  prepend(rest.compliance, result.compliance);
  prepend(rest.load_response, result.load_response);
  prepend(rest.compliance_slope, result.compliance_slope);
  prepend(rest.load_response_slope, result.load_response_slope);
  prepend(rest.compliance_error, result.compliance_error);
  prepend(rest.load_response_error, result.load_response_error);
}

// Zeros for a coefficient that is not condensed, the last.
void append_zeros(CondensedSpectrum& result) {
  const auto append = [](auto& matrix) {
    matrix.conservativeResize(matrix.rows() + 1, Eigen::NoChange);
    matrix.bottomRows(1).setZero();
  };
  append(result.compliance);
  append(result.load_response);
  append(result.compliance_slope);
  append(result.load_response_slope);
  append(result.compliance_error);
  append(result.load_response_error);
}

}  // namespace

StructureCompliance::StructureCompliance(TimePair pair, const LinearStructure& structure,
                                         CondensationMethod method, const HeldStructure* held)
    : pair_(std::move(pair)), loss_factor_(structure.loss_factor), condensation_(structure, method) {
  if (held) rest_ = std::make_unique<Rest>(Rest{*held, 0.0, nullptr, {}});
}

void StructureCompliance::condense_rest(double frequency) {
  const double stiffness = rest_->held.spring_stiffness(frequency);
  if (stiffness == rest_->stiffness) return;
  rest_->stiffness = stiffness;
  rest_->condensation = std::make_unique<Condensation>(rest_->held.with_springs(stiffness));
  rest_->point = rest_->condensation->dynamic_compliance({0.0, 0.0, pair_.symbol(0)[0]}, {0.0, 0.0, 0.0});
}

void StructureCompliance::set_factors(double frequency) {
  const int solved = pair_.solved_size();
  const auto symbol = [&](int derivative) { return pair_.symbol(derivative).head(solved); };
  factors_ = {symbol(2) * (frequency * frequency), symbol(1) * frequency, symbol(0)};
  // Structural damping acts on the harmonics between 0 and M/2. The coefficient M/2 contains both signs.
  const int damped = (pair_.functions() - 1) / 2;
  if (loss_factor_ > 0.0) factors_[2].segment(1, damped) *= std::complex<double>(1.0, loss_factor_);
  derivatives_ = {symbol(2) * (2.0 * frequency), symbol(1), Eigen::VectorXcd::Zero(solved)};
}

void StructureCompliance::condense_moving(const Eigen::MatrixXcd& loads, CondensedSpectrum& result) {
  const Eigen::Index moving = factors_[0].size() - 1;
  const auto tail = [&](const StiffnessSpectrum& all) -> StiffnessSpectrum {
    return {all[0].tail(moving), all[1].tail(moving), all[2].tail(moving)};
  };
  condensation_.condense(tail(factors_), tail(derivatives_), result, loads.middleRows(1, moving));
}

void StructureCompliance::condense(double frequency, const Eigen::MatrixXcd& loads,
                                   CondensedSpectrum& result) {
  set_factors(frequency);
  if (rest_) {
    condense_moving(loads, result);
    condense_rest(frequency);
    prepend(rest_->point, result);
  } else {
    condensation_.condense(factors_, derivatives_, result, loads.topRows(factors_[0].size()));
  }
  if (pair_.drops_nyquist()) append_zeros(result);
}

Eigen::VectorXcd StructureCompliance::recover(int k, const Eigen::VectorXcd& loads,
                                              const Eigen::VectorXcd& forces) {
  if (k >= pair_.solved_size()) return Eigen::VectorXcd::Zero(condensation_.size());
  Condensation& at = rest_ && k == 0 ? *rest_->condensation : condensation_;
  return at.recover({factors_[0][k], factors_[1][k], factors_[2][k]}, loads, forces);
}

}  // namespace wavebalance::solvers
