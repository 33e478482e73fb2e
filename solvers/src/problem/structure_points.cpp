#include "wavebalance/solvers/problem/structure_points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "problem/structure_curve.hpp"
#include "problem/thread_problems.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::solvers {
namespace {

using detail::OnSegment, detail::CurveSegment;

// The events of all segments, each once, and the corresponding bifurcation and grazing points of the
// balance.
class Assembly {
 public:
  Assembly(const std::vector<SpecialPoint>& points, const detail::CurveDistance& distance)
      : points_(points), distance_(distance) {
    result_.of_balance.resize(points.size());
  }

  /// Points farther apart than `farthest` are not the same. In a part of a segment only found points count.
  void add(const CurveSegment& stretch, OnSegment found, double farthest, bool part = false) {
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
      const NearStructurePoint one = near(i, numbers, farthest, known);
      if (!part || one.status == StructurePointStatus::repeated) result_.of_balance[i] = one;
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
    const ExactEvent& there = result_.events[event];
    return distance_.between(points_[point], there.value,
                             there.motion.displacement(detail::comparison_times()).cwiseAbs().maxCoeff());
  }

  std::size_t number_of(ExactEvent event) {
    const auto same = std::find_if(result_.events.begin(), result_.events.end(),
                                   [&](const ExactEvent& other) { return detail::is_same(event, other); });
    const auto number = static_cast<std::size_t>(same - result_.events.begin());
    if (same == result_.events.end()) result_.events.push_back(std::move(event));
    return number;
  }

  NearStructurePoint near(std::size_t point, const std::vector<std::size_t>& events, double farthest,
                          bool known) const {
    const std::size_t* best = nullptr;
    for (const std::size_t& event : events)
      if (result_.events[event].type == points_[point].type && distance(point, event) <= farthest &&
          (best == nullptr || distance(point, event) < distance(point, *best)))
        best = &event;
    if (best != nullptr) return {StructurePointStatus::repeated, *best};
    return {known ? StructurePointStatus::none : StructurePointStatus::not_known, 0};
  }

  const std::vector<SpecialPoint>& points_;
  const detail::CurveDistance& distance_;
  StructurePoints result_;
};

constexpr double share_of_whole = 0.25;  // of the operations; stretches have the rest

// One for each stretch; not all of them where the observer returns false.
std::vector<OnSegment> along_all(const std::vector<CurveSegment>& stretches,
                                 std::vector<ContactProblem>& problems, const FrequencySweep& curve,
                                 const StructurePointsOptions& options, detail::PlacesProgress& progress) {
  OnSegment stopped;  // before it was followed
  stopped.cancelled = true;
  std::vector<OnSegment> found(stretches.size(), stopped);
  const double curves = 2.0 * double(stretches.size());
  const detail::CurveEffort effort{options.max_points / curves,
                                   (1.0 - share_of_whole) * options.max_operations / curves};
  detail::at_places(problems, stretches.size(), progress,
                    [&](ContactProblem& problem, std::size_t i, const Observer& observer) {
                      found[i] = detail::structure_along(problem, curve, stretches[i], false, options, effort,
                                                         observer);
                      return std::nullopt;
                    });
  return found;
}

// All points of the curve, and all its bifurcation and grazing points.
CurveSegment all_of(const FrequencySweep& curve, const std::vector<SpecialPoint>& points) {
  CurveSegment all{0, curve.points.size() - 1, std::vector<std::size_t>(points.size())};
  std::iota(all.points.begin(), all.points.end(), std::size_t{0});
  return all;
}

// Along the whole curve at once.
OnSegment along_whole(ContactProblem& problem, const FrequencySweep& curve, const CurveSegment& all,
                      const StructurePointsOptions& options, detail::PlacesProgress& progress) {
  const double low = std::min(options.from, options.to), length = std::abs(options.to - options.from);
  const Observer observer = [&](const Progress& within) {
    return progress.tell(within.value, 0, std::clamp((within.value - low) / length, 0.0, 1.0));
  };
  // From the first point and from the last one.
  const detail::CurveEffort effort{double(options.max_points), 0.5 * share_of_whole * options.max_operations};
  return detail::structure_along(problem, curve, all, true, options, effort, observer);
}

// The folds that the balance's curve passes by.
std::vector<std::size_t> passed_by(ContactProblem& problem, const FrequencySweep& curve,
                                   const StructurePoints& found, double scale, double reach) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < found.events.size(); ++i) {
    const bool of_balance = std::any_of(
        found.of_balance.begin(), found.of_balance.end(),
        [i](const auto& near) { return near.status == StructurePointStatus::found && near.event == i; });
    if (found.events[i].type == SpecialPointType::fold && !of_balance &&
        !detail::lies_on(problem, curve, found.events[i], scale, reach))
      numbers.push_back(i);
  }
  return numbers;
}

StructurePoints of_whole(ContactProblem& problem, const FrequencySweep& curve, const CurveSegment& all,
                         OnSegment found, Assembly assembly, const StructurePointsOptions& options) {
  const bool apart = found.apart;
  assembly.add(all, std::move(found), options.reach);
  StructurePoints result = assembly.finished();
  result.whole = true;
  result.apart = apart;
  result.passed_by = passed_by(problem, curve, result, detail::unit_of_parameter(options), options.reach);
  return result;
}

StructurePoints of_stretches(const ProblemMaker& make, const FrequencySweep& curve,
                             const std::vector<CurveSegment>& stretches, Assembly assembly,
                             const StructurePointsOptions& options, detail::PlacesProgress& progress) {
  constexpr std::size_t places_worth = 4;  // a stretch is worth another problem
  if (stretches.empty()) return assembly.finished();
  std::vector<ContactProblem> problems =
      detail::thread_problems(make, places_worth * stretches.size(), options.threads);
  std::vector<OnSegment> found = along_all(stretches, problems, curve, options, progress);
  for (std::size_t i = 0; i < stretches.size(); ++i)
    assembly.add(stretches[i], std::move(found[i]), std::numeric_limits<double>::infinity());
  return assembly.finished();
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
  exact.validate();
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
  const detail::CurveDistance distance(curve, detail::unit_of_parameter(options));
  Assembly assembly(points, distance);
  ContactProblem problem = make();
  if (curve.points.empty() || problem.dynamics() == nullptr) return assembly.finished();
  detail::PlacesProgress progress(options.observer, "special points",
                                  unit_of(problem.condensed(), curve.parameter));
  const CurveSegment all = all_of(curve, points);
  OnSegment along = along_whole(problem, curve, all, options, progress);
  StructurePoints result;
  if (along.complete) {
    result = of_whole(problem, curve, all, std::move(along), std::move(assembly), options);
  } else {
    const bool grazings = !along.exhausted;  // else they would cost more than the curve of the balance
    if (along.exhausted) assembly.add(all, std::move(along), options.reach, true);
    result = of_stretches(
        make, curve,
        detail::segments_about(curve, points, distance, options.reach, options.max_segments, grazings),
        std::move(assembly), options, progress);
  }
  result.cancelled = progress.cancelled();
  return result;
}

}  // namespace wavebalance::solvers
