#pragma once
#include <cstddef>
#include <optional>
#include <span>

namespace wavebalance::app {

/// Where the polynomial through a point of a curve and so many neighbours on each side is highest, over the
/// length of the curve through them, of which places and heights have the range of these points as units.
struct PolynomialPeak {
  double place, height;
};
/// Nothing near an end of the curve, next to unknown points, and where the polynomial is highest beyond the
/// two neighbours.
std::optional<PolynomialPeak> polynomial_peak(std::span<const double> places, std::span<const double> heights,
                                              std::size_t index, std::size_t neighbours);

}  // namespace wavebalance::app
