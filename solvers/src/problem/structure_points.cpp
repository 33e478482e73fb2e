#include "wavebalance/solvers/problem/structure_points.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>

#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "problem/curve_stretches.hpp"
#include "problem/thread_problems.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::solvers {
namespace {

using detail::Stretch;

const Eigen::VectorXd& comparison_times() {
  static const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(64, 0.0, 1.0 - 1.0 / 64.0);
  return times;
}

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / std::max(b.norm(), 1e-300);
}

// The same point, followed from elsewhere.
bool is_same(const ExactEvent& a, const ExactEvent& b) {
  constexpr double of_value = 1e-7, of_motion = 1e-2;
  return a.type == b.type && std::abs(a.value - b.value) <= of_value * std::abs(b.value) &&
         relative_difference(a.motion.displacement(comparison_times()),
                             b.motion.displacement(comparison_times())) <= of_motion;
}

// Whether the curve has a motion at this value between two of its points, to first order.
bool passes(const ExactCurve& curve, double value, const PhaseMotion& motion) {
  constexpr double near = 0.05;
  const Eigen::MatrixXd there = motion.displacement(comparison_times());
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    const ExactPoint &a = curve.points[i], &b = curve.points[i + 1];
    if ((a.value - value) * (b.value - value) > 0.0 || a.value == b.value) continue;
    const double share = (value - a.value) / (b.value - a.value);
    const Eigen::MatrixXd between = (1.0 - share) * a.motion.displacement(comparison_times()) +
                                    share * b.motion.displacement(comparison_times());
    if (relative_difference(between, there) < near) return true;
  }
  return false;
}

bool has_multipliers(const ExactCurve& curve) {
  return std::all_of(curve.points.begin(), curve.points.end(),
                     [](const ExactPoint& point) { return point.unstable >= 0; });
}

bool left_its_interval(const ExactCurve& curve) {
  return curve.status == SweepStatus::reached_end || curve.status == SweepStatus::returned;
}

// A motion of the structure from which a stretch is followed.
struct StretchStart {
  double value = 0.0, direction = 1.0;
  PhaseMotion motion;  // not converged where none was found

  bool exists() const { return motion.converged(); }
};

// What was found along one stretch.
struct OnStretch {
  std::vector<ExactEvent> events;
  bool complete = false, with_multipliers = false, cancelled = false;

  void add(std::vector<ExactEvent> more, bool from_behind) {
    std::erase_if(more, [&](const ExactEvent& one) {
      return std::any_of(events.begin(), events.end(),
                         [&](const auto& other) { return is_same(one, other); });
    });
    if (from_behind) std::reverse(more.begin(), more.end());
    std::move(more.begin(), more.end(), std::back_inserter(events));
  }
};

// Follows the curve of the structure along stretches of that of a balance.
class StretchFollower {
 public:
  StretchFollower(ContactProblem& problem, const FrequencySweep& curve, const StructurePointsOptions& options,
                  std::size_t stretches, Observer observer)
      : problem_(problem),
        curve_(curve),
        options_(options),
        observer_(std::move(observer)),
        curves_(2.0 * double(stretches)) {}

  OnStretch along(const Stretch& stretch) const {
    OnStretch result;
    const StretchStart start = start_of(stretch, true);
    const ExactCurve forwards = followed(stretch, start);
    result.add(forwards.events, false);
    result.cancelled = forwards.status == SweepStatus::cancelled;
    result.with_multipliers = !forwards.points.empty() && has_multipliers(forwards);
    if (result.cancelled) return result;
    const StretchStart end = start_of(stretch, false);
    if (end.exists() && passes(forwards, end.value, end.motion)) {
      result.complete = true;
      return result;
    }
    const ExactCurve backwards = followed(stretch, end);
    result.add(backwards.events, true);
    result.cancelled = backwards.status == SweepStatus::cancelled;
    result.with_multipliers = result.with_multipliers && has_multipliers(backwards);
    result.complete =
        left_its_interval(backwards) &&
        (left_its_interval(forwards) || (start.exists() && passes(backwards, start.value, start.motion)));
    return result;
  }

 private:
  double scale() const { return std::abs(options_.to - options_.from) / 20.0; }

