#include "wavebalance/solvers/branches/branches.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "branches/branch_arrival.hpp"
#include "branches/perturbation.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

class Branches {
 public:
  Branches(const BranchProblems& problems, const ContactLaws& laws, DynamicsAlong dynamics,
           const BranchOptions& options)
      : problems_(problems),
        laws_(laws),
        dynamics_(std::move(dynamics)),
        options_(options),
        load_periods_(options.load_periods) {}

  std::vector<Branch> run(const FrequencySweep& main, const CurveStability& stability) {
    main_ = &main;
    branches_.reserve(std::size_t(options_.max_branches));  // parents point at them
    follow_all_of({0, 1, &main, &stability});
    for (std::size_t i = 0; i < branches_.size() && !cancelled_; ++i) {
      const Branch& branch = branches_[i];
      follow_all_of({int(i) + 1, branch.periods, &branch.curve, &branch.stability});
    }
    return std::move(branches_);
  }

 private:
  void follow_all_of(const Parent& parent) {
    std::vector<bool> arrived(parent.special_points().size(), false);
    for (std::size_t i = 0; i < parent.special_points().size(); ++i) {
      if (arrived[i] || cancelled_) continue;
      for (const double side : sides_of(parent, parent.special_points()[i])) {
        if (branches_.size() == std::size_t(options_.max_branches)) return;
        branches_.push_back(follow(parent, int(i), side));
        cancelled_ = branches_.back().end == BranchEnd::cancelled;
        const int end_point = branches_.back().end_point;
        if (end_point >= 0) arrived[std::size_t(end_point)] = true;
      }
    }
  }

  std::vector<double> sides_of(const Parent& parent, const SpecialPoint& point) const {
    // Branch points of a branch are mostly crossings with curves that are followed already.
    if (point.type == SpecialPointType::branch && point.located && parent.index == 0) return {1.0, -1.0};
    const bool doubles =
        point.type == SpecialPointType::period_doubling && 2 * parent.periods <= options_.largest_period;
    return doubles ? std::vector<double>{1.0} : std::vector<double>{};
  }

  Branch follow(const Parent& parent, int special_point, double side) {
    const SpecialPoint& from = parent.special_points()[std::size_t(special_point)];
    const int times = from.type == SpecialPointType::period_doubling ? 2 : 1;
    Branch branch;
    branch.parent = parent.index;
    branch.special_point = special_point;
    branch.periods = times * parent.periods;
    CondensedProblem problem = problem_of(branch.periods);
    if (problem.samples() != times * from.unknown.size())
      throw std::invalid_argument("follow_branches: the problem of " + std::to_string(branch.periods) +
                                  " periods has " + std::to_string(problem.samples()) +
                                  " samples; expected " + std::to_string(times * from.unknown.size()));
    FrequencySweepOptions sweep = sweep_options(branch.periods);
    const Scales scales{scale_of(from), sweep.arc_length.parameter_scale};
    sweep.arc_length.displacement_scale = scales.displacement;  // where they end is measured by it
    SweepStart start;
    hold(problem, from);
    if (!begin(parent, from, times, side, problem, scales, start)) return branch;
    trace(parent, problem, sweep, scales, std::move(start), branch);
    return branch;
  }

  CondensedProblem problem_of(int periods) const {
    CondensedProblem problem = problems_(periods);
    problem.set_periods(periods * load_periods_);
    return problem;
  }

  // Other parameters keep their values along the curves.
  void hold(CondensedProblem& problem, const SpecialPoint& at) const {
    const bool scaled = main_->parameter == SweepParameter::load_scale;
    problem.set_load_scale(scaled ? at.load_scale : main_->points.front().load_scale);
    problem.set_load_frequency(at.frequency);
  }

  double place_of(const SpecialPoint& at) const { return parameter_of(at, main_->parameter); }

  double scale_of(const SpecialPoint& from) const {
    const double given = options_.sweep.arc_length.displacement_scale, gap = laws_.largest_gap();
    return given > 0.0 ? given : gap > 0.0 ? gap : std::max(from.max_abs_displacement, 1e-300);
  }

  FrequencySweepOptions sweep_options(int periods) const {
    FrequencySweepOptions sweep = options_.sweep;
    auto& scale = sweep.arc_length.parameter_scale;
    if (scale == 0.0) scale = std::abs(sweep.to - sweep.from) / 20.0;
    sweep.output_points *= periods;
    sweep.keep_unknowns = true;
    sweep.observer = options_.observer;
    return sweep;
  }

