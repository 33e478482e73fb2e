#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "phases/pole_response_parts.hpp"

namespace wavebalance::solvers::detail {
namespace {

using PoleRate = std::complex<double>;

// The real states of poles: one of each real pole, the real and imaginary part of each pair.
class StatesOfPoles {
 public:
  explicit StatesOfPoles(const Eigen::VectorXcd& exponents) {
    for (const PoleRate exponent : exponents) {
      begins_.push_back(size_);
      pairs_.push_back(exponent.imag() > 0.0);
      size_ += pairs_.back() ? 2 : 1;
    }
  }

  Index size() const { return size_; }

  // Re(row factor state) of equations by complex states, for the real ones: equations x size().
  Eigen::MatrixXd columns(const Eigen::MatrixXd& real, const Eigen::MatrixXd& imag,
                          const Eigen::VectorXcd& factors) const {
    Eigen::MatrixXd result(real.rows(), size_);
    for (std::size_t r = 0; r < begins_.size(); ++r) {
      const PoleRate factor = factors[Index(r)];
      result.col(begins_[r]) = factor.real() * real.col(Index(r)) - factor.imag() * imag.col(Index(r));
      if (pairs_[r])
        result.col(begins_[r] + 1) = -factor.imag() * real.col(Index(r)) - factor.real() * imag.col(Index(r));
    }
    return result;
  }

  Eigen::MatrixXd rows(const Eigen::MatrixXcd& states) const {
    Eigen::MatrixXd result(size_, states.cols());
    for (std::size_t r = 0; r < begins_.size(); ++r) {
      result.row(begins_[r]) = states.row(Index(r)).real();
      if (pairs_[r]) result.row(begins_[r] + 1) = states.row(Index(r)).imag();
    }
    return result;
  }

  // What multiplies each complex state by its factor.
  Eigen::MatrixXd diagonal(const Eigen::VectorXcd& factors) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size_, size_);
    for (std::size_t r = 0; r < begins_.size(); ++r) {
      const Index i = begins_[r];
      const PoleRate factor = factors[Index(r)];
      result(i, i) = factor.real();
      if (!pairs_[r]) continue;
      result(i + 1, i + 1) = factor.real();
      result(i + 1, i) = factor.imag();
      result(i, i + 1) = -factor.imag();
    }
    return result;
  }

 private:
  std::vector<Index> begins_;
  std::vector<bool> pairs_;
  Index size_ = 0;
};

}  // namespace

Eigen::VectorXcd PoleResponse::free_multipliers() const {
  std::vector<PoleRate> multipliers;
  for (const PoleRate exponent : exponents_) {
    multipliers.push_back(std::exp(exponent));
    if (exponent.imag() > 0.0) multipliers.push_back(std::conj(multipliers.back()));
  }
  return Eigen::VectorXcd::Map(multipliers.data(), Index(multipliers.size()));
}

FreePeriod PoleResponse::free_period(const CellGrid& grid, const LegendreNodes& nodes, bool velocity) const {
  constexpr double negligible = 1e-18;
  const auto period = this->cells(grid, nodes);
  const std::vector<Cell>& cells = period->cells;
  const Index n = period->count(), m = period->marks();
  const std::vector<Rows> rows = rows_of(*period, velocity);
  const std::vector<Sources> sources = sources_of(*period);
  const std::size_t count = cells.size();
  std::size_t first = 0;
  double longest = 0.0;
  for (std::size_t j = 0; j < count; ++j)
    if (cells[j].parts.empty() && cells[j].length > longest) {
      longest = cells[j].length;
      first = (j + 1) % count;
    }
  const auto at = [&](std::size_t step) { return (first + step) % count; };
  Index left = 0;
  while (left < exponents_.size() && std::exp(longest * exponents_[left].real()) > negligible) ++left;
  const StatesOfPoles states(exponents_.head(left));

  const Index equations = n + 2 * m + (velocity ? n : 0);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(equations, n + m), by_states(equations, states.size());
  FreePeriod result;
  // At its beginning the period has impulses, and at its end what the last cell leaves.
  const Sources& at_begin = sources[at(0)];
  const auto nodes_there = Index(std::count_if(at_begin.numbers.begin(), at_begin.numbers.end(),
                                               [n](Index number) { return number < n; }));
  const auto split_at = at_begin.numbers.begin() + nodes_there;
  const std::vector<Index> of_nodes(at_begin.numbers.begin(), split_at),
      impulses(split_at, at_begin.numbers.end());
  MovingStates moving(exponents_.size(), n + m);
  moving.add(at_begin.states.rightCols(Index(impulses.size())), impulses);
  Eigen::VectorXcd gone = Eigen::VectorXcd::Ones(exponents_.size());  // of the states at the beginning
  for (std::size_t t = 0; t < count; ++t) {
    const Rows& seen = rows[at(t)];
    by_states(seen.numbers, Eigen::all) =
        states.columns(seen.real.leftCols(left), seen.imag.leftCols(left), gone.head(left));
    if (!seen.numbers.empty()) all(seen.numbers, Eigen::all) = moving.seen_by(seen.real, seen.imag);
    gone.array() *= cells[at(t)].decay.array();
    moving.multiply(cells[at(t)].decay);
    if (t + 1 < count) moving.add(sources[at(t + 1)].states, sources[at(t + 1)].numbers);
  }
  moving.add(at_begin.states.leftCols(nodes_there), of_nodes);
  result.states_by_states = states.diagonal(gone.head(left));
  result.states_by = states.rows(moving.top(left));
  add_within_cells(*period, velocity, all);
  result.influence = split(all, n, m, velocity);
  result.displacement_by = by_states.topRows(n + m);
  if (velocity) result.velocity_by = by_states.bottomRows(n);
  return result;
}

}  // namespace wavebalance::solvers::detail