  // The motion near the first point of the curve from an end of the stretch outwards that has one: near a
  // fold several points lie beyond that of the structure.
  StretchStart start_of(const Stretch& stretch, bool forwards) const {
    constexpr double clear = 0.02;  // of a step beside zigzags of the samples
    CurvePhasesOptions near;
    near.phases = options_.phases;
    near.max_distance = options_.max_distance;
    StretchStart start;
    for (const std::size_t steps : {0, 1, 3, 6}) {
      if (forwards ? stretch.first < steps : stretch.last + steps >= curve_.points.size()) break;
      const std::size_t at = forwards ? stretch.first - steps : stretch.last + steps;
      start.value = parameter_of(curve_.points[at], curve_.parameter);
      start.direction = detail::direction_from(curve_, at, forwards, clear * scale());
      const PeriodicResponse response = problem_.response(curve_, start.value, curve_.points[at].unknown);
      start.motion = near_phases(problem_, response, near).value().motion;
      if (start.motion.status != PhasesStatus::no_motion_near) break;  // elsewhere it takes as much
    }
    return start;
  }

  // So many motions of this size as the work allows.
  int most_points(const PhaseMotion& motion) const {
    constexpr double of_motion = 8.0, of_multipliers = 25.0;
    const double n = motion.unknowns, s = double(problem_.dynamics()->poles().size()),
                 one = of_motion * n * n * (n / 1.5 + 4.0 * s) + of_multipliers * s * s * s + 1.0;
    return static_cast<int>(std::min(options_.max_points / curves_, options_.max_operations / curves_ / one));
  }

  ExactCurve followed(const Stretch& stretch, const StretchStart& start) const {
    constexpr int fewest = 8;
    if (!start.exists() || most_points(start.motion) < fewest) return {};
    ExactCurveOptions options = interval(stretch, start);
    if (options.to == start.value) return {};
    options.parameter_scale = scale();
    options.first_step = options_.first_step;
    options.largest_step = options_.largest_step;
    options.max_points = most_points(start.motion);
    options.phases = options_.phases;
    options.observer = observer_;
    const PhaseFamily family(problem_.condensed(), problem_.laws(), *problem_.dynamics(), curve_.parameter);
    return exact_curve(family, start.motion, options);
  }

  // A little wider than the stretch, since the structure's folds lie beside those of the balance.
  ExactCurveOptions interval(const Stretch& stretch, const StretchStart& start) const {
    const auto [low, high] = detail::values_on(curve_, stretch.first, stretch.last);
    const double margin = std::max(high - low, scale());
    const double lowest = std::max(std::min(options_.from, options_.to), std::min(low, start.value) - margin),
                 highest =
                     std::min(std::max(options_.from, options_.to), std::max(high, start.value) + margin);
    ExactCurveOptions options;
    options.from = start.value;
    options.to = start.direction > 0.0 ? highest : lowest;
    options.behind = start.direction > 0.0 ? lowest : highest;
    return options;
  }

  ContactProblem& problem_;
  const FrequencySweep& curve_;
  const StructurePointsOptions& options_;
  Observer observer_;
  double curves_;
};

// The events of all stretches, each once, and beside them the special points of the balance.
class Assembly {
 public:
  Assembly(const std::vector<SpecialPoint>& points, SweepParameter parameter)
      : points_(points), parameter_(parameter) {
    result_.of_balance.resize(points.size());
  }

  void add(const Stretch& stretch, OnStretch found) {
    std::vector<std::size_t> numbers;
    for (ExactEvent& event : found.events) {
      event.next_point = stretch.first;
      numbers.push_back(number_of(std::move(event)));
    }
    if (found.cancelled) return;
    for (const std::size_t i : stretch.points) {
      const bool by_multipliers =
          points_[i].type != SpecialPointType::grazing && points_[i].type != SpecialPointType::fold;
      const bool known = found.complete && (found.with_multipliers || !by_multipliers);
      result_.of_balance[i] = near(i, numbers, known);
    }
  }

