#include "wavebalance/solvers/response/frequency_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "continuation/return_detector.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "response/bandwidth_steps.hpp"

namespace wavebalance::solvers {

std::string_view to_string(SweepStatus status) {
  using enum SweepStatus;
  return detail::name_in<SweepStatus>({{reached_end, "reached_end"},
                                       {returned, "returned"},
                                       {no_start, "no_start"},
                                       {closed, "closed"},
                                       {lost, "lost"},
                                       {unbounded, "unbounded"},
                                       {point_limit, "point_limit"},
                                       {ended, "ended"},
                                       {cancelled, "cancelled"}},
                                      status);
}

namespace {

// A response with contact larger than this many gaps, and than this many times that without contact.
constexpr double bound = 100.0;

// Leaves out neighbours that are less than `least` apart in the parameter, the nearest first. The turning
// points of the curve on that scale remain.
void leave_out_small_returns(std::vector<TurningPoint>& turns, double least, SweepParameter parameter) {
  const auto apart = [&](std::size_t i) {
    return std::abs(parameter_of(turns[i + 1], parameter) - parameter_of(turns[i], parameter));
  };
  while (turns.size() > 1) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i + 1 < turns.size(); ++i)
      if (apart(i) < apart(nearest)) nearest = i;
    if (apart(nearest) >= least) return;
    const auto first = turns.begin() + static_cast<std::ptrdiff_t>(nearest);
    turns.erase(first, first + 2);
  }
}

class Sweep {
 public:
  Sweep(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweepOptions& options,
        const SweepStart* start, SweepParameter parameter = SweepParameter::frequency)
      : problem_(problem),
        laws_(laws),
        system_(problem, laws),
        options_(options),
        start_(start),
        parameter_(parameter),
        evaluator_(problem.pair().trial(), options.output_points, 0) {}

  FrequencySweep run() {
    // Friction damps the superharmonics that it excites.
    if (parameter_ == SweepParameter::frequency && !laws_.act_over_period())
      bounded_ = detail::BandwidthSteps::make(problem_, std::abs(options_.to - options_.from));
    // Whether long steps pass a narrow undamped resonance depends on where they end, so other lengths are
    // tried.
    for (const double share : {1.0, 0.7, 1.4}) {
      step_share_ = share;
      largest_free_ = 0.0;
      result_ = {};
      result_.parameter = parameter_;
      trace();
      const bool again = result_.status == SweepStatus::unbounded &&
                         options_.arc_length.grazing_events != GrazingEvents::all;
      if (!again) break;
    }
    const double interval = std::abs(options_.to - options_.from);
    leave_out_small_returns(result_.turning_points,
                            options_.smallest_return > 0.0 ? options_.smallest_return : 1e-3 * interval,
                            parameter_);
    return std::move(result_);
  }

 private:
  PeriodicResponse first_response() {
    if (start_) {
      if (parameter_ == SweepParameter::load_scale) problem_.set_load_scale(start_->response.load_scale);
      problem_.set_frequency(start_->response.frequency);
      return start_->response;
    }
    if (parameter_ == SweepParameter::load_scale)
      problem_.set_load_scale(options_.from);
    else
      problem_.set_load_frequency(options_.from);
    ForcedResponseOptions how = options_.start;
    if (!how.observer) how.observer = options_.observer;
    return forced_response(problem_, laws_, how);
  }

  void trace() {
    const PeriodicResponse first = first_response();
    result_.condition = std::max(problem_.condition(), first.condition);
    result_.rounding_error = first.rounding_error;
    if (first.status == SolveStatus::cancelled) result_.status = SweepStatus::cancelled;
    if (!first.converged()) return;
    system_ = ContactSystem(problem_, laws_, first.series_flexibility);  // in the form of the first point
    result_.series_flexibility = first.series_flexibility;
    result_.form = first.series_flexibility.size() > 0 ? ContactForm::force : ContactForm::displacement;
    follow_until_open(first_point(first), scaled_options(first));
  }

