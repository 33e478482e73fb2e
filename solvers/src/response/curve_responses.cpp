#include "wavebalance/solvers/response/curve_responses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavebalance::solvers {

const CurveParameter& curve_parameter(SweepParameter parameter) {
  static const FrequencyParameter frequency;
  static const LoadScaleParameter load_scale;
  if (parameter == SweepParameter::frequency) return frequency;
  return load_scale;
}

std::string_view unit_of(const CondensedProblem& problem, SweepParameter parameter) {
  return parameter == SweepParameter::frequency ? std::string_view("Hz") : problem.load_unit();
}
CurvePoint solution_of(const FrequencySweep& curve, std::size_t index) {
  CurvePoint solution;
  solution.displacement = curve.points[index].unknown;
  solution.parameter = parameter_of(curve.points[index], curve.parameter);
  return solution;
}

ArcLengthOptions arc_scales(const FrequencySweep& curve) {
  const auto value = [&](const SweepPoint& point) { return parameter_of(point, curve.parameter); };
  const auto [low, high] =
      std::minmax_element(curve.points.begin(), curve.points.end(),
                          [&](const auto& a, const auto& b) { return value(a) < value(b); });
  double largest = 0.0;
  for (const SweepPoint& point : curve.points) largest = std::max(largest, point.max_abs_displacement);
  const double interval = value(*high) - value(*low);
  ArcLengthOptions scales;
  scales.max_corrections = 32;
  scales.displacement_scale = largest > 0.0 ? largest : 1.0;
  scales.parameter_scale = interval > 0.0 ? interval / 20.0 : 1.0;
  return scales;
}

namespace {

void require_unknown(const CondensedProblem& problem, const Eigen::VectorXd& unknown) {
  if (unknown.size() != problem.samples())
    throw std::invalid_argument("curve_response: a point of the curve has " + std::to_string(unknown.size()) +
                                " unknowns, but the problem has " + std::to_string(problem.samples()) +
                                "; frequency_sweep() keeps them with keep_unknowns");
}

/// A curve over the load has one frequency.
void set_frequency_of(const FrequencySweep& curve, CondensedProblem& problem) {
  if (curve.parameter == SweepParameter::load_scale && !curve.points.empty())
    problem.set_load_frequency(curve.points.front().frequency);
}

/// The point nearest to `wanted` that bisection between two points on either side of it finds.
CurvePoint nearest(ArcLength& path, CurvePoint before, CurvePoint after, double wanted) {
  constexpr int most_halvings = 60;
  constexpr double close_enough = 1e-9;
  const auto distance = [&](const CurvePoint& point) { return std::abs(point.parameter - wanted); };
  for (int i = 0; i < most_halvings; ++i) {
    const CurvePoint& nearer = distance(before) < distance(after) ? before : after;
    if (distance(nearer) <= close_enough * std::abs(wanted)) return nearer;
    // The share of the chord at which it would have that parameter, away from its ends.
    const double share =
        std::clamp((wanted - before.parameter) / (after.parameter - before.parameter), 0.1, 0.9);
    CurvePoint middle;
    if (!path.between(before, after, share, middle)) return nearer;
    const bool same_side = (middle.parameter - wanted) * (before.parameter - wanted) > 0.0;
    (same_side ? before : after) = std::move(middle);
  }
  return distance(before) < distance(after) ? before : after;
}

/// On which side of `wanted` a point of the curve lies, -1 or 1; 0: there, to rounding.
int side_of(const FrequencySweep& curve, std::size_t index, double wanted) {
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double apart = parameter_of(curve.points[index], curve.parameter) - wanted;
  if (std::abs(apart) <= rounding * std::abs(wanted)) return 0;
  return apart < 0.0 ? -1 : 1;
}

/// Whether the curve may reach `wanted` and turn back between the points i and i + 1, which lie on one
/// side of it: one of them is nearer to it than its neighbours are, and no farther than they are from it.
bool may_turn_at(const FrequencySweep& curve, std::size_t i, double wanted) {
  const auto& points = curve.points;
  const auto distance = [&](std::size_t k) {
    return std::abs(parameter_of(points[k], curve.parameter) - wanted);
  };
  const auto turns = [&](std::size_t k) {
    if (k == 0 || k + 1 == points.size()) return false;
    const double nearer = std::min(distance(k - 1), distance(k + 1)),
                 farther = std::max(distance(k - 1), distance(k + 1));
    return distance(k) <= nearer && distance(k) <= farther - distance(k);
  };
  return turns(i) || turns(i + 1);
}

class Crossings {
 public:
  Crossings(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve, double wanted)
      : problem_(problem),
        system_(problem, laws, curve.series_flexibility),
        parameter_(curve_parameter(curve.parameter)),
        path_(system_, parameter_, arc_scales(curve)),
        wanted_(wanted) {}

