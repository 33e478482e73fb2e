#include "wavebalance/solvers/stability/curve_stability.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/multipliers.hpp"
#include "linalg/option_checks.hpp"
#include "stability/curve_motions.hpp"
#include "stability/stability_checks.hpp"
#include "stability/stop_motion.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

constexpr int not_counted = -2;

/// A point of the curve with its stability. The count of unstable multipliers, and the signs as well, may not
/// have been measured.
struct CurveSample {
  CurvePoint point;
  PointStability stability;
};

/// The quantities that differ between two points.
struct Difference {
  bool contacts = false, fold = false, flip = false;
  bool count = false;  // whether the count changes by more or less than the changes of sign explain

  bool any() const { return contacts || fold || flip || count; }
};

bool is_known(const CurveSample& sample) { return sample.stability.status == StabilityStatus::converged; }

Difference difference(const CurveSample& a, const CurveSample& b) {
  const PointStability &p = a.stability, &q = b.stability;
  Difference result;
  result.contacts = p.contacts != q.contacts;
  if (!is_known(a) || !is_known(b) || p.fold == 0 || q.fold == 0) return result;
  result.fold = p.fold != q.fold;
  result.flip = p.flip != q.flip;
  const bool counted = p.unstable != not_counted && q.unstable != not_counted;
  result.count = counted && std::abs(p.unstable - q.unstable) != int{result.fold} + int{result.flip};
  return result;
}

/// The bifurcation and grazing points in a bracket between two points that differ. Multipliers jump at a
/// grazing, so that their differences then mean no other bifurcation or grazing point.
std::vector<SpecialPointType> events(const Difference& difference, bool reverses) {
  std::vector<SpecialPointType> types;
  if (difference.fold && reverses) types.push_back(SpecialPointType::fold);
  if (difference.contacts) {
    types.push_back(SpecialPointType::grazing);
    return types;
  }
  if (difference.fold && !reverses) types.push_back(SpecialPointType::branch);
  if (difference.flip) types.push_back(SpecialPointType::period_doubling);
  if (difference.count) types.push_back(SpecialPointType::neimark_sacker);
  return types;
}

/// The distance of a multiplier from the place that the type of bifurcation or grazing point requires.
double distance_from(SpecialPointType type, Complex multiplier) {
  if (type == SpecialPointType::period_doubling) return std::abs(multiplier + 1.0);
  if (type == SpecialPointType::neimark_sacker) return std::abs(std::abs(multiplier) - 1.0);
  return std::abs(multiplier - 1.0);
}

/// Whether a complex multiplier is on the unit circle, within the accuracy of the samples.
bool is_on_circle(Complex multiplier) {
  constexpr double near = 1e-3, real = 1e-6;
  return std::abs(std::abs(multiplier) - 1.0) <= near && multiplier.imag() > real;
}

class Tracker {
 public:
  Tracker(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve,
          DynamicsAlong dynamics, const CurveStabilityOptions& options)
      : problem_(problem),
        laws_(laws),
        curve_(curve),
        dynamics_(std::move(dynamics)),
        options_(options),
        stops_(StopMotions::of(problem, laws, *dynamics_.at(problem.structure()), options.stability)),
        motions_("curve_stability", problem, laws, curve, lengths(laws), options.output_points) {}

  CurveStability run() {
    std::optional<CurveSample> before;
    for (std::size_t i = 0; i < curve_.points.size(); ++i) {
      const SweepPoint& point = curve_.points[i];
      CurveSample here{motions_.at(point), {}};
      measure(here, options_.special_points ? Measure::count : Measure::count_alone);
      if (!is_known(here)) here.stability.unstable = -1;
      result_.points.push_back(here.stability);
      index_ = i;
      if (before && options_.special_points) {
        step_ = motions_.path().distance(before->point, here.point);
        examine(*before, here, 0);
      }
      before = std::move(here);
      if (result_.cancelled || !tell(value_of(point))) break;
    }
    return std::move(result_);
  }

