#include "period/step_forces.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace wavebalance::solvers {
namespace {

// The force f = law(u - d f, v - m f) of a law that depends on the velocity, by the regula falsi of Illinois
// between 0 and the force at (u, v), every third step halved: the residual rises with f where no slope is
// negative. At a jump of the law it is the value within.
double implicit_force(const AnyContactLaw& law, double u, double v, double compliance, double mobility) {
  constexpr int max_steps = 150;
  constexpr double settled = 1e-13;
  double near = 0.0, far = law.force(u, v);
  if (far == 0.0) return 0.0;
  const auto excess = [&](double f) { return f - law.force(u - compliance * f, v - mobility * f); };
  double near_excess = -far, far_excess = excess(far);
  for (int i = 1; i <= max_steps && far_excess != 0.0; ++i) {
    const bool halve = i % 3 == 0 || far_excess == near_excess;
    const double share = halve ? 0.5 : far_excess / (far_excess - near_excess);
    const double middle = far - share * (far - near), now = excess(middle);
    if (std::abs(now) <= settled * std::abs(middle) || std::abs(far - near) <= settled * std::abs(far))
      return middle;
    if (now * far > 0.0) {
      far = middle;
      far_excess = now;
      near_excess *= 0.5;
    } else {
      near = middle;
      near_excess = now;
      far_excess *= 0.5;
    }
  }
  return far;
}

// The force of row c of a law of one instant.
double force_of_row(const AnyContactLaw& law, const StepEnd& end, Eigen::Index c,
                    const Eigen::VectorXd& force) {
  const double d = end.compliance(c, c);
  const double u = end.displacement[c] - end.compliance.row(c).dot(force) + d * force[c];
  if (end.velocity.size() > 0 && law.depends_on_velocity()) {
    const double m = end.mobility(c, c);
    const double v = end.velocity[c] - end.mobility.row(c).dot(force) + m * force[c];
    return implicit_force(law, u, v, d, m);
  }
  return d > 0.0 ? law.resolvent(u, d).force : law.force(u);
}

// The forces of the rows of a law with memory from row `first` on.
Eigen::VectorXd forces_of_rows(const AnyContactLaw& law, const StepEnd& end, Eigen::Index first,
                               const Eigen::VectorXd& begin, const Eigen::VectorXd& force) {
  const Eigen::Index rows = law.rows();
  const auto span_of = [&](const Eigen::VectorXd& values) {
    return std::span<const double>(values.data(), static_cast<std::size_t>(values.size()));
  };
  const Eigen::VectorXd flexibility = end.compliance.diagonal().segment(first, rows);
  const Eigen::VectorXd v = end.displacement.segment(first, rows) -
                            end.compliance.middleRows(first, rows) * force +
                            flexibility.cwiseProduct(force.segment(first, rows));
  Eigen::VectorXd next = begin.segment(first, rows);
  const std::span<double> result(next.data(), static_cast<std::size_t>(rows));
  if (end.before.size() == 0) {
    law.start(span_of(v), span_of(flexibility), result);
  } else {
    const Eigen::VectorXd before = end.before.segment(first, rows);
    law.advance(span_of(before), span_of(v), span_of(flexibility), result);
  }
  return next;
}

}  // namespace

Eigen::VectorXd step_forces(const ContactLaws& laws, const StepEnd& end, const Eigen::VectorXd& begin) {
  constexpr int max_rounds = 200;
  constexpr double settled = 1e-12;
  Eigen::VectorXd force = begin;
  for (int round = 0; round < max_rounds; ++round) {
    double change = 0.0;
    for (Eigen::Index c = 0; c < force.size();) {
      const AnyContactLaw& law = laws[static_cast<int>(c)];
      if (law.acts_over_period()) {
        const Eigen::VectorXd next = forces_of_rows(law, end, c, begin, force);
        change = std::max(change, (next - force.segment(c, next.size())).cwiseAbs().maxCoeff());
        force.segment(c, next.size()) = next;
        c += next.size();
      } else {
        const double next = force_of_row(law, end, c, force);
        change = std::max(change, std::abs(next - force[c]));
        force[c++] = next;
      }
    }
    if (force.size() == 1 || !(change > settled * force.cwiseAbs().maxCoeff())) break;
  }
  return force;
}

}  // namespace wavebalance::solvers
