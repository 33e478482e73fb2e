#include "exact/exact_events.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

struct Located {
  double place;
  ExactEvent event;
};

// The modulus of the multiplier of that number, the largest first, less 1.
double beyond_circle(const PathPoint& point, Index number) {
  const Eigen::VectorXcd multipliers = point.motion.multipliers();
  return number < multipliers.size() ? std::abs(multipliers[number]) - 1.0 : missing;
}

SpecialPointType type_of(std::complex<double> multiplier) {
  constexpr double real = 1e-7;
  if (std::abs(multiplier.imag()) > real) return SpecialPointType::neimark_sacker;
  return multiplier.real() < 0.0 ? SpecialPointType::period_doubling : SpecialPointType::branch;
}

std::complex<double> upper(std::complex<double> multiplier) {
  return {multiplier.real(), std::abs(multiplier.imag())};
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
  const Held held = model.fastest(a, !turns);
  if (turns) {
    const std::optional<PathPoint> fold =
        zero_between(model, a, b, held, [](const PathPoint& point) { return point.slope(); });
    if (fold)
      found.push_back(
          {fold->place,
           {SpecialPointType::fold, fold->value, nearest(fold->motion.multipliers(), 1.0), fold->motion}});
  }
  const int before = unstable_of(of_a), after = unstable_of(of_b);
  const bool known = before >= 0 && after >= 0;
  for (int number = std::min(before, after); known && number < std::max(before, after); ++number) {
    const std::optional<PathPoint> crossing = zero_between(
        model, a, b, held, [number](const PathPoint& point) { return beyond_circle(point, number); });
    if (!crossing) continue;
    const std::complex<double> multiplier = upper(crossing->motion.multipliers()[number]);
    const SpecialPointType type = type_of(multiplier);
    const bool is_fold = type == SpecialPointType::branch && turns;
    const bool is_second =
        !found.empty() && type == SpecialPointType::neimark_sacker && found.back().event.type == type;
    if (!is_fold && !is_second)
      found.push_back({crossing->place, {type, crossing->value, multiplier, crossing->motion}});
  }
  std::sort(found.begin(), found.end(), [](const Located& x, const Located& y) { return x.place < y.place; });
  std::vector<ExactEvent> events;
  for (Located& one : found) events.push_back(std::move(one.event));
  return events;
}

}  // namespace wavebalance::solvers::detail