 private:
  double value_of(const SweepPoint& point) const { return motions_.value_of(point); }

  bool tell(double value) {
    const double done =
        static_cast<double>(result_.points.size()) / static_cast<double>(curve_.points.size());
    const int count = static_cast<int>(result_.points.size());
    result_.cancelled =
        !goes_on(options_.observer, {"stability", count, value, unit_of(problem_, curve_.parameter), done});
    return !result_.cancelled;
  }

  static ArcLengthOptions lengths(const ContactLaws& laws) {
    ArcLengthOptions options;
    options.displacement_scale = laws.largest_gap();
    options.least_scale = 1e-3;
    options.max_corrections = 32;  // half as many without grazing events
    return options;
  }

  // The measurements at a point; each includes those before it, but count_alone has no signs.
  enum class Measure { contacts, signs, count, count_alone };

  void measure(CurveSample& sample, Measure what) {
    const PeriodicResponse at = motions_.response(sample.point);
    const PeriodicStiffness stiffness = contact_stiffness(problem_, laws_, at);
    const auto dynamics = dynamics_.at(problem_.structure());
    const auto contacts =
        std::count_if(stiffness.intervals.begin(), stiffness.intervals.end(),
                      [&](const ContactInterval& interval) { return laws_.begins(interval.contact); });
    sample.stability = {stiffness.status, not_counted, static_cast<int>(contacts), 0, 0};
    if (what == Measure::contacts) return;
    StabilityOptions how = with_harmonics_of(problem_.pair(), options_.stability);
    how.leading = false;
    if (stops_ && stops_->are_needed(stiffness, at.frequency, how))
      return measure_exact(stops_->multipliers_beside(problem_, at, stiffness, how), what, sample);
    if (what == Measure::count_alone && stiffness.friction.empty())
      return set_count(unstable_multipliers(*dynamics, stiffness, at.frequency, how), sample);
    if (what == Measure::signs && stiffness.friction.empty())
      return set_signs(stability_signs(*dynamics, stiffness, at.frequency, how), sample);
    const SignsAndCount both = signs_and_count(*dynamics, stiffness, at.frequency, how);
    set_signs(both.signs, sample);
    if (is_known(sample)) set_count(both.count, sample);
  }

  static void measure_exact(const std::optional<Eigen::VectorXcd>& multipliers, Measure what,
                            CurveSample& sample) {
    PointStability& stability = sample.stability;
    stability.status = multipliers ? StabilityStatus::converged : StabilityStatus::too_few_harmonics;
    if (!multipliers) return;
    if (what != Measure::count_alone) set_signs(signs_of_multipliers(*multipliers), sample);
    if (what == Measure::signs) return;
    stability.unstable = detail::count_outside(*multipliers);
    if (stability.unstable < 0) stability.status = StabilityStatus::on_unit_circle;
  }

  static void set_signs(const StabilitySigns& signs, CurveSample& sample) {
    sample.stability.status = signs.status;
    sample.stability.fold = signs.fold;
    sample.stability.flip = signs.flip;
  }

  static void set_count(const UnstableMultipliers& count, CurveSample& sample) {
    sample.stability.status = count.status;
    sample.stability.unstable = count.count;
  }

  // Locates each difference between two points by divisions of the distance of two neighbours on the curve.
  // Points between them are measured only as far as the difference needs.
  void examine(const CurveSample& a, const CurveSample& b, int divisions) {
    constexpr int most = 36, most_predicted = 9;
    const Difference between = difference(a, b);
    if (!between.any() || result_.cancelled || !tell(a.point.parameter)) return;
    const double width = motions_.path().distance(a.point, b.point) / step_;
    const bool located = width <= options_.tolerance, signs = between.fold || between.flip;
    const Measure what = between.count ? Measure::count : signs ? Measure::signs : Measure::contacts;
    const bool predicts = what == Measure::contacts && divisions < most_predicted;
    const double share = predicts ? share_beside_grazing(a, b, width) : 0.5;
    const std::optional<CurveSample> middle =
        located || divisions >= most ? std::nullopt : sample_between(a.point, b.point, share, what);
    if (!middle) {
      for (const SpecialPointType type :
           events(between, reverses_between(a.point.parameter, b.point.parameter)))
        add(special_point(type, a.point, b.point, located));
      return;
    }
    examine(a, *middle, divisions + 1);
    examine(*middle, b, divisions + 1);
  }

