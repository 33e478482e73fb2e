#pragma once
#include <optional>
#include <vector>

#include "exact/exact_path.hpp"

namespace wavebalance::solvers::detail {

/// The time of a contact between two passages that follow each other.
struct Interval {
  int contact = 0, from = 0, to = 0;  ///< numbers of the passages
  double begin = 0.0, length = 0.0;   ///< periods
};

/// Those that vanish where a contact grazes: between passages of the same breakpoint, or from one to the end
/// of a force of the velocity, the shortest first.
std::vector<Interval> intervals_of(const Layout& layout);

/// How an interval's length changes along a direction, as of PathPoint.
double growth(const PathPoint& at, const Interval& interval);

/// The cuts of a layout together with the cuts of another layout in intervals of the same contact on the
/// same segment. Forces that the other layout resolves are then resolved too.
Layout with_cuts_of(const Layout& other, Layout layout);

/// The layout without contact intervals and gaps that vanish, with the cuts of all.
Layout without(Layout layout, std::vector<Interval> intervals);

/// A place where a contact may graze.
struct Grazing {
  int contact = 0;
  double breakpoint = 0.0;  ///< m
  double time = 0.0;        ///< periods, near the extremum of the displacement
  double width = 0.0;       ///< periods, of the interval there
  bool above = true;        ///< whether the displacement is above the breakpoint in the interval
};

Grazing grazing_of(const PathPoint& at, const Layout& layout, const Interval& interval);

/// By how much the extremum passes the breakpoint, m; NaN where there is none.
double passed_by(const ExactSolution& motion, const Grazing& grazing);

/// The start of a solution with other contact intervals, with the forces of the point.
CollocationIterate with_layout(const PathPoint& at, Layout layout);

}  // namespace wavebalance::solvers::detail
