#include "phases/law_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavebalance::solvers::detail {

LawPieces::LawPieces(AnyContactLaw law, double length, double holding, const Yielding& yielding)
    : law_(std::move(law)),
      rigid_(law_.is_rigid()),
      holding_(holding),
      yielding_(yielding),
      breakpoints_(law_.breakpoints()) {
  if (rigid_) {
    breakpoints_ = {law_.gap()};
    exerts_ = {false, true};
    return;
  }
  std::erase_if(breakpoints_, [](double at) { return !std::isfinite(at); });
  const auto force_at = [&](double displacement) {
    for (const double velocity : {0.0, -length, length}) {
      const ForceSlopes at = law_.at(displacement, velocity);
      if (at.force != 0.0 || at.tangent != 0.0 || at.damping != 0.0) return true;
    }
    return false;
  };
  for (int piece = 0; piece < count(); ++piece) {
    const bool first = piece == 0, last = piece + 1 == count();
    const double low = first ? (last ? 0.0 : breakpoint(0)) - 2.0 * length : breakpoint(piece - 1),
                 high = last ? low + 4.0 * length : breakpoint(piece);
    bool acts = false;
    for (const double share : {0.1, 0.5, 0.9}) acts = acts || force_at(low + share * (high - low));
    exerts_.push_back(acts);
  }
}

int LawPieces::piece_at(double displacement) const {
  return static_cast<int>(std::upper_bound(breakpoints_.begin(), breakpoints_.end(), displacement) -
                          breakpoints_.begin());
}

// The displacement, or the last one within the piece.
double LawPieces::inside(int piece, double displacement) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (piece > 0 && displacement <= breakpoint(piece - 1))
    return std::nextafter(breakpoint(piece - 1), infinity);
  if (piece + 1 < count() && displacement >= breakpoint(piece))
    return std::nextafter(breakpoint(piece), -infinity);
  return displacement;
}

ForceSlopes LawPieces::at(int piece, double displacement, double velocity) const {
  if (rigid_) {
    if (!exerts(piece)) return {};
    if (jumps()) return {.force = velocity / yielding_.velocity, .damping = 1.0 / yielding_.velocity};
    return {.force = (displacement - law_.gap()) / yielding_.displacement,
            .tangent = 1.0 / yielding_.displacement};
  }
  const double within = inside(piece, displacement);
  ForceSlopes value = law_.at(within, velocity);
  value.force += value.tangent * (displacement - within) - holding_ * displacement;
  value.tangent -= holding_;
  return value;
}

}  // namespace wavebalance::solvers::detail
