#include "exact/exact_events.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The product of all 1 + sign multiplier, which is smooth and changes its sign where a real one passes.
double product_of(const Eigen::VectorXcd& multipliers, double sign) {
  std::complex<double> product = 1.0;
  for (const std::complex<double> multiplier : multipliers) product *= 1.0 + sign * multiplier;
  return multipliers.size() > 0 ? product.real() : missing;
}

// The modulus of the multiplier of that number, the largest first, less 1.
double beyond_circle(const CurvePoint& point, Index number) {
  const Eigen::VectorXcd multipliers = point.motion.multipliers();
  return number < multipliers.size() ? std::abs(multipliers[number]) - 1.0 : missing;
}

std::complex<double> upper(std::complex<double> multiplier) {
  return {multiplier.real(), std::abs(multiplier.imag())};
}

// A step of a curve.
struct Step {
  const CurvePath& path;
  const CurvePoint &a, &b;
  bool turns;

  PointOnCurve zero(const std::function<double(const CurvePoint&)>& function) const {
    return zero_between(path, a, b, turns, function);
  }
};

void append_real(std::vector<PlacedEvent>& found, const Step& step, const Eigen::VectorXcd& of_a,
                 const Eigen::VectorXcd& of_b, double sign, SpecialPointType type) {
  if (!(product_of(of_a, sign) * product_of(of_b, sign) < 0.0)) return;
  const PointOnCurve at =
      step.zero([sign](const CurvePoint& point) { return product_of(point.motion.multipliers(), sign); });
  if (!at) return;
  const std::complex<double> multiplier = nearest(at->motion.multipliers(), -sign);
  found.push_back({type, at, at->value, multiplier});
}

// Multipliers that pass the circle at a place, and the numbers outside it on both sides.
struct Passing {
  int beside = 0, near = 0;
};

Passing passing(const PlacedEvent& at) {
  constexpr double near = 1e-3;
  Passing counts;
  for (const std::complex<double> multiplier : at.point->motion.multipliers()) {
    const bool passes = std::abs(upper(multiplier) - at.multiplier) <= near;
    counts.near += passes;
    counts.beside += !passes && lies_outside_circle(multiplier);
  }
  return counts;
}

// Where a complex pair passes the circle, between two places with so many multipliers outside. One that
// passes it on the real axis at a place may be among them or not.
void append_pair(std::vector<PlacedEvent>& found, const Step& step, int before, int after) {
  constexpr double real = 1e-9;
  if (before < 0 || after < 0 || std::abs(after - before) < 2) return;
  for (int number = std::min(before, after); number < std::max(before, after); ++number) {
    const PointOnCurve at =
        step.zero([number](const CurvePoint& point) { return beyond_circle(point, number); });
    if (!at) continue;
    const std::complex<double> multiplier = upper(at->motion.multipliers()[number]);
    if (multiplier.imag() <= real) continue;
    found.push_back({SpecialPointType::neimark_sacker, at, at->value, multiplier});
    return;
  }
}

void sort(std::vector<PlacedEvent>& found) {
  std::sort(found.begin(), found.end(),
            [](const PlacedEvent& x, const PlacedEvent& y) { return x.point->place < y.point->place; });
}

void append_pairs(std::vector<PlacedEvent>& found, const Step& step, int of_a, int of_b) {
  sort(found);
  std::vector<PlacedEvent> pairs;
  const CurvePoint* last = &step.a;
  int before = of_a;
  for (const PlacedEvent& one : found) {
    const int beside = passing(one).beside;
    append_pair(pairs, {step.path, *last, *one.point, step.turns}, before, beside);
    last = one.point.get();
    before = beside;
  }
  append_pair(pairs, {step.path, *last, step.b, step.turns}, before, of_b);
  std::move(pairs.begin(), pairs.end(), std::back_inserter(found));
  sort(found);
}

// The count of multipliers outside the circle, or -1 where one of them is so near to it that rounding
// decides.
int clear_count(const Eigen::VectorXcd& multipliers) {
  constexpr double rounding = 1e-8;
  const bool clear = ((multipliers.array().abs() - 1.0).abs() > rounding).all();
  return clear ? count_outside(multipliers) : -1;
}

// Whether the count changes from one neighbour to the next as it does at the places between them. Where
// several multipliers pass together, or one lies on the circle, nothing is known.
bool is_explained(const std::vector<PlacedEvent>& found, const Eigen::VectorXcd& of_a,
                  const Eigen::VectorXcd& of_b) {
  int count = clear_count(of_a);
  for (const PlacedEvent& one : found) {
    const Passing counts = passing(one);
    const int passes = one.type == SpecialPointType::neimark_sacker ? 2 : 1;
    if (counts.near != passes)
      count = -1;
    else if (count >= 0 && count != counts.beside && count != counts.beside + passes)
      return false;
    else if (count >= 0)
      count = 2 * counts.beside + passes - count;
  }
  const int last = clear_count(of_b);
  return count < 0 || last < 0 || count == last;
}