  // With a tangent to the side on which the curve is followed.
  CurvePoint first_point(const PeriodicResponse& first) const {
    CurvePoint point;
    point.displacement = first.unknown;
    point.parameter =
        parameter_ == SweepParameter::frequency ? first.frequency * problem_.periods() : first.load_scale;
    const bool directed = start_ && start_->direction.size() > 0;
    point.displacement_tangent = directed ? start_->direction : Eigen::VectorXd::Zero(first.unknown.size());
    point.parameter_tangent = directed ? 0.0 : options_.to - options_.from;
    return point;
  }

  // Follows the curve from the first point. Where it returns to a point that the detector keeps, it is
  // followed again from the kept point before, each time with shorter steps.
  void follow_until_open(CurvePoint from, ArcLengthOptions arc) {
    constexpr double shorter = 0.7;  // first step after one that was lost
    ReturnDetector detector(arc);
    turns_at_point_.clear();
    recent_.clear();
    lost_at_ = attempts_back_ = 0;
    while (true) {
      ArcLengthOptions now = arc;
      now.initial_step *= std::pow(shorter, attempts_back_);
      ArcLength curve(system_, bounded_ ? *bounded_ : curve_parameter(parameter_), now);
      if (bounded_) bounded_->begin_at(from.parameter, false);
      if (start_curve(curve, from) != ArcLength::Status::advanced) return;
      if (result_.points.empty() && !record(curve.point())) {
        result_.status = SweepStatus::cancelled;
        return;
      }
      result_.status = follow(curve, detector);
      if (result_.status == SweepStatus::lost && step_back(detector, from)) continue;
      result_.closed_at_start = result_.status == SweepStatus::closed && returned_to_ == 0;
      if (result_.status != SweepStatus::closed || result_.closed_at_start || !shorten(arc)) return;
      const std::size_t before = returned_to_ > 0 ? returned_to_ - 1 : 0;
      detector.forget_after(before);
      from = detector[before].point;
      forget_points_after(detector[before].count);
      recent_.clear();
    }
  }

  ArcLength::Status start_curve(ArcLength& curve, const CurvePoint& from) const {
    if (from.parameter_tangent == 0.0) return curve.start(from);
    const double direction = from.parameter_tangent > 0.0 ? 1.0 : -1.0;
    return curve.start(from.displacement, from.parameter, direction);
  }

  // Shorter steps than the last; false when there are none.
  bool shorten(ArcLengthOptions& arc) const {
    constexpr double shortest = 0.25;  // of the largest step at first
    if (arc.grazing_events == GrazingEvents::all) return false;
    if (arc.max_step <= shortest * options_.arc_length.max_step * step_share_) {
      arc.grazing_events = GrazingEvents::all;
    } else {
      arc.max_step *= 0.5;
      arc.min_step = std::min(arc.min_step, 0.1 * arc.max_step);
      arc.initial_step = std::min(arc.initial_step, arc.max_step);
    }
    return true;
  }

  // Goes back from where the curve was lost, from there on with other steps: which kinks lie within one step
  // depends on where it begins. Each time farther back; false when that has not helped.
  bool step_back(ReturnDetector& detector, CurvePoint& from) {
    constexpr std::size_t attempts = 4;
    const std::size_t count = result_.points.size();
    if (count > lost_at_) attempts_back_ = 0;
    lost_at_ = std::max(lost_at_, count);
    const std::size_t back = std::size_t{2} << attempts_back_;
    if (attempts_back_++ == attempts || back >= recent_.size()) return false;
    recent_.resize(recent_.size() - back);
    from = recent_.back();
    recent_.pop_back();
    forget_points_after(static_cast<int>(count - back));
    detector.forget_points_after(static_cast<int>(count - back));
    return true;
  }

  void remember(const CurvePoint& point) {
    constexpr std::size_t most = 40;
    recent_.push_back(point);
    if (recent_.size() > most) recent_.pop_front();
  }