  // The direction of the branch in the unknown of a problem with this pair; empty where the perturbation was
  // not found.
  Eigen::VectorXd direction(const Parent& parent, const SpecialPoint& from, int times, const TimePair& pair) {
    CondensedProblem before = problem_of(parent.periods);
    hold(before, from);
    ContactSystem system(before, laws_, parent.curve->series_flexibility);
    FloquetOptions how;
    how.stability = options_.stability.stability;
    const double due = times == 2 ? -1.0 : 1.0;
    const FloquetExponent* nearest = nullptr;
    const FloquetExponents found = floquet_exponents(*dynamics_.at(before.structure()), before, laws_,
                                                     response_at(system, from.unknown), how);
    for (const FloquetExponent& one : found.values)
      if (!nearest || std::abs(one.multiplier - due) < std::abs(nearest->multiplier - due)) nearest = &one;
    if (!nearest || !(std::abs(nearest->multiplier - due) < 0.1)) return {};
    FloquetExponent exact = *nearest;
    exact.multiplier = due;
    return perturbation(exact, times, pair).unknown(parent.curve->series_flexibility);
  }

  // The first point of a branch: a small multiple of the direction away from the bifurcation or grazing
  // point, and on the curve.
  bool begin(const Parent& parent, const SpecialPoint& from, int times, double side,
             CondensedProblem& problem, const Scales& scales, SweepStart& start) {
    const Eigen::VectorXd way = side * direction(parent, from, times, problem.pair());
    if (way.size() != problem.samples()) return false;
    ContactSystem system(problem, laws_, parent.curve->series_flexibility);
    const CurvePoint origin = curve_point(repeated(from.unknown, problem.contacts(), times), place_of(from));
    const double rms = origin.displacement.norm() / std::sqrt(double(origin.displacement.size()));
    for (const double size : {0.01, 0.03, 0.1}) {
      auto first = motion_beside(system, origin, size * rms * way, scales, main_->parameter);
      if (!first) continue;
      const bool scaled = main_->parameter == SweepParameter::load_scale;
      const CurvePoint place =
          curve_point(first->response.unknown, scaled ? problem.load_scale() : problem.load_frequency());
      if (times == 1 && lies_on(*parent.curve, origin, place, scales)) continue;
      start = *std::move(first);
      start.direction = way;
      return true;
    }
    return false;
  }

  void trace(const Parent& parent, CondensedProblem& problem, const FrequencySweepOptions& sweep,
             const Scales& scales, SweepStart start, Branch& branch) {
    Arrival arrival(parent, branch.special_point, problem.contacts(), scales);
    start.ends = [&](const CurvePoint& before, const CurvePoint& after) { return arrival(before, after); };
    const bool scaled = main_->parameter == SweepParameter::load_scale;
    branch.curve = scaled ? amplitude_sweep(problem, laws_, sweep, start)
                          : frequency_sweep(problem, laws_, sweep, start);
    branch.end = end_of(branch.curve.status);
    if (branch.curve.points.empty()) return;
    const SweepPoint& end = branch.curve.points.back();
    const CurvePoint last = curve_point(end.unknown, parameter_of(end, main_->parameter));
    if (branch.end == BranchEnd::lost && arrival.is_beside(last)) branch.end = BranchEnd::special_point;
    if (branch.end == BranchEnd::special_point) {
      arrival.note_nearest(last, 2.0 * std::max(arrival.step(), sweep.arc_length.max_step));
      branch.end_point = arrival.end_point();
      if (branch.end_point < 0) branch.end = BranchEnd::parent_curve;
    }
    CurveStabilityOptions stability = options_.stability;
    stability.observer = options_.observer;
    stability.output_points *= branch.periods;
    branch.stability = curve_stability(problem, laws_, branch.curve, dynamics_, stability);
    if (branch.stability.cancelled) branch.end = BranchEnd::cancelled;
    if (branch.end == BranchEnd::cancelled) return;
    if (branch.periods > parent.periods) leave_out_parent(problem.contacts(), branch);
    add_ends(parent, problem, branch);
  }

