#include "collocation/collocation_layout.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// A cubic on [0, 1] by its values and slopes at both ends.
struct Cubic {
  double a, b, c, d;  // a + b t + c t^2 + d t^3

  static Cubic between(double u0, double v0, double u1, double v1) {
    return {u0, v0, 3.0 * (u1 - u0) - 2.0 * v0 - v1, 2.0 * (u0 - u1) + v0 + v1};
  }
  double at(double t) const { return a + t * (b + t * (c + t * d)); }
  double slope(double t) const { return b + t * (2.0 * c + t * 3.0 * d); }
  // Where its slope vanishes in (0, 1), ascending.
  std::vector<double> extremes() const {
    std::vector<double> places;
    if (d == 0.0) {
      if (c != 0.0) places = {-b / (2.0 * c)};
    } else if (const double root = c * c - 3.0 * b * d; root > 0.0) {
      places = {(-c - std::sqrt(root)) / (3.0 * d), (-c + std::sqrt(root)) / (3.0 * d)};
      std::sort(places.begin(), places.end());
    }
    std::erase_if(places, [](double t) { return !(t > 0.0 && t < 1.0); });
    return places;
  }
  // Where a part that is monotone from t0 to t1 has a value between its ends.
  double root(double value, double t0, double t1) const {
    const bool rises = at(t1) > at(t0);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (t0 + t1);
      ((at(middle) < value) == rises ? t0 : t1) = middle;
    }
    return 0.5 * (t0 + t1);
  }
};

// A motion that is a cubic between samples at times l / N of displacements, m, and velocities, m per period.
struct SampledMotion {
  Eigen::RowVectorXd displacement, velocity;

  Index samples() const { return displacement.size(); }
  Cubic after(Index l) const {
    const double length = 1.0 / double(samples());
    const Index next = (l + 1) % samples();
    return Cubic::between(displacement[l], length * velocity[l], displacement[next], length * velocity[next]);
  }
};

// A passage with the pieces before and after it.
struct Step {
  double time;
  int from, to;
};

// The passages within one monotone part of the cubic, which ends at `end`.
void append_steps(std::vector<Step>& steps, const LawSegments& law, const Cubic& motion, double t0, double t1,
                  double end, double start, double length) {
  int piece = steps.back().to;
  const int last = law.piece_at(end);
  while (piece != last) {
    const int next = last > piece ? piece + 1 : piece - 1;
    const double breakpoint = law.breakpoint(std::min(piece, next));
    steps.push_back({start + length * motion.root(breakpoint, t0, t1), piece, next});
    piece = next;
  }
}

// From the piece at the beginning to itself, then by breakpoints.
std::vector<Step> steps_of(const LawSegments& law, const SampledMotion& motion) {
  const int first = law.piece_at(motion.displacement[0]);
  std::vector<Step> steps{{0.0, first, first}};
  const Index samples = motion.samples();
  const double length = 1.0 / double(samples);
  for (Index l = 0; l < samples; ++l) {
    const double start = length * double(l);
    const Cubic own = motion.after(l);
    double from = 0.0;
    for (const double extreme : own.extremes()) {
      append_steps(steps, law, own, from, extreme, own.at(extreme), start, length);
      from = extreme;
    }
    append_steps(steps, law, own, from, 1.0, motion.displacement[(l + 1) % samples], start, length);
  }
  return steps;
}

// At times from one passage to the next: whether the force vanishes though the contact is on a piece that
// exerts one. Its changes between samples are found by bisection.
class ForceAlong {
 public:
  ForceAlong(const LawSegments& law, double frequency, const SampledMotion& motion)
      : law_(law), frequency_(frequency), motion_(motion) {}

  int state(int piece, double time) const {
    const double samples = double(motion_.samples()), place = (time - std::floor(time)) * samples;
    const Index l = std::min(Index(place), motion_.samples() - 1);
    const Cubic own = motion_.after(l);
    const double t = place - double(l), velocity = frequency_ * samples * own.slope(t);
    return law_.vanishes(piece, own.at(t), velocity) ? law_.released(piece) : piece;
  }