  // A share of the chord a little to the longer side of the grazing that samples predict, so that the other
  // part holds it. The prediction is in error by the square of the width.
  double share_beside_grazing(const CurveSample& a, const CurveSample& b, double width) const {
    constexpr double curvature = 0.5, of_tolerance = 0.3;
    const double at = motions_.share_of_grazing(a.point, b.point);
    const double beside =
        std::max(curvature * width * at * (1.0 - at), of_tolerance * options_.tolerance / width);
    return std::clamp(at > 0.5 ? at - beside : at + beside, 0.01 * beside, 1.0 - 0.01 * beside);
  }

  // A point between two others, preferably one whose stability is known. The plane through this place of
  // their chord may meet the curve at a kink, where Newton's method cycles, or where contact has just begun.
  // Planes through other places of the chord are then tried.
  std::optional<CurveSample> sample_between(const CurvePoint& a, const CurvePoint& b, double first,
                                            Measure what) {
    constexpr double farthest = 0.25;  // from the chord, over the distance of two neighbours on the curve
    std::optional<CurveSample> found;
    for (const double share : {first, first == 0.5 ? 0.4 : 0.5, 0.6, 0.3, 0.7}) {
      CurveSample sample{{}, {}};
      if (!motions_.path().between(a, b, share, sample.point, farthest * step_)) continue;
      measure(sample, what);
      if (what == Measure::contacts || is_known(sample)) return sample;
      if (!found) found = std::move(sample);
    }
    return found;
  }

  // Whether the curve reverses in a bracket, that is, leaves it to the same side forwards and backwards. The
  // neighbours do not decide that, since kinks of the samples make a curve turn to and fro near a fold, by
  // about the distance of its points. The smallest scale decides at which the curve leaves the bracket both
  // ways.
  bool reverses_between(double from, double to) const {
    const double middle = 0.5 * (from + to);
    const auto here = curve_.points.begin() + static_cast<std::ptrdiff_t>(index_);
    const auto back = std::make_reverse_iterator(here);
    if (here == curve_.points.begin()) return false;
    const double spacing = std::abs(value_of(*here) - value_of(*back));
    for (double scale = std::max({1e-5 * std::abs(middle), std::abs(from - to), spacing});; scale *= 2.0) {
      const Departure before = departure(back, curve_.points.rend(), middle, scale);
      const Departure after = departure(here, curve_.points.end(), middle, scale);
      if (before == Departure::none || after == Departure::none) return false;
      if (before != Departure::returns && after != Departure::returns) return before == after;
    }
  }

  enum class Departure { below, above, returns, none };

  // To which side a curve leaves a value. It has left where it is farther than `scale` from the value and
  // stays so until it is twice as far or ends; it returns where it comes nearer again before.
  template <typename Iterator>
  Departure departure(Iterator from, Iterator end, double value, double scale) const {
    const auto is_near = [&](const SweepPoint& point) { return std::abs(value_of(point) - value) <= scale; };
    const auto first = std::find_if_not(from, end, is_near);
    if (first == end) return Departure::none;
    const bool above = value_of(*first) > value;
    for (auto point = first; point != end; ++point) {
      const double distance = above ? value_of(*point) - value : value - value_of(*point);
      if (distance <= scale) return Departure::returns;
      if (distance > 2.0 * scale) break;
    }
    return above ? Departure::above : Departure::below;
  }

