#include "structure/pivot_recursion.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"
#include "structure/condensation_method.hpp"

namespace wavebalance::solvers {

PivotRecursion::PivotRecursion(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives)
    : chunks_(static_cast<std::size_t>((factors[0].size() + block_size - 1) / block_size)) {
  const Index last = factors[0].size() - 1;
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    for (std::size_t d = 0; d < 3; ++d) {
      Chunk& chunk = chunks_[c];
      for (Index i = 0; i < block_size; ++i) {
        const Index k = std::min(Index(c) * block_size + i, last);
        chunk.factors[d].re[i] = factors[d][k].real();
        chunk.factors[d].im[i] = factors[d][k].imag();
        chunk.derivatives[d].re[i] = derivatives[d][k].real();
        chunk.derivatives[d].im[i] = derivatives[d][k].imag();
      }
      chunk.magnitudes[d] = weak_pivot * (chunk.factors[d].re.abs() + chunk.factors[d].im.abs());
    }
}

PivotRecursion::Parts PivotRecursion::combine(const std::array<Parts, 3>& spectrum,
                                              const std::array<double, 3>& entries) {
  return {spectrum[0].re * entries[0] + spectrum[1].re * entries[1] + spectrum[2].re * entries[2],
          spectrum[0].im * entries[0] + spectrum[1].im * entries[1] + spectrum[2].im * entries[2]};
}

void PivotRecursion::eliminate(const Row& row) {
  for (Chunk& chunk : chunks_) eliminate(row, chunk);
  first_ = false;
}

void PivotRecursion::eliminate(const Row& row, Chunk& chunk) {
  const auto& [factors, derivatives, magnitudes, inverse, slope, error] = chunk;
  Parts pivot = combine(factors, row.diagonal);
  Parts rate = combine(derivatives, row.diagonal);
  // The size of the terms, not of their sum: at a natural frequency of an undamped structure they cancel.
  const Block scale = magnitudes[0] * std::abs(row.diagonal[0]) + magnitudes[1] * std::abs(row.diagonal[1]) +
                      magnitudes[2] * std::abs(row.diagonal[2]);
  if (!first_) {
    const Parts off = combine(factors, row.off);
    const Parts twice_off_rate = combine(derivatives, {2.0 * row.off[0], 2.0 * row.off[1], 2.0 * row.off[2]});
    // w = off / d, so that d_i = z_ii - off w and d_i' = z_ii' - 2 off' w - off^2 (1/d)'.
    const Parts w{off.re * inverse.re - off.im * inverse.im, off.re * inverse.im + off.im * inverse.re};
    const Parts square{off.re * off.re - off.im * off.im, 2.0 * off.re * off.im};
    pivot.re -= off.re * w.re - off.im * w.im;
    pivot.im -= off.re * w.im + off.im * w.re;
    rate.re -=
        twice_off_rate.re * w.re - twice_off_rate.im * w.im + square.re * slope.re - square.im * slope.im;
    rate.im -=
        twice_off_rate.re * w.im + twice_off_rate.im * w.re + square.re * slope.im + square.im * slope.re;
    // An error of z_ii changes d_i as much, and one of d_{i-1} by |w|^2. Errors of off and of the pivot are
    // of the same sizes, since off^2 is at most the product of two diagonal entries.
    chunk.error = error * (w.re.square() + w.im.square()) + scale;
  } else {
    chunk.error = scale;
  }
  const Block norm = pivot.re.square() + pivot.im.square();
  weak_ = weak_ || !(norm > scale.square()).all();
  chunk.inverse = {pivot.re / norm, -pivot.im / norm};
  // (1/d)' = -d' / d^2
  const Parts square{inverse.im.square() - inverse.re.square(), -2.0 * inverse.re * inverse.im};
  chunk.slope = {rate.re * square.re - rate.im * square.im, rate.re * square.im + rate.im * square.re};
}

void PivotRecursion::last(Eigen::Ref<Eigen::VectorXcd> inverse, Eigen::Ref<Eigen::VectorXcd> slope,
                          Eigen::Ref<Eigen::VectorXd> error) const {
  for (Index k = 0; k < inverse.size(); ++k) {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(k / block_size)];
    const Index i = k % block_size;
    inverse[k] = {chunk.inverse.re[i], chunk.inverse.im[i]};
    slope[k] = {chunk.slope.re[i], chunk.slope.im[i]};
    error[k] = (rounding_unit / weak_pivot) * chunk.error[i] * std::norm(inverse[k]);
  }
}

}  // namespace wavebalance::solvers
