#include "period/step_forces.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace wavebalance::solvers {
namespace {

// The force f = law(u - d f, v - m f) of a law that depends on the velocity, by the regula falsi of Illinois
// between 0 and the force at (u, v), every third step halved: the residual rises with f where no slope is
// negative. At a jump of the law it is the value within.
double implicit_force(const AnyContactLaw& law, double u, double v, double compliance, double mobility,
                      int& evaluations) {
  constexpr int max_steps = 150;
  constexpr double settled = 1e-13;
  double near = 0.0, far = law.force(u, v);
  if (far == 0.0) return 0.0;
  const auto excess = [&](double f) {
    ++evaluations;
    return f - law.force(u - compliance * f, v - mobility * f);
  };
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

std::span<double> rows_of(Eigen::VectorXd& values, Eigen::Index first, Eigen::Index rows) {
  return {values.data() + first, static_cast<std::size_t>(rows)};
}

std::span<const double> rows_of(const Eigen::VectorXd& values, Eigen::Index first, Eigen::Index rows) {
  return {values.data() + first, static_cast<std::size_t>(rows)};
}

// Forces at the end of a step and their reduction of displacements and velocities there, updated for each
// change of one contact's force.
class Forces {
 public:
  Forces(const StepEnd& end, const Eigen::VectorXd& begin)
      : end_(end), begin_(begin), force_(begin), next_(begin), flexibility_(end.compliance.diagonal()) {
    displacement_ = end.displacement - end.compliance * force_;
    if (end.velocity.size() > 0) velocity_ = end.velocity - end.mobility * force_;
  }

  const Eigen::VectorXd& force() const { return force_; }

  int evaluations() const { return evaluations_; }

  // Sets the rows of a law from row `first` on; by how much a force changed.
  double set(const AnyContactLaw& law, Eigen::Index first) {
    const Eigen::Index rows = law.acts_over_period() ? law.rows() : 1;
    ++evaluations_;
    if (law.acts_over_period())
      set_next_with_memory(law, first, rows);
    else
      next_[first] = of_one_instant(law, first);
    double largest = 0.0;
    for (Eigen::Index c = first; c < first + rows; ++c) {
      const double change = next_[c] - force_[c];
      if (change == 0.0) continue;
      largest = std::max(largest, std::abs(change));
      displacement_ -= change * end_.compliance.col(c);
      if (velocity_.size() > 0) velocity_ -= change * end_.mobility.col(c);
      force_[c] = next_[c];
    }
    return largest;
  }

 private:
  double of_one_instant(const AnyContactLaw& law, Eigen::Index c) {
    const double d = flexibility_[c], u = displacement_[c] + d * force_[c];
    if (velocity_.size() > 0 && law.depends_on_velocity()) {
      const double m = end_.mobility(c, c);
      return implicit_force(law, u, velocity_[c] + m * force_[c], d, m, evaluations_);
    }
    return d > 0.0 ? law.resolvent(u, d).force : law.force(u);
  }

  void set_next_with_memory(const AnyContactLaw& law, Eigen::Index first, Eigen::Index rows) {
    const auto flexibility = rows_of(std::as_const(flexibility_), first, rows);
    without_ = displacement_.segment(first, rows) +
               flexibility_.segment(first, rows).cwiseProduct(force_.segment(first, rows));
    next_.segment(first, rows) = begin_.segment(first, rows);
    if (end_.before.size() == 0)
      law.start({without_.data(), flexibility.size()}, flexibility, rows_of(next_, first, rows));
    else
      law.advance(rows_of(end_.before, first, rows), {without_.data(), flexibility.size()}, flexibility,
                  rows_of(next_, first, rows));
  }

  const StepEnd& end_;
  const Eigen::VectorXd& begin_;
  Eigen::VectorXd force_, next_, flexibility_;
  Eigen::VectorXd displacement_, velocity_;  // under the forces
  Eigen::VectorXd without_;                  // displacements of a law's rows without its own forces
  int evaluations_ = 0;
};

}  // namespace

StepForces step_forces(const ContactLaws& laws, const StepEnd& end, const Eigen::VectorXd& begin) {
  constexpr int max_rounds = 200;
  constexpr double settled = 1e-12;
  Forces forces(end, begin);
  for (int round = 0; round < max_rounds; ++round) {
    double change = 0.0;
    for (Eigen::Index c = 0; c < begin.size();) {
      const AnyContactLaw& law = laws[static_cast<int>(c)];
      change = std::max(change, forces.set(law, c));
      c += law.acts_over_period() ? law.rows() : 1;
    }
    if (begin.size() == 1 || !(change > settled * forces.force().cwiseAbs().maxCoeff())) break;
  }
  return {forces.force(), forces.evaluations()};
}

}  // namespace wavebalance::solvers