  StructurePoints finished() {
    for (std::size_t event = 0; event < result_.events.size(); ++event) {
      NearStructurePoint* nearest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < points_.size(); ++i) {
        NearStructurePoint& one = result_.of_balance[i];
        if (one.status != StructurePointStatus::repeated || one.event != event) continue;
        if (distance(i, event) >= least) continue;
        least = distance(i, event);
        nearest = &one;
      }
      if (nearest != nullptr) nearest->status = StructurePointStatus::found;
    }
    return std::move(result_);
  }

 private:
  double distance(std::size_t point, std::size_t event) const {
    return std::abs(parameter_of(points_[point], parameter_) - result_.events[event].value);
  }

  std::size_t number_of(ExactEvent event) {
    const auto same = std::find_if(result_.events.begin(), result_.events.end(),
                                   [&](const ExactEvent& other) { return is_same(event, other); });
    const auto number = static_cast<std::size_t>(same - result_.events.begin());
    if (same == result_.events.end()) result_.events.push_back(std::move(event));
    return number;
  }

  NearStructurePoint near(std::size_t point, const std::vector<std::size_t>& events, bool known) const {
    const std::size_t* best = nullptr;
    for (const std::size_t& event : events)
      if (result_.events[event].type == points_[point].type &&
          (best == nullptr || distance(point, event) < distance(point, *best)))
        best = &event;
    if (best != nullptr) return {StructurePointStatus::repeated, *best};
    return {known ? StructurePointStatus::none : StructurePointStatus::not_known, 0};
  }

  const std::vector<SpecialPoint>& points_;
  SweepParameter parameter_;
  StructurePoints result_;
};

// One for each stretch; not all of them where the observer returns false.
std::vector<OnStretch> along_all(const std::vector<Stretch>& stretches, std::vector<ContactProblem>& problems,
                                 const FrequencySweep& curve, const StructurePointsOptions& options) {
  std::vector<OnStretch> found(stretches.size());
  const std::string_view unit = unit_of(problems.front().condensed(), curve.parameter);
  std::atomic<int> done{0};
  std::atomic<bool> cancelled{false};
  const auto tell = [&](double value) {
    const int count = done;
    if (!cancelled && !goes_on(options.observer, {"special points", count, value, unit,
                                                  double(count) / double(stretches.size())}))
      cancelled = true;
    return !cancelled;
  };
  const auto work = [&](int worker, Eigen::Index index) {
    const auto i = static_cast<std::size_t>(index);
    const Observer observer = [&tell, &cancelled, worker](const Progress& progress) {
      return worker == 0 ? tell(progress.value) : !cancelled;
    };
    ContactProblem& problem = problems[static_cast<std::size_t>(worker)];
    found[i].cancelled = cancelled;
    if (cancelled) return;
    found[i] = StretchFollower(problem, curve, options, stretches.size(), observer).along(stretches[i]);
    ++done;
  };
  parallel_for(static_cast<int>(problems.size()), static_cast<Eigen::Index>(stretches.size()), work,
               [&] { tell(missing); });
  return found;
}

}  // namespace

std::string_view to_string(StructurePointStatus status) {
  using enum StructurePointStatus;
  return detail::name_in<StructurePointStatus>({{found, "found"},
                                                {repeated, "repeated"},
                                                {none, "none"},
                                                {not_known, "not_known"},
                                                {not_sought, "not_sought"}},
                                               status);
}

void StructurePointsOptions::validate() const {
  phases.validate();
  detail::require_positive("structure_points", "from", from);
  detail::require_positive("structure_points", "to", to);
  detail::require_positive("structure_points", "reach", reach);
  detail::require_at_least("structure_points", "max_points", max_points, 1);
  detail::require_positive("structure_points", "max_operations", max_operations);
  detail::require_positive("structure_points", "max_distance", max_distance);
  thread_count(threads);
}

StructurePoints structure_points(const ProblemMaker& make, const FrequencySweep& curve,
                                 const std::vector<SpecialPoint>& points,
                                 const StructurePointsOptions& options) {
  options.validate();
  Assembly assembly(points, curve.parameter);
  if (points.empty()) return assembly.finished();
  const detail::CurveDistance distance(curve, std::abs(options.to - options.from) / 20.0);
  const std::vector<Stretch> stretches =
      detail::stretches_about(curve, points, distance, options.reach, options.max_stretches);
  constexpr std::size_t places_worth = 4;  // a stretch is worth another problem
  std::vector<ContactProblem> problems =
      detail::thread_problems(make, places_worth * stretches.size(), options.threads);
  if (problems.front().dynamics() == nullptr) return assembly.finished();
  std::vector<OnStretch> found = along_all(stretches, problems, curve, options);
  bool cancelled = false;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    cancelled = cancelled || found[i].cancelled;
    assembly.add(stretches[i], std::move(found[i]));
  }
  StructurePoints result = assembly.finished();
  result.cancelled = cancelled;
  return result;
}

}  // namespace wavebalance::solvers