  void forget_points_after(int count) {
    const auto size = static_cast<std::size_t>(count);
    result_.turning_points.resize(turns_at_point_[size - 1]);
    result_.points.resize(size);
    turns_at_point_.resize(size);
  }

  ArcLengthOptions scaled_options(const PeriodicResponse& first) const {
    ArcLengthOptions arc = options_.arc_length;
    const double gap = system_.laws().largest_gap();
    const double rms = first.displacement.norm() / std::sqrt(double(first.displacement.size()));
    constexpr double least_share = 1e-3;  // of a gap, of what vibrates
    if (arc.displacement_scale == 0.0) {
      arc.displacement_scale = gap > least_share * rms ? gap : length_of_springs(rms);
      arc.least_scale = std::min(arc.least_scale, least_share);
    }
    if (arc.parameter_scale == 0.0) arc.parameter_scale = std::abs(options_.to - options_.from) / 20.0;
    arc.max_step *= step_share_;
    return arc;
  }

  // The least displacement from `least` on, by doubling, at which a law of one instant without a gap has a
  // force that matters compared with the stiffness of its contact; `least` where there is none.
  double length_of_springs(double least) const {
    constexpr double share = 0.3;
    constexpr int doublings = 20;
    const Eigen::VectorXd compliance = problem_.contact_compliance();
    for (double length = least; length <= std::ldexp(least, doublings) && length > 0.0; length *= 2.0)
      for (int c = 0; c < problem_.contacts(); ++c)
        if (!laws_[c].acts_over_period() && compliance[c] * std::abs(laws_[c].force(length)) > share * length)
          return length;
    return least;
  }

  SweepStatus follow(ArcLength& curve, ReturnDetector& detector) {
    const double direction = options_.to > options_.from ? 1.0 : -1.0;
    while (static_cast<int>(result_.points.size()) < options_.max_points) {
      detector.add(curve.point(), static_cast<int>(result_.points.size()));
      remember(curve.point());
      if (bounded_) bounded_->begin_at(curve.point().parameter, result_.points.back().contact_fraction > 0.0);
      if (curve.advance() != ArcLength::Status::advanced) return SweepStatus::lost;
      if (start_ && start_->ends && start_->ends(curve.previous(), curve.point())) return SweepStatus::ended;
      note_turning_point(curve);
      const double ahead = direction * (curve.point().parameter - options_.to);
      const double behind = direction * (options_.from - curve.point().parameter);
      if (ahead >= 0.0 || behind > 0.0) {
        const double end = ahead >= 0.0 ? options_.to : options_.from;
        CurvePoint last;
        if (curve.locate([end](const CurvePoint& p) { return p.parameter - end; }, last)) record(last);
        return ahead >= 0.0 ? SweepStatus::reached_end : SweepStatus::returned;
      }
      const std::optional<std::size_t> kept = detector.returned_to(curve);
      if (!record(curve.point())) return SweepStatus::cancelled;
      if (kept) {
        returned_to_ = *kept;
        return SweepStatus::closed;
      }
      if (has_grown_past_bounds()) return SweepStatus::unbounded;
    }
    return SweepStatus::point_limit;
  }

  // Uses the linear response of the last point measured.
  bool has_grown_past_bounds() {
    largest_free_ = std::max(largest_free_, problem_.linear_response().cwiseAbs().maxCoeff());
    const double gap = system_.laws().largest_gap();
    return gap > 0.0 && result_.points.back().max_abs_displacement > bound * std::max(gap, largest_free_);
  }

  void note_turning_point(ArcLength& curve) {
    if (curve.previous().parameter_tangent * curve.point().parameter_tangent >= 0.0) return;
    // At a grazing event the sign changes at the point itself, because its tangent belongs to the next
    // segment.
    CurvePoint turning = curve.point();
    if (!turning.grazing) {
      if (!curve.locate_turning_point(turning)) turning = curve.point();
    }
    const SweepPoint measured = measure(turning);
    result_.turning_points.push_back({measured.frequency, measured.max_displacement,
                                      measured.max_abs_displacement, turning.grazing, measured.load_scale});
  }