  void append_changes(std::vector<Step>& steps, int piece, double begin, double end) const {
    const double samples = double(motion_.samples());
    for (double from = begin; from < end;) {
      const double to = std::min(end, (std::floor(from * samples + 1e-9) + 1.0) / samples);
      const int next = state(piece, to), now = steps.back().to;
      if (next != now) steps.push_back({change(piece, now, from, to), now, next});
      from = to;
    }
  }

 private:
  double change(int piece, int state_before, double before, double after) const {
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (before + after);
      (state(piece, middle) == state_before ? before : after) = middle;
    }
    return 0.5 * (before + after);
  }

  const LawSegments& law_;
  double frequency_;
  const SampledMotion& motion_;
};

// All passages of a contact, by time, with those at which its force vanishes; before them the state at the
// beginning.
std::vector<Step> all_steps_of(const LawSegments& law, double frequency, const SampledMotion& motion) {
  const std::vector<Step> by_piece = steps_of(law, motion);
  if (!law.may_vanish()) return by_piece;
  const ForceAlong force(law, frequency, motion);
  const int first = force.state(by_piece.front().to, 0.0);
  std::vector<Step> steps{{0.0, first, first}};
  for (std::size_t i = 0; i < by_piece.size(); ++i) {
    const int piece = by_piece[i].to;
    if (i > 0) steps.push_back({by_piece[i].time, steps.back().to, force.state(piece, by_piece[i].time)});
    force.append_changes(steps, piece, by_piece[i].time,
                         i + 1 < by_piece.size() ? by_piece[i + 1].time : 1.0);
  }
  return steps;
}

Passage passage_of(int contact, const LawSegments& law, const Step& step) {
  const int from = law.without_release(step.from), to = law.without_release(step.to);
  const bool leaves = law.jumps() && law.exerts(from) && !law.exerts(to);
  if (from == to) return {contact, step.time, no_breakpoint, true};
  return {contact, step.time, law.breakpoint(std::min(from, to)), leaves};
}

// From one instant to the next that follows it, in periods.
double interval(double from, double to) { return to - from - std::floor(to - from); }

// Leaves out what lasts less than `least` between two intervals on the same piece. Returns that piece if
// nothing else is left, and `piece_at_start` otherwise.
int join_over_short(std::vector<Step>& steps, double least, int piece_at_start) {
  for (std::size_t i = 0; i < steps.size();) {
    const std::size_t next = (i + 1) % steps.size();
    const int piece = steps[i].from;
    if (steps.size() < 2 || steps[next].to != piece || interval(steps[i].time, steps[next].time) >= least) {
      ++i;
      continue;
    }
    steps.erase(steps.begin() + Index(std::max(i, next)));
    steps.erase(steps.begin() + Index(std::min(i, next)));
    if (steps.empty()) return piece;
    i = 0;
  }
  return piece_at_start;
}

void append_exact(Layout& layout, int contact, const LawSegments& law, std::vector<Step> steps,
                  double least) {
  int piece_at_start = steps.front().to;
  steps.erase(steps.begin());
  std::erase_if(steps, [&](const Step& step) { return !law.acts(step.from) && !law.acts(step.to); });
  piece_at_start = join_over_short(steps, least, piece_at_start);
  if (steps.empty()) {
    if (law.acts(piece_at_start))
      layout.intervals.push_back({contact, piece_at_start, -1, -1, 1.0, {0.25, 0.5, 0.75}});
    return;
  }
  const int first = static_cast<int>(layout.passages.size());
  for (const Step& step : steps) layout.passages.push_back(passage_of(contact, law, step));
  const int count = static_cast<int>(steps.size());
  for (int i = 0; i < count; ++i) {
    const int piece = steps[static_cast<std::size_t>(i)].to;
    if (!law.acts(piece)) continue;
    const bool around = i + 1 == count;
    layout.intervals.push_back(
        {contact, piece, first + i, first + (around ? 0 : i + 1), around ? 1.0 : 0.0, {}});
  }
}