  PeriodicResponse at(const SweepPoint& point) { return solved(point.unknown, {}); }

  PeriodicResponse between(const CurvePoint& before, const CurvePoint& after) {
    const CurvePoint found = nearest(path_, before, after, wanted_);
    return solved(found.displacement, after.displacement - before.displacement);
  }

  // A point of the curve between two on one side of the requested parameter that is on the other side: a
  // fold between them. By golden section of the chord.
  std::optional<CurvePoint> beyond(const CurvePoint& before, const CurvePoint& after) {
    constexpr int most_points = 24;
    const double ratio = 0.5 * (std::sqrt(5.0) - 1.0), side = before.parameter < wanted_ ? 1.0 : -1.0;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < most_points; ++i) {
      std::array<double, 2> shares{high - ratio * (high - low), low + ratio * (high - low)};
      std::array<CurvePoint, 2> points;
      for (std::size_t k : {0u, 1u}) {
        if (!path_.between(before, after, shares[k], points[k])) return std::nullopt;
        if (side * (points[k].parameter - wanted_) > 0.0) return points[k];
      }
      const bool left = side * points[0].parameter > side * points[1].parameter;
      (left ? high : low) = left ? shares[1] : shares[0];
    }
    return std::nullopt;
  }

 private:
  // From a nearby start. A solution farther from it than the distance `apart` of the two points belongs to
  // another crossing.
  PeriodicResponse solved(const Eigen::VectorXd& start, const Eigen::VectorXd& apart) {
    parameter_.set(system_, wanted_);
    Eigen::VectorXd unknown = start;
    const NewtonResult result = newton(system_, unknown, {});
    const bool here = apart.size() == 0 || (unknown - start).norm() <= apart.norm();
    PeriodicResponse response = response_at(system_, std::move(unknown));
    response.status = result.status == SolveStatus::converged && !here ? SolveStatus::stalled : result.status;
    response.iterations = result.iterations;
    response.condition = result.condition;
    response.residual_history = result.residual_history;
    if (response.converged()) response.strategy = Strategy::newton;
    response.rounding_error = problem_.rounding_error(response.force_on_held_structure);
    return response;
  }

  CondensedProblem& problem_;
  ContactSystem system_;
  const CurveParameter& parameter_;
  ArcLength path_;
  double wanted_;
};

}  // namespace

PeriodicResponse curve_response(CondensedProblem& problem, const ContactLaws& laws,
                                const FrequencySweep& curve, double value, const Eigen::VectorXd& unknown) {
  require_unknown(problem, unknown);
  set_frequency_of(curve, problem);
  ContactSystem system(problem, laws, curve.series_flexibility);
  curve_parameter(curve.parameter).set(system, value);
  return response_at(system, unknown);
}

std::vector<PeriodicResponse> responses_at(CondensedProblem& problem, const ContactLaws& laws,
                                           const FrequencySweep& curve, double value) {
  for (const SweepPoint& point : curve.points) require_unknown(problem, point.unknown);
  std::vector<PeriodicResponse> responses;
  if (curve.points.empty()) return responses;
  set_frequency_of(curve, problem);
  Crossings crossings(problem, laws, curve, value);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const int side = side_of(curve, i, value);
    if (side == 0) responses.push_back(crossings.at(curve.points[i]));
    if (i + 1 == curve.points.size()) break;
    const int sides = side * side_of(curve, i + 1, value);
    if (sides == 0 || (sides > 0 && !may_turn_at(curve, i, value))) continue;
    const CurvePoint here = solution_of(curve, i), next = solution_of(curve, i + 1);
    if (sides < 0) {
      responses.push_back(crossings.between(here, next));
      continue;
    }
    if (const auto turn = crossings.beyond(here, next)) {
      responses.push_back(crossings.between(here, *turn));
      responses.push_back(crossings.between(*turn, next));
    }
  }
  return responses;
}

}  // namespace wavebalance::solvers
