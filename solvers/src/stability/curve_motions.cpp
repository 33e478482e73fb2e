#include "stability/curve_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace wavebalance::solvers {
namespace {

ArcLengthOptions with_scales(const FrequencySweep& curve, ArcLengthOptions options) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double largest = 0.0, low = infinite, high = -infinite;
  for (const SweepPoint& point : curve.points) {
    largest = std::max(largest, point.max_abs_displacement);
    low = std::min(low, parameter_of(point, curve.parameter));
    high = std::max(high, parameter_of(point, curve.parameter));
  }
  if (!(options.displacement_scale > 0.0)) options.displacement_scale = largest > 0.0 ? largest : 1.0;
  options.parameter_scale = high > low ? (high - low) / 20.0 : 1.0;
  return options;
}

// The curve, once its points are known to have unknowns.
const FrequencySweep& with_unknowns(const char* who, const CondensedProblem& problem,
                                    const FrequencySweep& curve) {
  for (const SweepPoint& point : curve.points)
    if (point.unknown.size() != problem.samples())
      throw std::invalid_argument(std::string(who) + ": a point of the curve has " +
                                  std::to_string(point.unknown.size()) + " unknowns, but the problem has " +
                                  std::to_string(problem.samples()) +
                                  "; frequency_sweep() keeps them with keep_unknowns");
  return curve;
}

}  // namespace

CurveMotions::CurveMotions(const char* who, CondensedProblem& problem, const ContactLaws& laws,
                           const FrequencySweep& curve, ArcLengthOptions options, int output_points)
    : curve_(with_unknowns(who, problem, curve)),
      system_(problem, laws, curve.series_flexibility),
      path_(system_, curve_parameter(curve.parameter), with_scales(curve, std::move(options))),
      evaluator_(problem.pair().trial(), output_points, 0),
      points_(problem.points()) {
  if (curve.parameter == SweepParameter::load_scale && !curve.points.empty())
    problem.set_load_frequency(curve.points.front().frequency);
}

PeriodicResponse CurveMotions::response(const CurvePoint& point) {
  curve_parameter(curve_.parameter).set(system_, point.parameter);
  return response_at(system_, point.displacement);
}

// Samples change between contact and its absence one after the other. The first one whose neighbours are
// alike begins, ends, joins or splits an interval.
double CurveMotions::share_of_grazing(const CurvePoint& a, const CurvePoint& b) const {
  struct Change {
    double share;
    int sample;
  };
  const int samples = static_cast<int>(a.displacement.size());
  std::vector<bool> closed(static_cast<std::size_t>(samples));
  std::vector<Change> changes;
  for (int l = 0; l < samples; ++l) {
    const double from = a.displacement[l], to = b.displacement[l];
    const int piece = system_.piece_at(l, from), other = system_.piece_at(l, to);
    closed[std::size_t(l)] = piece != system_.rest_piece(l);
    if (closed[std::size_t(l)] == (other != system_.rest_piece(l))) continue;
    const double kink = system_.kinks_at(l)[std::size_t(std::min(piece, other))].at;
    changes.push_back({(kink - from) / (to - from), l});
  }
  std::ranges::sort(changes, {}, &Change::share);
  for (const Change& change : changes) {
    const int first = change.sample / points_ * points_, at = change.sample - first;
    const auto before = std::size_t(first + (at + points_ - 1) % points_),
               after = std::size_t(first + (at + 1) % points_);
    if (closed[before] == closed[after]) return change.share;
    closed[std::size_t(change.sample)].flip();
  }
  return 0.5;
}

SpecialPoint CurveMotions::special_point(SpecialPointType type, const CurvePoint& a, const CurvePoint& b,
                                         std::size_t next) {
  const SweepPoint measured = sweep_point(system_, evaluator_, a, curve_.parameter);
  SpecialPoint point;
  point.type = type;
  point.frequency = measured.frequency;
  const double middle = 0.5 * (a.parameter + b.parameter);
  (curve_.parameter == SweepParameter::frequency ? point.frequency : point.load_scale) = middle;
  point.bracket = std::abs(a.parameter - b.parameter);
  point.multiplier = {missing, missing};
  point.max_displacement = measured.max_displacement;
  point.max_abs_displacement = measured.max_abs_displacement;
  point.unknown = a.displacement;
  point.unknown_parameter = a.parameter;
  point.next_point = next;
  point.vibration = measured.vibration;
  return point;
}

}  // namespace wavebalance::solvers
