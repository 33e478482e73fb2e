#include "phases/cell_waves.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

using Complex = std::complex<double>;

CellWaves::CellWaves(const Eigen::VectorXcd& z, const LegendreNodes& nodes)
    : nodes_(nodes),
      points_(nodes.points),
      decay_(z.size()),
      at_nodes_(nodes.count(), z.size()),
      at_end_(z.size(), nodes.count()) {
  sum_up(z, nodes.points);
}

CellWaves::CellWaves(const Eigen::VectorXcd& z, const LegendreNodes& nodes, const Eigen::VectorXd& points)
    : nodes_(nodes),
      points_(points),
      own_points_(true),
      decay_(z.size()),
      at_nodes_(points.size(), z.size()),
      at_end_(z.size(), nodes.count()) {
  sum_up(z, points);
}

void CellWaves::sum_up(const Eigen::VectorXcd& z, const Eigen::VectorXd& at) {
  constexpr double most_turns = 32.0, most_decay = 64.0;  // of the slow poles
  const Index poles = z.size(), count = nodes_.count();
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
  if (own_points_) own_values_ = legendre_values(at, Index(longest) + count);
  const Eigen::MatrixXd waves = values().leftCols(Index(longest));
  at_nodes_.real() = product(waves, series_real_);
  at_nodes_.imag() = product(waves, series_imag_);
  if (fast_.empty()) return;
  Eigen::VectorXd points(at.size() + 1);
  points << at, 1.0;
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
  const Index points = at_nodes_.rows();
  integrals.compute(z);
  const auto& decay = integrals.decay();
  const auto integral = integrals.values();
  decay_[pole] = decay[points];
  at_nodes_.col(pole) = decay.head(points).template cast<Complex>();
  at_end_.row(pole) = integral.row(points).template cast<Complex>();
  fast_integrals_.push_back({integral.topRows(points).real(), {}});
  if constexpr (std::same_as<Scalar, Complex>) fast_integrals_.back().imag = integral.topRows(points).imag();
}

Eigen::VectorXd CellWaves::slow_series(const Eigen::VectorXcd& weights) const {
  return series_real_ * weights.real() - series_imag_ * weights.imag();
}

Eigen::MatrixXd CellWaves::up_to_nodes(const Eigen::VectorXcd& weights, Index first, Index count) const {
  const Eigen::MatrixXd slow = convolution(slow_series(weights), nodes_.count());
  Eigen::MatrixXd result = product(values().block(first, 0, count, slow.rows()), slow);
  for (std::size_t i = 0; i < fast_.size(); ++i) {
    const Complex weight = weights[fast_[i]];
    const Integrals& own = fast_integrals_[i];
    result += weight.real() * own.real.middleRows(first, count);
    if (own.imag.size() > 0) result -= weight.imag() * own.imag.middleRows(first, count);
  }
  return result;
}

std::vector<Eigen::MatrixXcd> CellWaves::integrals_of(const Eigen::VectorXcd& z) const {
  std::vector<Eigen::MatrixXcd> result;
  ExponentialIntegrals<Complex> integrals(points_, nodes_.count());
  for (const Complex pole : z) {
    integrals.compute(pole);
    result.push_back(integrals.values());
  }
  return result;
}

}  // namespace wavebalance::solvers::detail
