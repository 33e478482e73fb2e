#include "collocation/law_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavebalance::solvers::detail {
namespace {

bool is_none(const ForceSlopes& at) { return at.force == 0.0 && at.tangent == 0.0 && at.damping == 0.0; }

}  // namespace

LawSegments::LawSegments(AnyContactLaw law, double length, double holding, const Yielding& yielding)
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
    for (const double velocity : {0.0, -length, length})
      if (!is_none(law_.at(displacement, velocity))) return true;
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

int LawSegments::piece_at(double displacement) const {
  return static_cast<int>(std::upper_bound(breakpoints_.begin(), breakpoints_.end(), displacement) -
                          breakpoints_.begin());
}

// The displacement, or the last one within the piece.
double LawSegments::inside(int piece, double displacement) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (piece > 0 && displacement <= breakpoint(piece - 1))
    return std::nextafter(breakpoint(piece - 1), infinity);
  if (piece + 1 < count() && displacement >= breakpoint(piece))
    return std::nextafter(breakpoint(piece), -infinity);
  return displacement;
}

bool LawSegments::vanishes(int piece, double displacement, double velocity) const {
  return may_vanish() && exerts(piece) && is_none(law_.at(inside(piece, displacement), velocity));
}

// By a force that is linear in the velocity, as in the catalogue.
ForceSlopes LawSegments::continued(double displacement, double velocity) const {
  const ForceSlopes rest = law_.at(displacement, 0.0), back = law_.at(displacement, -velocity);
  return {2.0 * rest.force - back.force, 2.0 * rest.tangent - back.tangent,
          2.0 * rest.damping - back.damping};
}

// The cubic through the ends of a piece between two breakpoints, which the pieces of tables are, and their
// lines: a panel that leaves the piece remains smooth. Farther away than the piece is long it is a line.
ForceSlopes LawSegments::beyond(int piece, double displacement) const {
  const double low = breakpoint(piece - 1), high = breakpoint(piece), h = high - low;
  const ForceSlopes a = law_.at(inside(piece, low), 0.0), b = law_.at(inside(piece, high), 0.0);
  const double rise = b.force - a.force, square = 3.0 * rise - h * (2.0 * a.tangent + b.tangent),
               cube = h * (a.tangent + b.tangent) - 2.0 * rise,
               reached = std::clamp(displacement, low - h, high + h), x = (reached - low) / h,
               tangent = a.tangent + x * (2.0 * square + x * 3.0 * cube) / h;
  return {a.force + x * (h * a.tangent + x * (square + x * cube)) + tangent * (displacement - reached),
          tangent, 0.0};
}

ForceSlopes LawSegments::at(int piece, double displacement, double velocity) const {
  if (rigid_) {
    if (!exerts(piece)) return {};
    if (jumps()) return {.force = velocity / yielding_.velocity, .damping = 1.0 / yielding_.velocity};
    return {.force = (displacement - law_.gap()) / yielding_.displacement,
            .tangent = 1.0 / yielding_.displacement};
  }
  if (piece >= count()) return {-holding_ * displacement, -holding_, 0.0};
  const double within = inside(piece, displacement);
  const bool between = piece > 0 && piece + 1 < count() && !law_.depends_on_velocity();
  ForceSlopes value = between && within != displacement         ? beyond(piece, displacement)
                      : vanishes(piece, displacement, velocity) ? continued(within, velocity)
                                                                : law_.at(within, velocity);
  if (!between) value.force += value.tangent * (displacement - within);
  value.force -= holding_ * displacement;
  value.tangent -= holding_;
  return value;
}

}  // namespace wavebalance::solvers::detail
