#include "exact/grazing.hpp"

#include <algorithm>
#include <cmath>

#include "collocation/exact_solution_parts.hpp"
#include "linalg/index.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Numbers of the passages of a contact, in the order of its intervals around the period.
std::vector<int> passages_of(const Layout& layout, int contact) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < layout.passages.size(); ++i)
    if (layout.passages[i].contact == contact) numbers.push_back(static_cast<int>(i));
  return numbers;
}

int contacts_of(const Layout& layout) {
  int count = 0;
  for (const Passage& passage : layout.passages) count = std::max(count, passage.contact + 1);
  return count;
}

Passage& passage(Layout& layout, int number) { return layout.passages[static_cast<std::size_t>(number)]; }

const Passage& passage(const Layout& layout, int number) {
  return layout.passages[static_cast<std::size_t>(number)];
}

// The contact intervals on both sides of a gap become one; where they are the same, one that lasts the
// period.
void join(std::vector<LayoutInterval>& intervals, const Interval& interval) {
  const auto before = std::find_if(intervals.begin(), intervals.end(),
                                   [&](const LayoutInterval& p) { return p.end == interval.from; });
  const auto after = std::find_if(intervals.begin(), intervals.end(),
                                  [&](const LayoutInterval& p) { return p.begin == interval.to; });
  if (before == intervals.end() || after == intervals.end()) return;
  if (before == after) {
    *before = {before->contact, before->piece, -1, -1, 1.0, {0.25, 0.5, 0.75}};
    return;
  }
  before->end = after->end;
  before->cuts.clear();
  intervals.erase(after);
}

// The whole turns that bring the end of each interval behind its begin.
void set_turns(Layout& layout) {
  for (LayoutInterval& part : layout.intervals) {
    if (part.begin < 0) continue;
    const double length = passage(layout, part.end).time - passage(layout, part.begin).time;
    part.turns = 1.0 - std::ceil(length);
    if (length + part.turns <= 0.0) part.turns += 1.0;
  }
}

void erase_passage(Layout& layout, int number) {
  layout.passages.erase(layout.passages.begin() + number);
  for (LayoutInterval& part : layout.intervals) {
    if (part.begin > number) --part.begin;
    if (part.end > number) --part.end;
  }
}

// Whether a contact on a piece that begins there ends with its force, before it leaves the piece.
bool ends_with_force(const Layout& layout, int from, int to) {
  const auto begins = [&](const LayoutInterval& part) { return part.begin == to; };
  return passage(layout, to).breakpoint == no_breakpoint && !passage(layout, from).released &&
         std::none_of(layout.intervals.begin(), layout.intervals.end(), begins);
}

}  // namespace

std::vector<Interval> intervals_of(const Layout& layout) {
  std::vector<Interval> intervals;
  for (int c = 0; c < contacts_of(layout); ++c) {
    const std::vector<int> numbers = passages_of(layout, c);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const bool last = i + 1 == numbers.size();
      const int from = numbers[i], to = numbers[last ? 0 : i + 1];
      const Passage &a = passage(layout, from), &b = passage(layout, to);
      const bool passes = a.breakpoint == b.breakpoint && !a.released && !b.released && from != to;
      if (!passes && !ends_with_force(layout, from, to)) continue;
      intervals.push_back({c, from, to, a.time, b.time - a.time + (last ? 1.0 : 0.0)});
    }
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.length < b.length; });
  return intervals;
}

double growth(const PathPoint& at, const Interval& interval) {
  return at.motion_of(interval.to) - at.motion_of(interval.from);
}

Layout with_cuts_of(const Layout& other, Layout layout) {
  constexpr double least = 1e-3;  // of an interval, between cuts
  for (LayoutInterval& part : layout.intervals) {
    const double begin = layout.begin(part), length = layout.end(part) - begin;
    const auto add = [&](double time) {
      const double share = (time - std::floor(time - begin) - begin) / length;
      const bool apart = std::none_of(part.cuts.begin(), part.cuts.end(),
                                      [&](double cut) { return std::abs(cut - share) < least; });
      if (share > least && share < 1.0 - least && apart) part.cuts.push_back(share);
    };
    for (const LayoutInterval& one : other.intervals)
      if (one.contact == part.contact && one.piece == part.piece)
        for (const double cut : one.cuts) add(other.begin(one) + cut * (other.end(one) - other.begin(one)));
    std::sort(part.cuts.begin(), part.cuts.end());
  }
  return layout;
}

Layout without(Layout layout, std::vector<Interval> intervals) {
  const Layout before = layout;
  std::vector<int> numbers;
  for (const Interval& interval : intervals) {
    std::erase_if(layout.intervals, [&](const LayoutInterval& part) {
      return part.begin == interval.from && part.end == interval.to;
    });
    join(layout.intervals, interval);
    numbers.push_back(interval.from);
    numbers.push_back(interval.to);
  }
  std::sort(numbers.rbegin(), numbers.rend());
  for (const int number : numbers) erase_passage(layout, number);
  set_turns(layout);
  return with_cuts_of(before, std::move(layout));
}

Grazing grazing_of(const PathPoint& at, const Layout& layout, const Interval& interval) {
  const double middle = interval.begin + 0.5 * interval.length;
  const double there = at.motion.displacement(Eigen::VectorXd::Constant(1, middle))(interval.contact, 0);
  const double breakpoint = passage(layout, interval.from).breakpoint;
  return {interval.contact, breakpoint, middle, interval.length, there > breakpoint};
}

double passed_by(const ExactSolution& motion, const Grazing& grazing) {
  constexpr double least = 1e-3, most = 0.1;
  const auto velocity = [&](double time) {
    return motion.velocity(Eigen::VectorXd::Constant(1, time))(grazing.contact, 0);
  };
  for (double width = std::max(least, grazing.width); width < most; width *= 2.0) {
    const double from = grazing.time - width, to = grazing.time + width;
    const std::optional<double> time = root(velocity, {from, velocity(from)}, {to, velocity(to)}, 1e-13);
    if (!time) continue;
    const double extremum = motion.displacement(Eigen::VectorXd::Constant(1, *time))(grazing.contact, 0);
    return grazing.above ? extremum - grazing.breakpoint : grazing.breakpoint - extremum;
  }
  return missing;
}

CollocationIterate with_layout(const PathPoint& at, Layout layout) {
  const PanelForces& old = at.iterate.forces;
  const LegendreNodes nodes(std::max<Index>(4, old.coefficients().rows()));
  return with_forces(std::move(layout), nodes,
                     [&](const Panel& panel, double time) { return old.at(panel.contact, time); });
}

}  // namespace wavebalance::solvers::detail