constexpr double together = 1e-12;  // periods: instants nearer to each other are one

// Simultaneous passages of different contacts are one boundary.
std::vector<double> boundaries_among(std::vector<double> times) {
  for (double& time : times) time -= std::floor(time);
  std::sort(times.begin(), times.end());
  const auto last =
      std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < together; });
  times.erase(last, times.end());
  if (times.size() > 1 && times.front() + 1.0 - times.back() < together) times.pop_back();
  return times;
}

}  // namespace

double Layout::begin(const LayoutInterval& interval) const {
  return interval.begin < 0 ? 0.0 : passages[static_cast<std::size_t>(interval.begin)].time;
}

double Layout::end(const LayoutInterval& interval) const {
  return interval.end < 0 ? 1.0 : passages[static_cast<std::size_t>(interval.end)].time + interval.turns;
}

CellGrid Layout::grid() const {
  std::vector<double> times;
  for (const Passage& passage : passages) times.push_back(passage.time);
  for (const LayoutInterval& interval : intervals) {
    const double from = begin(interval), length = end(interval) - from;
    if (interval.begin < 0) times.push_back(from);
    for (const double cut : interval.cuts) times.push_back(from + cut * length);
  }
  CellGrid grid{boundaries_among(std::move(times)), {}, {}};
  for (std::size_t p = 0; p < intervals.size(); ++p) {
    const LayoutInterval& interval = intervals[p];
    double time = begin(interval);
    int cell = grid.boundary_near(time);
    const int last = grid.boundary_near(end(interval));
    if (cell == last && end(interval) - time < 0.5) continue;  // without length
    std::vector<int> own_cuts{0};
    for (const double cut : interval.cuts)
      own_cuts.push_back(grid.boundary_near(begin(interval) + cut * (end(interval) - begin(interval))));
    bool meets = true;  // the panel before
    do {
      const double length = grid.length(cell);
      if (meets) {
        grid.panels.push_back({interval.contact, static_cast<int>(p), cell, time, time + length});
      } else {
        grid.panels.back().end = time + length;
        ++grid.panels.back().cells;
      }
      time += length;
      cell = grid.next(cell);
      meets = cut_by_others || std::find(own_cuts.begin(), own_cuts.end(), cell) != own_cuts.end();
    } while (cell != last);
  }
  for (std::size_t i = 0; i < passages.size(); ++i) {
    const auto number = static_cast<int>(i);
    const bool ends = std::any_of(intervals.begin(), intervals.end(),
                                  [&](const LayoutInterval&p) { return p.end == number; }),
               begins = std::any_of(intervals.begin(), intervals.end(),
                                    [&](const LayoutInterval&p) { return p.begin == number; });
    grid.marks.push_back({passages[i].contact, grid.boundary_near(passages[i].time), ends, begins});
  }
  return grid;
}

Eigen::MatrixXd periodic_slopes(const Eigen::MatrixXd& samples) {
  const Index count = samples.cols();
  Eigen::MatrixXd slopes(samples.rows(), count);
  const auto at = [&](Index l) { return samples.col((l % count + count) % count); };
  for (Index l = 0; l < count; ++l)
    slopes.col(l) = double(count) / 12.0 * (8.0 * (at(l + 1) - at(l - 1)) - (at(l + 2) - at(l - 2)));
  return slopes;
}

double Layout::shortest_interval() const {
  double shortest = 1.0;
  for (std::size_t i = 0; i < passages.size(); ++i)
    for (std::size_t j = 0; j < passages.size(); ++j)
      if (i != j && passages[i].contact == passages[j].contact)
        shortest = std::min(shortest, interval(passages[i].time, passages[j].time));
  return shortest;
}

