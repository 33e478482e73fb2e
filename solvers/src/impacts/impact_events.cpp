#include "impacts/impact_events.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "linalg/index.hpp"
#include "linalg/root.hpp"
#include "wavebalance/solvers/impacts/impact_stability.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;
using PlaceValue = std::function<double(const ImpactPlace&)>;

// The product of all 1 - place * multiplier, place 1 or -1, which changes its sign where a real one passes.
double real_product(const Eigen::VectorXcd& multipliers, double place) {
  Complex product = 1.0;
  for (const Complex multiplier : multipliers) product *= 1.0 - place * multiplier;
  return product.real();
}

// Of those on the circle the one beside a place of it, Im >= 0.
Complex multiplier_beside(const Eigen::VectorXcd& multipliers, Complex place) {
  Complex best(missing, missing);
  double distance = std::numeric_limits<double>::infinity();
  for (const Complex multiplier : multipliers)
    if (std::abs(multiplier - place) < distance) {
      distance = std::abs(multiplier - place);
      best = {multiplier.real(), std::abs(multiplier.imag())};
    }
  return best;
}

// The multiplier with an imaginary part that is nearest to the circle.
Complex complex_beside(const Eigen::VectorXcd& multipliers) {
  constexpr double real = 1e-9;
  Complex best(missing, missing);
  for (const Complex multiplier : multipliers)
    if (multiplier.imag() > real && !(std::abs(std::abs(multiplier) - 1.0) >= std::abs(std::abs(best) - 1.0)))
      best = multiplier;
  return best;
}

// Seeks zeros within one step.
class StepZeros {
 public:
  StepZeros(ImpactPath& path, const ImpactPlace& last, double step) : path_(path), last_(last), step_(step) {}

  // Appends the place where a function of the places is zero that differs in sign at the ends.
  void add(SpecialPointType type, const PlaceValue& function, double at_last, double at_next,
           Complex beside) {
    constexpr double rounding = 1e-13, on_circle = 1e-6;
    if (!(at_last * at_next < 0.0)) return;
    const auto value = [&](double step) {
      const std::optional<ImpactPlace> place = path_.ahead(last_.point, step);
      return place && place->motion.converged() ? function(*place) : missing;
    };
    const std::optional<double> at = root(value, {0.0, at_last}, {step_, at_next}, rounding);
    if (!at) return;
    const std::optional<ImpactPlace> place = path_.ahead(last_.point, *at);
    if (!place || !place->motion.converged()) return;
    const Eigen::VectorXcd multipliers = impact_multipliers(place->motion);
    const bool pair = type == SpecialPointType::neimark_sacker;
    const Complex multiplier = pair ? complex_beside(multipliers) : multiplier_beside(multipliers, beside);
    // A pair that meets on the real axis is no pair behind it, so that another one is then nearest to the
    // circle.
    if (pair && !(std::abs(std::abs(multiplier) - 1.0) <= on_circle)) return;
    found_.push_back({*at, {type, place->point.parameter, multiplier, place->motion, 0}});
  }

  std::vector<ImpactEvent> in_order() {
    std::ranges::stable_sort(found_, {}, &Found::step);
    std::vector<ImpactEvent> events;
    for (Found& one : found_) events.push_back(std::move(one.event));
    return events;
  }

 private:
  struct Found {
    double step;
    ImpactEvent event;
  };
  ImpactPath& path_;
  const ImpactPlace& last_;
  double step_;
  std::vector<Found> found_;
};

double beyond_circle(const Eigen::VectorXcd& multipliers) {
  return std::abs(complex_beside(multipliers)) - 1.0;
}

}  // namespace

std::vector<ImpactEvent> impact_events(ImpactPath& path, const ImpactPlace& last, const ImpactPlace& next,
                                       double step, const Eigen::VectorXcd& of_last,
                                       const Eigen::VectorXcd& of_next) {
  StepZeros zeros(path, last, step);
  const double slope = last.point.parameter_tangent, next_slope = next.point.parameter_tangent;
  zeros.add(
      SpecialPointType::fold, [](const ImpactPlace& at) { return at.point.parameter_tangent; }, slope,
      next_slope, 1.0);
  if (of_last.size() == 0 || of_next.size() == 0) return zeros.in_order();
  const auto product = [](double place) {
    return [place](const ImpactPlace& at) { return real_product(impact_multipliers(at.motion), place); };
  };
  if (slope * next_slope > 0.0)
    zeros.add(SpecialPointType::branch, product(1.0), real_product(of_last, 1.0), real_product(of_next, 1.0),
              1.0);
  zeros.add(SpecialPointType::period_doubling, product(-1.0), real_product(of_last, -1.0),
            real_product(of_next, -1.0), -1.0);
  zeros.add(
      SpecialPointType::neimark_sacker,
      [](const ImpactPlace& at) { return beyond_circle(impact_multipliers(at.motion)); },
      beyond_circle(of_last), beyond_circle(of_next), 1.0);
  return zeros.in_order();
}

}  // namespace wavebalance::solvers::detail