  // A pair that passes the circle is seen to be on it, and not where a count jumps as kinks of the samples
  // do. Kinks near a point also repeat it: what coincides is one point.
  void add(SpecialPoint point) {
    constexpr double same = 1e-7;
    const bool pair = point.type == SpecialPointType::neimark_sacker;
    if (pair && !is_on_circle(point.multiplier)) return;
    const double value = parameter_of(point, curve_.parameter);
    const bool known = std::any_of(
        result_.special_points.begin(), result_.special_points.end(), [&](const SpecialPoint& other) {
          const bool counts = other.type == point.type || (pair && other.type == SpecialPointType::fold);
          return counts && other.next_point == point.next_point &&
                 std::abs(parameter_of(other, curve_.parameter) - value) <= same * std::abs(value);
        });
    if (!known || point.type == SpecialPointType::grazing) result_.special_points.push_back(std::move(point));
  }

  SpecialPoint special_point(SpecialPointType type, const CurvePoint& a, const CurvePoint& b, bool located) {
    SpecialPoint point = motions_.special_point(type, a, b, index_);
    point.located = located;
    if (type != SpecialPointType::grazing) point.multiplier = critical_multiplier(type, motions_.response(a));
    return point;
  }

  Complex critical_multiplier(SpecialPointType type, const PeriodicResponse& at) {
    FloquetOptions how;
    how.stability = with_harmonics_of(problem_.pair(), options_.stability);
    const PeriodicStiffness stiffness = contact_stiffness(problem_, laws_, at);
    const auto dynamics = dynamics_.at(problem_.structure());
    Complex nearest(missing, missing);
    const auto consider = [&](Complex multiplier) {
      if (!(distance_from(type, multiplier) >= distance_from(type, nearest))) nearest = multiplier;
    };
    std::optional<Eigen::VectorXcd> all;
    if (stops_ && stops_->are_needed(stiffness, at.frequency, how.stability))
      all = stops_->multipliers_beside(problem_, at, stiffness, how.stability);
    if (!all) all = multipliers_of_costly(*dynamics, stiffness, at.frequency, how.stability);
    if (all)
      for (const Complex multiplier : *all) consider({multiplier.real(), std::abs(multiplier.imag())});
    else
      for (const FloquetExponent& one : floquet_exponents(*dynamics, stiffness, at.frequency, how).values)
        consider(one.multiplier);
    return nearest;
  }

  CondensedProblem& problem_;
  const ContactLaws& laws_;
  const FrequencySweep& curve_;
  DynamicsAlong dynamics_;
  const CurveStabilityOptions& options_;
  std::optional<StopMotions> stops_;
  CurveMotions motions_;
  CurveStability result_;
  std::size_t index_ = 0;  // the point at the end of the piece that is examined
  double step_ = 0.0;      // its scaled arc length
};

}  // namespace

std::string_view to_string(SpecialPointType type) {
  using enum SpecialPointType;
  return detail::name_in<SpecialPointType>({{fold, "fold"},
                                            {period_doubling, "period_doubling"},
                                            {neimark_sacker, "neimark_sacker"},
                                            {grazing, "grazing"},
                                            {branch, "branch"},
                                            {slip, "slip"},
                                            {stick, "stick"},
                                            {krein_collision, "krein_collision"}},
                                           type);
}

StabilityStatus CurveStability::status() const {
  for (const PointStability& point : points)
    if (point.status != StabilityStatus::converged) return point.status;
  return StabilityStatus::converged;
}

void CurveStabilityOptions::validate() const {
  stability.validate();
  detail::require_positive("CurveStabilityOptions", "tolerance", tolerance);
  detail::require_at_least("CurveStabilityOptions", "output_points", output_points, 1);
}

CurveStability curve_stability(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweep& curve, DynamicsAlong dynamics,
                               const CurveStabilityOptions& options) {
  options.validate();
  return Tracker(problem, laws, curve, std::move(dynamics), options).run();
}

}  // namespace wavebalance::solvers
