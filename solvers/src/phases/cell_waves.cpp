#include "phases/cell_waves.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

using Complex = std::complex<double>;

CellWaves::CellWaves(Eigen::VectorXcd z, Index count)
    : z_(std::move(z)), decay_(z_.size()), at_end_(Eigen::MatrixXcd::Zero(z_.size(), count)) {
  constexpr double most_turns = 32.0, most_decay = 64.0;  // of the slow poles
  const Index poles = z_.size();
  std::vector<std::vector<Complex>> series(static_cast<std::size_t>(poles));
  std::size_t longest = 1;
  for (Index r = 0; r < poles; ++r) {
    if (std::abs(z_[r].imag()) > most_turns || -z_[r].real() > most_decay) {
      fast_.push_back(r);
      continue;
    }
    auto& own = series[static_cast<std::size_t>(r)] = exponential_series(z_[r]);
    longest = std::max(longest, own.size());
  }
  series_real_.setZero(Index(longest), poles);
  series_imag_.setZero(Index(longest), poles);
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
  if (fast_.empty()) return;
  ExponentialIntegrals<Complex> integrals(Eigen::VectorXd::Ones(1), count);
  for (const Index r : fast_) {
    integrals.compute(z_[r]);
    decay_[r] = integrals.decay()[0];
    at_end_.row(r) = integrals.values().row(0);
  }
}

Eigen::VectorXd CellWaves::slow_series(const Eigen::VectorXcd& weights) const {
  return series_real_ * weights.real() - series_imag_ * weights.imag();
}

WavesAtNodes::WavesAtNodes(const CellWaves& waves, const LegendreNodes& nodes)
    : waves_(waves), nodes_(nodes), points_(nodes.points) {
  integrate_fast();
}

WavesAtNodes::WavesAtNodes(const CellWaves& waves, const LegendreNodes& nodes, const Eigen::VectorXd& points)
    : waves_(waves),
      nodes_(nodes),
      points_(points),
      own_points_(true),
      own_values_(legendre_values(points, waves.series_length() + nodes.count())) {
  integrate_fast();
}

void WavesAtNodes::integrate_fast() {
  if (waves_.fast().empty()) return;
  ExponentialIntegrals<double> real(points_, nodes_.count());
  ExponentialIntegrals<Complex> complex(points_, nodes_.count());
  for (const Index r : waves_.fast())
    if (const Complex z = waves_.z()[r]; z.imag() == 0.0)
      add_fast(z.real(), real);
    else
      add_fast(z, complex);
}

template <class Scalar>
void WavesAtNodes::add_fast(Scalar z, ExponentialIntegrals<Scalar>& integrals) {
  integrals.compute(z);
  fast_integrals_.push_back({integrals.values().real(), {}, integrals.decay().template cast<Complex>()});
  if constexpr (std::same_as<Scalar, Complex>) fast_integrals_.back().imag = integrals.values().imag();
}

Eigen::MatrixXcd WavesAtNodes::values() const {
  Eigen::MatrixXcd result(points_.size(), waves_.z().size());
  const Eigen::MatrixXd slow = polynomials().leftCols(waves_.series_length());
  result.real() = product(slow, waves_.series_real());
  result.imag() = product(slow, waves_.series_imag());
  for (std::size_t i = 0; i < fast_integrals_.size(); ++i)
    result.col(waves_.fast()[i]) = fast_integrals_[i].decay;
  return result;
}

Eigen::VectorXcd WavesAtNodes::states(std::size_t number, Complex start,
                                      const Eigen::VectorXcd& force) const {
  const Integrals& own = fast_integrals_[number];
  Eigen::VectorXcd result = start * own.decay + own.real * force;
  if (own.imag.size() > 0) result += Complex(0.0, 1.0) * (own.imag * force);
  return result;
}

Eigen::MatrixXd WavesAtNodes::up_to(const Eigen::VectorXcd& weights, Index first, Index count) const {
  const Eigen::MatrixXd slow = convolution(waves_.slow_series(weights), nodes_.count());
  Eigen::MatrixXd result = product(polynomials().block(first, 0, count, slow.rows()), slow);
  for (std::size_t i = 0; i < waves_.fast().size(); ++i) {
    const Complex weight = weights[waves_.fast()[i]];
    const Integrals& own = fast_integrals_[i];
    result += weight.real() * own.real.middleRows(first, count);
    if (own.imag.size() > 0) result -= weight.imag() * own.imag.middleRows(first, count);
  }
  return result;
}

std::vector<Eigen::MatrixXcd> WavesAtNodes::integrals() const {
  std::vector<Eigen::MatrixXcd> result;
  ExponentialIntegrals<Complex> integrals(points_, nodes_.count());
  for (const Complex pole : waves_.z()) {
    integrals.compute(pole);
    result.push_back(integrals.values());
  }
  return result;
}

}  // namespace wavebalance::solvers::detail
