#include "complementarity/josephy_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "complementarity/lcp_homotopy.hpp"
#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {
namespace {

// The displacement at which a law has the force `force` > 0; NaN if there is none. Newton's method within a
// bracket, with bisection when a step is not half of the one before, because Newton alone takes thousands of
// equal steps on a steep exponential.
double inverse(const AnyContactLaw& law, double force) {
  constexpr int most = 200;
  double low = law.gap(), width = force / law.tangent(low);
  int doublings = 0;
  while (law.force(low + width) < force && ++doublings < most) width *= 2.0;
  if (doublings == most) return std::numeric_limits<double>::quiet_NaN();
  double high = low + width, u = high, step = width;
  for (int i = 0; i < most && high > low; ++i) {
    const double excess = law.force(u) - force;
    if (excess == 0.0) return u;
    (excess > 0.0 ? high : low) = u;
    const double next = u - excess / law.tangent(u);
    const bool falls = next > low && next < high && std::abs(next - u) <= 0.5 * step;
    const double before = std::exchange(u, falls ? next : 0.5 * (low + high));
    step = std::abs(u - before);
    if (step == 0.0) return u;
  }
  return u;
}

bool starts_with_a_slope(const AnyContactLaw& law) {
  if (!std::isfinite(law.gap())) return true;
  const double slope = law.tangent(law.gap());
  return std::isfinite(slope) && slope > std::numeric_limits<double>::min() && law.force(law.gap()) == 0.0;
}

class LawObstacles {
 public:
  explicit LawObstacles(ContactSystem& system)
      : system_(system), free_(system.problem().contact_free_response()) {}

  bool usable() const {
    for (int c = 0; c < system_.problem().contacts(); ++c)
      if (!starts_with_a_slope(system_.laws()[c])) return false;
    return true;
  }

  // The laws' tangents at given forces; at their gaps where the force is zero.
  Obstacles tangents(const Eigen::VectorXd& force) const {
    Obstacles result{-free_, Eigen::VectorXd::Zero(free_.size())};
    for (int l = 0; l < free_.size(); ++l) {
      const AnyContactLaw& law = system_.law_at(l);
      result.gap_without_force[l] += law.gap();
      if (!std::isfinite(law.gap())) continue;
      const double u = force[l] > 0.0 ? inverse(law, force[l]) : law.gap(), penetration = u - law.gap();
      // If the law is too steep for double precision at this force, its secant is used.
      const bool resolved = std::abs(law.force(u) - force[l]) <= 0.5 * force[l];
      result.flexibility[l] = resolved ? 1.0 / law.tangent(u) : penetration / force[l];
      if (force[l] > 0.0) result.gap_without_force[l] += penetration - force[l] * result.flexibility[l];
    }
    return result;
  }

  void measure(LawForce& found) const {
    Eigen::VectorXd product;
    system_.problem().apply(found.force, product);
    found.displacement = free_ - product;
    double worst = 0.0, slope = 0.0;
    for (int l = 0; l < free_.size(); ++l) {
      const AnyContactLaw& law = system_.law_at(l);
      const double f = found.force[l], u = found.displacement[l];
      const double at = f > 0.0 ? inverse(law, f) : law.gap();
      const double miss = f > 0.0 ? std::abs(u - at) : std::max(0.0, u - at);
      if (f > 0.0) slope = std::max(slope, law.tangent(at));
      worst = std::isnan(miss) ? std::numeric_limits<double>::infinity() : std::max(worst, miss);
    }
    const double scale = free_.cwiseAbs().maxCoeff() + product.cwiseAbs().maxCoeff();
    found.defect = relative_to(scale, worst);
    const double largest = found.force.maxCoeff();
    constexpr double eps = std::numeric_limits<double>::epsilon();
    found.rounding = largest > 0.0 ? eps * found.displacement.cwiseAbs().maxCoeff() * (slope / largest) : 0.0;
  }

 private:
  ContactSystem& system_;
  const Eigen::VectorXd& free_;
};

}  // namespace

LawForce josephy_newton(ContactSystem& system, const ComplementarityOptions& options, Observer observer) {
  constexpr int rounds = 10;
  constexpr double settled = 1e-14;
  LawForce best;
  const LawObstacles laws(system);
  if (!laws.usable()) return best;
  LcpHomotopy obstacles(system.problem(), options, std::move(observer));
  const auto note = [&](LawForce& result) {
    result.force = obstacles.force();
    result.condition = obstacles.condition();
    laws.measure(result);
  };
  best.found = obstacles.solve(laws.tangents(Eigen::VectorXd::Zero(system.problem().samples())));
  best.status = obstacles.status();
  best.strategy = obstacles.strategy();
  if (best.found) note(best);
  for (int round = 0; best.found && round < rounds && best.defect > settled; ++round) {
    const Obstacles tangents = laws.tangents(best.force);
    if (!obstacles.follow(tangents) && !obstacles.solve(tangents)) break;
    LawForce next;
    next.found = true;
    next.status = best.status;
    next.strategy = best.strategy;
    note(next);
    if (!(next.defect < best.defect)) break;
    best = std::move(next);
  }
  best.pivots = obstacles.pivots();
  return best;
}

}  // namespace wavebalance::solvers
