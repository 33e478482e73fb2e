#include "response/free_balance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {
namespace {

// min ||A x - b|| over x >= 0 by the active set of Lawson and Hanson; the residual b - A x.
Eigen::VectorXd nonnegative_residual(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  std::vector<Eigen::Index> active;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols()), residual = b;
  const double negligible = 1e-12 * b.norm() * a.norm();
  for (Eigen::Index round = 0; round < 3 * a.cols(); ++round) {
    Eigen::VectorXd gain = a.transpose() * residual;
    for (const Eigen::Index i : active) gain[i] = 0.0;
    Eigen::Index next = 0;
    if (gain.size() == 0 || !(gain.maxCoeff(&next) > negligible)) break;
    active.push_back(next);
    while (!active.empty()) {
      const Eigen::VectorXd full = detail::least_squares(a(Eigen::all, active), b);
      double share = 1.0;
      for (std::size_t i = 0; i < active.size(); ++i)
        if (const double from = x[active[i]], to = full[Eigen::Index(i)]; to <= 0.0)
          share = std::min(share, from / (from - to));
      for (std::size_t i = 0; i < active.size(); ++i)
        x[active[i]] += share * (full[Eigen::Index(i)] - x[active[i]]);
      if (share >= 1.0) break;
      const double zero = 1e-14 * x.maxCoeff();
      std::erase_if(active, [&](Eigen::Index i) { return x[i] <= zero; });
      for (Eigen::Index i = 0; i < x.size(); ++i)
        if (x[i] <= zero) x[i] = 0.0;
    }
    residual = b - a * x;
  }
  return residual;
}

// The mean forces along the rigid motions less those that balance the static load, at a shift of them.
class MeanForce {
 public:
  MeanForce(const CondensedProblem& problem, const ContactLaws& laws, bool moving)
      : problem_(problem),
        laws_(laws),
        wanted_(problem.balancing_force()),
        motion_(problem.linear_response()) {
    for (int c = 0; c < problem.contacts() && !moving; ++c) {
      auto samples = motion_.segment(c * problem.points(), problem.points());
      samples.setConstant(samples.mean());
    }
  }

  double along(Eigen::Index direction, const Eigen::VectorXd& shift) {
    evaluate(shift);
    const Eigen::VectorXd mean = force_.reshaped(problem_.points(), problem_.contacts()).colwise().mean();
    return problem_.rigid_directions().col(direction).dot(mean) - wanted_[direction];
  }
  const Eigen::VectorXd& evaluate(const Eigen::VectorXd& shift) {
    const Eigen::VectorXd moved = problem_.rigid_directions() * shift;
    unknown_ = motion_;
    for (int c = 0; c < problem_.contacts(); ++c)
      unknown_.segment(c * problem_.points(), problem_.points()).array() += moved[c];
    force_.resize(unknown_.size());
    tangent_.resize(unknown_.size());
    laws_.evaluate(problem_.contacts(), unknown_, force_, tangent_);
    return force_;
  }
  const Eigen::VectorXd& unknown() const { return unknown_; }

 private:
  const CondensedProblem& problem_;
  const ContactLaws& laws_;
  Eigen::VectorXd wanted_, motion_, unknown_, force_, tangent_;
};

// Moves shift[i] to where the mean force, which grows with it, is negligible, or leaves it where there is no
// such place. `length` is a length of the motion.
void balance_one(MeanForce& force, Eigen::Index i, double length, double negligible, Eigen::VectorXd& shift) {
  const auto at = [&](double value) {
    shift[i] = value;
    const double found = force.along(i, shift);
    return std::isfinite(found) ? found : std::copysign(1e300, value);
  };
  const double start = shift[i], first = at(start);
  if (std::abs(first) <= negligible) return;
  const double way = first < 0.0 ? 1.0 : -1.0;
  constexpr int doublings = 60, halvings = 60;
  double near = start, far = start;
  bool found = false;
  for (int k = 0; k < doublings && !found; ++k) {
    far = start + way * std::ldexp(length, k - 20);
    found = way * at(far) >= -negligible;
    if (!found) near = far;
  }
  shift[i] = start;
  if (!found) return;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (near + far);
    (way * at(middle) >= -negligible ? far : near) = middle;
  }
  shift[i] = far;
}

}  // namespace

bool static_load_is_balanced(const CondensedProblem& problem, const ContactLaws& laws) {
  if (!problem.drift_is_balanced()) return false;
  const Eigen::MatrixXd& directions = problem.rigid_directions();
  const Eigen::VectorXd wanted = problem.balancing_force();
  std::vector<Eigen::VectorXd> forces;
  for (int c = 0; c < problem.contacts(); ++c) {
    if (!std::isfinite(laws[c].gap())) continue;
    forces.push_back(directions.row(c).transpose());
    if (!laws[c].unilateral()) forces.push_back(-directions.row(c).transpose());
  }
  Eigen::MatrixXd columns(directions.cols(), Eigen::Index(forces.size()));
  for (std::size_t i = 0; i < forces.size(); ++i) columns.col(Eigen::Index(i)) = forces[i];
  // relative to the force of the holding springs in the motion without contact
  constexpr double rounding = 1e-9;
  return nonnegative_residual(columns, wanted).norm() <= rounding * problem.spring_force();
}

BalancedMotion balanced_motion(const CondensedProblem& problem, const ContactLaws& laws,
                               const Eigen::VectorXd& series_flexibility, bool moving) {
  const bool forces = series_flexibility.size() > 0;
  const ContactLaws own = forces ? laws.resolvents(series_flexibility) : laws;
  MeanForce mean(problem, own, moving);
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(problem.rigid_directions().cols());
  const double length = std::max(problem.linear_response().cwiseAbs().maxCoeff(), laws.largest_gap());
  constexpr int rounds = 20;
  for (int round = 0; round < (shift.size() > 1 ? rounds : 1) && length > 0.0; ++round)
    for (Eigen::Index i = 0; i < shift.size(); ++i)
      balance_one(mean, i, length, 1e-9 * problem.spring_force(), shift);
  BalancedMotion motion;
  motion.force = mean.evaluate(shift);
  motion.displacement = mean.unknown();
  for (int c = 0; c < problem.contacts() && forces; ++c)
    motion.displacement.segment(c * problem.points(), problem.points()) -=
        series_flexibility[c] * motion.force.segment(c * problem.points(), problem.points());
  return motion;
}

}  // namespace wavebalance::solvers
