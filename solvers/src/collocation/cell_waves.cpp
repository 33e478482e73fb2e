#include "collocation/cell_waves.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

using Complex = std::complex<double>;

namespace {

// The polynomials of a far pole grow with their degree by exp(q^2 / (2 |z|)), but are of the size 1 / |z|,
// so that their rounding errors in the motion are as small as the others.
bool is_far(Complex z, Index count) {
  const double size = std::abs(z);
  return follows_upwards(z, count) ||
         (-z.real() > std::abs(z.imag()) && size * std::log(size) > 0.5 * double(count * count));
}

}  // namespace

CellWaves::CellWaves(Eigen::VectorXcd z, Index count)
    : z_(std::move(z)), decay_(z_.size()), at_end_(Eigen::MatrixXcd::Zero(z_.size(), count)) {
  constexpr double most_turns = 32.0, most_decay = 64.0;  // of the slow poles
  for (Index r = 0; r < z_.size(); ++r) {
    const bool is_slow = std::abs(z_[r].imag()) <= most_turns && -z_[r].real() <= most_decay;
    (is_slow ? slow_ : is_far(z_[r], count) ? far_ : fast_).push_back(r);
  }
  set_slow();
  set_far();
  if (fast_.empty()) return;
  ExponentialIntegrals<Complex> integrals(Eigen::VectorXd::Ones(1), count);
  for (const Index r : fast_) {
    integrals.compute(z_[r]);
    decay_[r] = integrals.decay()[0];
    at_end_.row(r) = integrals.values().row(0);
  }
}

void CellWaves::set_slow() {
  Index most = 1, longest = 1;
  for (const Index r : slow_) most = std::max(most, most_coefficients(z_[r]));
  series_real_.resize(most, Index(slow_.size()));
  series_imag_.resize(most, Index(slow_.size()));
  const Index count = std::min(most, at_end_.cols());
  for (std::size_t i = 0; i < slow_.size(); ++i) {
    const Index r = slow_[i];
    auto real = series_real_.col(Index(i)), imag = series_imag_.col(Index(i));
    longest = std::max(longest, exponential_series(z_[r], real, imag));
    decay_[r] = {real.sum(), imag.sum()};
    for (Index n = 0; n < count; ++n)
      at_end_(r, n) = ((n % 2 == 0 ? 2.0 : -2.0) / double(2 * n + 1)) * Complex(real[n], imag[n]);
  }
  series_real_.conservativeResize(longest, Eigen::NoChange);
  series_imag_.conservativeResize(longest, Eigen::NoChange);
}

void CellWaves::set_far() {
  far_poles_ = FarPoles(z_(far_), at_end_.cols());
  const FarPoles::Decay decay = far_poles_.decay(Eigen::VectorXd::Ones(1));
  for (std::size_t i = 0; i < far_.size(); ++i) {
    decay_[far_[i]] = decay.column(Index(i))[0];
    at_end_.row(far_[i]) =
        far_poles_.at_end().row(Index(i)) - decay_[far_[i]] * far_poles_.at_begin().row(Index(i));
  }
}

Eigen::VectorXd CellWaves::slow_series(const Eigen::VectorXcd& weights) const {
  const Eigen::VectorXcd own = weights(slow_);
  return series_real_ * own.real() - series_imag_ * own.imag();
}

WavesAtNodes::WavesAtNodes(const CellWaves& waves, const LegendreNodes& nodes)
    : waves_(waves), nodes_(nodes), points_(nodes.points), far_decay_(waves.far_poles().decay(points_)) {
  integrate_fast();
}

WavesAtNodes::WavesAtNodes(const CellWaves& waves, const LegendreNodes& nodes, const Eigen::VectorXd& points)
    : waves_(waves),
      nodes_(nodes),
      points_(points),
      own_points_(true),
      own_values_(legendre_values(points, waves.series_length() + nodes.count())),
      far_decay_(waves.far_poles().decay(points_)) {
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
  const Eigen::MatrixXd real = product(slow, waves_.series_real()),
                        imag = product(slow, waves_.series_imag());
  for (std::size_t i = 0; i < waves_.slow().size(); ++i) {
    result.col(waves_.slow()[i]).real() = real.col(Index(i));
    result.col(waves_.slow()[i]).imag() = imag.col(Index(i));
  }
  for (std::size_t i = 0; i < fast_integrals_.size(); ++i)
    result.col(waves_.fast()[i]) = fast_integrals_[i].decay;
  for (std::size_t i = 0; i < waves_.far().size(); ++i)
    result.col(waves_.far()[i]) = far_decay_.column(Index(i));
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
  Eigen::MatrixXd series = convolution(waves_.slow_series(weights), nodes_.count());
  const Eigen::VectorXcd of_far = weights(waves_.far());
  series.topRows(nodes_.count()) += waves_.far_poles().polynomials(of_far);
  Eigen::MatrixXd result = product(polynomials().block(first, 0, count, series.rows()), series);
  const Eigen::MatrixXcd begins = of_far.asDiagonal() * waves_.far_poles().at_begin();
  if (of_far.size() > 0) result -= product(far_decay_.real.middleRows(first, count), begins.real());
  if (far_decay_.imag.size() > 0) result += product(far_decay_.imag.middleRows(first, count), begins.imag());
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
