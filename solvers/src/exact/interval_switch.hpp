#pragma once
#include <optional>
#include <vector>

#include "exact/grazing.hpp"

namespace wavebalance::solvers::detail {

/// Where a curve goes on with other intervals: the grazing motion, and the first point behind it.
struct Switch {
  PathPoint grazing;  ///< without the interval that appears or vanishes
  PathPoint next;
  bool appears = true;  ///< the interval, else it vanishes
  /// Points with the interval between grazing and the one that has it, in the order of the curve: there the
  /// slope or the stability changes.
  std::vector<PathPoint> between{};
  /// Whether the curve reverses so near to grazing that both are one to ten digits.
  bool reverses = false;
};

/// An interval that `next` has in addition to the intervals of `current` appears between the two.
/// Nothing where it is none that grows from no length, or the solutions are not found.
std::optional<Switch> appearance(const PathModel& model, const PathPoint& current, const PathPoint& next);

/// The shortest interval of `current` vanishes soon behind it: it is short and becomes shorter. Nothing where
/// it does not.
std::optional<Switch> disappearance(const PathModel& model, const PathPoint& current);

}  // namespace wavebalance::solvers::detail
