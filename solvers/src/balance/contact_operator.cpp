#include "wavebalance/solvers/balance/contact_operator.hpp"

#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavebalance::solvers {

ContactOperator::ContactOperator(CondensedProblem& problem, Eigen::VectorXd series_flexibility)
    : problem_(&problem),
      series_flexibility_(std::move(series_flexibility)),
      columns_are_current_(static_cast<std::size_t>(problem.contacts()), false) {
  if (series_flexibility_.size() != 0 && series_flexibility_.size() != problem.contacts())
    throw std::invalid_argument("ContactOperator: there are " + std::to_string(series_flexibility_.size()) +
                                " flexibilities; give none or " + std::to_string(problem.contacts()) +
                                ", one per contact");
  if (!series_flexibility_.allFinite() || (series_flexibility_.array() < 0.0).any())
    throw std::invalid_argument("ContactOperator: every flexibility must be at least 0 m/N and finite");
}

// P is the inverse of the symbol of degree 0 after the inner products with the weighting functions.
void ContactOperator::follow_problem() {
  if (condensation_ == problem_->condensations()) return;
  condensation_ = problem_->condensations();
  columns_are_current_.assign(columns_are_current_.size(), false);
  if (!is_force_form()) return;
  const TimePair& pair = problem_->pair();
  kernel_ = problem_->compliance();
  for (int c = 0; c < problem_->contacts(); ++c)
    kernel_.col(c + problem_->contacts() * c).head(pair.solved_size()) -=
        series_flexibility_[c] * pair.symbol(0).head(pair.solved_size()).cwiseInverse();
}

const Eigen::MatrixXcd& ContactOperator::kernel() {
  follow_problem();
  return is_force_form() ? kernel_ : problem_->compliance();
}

void ContactOperator::apply(const Eigen::VectorXd& force, Eigen::VectorXd& unknown) {
  problem_->apply(kernel(), force, unknown);
}

void ContactOperator::apply_transposed(const Eigen::VectorXd& values, Eigen::VectorXd& result) {
  problem_->apply_transposed(kernel(), values, result);
}

Eigen::MatrixXcd ContactOperator::harmonic_response(int n) {
  const TimePair& pair = problem_->pair();
  const int k = n % pair.functions(), contacts = problem_->contacts();
  const bool mirrored = k >= pair.spectrum_size();
  const double scale = double(pair.functions()) / pair.points() / pair.points();
  const std::complex<double> bases = scale * std::conj(pair.weight_spectrum()[n]) * pair.trial_spectrum()[n];
  Eigen::MatrixXcd compliance =
      kernel().row(mirrored ? pair.functions() - k : k).reshaped(contacts, contacts);
  if (mirrored) compliance = compliance.conjugate().eval();
  return bases * compliance;
}

const Eigen::MatrixXd& ContactOperator::columns() {
  std::vector<int> all(columns_are_current_.size());
  std::iota(all.begin(), all.end(), 0);
  return columns(all);
}

const Eigen::MatrixXd& ContactOperator::columns(std::span<const int> wanted) {
  follow_problem();
  const int period = problem_->pair().shift_period(), points = problem_->points();
  columns_.resize(problem_->samples(), problem_->contacts() * period);
  Eigen::VectorXd unit, column;
  for (const int d : wanted) {
    if (columns_are_current_[static_cast<std::size_t>(d)]) continue;
    for (int m = 0; m < period; ++m) {
      unit.setZero(problem_->samples());
      unit[d * points + m] = 1.0;
      apply(unit, column);
      columns_.col(d * period + m) = column;
    }
    columns_are_current_[static_cast<std::size_t>(d)] = true;
  }
  return columns_;
}

Eigen::VectorXd ContactOperator::rigid_position(const Eigen::VectorXd& unknown,
                                                const Eigen::VectorXd& force) const {
  return problem_->rigid_position(unknown, force, series_flexibility_);
}

Eigen::VectorXd ContactOperator::force_on_held_structure(const Eigen::VectorXd& force,
                                                         const Eigen::VectorXd& unknown) const {
  return problem_->force_on_held_structure(force, unknown, series_flexibility_);
}

Eigen::MatrixXcd ContactOperator::unknown_coefficients(const Eigen::VectorXd& force,
                                                       const Eigen::VectorXd& held) {
  if (!problem_->is_free()) return problem_->coefficients(kernel(), force);
  return problem_->coefficients(held) + problem_->coefficients(kernel(), force) -
         problem_->coefficients(force);
}

}  // namespace wavebalance::solvers
