#include "wavebalance/solvers/balance/contact_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavebalance::solvers {
namespace {

struct NoContact {
  double force(double) const { return 0.0; }
  double tangent(double) const { return 0.0; }
  double potential(double) const { return 0.0; }
  double gap() const { return std::numeric_limits<double>::infinity(); }
  bool unilateral() const { return true; }
  ForceSlope resolvent(double, double) const { return {}; }
};

}  // namespace

AnyContactLaw::AnyContactLaw() : AnyContactLaw(NoContact{}) {}

double AnyContactLaw::force(double displacement) const { return model_->force(displacement); }
double AnyContactLaw::tangent(double displacement) const { return model_->tangent(displacement); }
double AnyContactLaw::potential(double displacement) const { return model_->potential(displacement); }

void AnyContactLaw::refuse_instant() {
  throw std::invalid_argument(
      "a contact law acts over a period, and what was asked for needs the force of one instant; responses and "
      "sweeps in the displacement form take such laws");
}

void AnyContactLaw::refuse_steps() {
  throw std::invalid_argument(
      "a contact law acts over a period and cannot go on step by step, as integration in time needs it to");
}

bool AnyContactLaw::is_rigid() const {
  if (acts_over_period()) return model_->is_rigid_over_period();
  const double at = gap();
  return std::isfinite(at) && std::isinf(tangent(at));
}

// Newton on r(u) = u + c force(u) - v, which rises with slope 1 + c tangent, from v within the bracket that
// its signs make, down to rounding; halves it where a step leaves it. A force that opposes the displacement
// keeps u between v and the first point at which the force is zero, which doubling finds.
ForceSlope AnyContactLaw::solve_resolvent(const Interface& law, double v, double flexibility) {
  constexpr int max_iterations = 200;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const auto slope = [&](double tangent) {
    return tangent != 0.0 ? 1.0 / (1.0 / tangent + flexibility) : 0.0;
  };
  ForceSlopes now = law.at(v, 0.0);
  const double first = flexibility * now.force;
  if (first == 0.0) return {now.force, slope(now.tangent)};
  if (std::isnan(first)) return {first, first};
  // r(v) = c force(v) has the sign of the force: the other end of the bracket lies on the other side of v.
  const double outward = first > 0.0 ? -1.0 : 1.0;
  double near = v, far = v;
  double reach = std::min(std::abs(first), std::max(std::abs(v - law.gap()), eps * std::abs(v)));
  if (!(reach > 0.0)) reach = std::abs(first);
  for (int i = 0; i < max_iterations; ++i, reach *= 2.0) {
    far = v + outward * reach;
    if ((far + flexibility * law.force(far) - v) * outward >= 0.0) break;
    near = far;
  }
  double u = v, r = first, step = 2.0 * std::abs(far - near);
  for (int i = 0; i < max_iterations && std::abs(r) > eps * std::abs(v); ++i) {
    const double newton = u - r / (1.0 + flexibility * now.tangent);
    const bool inside = (newton - near) * (newton - far) <= 0.0 && std::abs(newton - u) <= 0.5 * step;
    const double next = inside ? newton : 0.5 * (near + far);
    step = std::abs(next - u);
    u = next;
    now = law.at(u, 0.0);
    if (step <= eps * std::abs(u)) break;
    r = u + flexibility * now.force - v;
    (r * outward < 0.0 ? near : far) = u;
  }
  // The softer of law and spring gives the force without cancellation.
  const bool soft = std::abs(v - u) < 0.5 * std::abs(v - law.gap());
  return {soft ? now.force : (v - u) / flexibility, slope(now.tangent)};
}

bool AnyContactLaw::vanishes_below_gap(const Interface& law) {
  const double gap = law.gap();
  if (!std::isfinite(gap)) return gap > 0.0;
  const double scale = gap != 0.0 ? std::abs(gap) : 1.0;
  for (double distance = 1e-9 * scale; distance <= 1e9 * scale; distance *= 10.0)
    for (const double velocity : {0.0, -scale, scale, -1.0, 1.0})
      if (law.at(gap - distance, velocity).force != 0.0 || law.at(gap + distance, velocity).force < 0.0)
        return false;
  return true;
}

std::vector<double> AnyContactLaw::kinks_of(const Interface& law) {
  const double gap = law.gap();
  if (!std::isfinite(gap)) return {};
  if (law.unilateral()) return {gap};
  const auto jumps = [&](double at) {
    constexpr double rounding = 1e-9;
    const double below = law.tangent(std::nextafter(at, -std::numeric_limits<double>::infinity()));
    const double beyond = law.tangent(std::nextafter(at, std::numeric_limits<double>::infinity()));
    return std::abs(beyond - below) > rounding * std::max(std::abs(beyond), std::abs(below));
  };
  std::vector<double> kinks;
  for (const double at : {-std::abs(gap), std::abs(gap)})
    if (jumps(at) && (kinks.empty() || kinks.back() != at)) kinks.push_back(at);
  return kinks;
}

}  // namespace wavebalance::solvers