// Distance of the multipliers from a place on the unit circle.
double distance_from(const Eigen::VectorXcd& multipliers, double place) {
  return (multipliers.array() - place).abs().minCoeff();
}

// Whether a multiplier may pass a place of the circle between two neighbours and come back: it is near at one
// of them, and what is left changes by much of itself; in a whole step it may do so unseen.
bool may_pass_twice(const Eigen::VectorXcd& of_a, const Eigen::VectorXcd& of_b, double place, bool whole) {
  constexpr double near = 0.2, much = 0.5;
  const double a = distance_from(of_a, place), b = distance_from(of_b, place), least = std::min(a, b);
  return least < (whole ? near : much) && (whole || std::abs(a - b) > much * least);
}

// Whether the parameter may turn twice on the way: by the cubic with its values and slopes at both ends.
bool may_turn_twice(const Step& step) {
  constexpr double clear = 0.5;
  const double length = step.b.place - step.a.place, begin = step.a.slope, end = step.b.slope;
  const double middle = 1.5 * (step.b.value - step.a.value) / length - 0.25 * (begin + end);
  return middle * begin < 0.0 || std::abs(middle) < clear * std::min(std::abs(begin), std::abs(end));
}

std::vector<PlacedEvent> places_within(const Step& step, const Eigen::VectorXcd& of_a,
                                       const Eigen::VectorXcd& of_b) {
  std::vector<PlacedEvent> found;
  if (step.a.slope * step.b.slope < 0.0) {
    const PointOnCurve at = step.zero([](const CurvePoint& point) { return point.slope; });
    if (at) {
      const std::complex<double> multiplier = nearest(at->motion.multipliers(), 1.0);
      found.push_back({SpecialPointType::fold, at, at->value, multiplier});
    }
  } else {
    append_real(found, step, of_a, of_b, -1.0, SpecialPointType::branch);
  }
  append_real(found, step, of_a, of_b, 1.0, SpecialPointType::period_doubling);
  if (clear_count(of_a) >= 0 && clear_count(of_b) >= 0)
    append_pairs(found, step, count_outside(of_a), count_outside(of_b));
  else
    sort(found);
  return found;
}

constexpr int most_halvings = 7;

// The same by halves of the step, where the count changes otherwise than by the places found, or places may
// have cancelled each other.
EventsBetween places_between(const CurvePath& path, const CurvePoint& a, const CurvePoint& b,
                             const Eigen::VectorXcd& of_a, const Eigen::VectorXcd& of_b, int halvings) {
  const bool turns = a.slope * b.slope < 0.0;
  const bool known = clear_count(of_a) >= 0 && clear_count(of_b) >= 0;
  const Step step{path, a, b, turns};
  EventsBetween places{places_within(step, of_a, of_b)};
  if (!known) return places;
  places.explained = is_explained(places.events, of_a, of_b);
  const bool whole = halvings == most_halvings;
  const bool clear = places.explained && !may_pass_twice(of_a, of_b, -1.0, whole) &&
                     (turns || (!may_pass_twice(of_a, of_b, 1.0, whole) && !may_turn_twice(step)));
  if (halvings == 0 || clear) return places;
  const PointOnCurve middle = path.between(a, b, 0.5, turns);
  if (!middle || !middle->agrees) return places;
  const Eigen::VectorXcd of_middle = middle->motion.multipliers();
  EventsBetween first = places_between(path, a, *middle, of_a, of_middle, halvings - 1);
  EventsBetween second = places_between(path, *middle, b, of_middle, of_b, halvings - 1);
  first.explained = first.explained && second.explained;
  if (places.explained &&
      (!first.explained || first.events.size() + second.events.size() <= places.events.size()))
    return places;
  std::move(second.events.begin(), second.events.end(), std::back_inserter(first.events));
  return first;
}

}  // namespace

std::complex<double> nearest(const Eigen::VectorXcd& multipliers, std::complex<double> place) {
  std::complex<double> best(missing, missing);
  double distance = std::numeric_limits<double>::infinity();
  for (const std::complex<double> multiplier : multipliers)
    if (std::abs(multiplier - place) < distance) {
      distance = std::abs(multiplier - place);
      best = multiplier;
    }
  return upper(best);
}

EventsBetween events_between(const CurvePath& path, const CurvePoint& a, const CurvePoint& b,
                             const Eigen::VectorXcd& of_a, const Eigen::VectorXcd& of_b) {
  return places_between(path, a, b, of_a, of_b, most_halvings);
}

}  // namespace wavebalance::solvers::detail