  SweepPoint measure(const CurvePoint& point) {
    SweepPoint measured = sweep_point(system_, evaluator_, point, parameter_);
    result_.condition = std::max(result_.condition, problem_.condition());
    result_.rounding_error =
        std::max(result_.rounding_error, problem_.rounding_error(system_.force_on_held_structure()));
    if (!options_.keep_unknowns) measured.unknown.resize(0);
    return measured;
  }

  bool record(const CurvePoint& point) {
    result_.points.push_back(measure(point));
    turns_at_point_.push_back(result_.turning_points.size());
    const double done = (point.parameter - options_.from) / (options_.to - options_.from);
    const int count = static_cast<int>(result_.points.size());
    const char* phase = parameter_ == SweepParameter::frequency ? "frequency sweep" : "amplitude sweep";
    return goes_on(options_.observer, {phase, count, point.parameter, unit_of(problem_, parameter_),
                                       std::clamp(done, 0.0, 1.0)});
  }

  CondensedProblem& problem_;
  const ContactLaws& laws_;
  ContactSystem system_;
  const FrequencySweepOptions& options_;
  const SweepStart* start_;  // null: the first response is computed at `from`
  SweepParameter parameter_;
  TrialEvaluator evaluator_;
  FrequencySweep result_;
  double largest_free_ = 0.0;
  double step_share_ = 1.0;                  // factor on the largest step
  std::vector<std::size_t> turns_at_point_;  // number of turning points up to each point
  std::size_t returned_to_ = 0;              // the kept point that a closed curve came back to
  std::optional<detail::BandwidthSteps> bounded_;
  std::deque<CurvePoint> recent_;  // the last points of the curve
  std::size_t lost_at_ = 0;        // the most points after which the curve was lost
  std::size_t attempts_back_ = 0;  // from there
};

FrequencySweep sweep_from(CondensedProblem& problem, const ContactLaws& laws,
                          const FrequencySweepOptions& options, const SweepStart& start,
                          SweepParameter parameter) {
  options.validate();
  for (const auto* samples : {&start.response.unknown, &start.direction})
    if (samples->size() != 0 && samples->size() != problem.samples())
      throw std::invalid_argument("a sweep's start has " + std::to_string(samples->size()) +
                                  " samples; expected the problem's " + std::to_string(problem.samples()));
  return Sweep(problem, laws, options, &start, parameter).run();
}

}  // namespace

void FrequencySweepOptions::validate() const {
  const bool valid = std::isfinite(from) && std::isfinite(to) && from > 0.0 && to > 0.0 && from != to;
  if (!valid)
    throw std::invalid_argument("FrequencySweepOptions: from " + std::to_string(from) + " Hz to " +
                                std::to_string(to) + " Hz; both must be positive, finite and different");
  if (!(smallest_return >= 0.0))
    throw std::invalid_argument("FrequencySweepOptions: smallest_return is " +
                                std::to_string(smallest_return) + " Hz; it must not be negative");
  detail::require_at_least("FrequencySweepOptions", "output_points", output_points, 1);
  detail::require_at_least("FrequencySweepOptions", "max_points", max_points, 1);
  arc_length.validate();
  start.validate();
}

FrequencySweep frequency_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options) {
  options.validate();
  return Sweep(problem, laws, options, nullptr).run();
}

FrequencySweep amplitude_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options) {
  options.validate();
  if (!(problem.frequency() > 0.0))
    throw std::invalid_argument(
        "amplitude_sweep: the problem has no frequency yet; call set_frequency first");
  return Sweep(problem, laws, options, nullptr, SweepParameter::load_scale).run();
}

FrequencySweep frequency_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options, const SweepStart& start) {
  return sweep_from(problem, laws, options, start, SweepParameter::frequency);
}

FrequencySweep amplitude_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options, const SweepStart& start) {
  return sweep_from(problem, laws, options, start, SweepParameter::load_scale);
}

}  // namespace wavebalance::solvers
