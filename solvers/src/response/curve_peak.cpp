#include "wavebalance/solvers/response/curve_peak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "wavebalance/solvers/response/curve_responses.hpp"

namespace wavebalance::solvers {
namespace {

/// Places of a search with their values, from the left: two ends and the highest one between them.
struct Bracket {
  double left, middle, right, at_left, at_middle, at_right;

  /// The vertex of the parabola through the three; nothing where it is no maximum between the ends.
  std::optional<double> vertex() const {
    const double before = middle - left, after = right - middle, rise = (at_middle - at_left) / before,
                 fall = (at_right - at_middle) / after, curvature = (fall - rise) / (before + after);
    if (!(curvature < 0.0)) return std::nullopt;
    const double slope = (rise * after + fall * before) / (before + after);
    const double place = middle - 0.5 * slope / curvature;
    return place > left && place < right ? std::optional(place) : std::nullopt;
  }

  void take(double place, double value) {
    const bool higher = value > at_middle;
    if ((place < middle) == higher) {
      right = higher ? middle : place;
      at_right = higher ? at_middle : value;
    } else {
      left = higher ? middle : place;
      at_left = higher ? at_middle : value;
    }
    if (!higher) return;
    middle = place;
    at_middle = value;
  }
};

}  // namespace

Maximum maximum_between(const std::function<double(double)>& function, double left, double middle,
                        double right, double tolerance) {
  constexpr int most = 60, most_retries = 6;
  constexpr double golden = 0.381966011250105;
  Bracket now{left, middle, right, function(left), function(middle), function(right)};
  const double extent = right - left, least = tolerance * extent;
  double earlier = extent;  // some steps before
  bool known = std::isfinite(now.at_left) && std::isfinite(now.at_middle) && std::isfinite(now.at_right);
  const bool inside = known && now.at_middle >= now.at_left && now.at_middle >= now.at_right;
  for (int i = 1; inside && known && i < most && now.right - now.left > 2.0 * least; ++i) {
    const bool to_right = now.right - now.middle > now.middle - now.left;
    const double section = to_right ? now.middle + golden * (now.right - now.middle)
                                    : now.middle - golden * (now.middle - now.left);
    bool lags = false;
    if (i % 3 == 0) lags = now.right - now.left > 0.5 * std::exchange(earlier, now.right - now.left);
    double place = lags ? section : now.vertex().value_or(section);
    // Beside a middle that is the vertex, so that both ends come near to it.
    if (std::abs(place - now.middle) < least) place = now.middle + (to_right ? least : -least);
    double value = function(place);
    // Nearer to the middle if there is none: near kinks not every place has a solution.
    for (int k = 0; k < most_retries && !std::isfinite(value); ++k) {
      place = 0.5 * (place + now.middle);
      value = function(place);
    }
    known = std::isfinite(value);
    if (known) now.take(place, value);
  }
  return {now.middle,
          now.at_middle,
          now.left,
          now.right,
          std::max(now.at_left, now.at_right),
          inside && known && now.right - now.left <= 2.0 * least * (1.0 + 1e-9)};
}

namespace {

/// Points of a curve by their arc length from one of them, between its neighbours.
class Neighbourhood {
 public:
  Neighbourhood(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve,
                std::size_t index)
      : system_(problem, laws, curve.series_flexibility),
        path_(system_, curve_parameter(curve.parameter), arc_scales(curve)),
        points_{solution_of(curve, index - 1), solution_of(curve, index), solution_of(curve, index + 1)},
        before_(path_.distance(points_[0], points_[1])),
        after_(path_.distance(points_[1], points_[2])) {}

  double before() const { return before_; }
  double after() const { return after_; }
  /// Nothing where none was found.
  std::optional<CurvePoint> at(double length) {
    if (length <= -before_) return points_[0];
    if (length >= after_) return points_[2];
    if (length == 0.0) return points_[1];
    CurvePoint found;
    const bool left = length < 0.0;
    const double share = left ? 1.0 + length / before_ : length / after_;
    if (!path_.between(points_[left ? 0 : 1], points_[left ? 1 : 2], share, found)) return std::nullopt;
    ++solutions;
    return found;
  }

  int solutions = 0;

 private:
  ContactSystem system_;
  ArcLength path_;
  std::array<CurvePoint, 3> points_;
  double before_, after_;
};

}  // namespace

CurvePeak curve_peak(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve,
                     std::size_t index, const CurveHeight& height) {
  const SweepPoint& point = curve.points.at(index);
  if (point.unknown.size() != problem.samples())
    throw std::invalid_argument(
        "curve_peak: the point has no unknown; frequency_sweep() keeps them with "
        "keep_unknowns");
  const auto value = [&](std::size_t i) { return parameter_of(curve.points[i], curve.parameter); };
  CurvePeak peak{value(index), point.unknown, height(value(index), point.unknown)};
  if (index == 0 || index + 1 >= curve.points.size()) return peak;
  if (curve.parameter == SweepParameter::load_scale) problem.set_load_frequency(point.frequency);
  Neighbourhood near(problem, laws, curve, index);
  const auto measured = [&](double length) {
    const std::optional<CurvePoint> found = near.at(length);
    return found ? height(found->parameter, found->displacement) : std::nan("");
  };
  constexpr double tolerance = 1e-5;  // of the way between the neighbours
  const Maximum best = maximum_between(measured, -near.before(), 0.0, near.after(), tolerance);
  const auto found = near.at(best.at), left = near.at(best.left), right = near.at(best.right);
  peak.solutions = near.solutions;
  if (!found || !left || !right || !std::isfinite(best.value)) {
    peak.value_error =
        std::max(std::abs(value(index + 1) - peak.value), std::abs(peak.value - value(index - 1)));
    return peak;
  }
  peak.value = found->parameter;
  peak.unknown = found->displacement;
  peak.height = best.value;
  peak.value_error =
      std::max(std::abs(left->parameter - peak.value), std::abs(right->parameter - peak.value));
  peak.height_error = std::abs(best.value - best.beside) / std::abs(best.value);
  return peak;
}

}  // namespace wavebalance::solvers
