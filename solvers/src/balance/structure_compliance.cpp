#include "balance/structure_compliance.hpp"

#include <numbers>
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
                                         CondensationMethod method, const HeldStructure* held, int periods)
    : pair_(std::move(pair)),
      loss_factor_(structure.loss_factor),
      turns_(structure.turns()),
      base_speed_(structure.turning.speed),
      speed_by_frequency_(2.0 * std::numbers::pi * periods),
      condensation_(structure, method) {
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
  derivatives_ = {symbol(2) * (2.0 * frequency), symbol(1), Eigen::VectorXcd::Zero(solved)};
  if (turns_) set_turning_factors(frequency);
  // Structural damping acts on the harmonics between 0 and M/2. The coefficient M/2 contains both signs.
  const int damped = (pair_.functions() - 1) / 2;
  if (loss_factor_ == 0.0) return;
  for (Eigen::VectorXcd* of_stiffness : {&factors_[2], &factors_[4], &derivatives_[4]})
    if (of_stiffness->size() > 0) of_stiffness->segment(1, damped) *= std::complex<double>(1.0, loss_factor_);
}

// Parts of G and K_s that the matrices do not contain.
void StructureCompliance::set_turning_factors(double frequency) {
  const int solved = pair_.solved_size();
  const double speed = speed_by_frequency_ * frequency, beyond = speed - base_speed_;
  factors_[3] = pair_.symbol(1).head(solved) * (frequency * beyond);
  derivatives_[3] = pair_.symbol(1).head(solved) * (beyond + frequency * speed_by_frequency_);
  factors_[4] = pair_.symbol(0).head(solved) * (beyond * (speed + base_speed_));
  derivatives_[4] = pair_.symbol(0).head(solved) * (2.0 * speed * speed_by_frequency_);
}

void StructureCompliance::condense_moving(const Eigen::MatrixXcd& loads, CondensedSpectrum& result) {
  const Eigen::Index moving = factors_[0].size() - 1;
  const auto tail = [&](const StiffnessSpectrum& all) -> StiffnessSpectrum {
    StiffnessSpectrum part;
    for (std::size_t d = 0; d < all.size(); ++d)
      if (all[d].size() > 0) part[d] = all[d].tail(moving);
    return part;
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
  return at.recover(coefficients_at(factors_, k), loads, forces);
}

}  // namespace wavebalance::solvers