  // Near a period doubling a multiplier of the doubled motion is near 1. If it passes 1 there, the
  // discretisation has the doubling of the curve and of the multiplier at slightly different places. This
  // is neither a fold nor a branch point, and the count of the points beyond applies.
  static void leave_out_parent(int contacts, Branch& branch) {
    constexpr double beside = 0.03, beside_unlocated = 0.06;
    const auto content = [&](const auto& point) { return alternating_share(point.unknown, contacts); };
    const auto is_beside = [&](const auto& point) { return content(point) < beside; };
    const auto removed = std::erase_if(branch.stability.special_points, [&](const SpecialPoint& point) {
      if (point.type != SpecialPointType::fold && point.type != SpecialPointType::branch) return false;
      if (!point.located) return content(point) < beside_unlocated;
      return point.type == SpecialPointType::branch && is_beside(point);
    });
    if (removed == 0) return;
    const auto& curve = branch.curve.points;
    auto& counts = branch.stability.points;
    std::size_t first = 0, last = curve.size() - 1;
    while (first < last && is_beside(curve[first])) ++first;
    while (last > first && is_beside(curve[last])) --last;
    for (std::size_t i = 0; i < first; ++i) counts[i].unstable = counts[first].unstable;
    for (std::size_t i = last + 1; i < curve.size(); ++i) counts[i].unstable = counts[last].unstable;
  }

  // The bifurcation and grazing points at which a branch begins and ends are points of it, with the counts
  // of their neighbours.
  void add_ends(const Parent& parent, CondensedProblem& problem, Branch& branch) {
    ContactSystem system(problem, laws_, parent.curve->series_flexibility);
    TrialEvaluator evaluator(problem.pair().trial(), options_.sweep.output_points * branch.periods, 0);
    const auto point_of = [&](int special_point) {
      const SpecialPoint& from = parent.special_points()[std::size_t(special_point)];
      const int times = branch.periods / parent.periods;
      return sweep_point(system, evaluator,
                         curve_point(repeated(from.unknown, problem.contacts(), times), place_of(from)),
                         main_->parameter);
    };
    auto& points = branch.curve.points;
    auto& stability = branch.stability.points;
    points.insert(points.begin(), point_of(branch.special_point));
    stability.insert(stability.begin(), PointStability(stability.front()));
    if (branch.end_point < 0) return;
    points.push_back(point_of(branch.end_point));
    stability.push_back(PointStability(stability.back()));
  }

  const BranchProblems& problems_;
  const ContactLaws& laws_;
  DynamicsAlong dynamics_;
  const BranchOptions& options_;
  int load_periods_;  // in a period of the main curve
  const FrequencySweep* main_ = nullptr;
  std::vector<Branch> branches_;
  bool cancelled_ = false;
};

}  // namespace

BranchEnd end_of(SweepStatus status) {
  static constexpr std::pair<SweepStatus, BranchEnd> ends[] = {
      {SweepStatus::reached_end, BranchEnd::to_end},
      {SweepStatus::returned, BranchEnd::from_end},
      {SweepStatus::no_start, BranchEnd::no_start},
      {SweepStatus::closed, BranchEnd::closed},
      {SweepStatus::lost, BranchEnd::lost},
      {SweepStatus::unbounded, BranchEnd::unbounded},
      {SweepStatus::point_limit, BranchEnd::point_limit},
      {SweepStatus::ended, BranchEnd::special_point}};
  for (const auto& [of_curve, of_branch] : ends)
    if (of_curve == status) return of_branch;
  return BranchEnd::cancelled;
}

std::string_view to_string(BranchEnd end) {
  using enum BranchEnd;
  return detail::name_in<BranchEnd>({{special_point, "special_point"},
                                     {parent_curve, "parent_curve"},
                                     {from_end, "frequency_from"},
                                     {to_end, "frequency_to"},
                                     {no_start, "no_start"},
                                     {closed, "closed"},
                                     {lost, "lost"},
                                     {unbounded, "unbounded"},
                                     {point_limit, "point_limit"},
                                     {cancelled, "interrupted"}},
                                    end);
}

void BranchOptions::validate() const {
  sweep.validate();
  stability.validate();
  detail::require_at_least("BranchOptions", "largest_period", largest_period, 1);
  detail::require_at_least("BranchOptions", "max_branches", max_branches, 0);
}

std::vector<Branch> follow_branches(const BranchProblems& problems, const ContactLaws& laws,
                                    DynamicsAlong dynamics, const FrequencySweep& main,
                                    const CurveStability& stability, const BranchOptions& options) {
  options.validate();
  return Branches(problems, laws, std::move(dynamics), options).run(main, stability);
}

}  // namespace wavebalance::solvers