Layout layout_of(const std::vector<LawSegments>& laws, double frequency, const Eigen::MatrixXd& displacement,
                 const Eigen::MatrixXd& velocity, double least) {
  Layout layout;
  for (Index c = 0; c < displacement.rows(); ++c) {
    const LawSegments& law = laws[static_cast<std::size_t>(c)];
    append_exact(layout, static_cast<int>(c), law,
                 all_steps_of(law, frequency, {displacement.row(c), velocity.row(c)}), least);
  }
  return layout;
}

bool same_intervals(const Layout& a, const Layout& b, int contact) {
  // Periods: far more than the error of a cubic between samples. A force may vanish slowly.
  constexpr double near = 1e-3, near_release = 1e-2;
  const auto close = [](double s, double t, bool released) {
    return std::abs(s - t - std::round(s - t)) < (released ? near_release : near);
  };
  const auto released = [&](int passage) {
    return passage >= 0 && a.passages[static_cast<std::size_t>(passage)].released;
  };
  const auto same_passage = [&](const Passage& p, const Passage& q) {
    return q.contact == p.contact && q.breakpoint == p.breakpoint && q.released == p.released &&
           close(q.time, p.time, p.released);
  };
  const auto same_interval = [&](const LayoutInterval& p, const LayoutInterval& q) {
    return q.contact == p.contact && q.piece == p.piece && (q.begin < 0) == (p.begin < 0) &&
           close(b.begin(q), a.begin(p), released(p.begin)) && close(b.end(q), a.end(p), released(p.end));
  };
  const auto all_have = [contact](const auto& from, const auto& among, const auto& same) {
    const auto of_contact = [contact](const auto& one) { return one.contact == contact; };
    if (std::count_if(from.begin(), from.end(), of_contact) !=
        std::count_if(among.begin(), among.end(), of_contact))
      return false;
    return std::all_of(from.begin(), from.end(), [&](const auto& one) {
      return one.contact != contact ||
             std::any_of(among.begin(), among.end(), [&](const auto& other) { return same(one, other); });
    });
  };
  return all_have(a.passages, b.passages, same_passage) && all_have(a.intervals, b.intervals, same_interval);
}

PanelForces::PanelForces(CellGrid grid, const LegendreNodes& nodes, const Eigen::VectorXd& values)
    : grid_(std::move(grid)),
      coefficients_(nodes.coefficients * values.reshaped(nodes.count(), Index(grid_.panels.size()))) {}

double PanelForces::value(std::size_t panel, double time) const {
  const Panel& at = grid_.panels[panel];
  const double x = 2.0 * (time - at.begin) / at.length() - 1.0;
  double before = 1.0, now = x, sum = coefficients_(0, Index(panel));
  for (Index k = 1; k < coefficients_.rows(); ++k) {
    sum += coefficients_(k, Index(panel)) * now;
    const double next = (double(2 * k + 1) * x * now - double(k) * before) / double(k + 1);
    before = now;
    now = next;
  }
  return sum;
}

// The panel of the interval that holds the time, or the one next to it.
std::size_t PanelForces::panel_of(int interval, double time) const {
  std::size_t nearest = grid_.panels.size();
  for (std::size_t p = 0; p < grid_.panels.size(); ++p) {
    if (grid_.panels[p].interval != interval) continue;
    if (nearest == grid_.panels.size() || time > grid_.panels[p].begin) nearest = p;
  }
  return nearest;
}

double PanelForces::in_interval(int interval, double time) const {
  const std::size_t panel = panel_of(interval, time);
  return panel == grid_.panels.size() ? 0.0 : value(panel, time);
}

double PanelForces::at(int contact, double time) const {
  constexpr double rounding = 1e-13;
  for (std::size_t p = 0; p < grid_.panels.size(); ++p) {
    if (grid_.panels[p].contact != contact) continue;
    const double after = time - grid_.panels[p].begin - std::floor(time - grid_.panels[p].begin + rounding);
    if (after <= grid_.panels[p].length() + rounding) return value(p, grid_.panels[p].begin + after);
  }
  return 0.0;
}

}  // namespace wavebalance::solvers::detail
