#include "exact/exact_events.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// A special point by its place between two neighbours, and the motion there.
struct Located {
  SpecialPointType type;
  PathPoint point;
  std::complex<double> multiplier;
};

// The product of all 1 + sign multiplier, which is smooth and changes its sign where a real one passes.
double product_of(const Eigen::VectorXcd& multipliers, double sign) {
  std::complex<double> product = 1.0;
  for (const std::complex<double> multiplier : multipliers) product *= 1.0 + sign * multiplier;
  return multipliers.size() > 0 ? product.real() : missing;
}

// The modulus of the multiplier of that number, the largest first, less 1.
double beyond_circle(const PathPoint& point, Index number) {
  const Eigen::VectorXcd multipliers = point.motion.multipliers();
  return number < multipliers.size() ? std::abs(multipliers[number]) - 1.0 : missing;
}

std::complex<double> upper(std::complex<double> multiplier) {
  return {multiplier.real(), std::abs(multiplier.imag())};
}

// A step of a curve and an unknown that changes monotonically along it.
struct Step {
  const PathModel& model;
  const PathPoint &a, &b;
  Held held;

  std::optional<PathPoint> zero(const std::function<double(const PathPoint&)>& function) const {
    return zero_between(model, a, b, held, function);
  }
};

void append_real(std::vector<Located>& found, const Step& step, const Eigen::VectorXcd& of_a,
                 const Eigen::VectorXcd& of_b, double sign, SpecialPointType type) {
  if (!(product_of(of_a, sign) * product_of(of_b, sign) < 0.0)) return;
  std::optional<PathPoint> at =
      step.zero([sign](const PathPoint& point) { return product_of(point.motion.multipliers(), sign); });
  if (!at) return;
  const std::complex<double> multiplier = nearest(at->motion.multipliers(), -sign);
  found.push_back({type, std::move(*at), multiplier});
}

// Multipliers outside the circle but the one that passes it at a place on the real axis.
int unstable_beside(const Located& at) {
  constexpr double near = 1e-3;
  int count = 0;
  for (const std::complex<double> multiplier : at.point.motion.multipliers())
    if (std::abs(multiplier) > 1.0 && std::abs(multiplier - at.multiplier) > near) ++count;
  return count;
}

// Where a complex pair passes the circle, between two places with so many multipliers outside. One that
// passes it on the real axis at a place may be among them or not.
void append_pair(std::vector<Located>& found, const Step& step, int before, int after) {
  constexpr double real = 1e-9;
  if (before < 0 || after < 0 || std::abs(after - before) < 2) return;
  for (int number = std::min(before, after); number < std::max(before, after); ++number) {
    std::optional<PathPoint> at =
        step.zero([number](const PathPoint& point) { return beyond_circle(point, number); });
    if (!at) continue;
    const std::complex<double> multiplier = upper(at->motion.multipliers()[number]);
    if (multiplier.imag() <= real) continue;
    found.push_back({SpecialPointType::neimark_sacker, std::move(*at), multiplier});
    return;
  }
}

void sort(std::vector<Located>& found) {
  std::sort(found.begin(), found.end(),
            [](const Located& x, const Located& y) { return x.point.place < y.point.place; });
}

void append_pairs(std::vector<Located>& found, const Step& step, int of_a, int of_b) {
  sort(found);
  std::vector<Located> pairs;
  const PathPoint* last = &step.a;
  int before = of_a;
  for (const Located& one : found) {
    const int beside = unstable_beside(one);
    append_pair(pairs, {step.model, *last, one.point, step.held}, before, beside);
    last = &one.point;
    before = beside;
  }
  append_pair(pairs, {step.model, *last, step.b, step.held}, before, of_b);
  std::move(pairs.begin(), pairs.end(), std::back_inserter(found));
  sort(found);
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

int unstable_of(const Eigen::VectorXcd& multipliers) {
  if (multipliers.size() == 0) return -1;
  return static_cast<int>((multipliers.array().abs() > 1.0).count());
}

std::vector<ExactEvent> events_between(const PathModel& model, const PathPoint& a, const PathPoint& b,
                                       const Eigen::VectorXcd& of_a, const Eigen::VectorXcd& of_b) {
  std::vector<Located> found;
  const bool turns = a.slope() * b.slope() < 0.0;
  const Step step{model, a, b, model.fastest(a, !turns)};
  if (turns) {
    std::optional<PathPoint> at = step.zero([](const PathPoint& point) { return point.slope(); });
    if (at) {
      const std::complex<double> multiplier = nearest(at->motion.multipliers(), 1.0);
      found.push_back({SpecialPointType::fold, std::move(*at), multiplier});
    }
  } else {
    append_real(found, step, of_a, of_b, -1.0, SpecialPointType::branch);
  }
  append_real(found, step, of_a, of_b, 1.0, SpecialPointType::period_doubling);
  append_pairs(found, step, unstable_of(of_a), unstable_of(of_b));
  std::vector<ExactEvent> events;
  for (Located& one : found)
    events.push_back({one.type, one.point.value, one.multiplier, std::move(one.point.motion)});
  return events;
}

}  // namespace wavebalance::solvers::detail
