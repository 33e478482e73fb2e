#include "phases/cell_waves.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

using Complex = std::complex<double>;

CellWaves::CellWaves(const Eigen::VectorXcd& z, const LegendreNodes& nodes)
    : nodes_(nodes), decay_(z.size()), at_nodes_(nodes.count(), z.size()), at_end_(z.size(), nodes.count()) {
  constexpr double most_turns = 32.0, most_decay = 64.0;  // of the slow poles
  const Index poles = z.size(), count = nodes.count();
  std::vector<std::vector<Complex>> series(static_cast<std::size_t>(poles));
  std::size_t longest = 1;
  for (Index r = 0; r < poles; ++r) {
    if (std::abs(z[r].imag()) > most_turns || -z[r].real() > most_decay) {
      fast_.push_back(r);
      continue;
    }
    auto& own = series[static_cast<std::size_t>(r)] = exponential_series(z[r]);
    longest = std::max(longest, own.size());
  }
  series_real_.setZero(Index(longest), poles);
  series_imag_.setZero(Index(longest), poles);
  at_end_.setZero();
  for (Index r = 0; r < poles; ++r) {
    const auto& own = series[static_cast<std::size_t>(r)];
    Complex sum = 0.0;
    for (Index n = 0; n < Index(own.size()); ++n) {
      const Complex coefficient = own[static_cast<std::size_t>(n)];
      series_real_(n, r) = coefficient.real();
      series_imag_(n, r) = coefficient.imag();
      sum += coefficient;
      if (n < count) at_end_(r, n) = ((n % 2 == 0 ? 2.0 : -2.0) / double(2 * n + 1)) * coefficient;
    }
    decay_[r] = sum;
  }
  const Eigen::MatrixXd values = nodes.values.leftCols(Index(longest));
  at_nodes_.real() = product(values, series_real_);
  at_nodes_.imag() = product(values, series_imag_);
  if (fast_.empty()) return;
  Eigen::VectorXd points(count + 1);
  points << nodes.points, 1.0;
  ExponentialIntegrals<double> real(points, count);
  ExponentialIntegrals<Complex> complex(points, count);
  for (const Index r : fast_)
    if (z[r].imag() == 0.0)
      add_fast(r, z[r].real(), real);
    else
      add_fast(r, z[r], complex);
}

template <class Scalar>
void CellWaves::add_fast(Index pole, Scalar z, ExponentialIntegrals<Scalar>& integrals) {
  const Index count = nodes_.count();
  integrals.compute(z);
  const auto& decay = integrals.decay();
  const auto values = integrals.values();
  decay_[pole] = decay[count];
  at_nodes_.col(pole) = decay.head(count).template cast<Complex>();
  at_end_.row(pole) = values.row(count).template cast<Complex>();
  fast_integrals_.push_back({values.topRows(count).real(), {}});
  if constexpr (std::same_as<Scalar, Complex>) fast_integrals_.back().imag = values.topRows(count).imag();
}

Eigen::VectorXd CellWaves::slow_series(const Eigen::VectorXcd& weights) const {
  return series_real_ * weights.real() - series_imag_ * weights.imag();
}

Eigen::MatrixXd CellWaves::up_to_nodes(const Eigen::VectorXcd& weights) const {
  const Eigen::MatrixXd slow = convolution(slow_series(weights), nodes_.count());
  Eigen::MatrixXd result = product(nodes_.values.leftCols(slow.rows()), slow);
  for (std::size_t i = 0; i < fast_.size(); ++i) {
    const Complex weight = weights[fast_[i]];
    result += weight.real() * fast_integrals_[i].real;
    if (fast_integrals_[i].imag.size() > 0) result -= weight.imag() * fast_integrals_[i].imag;
  }
  return result;
}

}  // namespace wavebalance::solvers::detail
