#include <cmath>

#include "collocation/pole_response_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/multipliers.hpp"

namespace wavebalance::solvers::detail {

Eigen::VectorXcd PoleResponse::free_multipliers() const {
  std::vector<std::complex<double>> multipliers;
  for (const std::complex<double> exponent : exponents_) {
    multipliers.push_back(free_multiplier(exponent));
    if (exponent.imag() > 0.0) multipliers.push_back(std::conj(multipliers.back()));
  }
  return Eigen::VectorXcd::Map(multipliers.data(), Index(multipliers.size()));
}

FreeCells PoleResponse::free_cells(const PeriodCells& period, bool velocity) const {
  const std::size_t last = period.cells.size() - 1;
  const Index n = period.count(), m = period.marks(), poles = exponents_.size();
  const std::vector<Rows> rows = rows_of(period, velocity);
  const std::vector<Sources> sources = sources_of(period);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + 2 * m + (velocity ? n : 0), n + m);
  Eigen::MatrixXcd by_states(all.rows(), poles);
  FreeCells result;
  result.decay = Eigen::VectorXcd::Ones(poles);
  MovingStates moving(poles, n + m);
  moving.add(sources[0].states, sources[0].numbers);
  for (std::size_t j = 0; j < last; ++j) {
    for (Index i = 0; i < Index(rows[j].numbers.size()); ++i) {
      auto row = by_states.row(rows[j].numbers[std::size_t(i)]);
      row.real() = rows[j].real.row(i);
      row.imag() = rows[j].imag.row(i);
      row.array() *= result.decay.transpose().array();
    }
    if (!rows[j].numbers.empty())
      all(rows[j].numbers, Eigen::all) = moving.seen_by(rows[j].real, rows[j].imag);
    result.decay.array() *= period.cells[j].decay.array();
    moving.multiply(period.cells[j].decay);
    moving.add(sources[j + 1].states, sources[j + 1].numbers);
  }
  add_within_cells(period, velocity, all);
  result.influence = split(all, n, m, velocity);
  result.displacement_by = by_states.topRows(n + m);
  if (velocity) result.velocity_by = by_states.bottomRows(n);
  result.states_by = moving.top(poles);
  return result;
}

}  // namespace wavebalance::solvers::detail
