#include "collocation/interval_agreement.hpp"

#include <algorithm>
#include <utility>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr double tiny = 1e-300;

// Whether a rigid contact pushes only, and does not pass the gap.
bool is_complementary(const Eigen::RowVectorXd& displacement, const Eigen::RowVectorXd& force, double gap) {
  constexpr double small = 1e-4;
  const double length = small * displacement.cwiseAbs().maxCoeff(), push = force.cwiseAbs().maxCoeff();
  return (displacement.array() < gap + length).all() && (force.array() >= -small * push).all();
}

}  // namespace

ContactMotion reach(const CollocationModel& model, ContactMotion motion, const Eigen::MatrixXd& force) {
  for (Index c = 0; c < force.rows(); ++c) {
    const LawSegments& law = model.laws[static_cast<std::size_t>(c)];
    if (!law.rigid()) continue;
    const double softness = law.jumps() ? motion.displacement.row(c).cwiseAbs().maxCoeff() /
                                              std::max(force.row(c).cwiseAbs().maxCoeff(), tiny)
                                        : law.yielding().displacement;
    motion.displacement.row(c) += softness * force.row(c);
    if (law.jumps())
      motion.velocity.row(c).setZero();
    else
      motion.velocity.row(c) = periodic_slopes(motion.displacement.row(c));
  }
  return motion;
}

CollocationSolution::CollocationSolution(const CollocationModel& model, CollocationResult solved,
                                         const LegendreNodes& nodes, const Eigen::VectorXd& times,
                                         const ContactMotion& free)
    : newton(std::move(solved)) {
  const PanelForces& forces = newton.iterate.forces;
  const auto period = std::exchange(newton.known, {}).period;
  motion = model.response.motion(period ? *period : *model.response.cells(forces.grid(), nodes),
                                 forces.coefficients(), times);
  motion.displacement = free.displacement - motion.displacement;
  motion.velocity = free.velocity - motion.velocity;
  const bool rigid =
      std::any_of(model.laws.begin(), model.laws.end(), [](const auto& law) { return law.rigid(); });
  const Eigen::MatrixXd force = rigid ? force_at(forces, model, times) : Eigen::MatrixXd();
  reach = detail::reach(model, motion, force);
  intervals_of_motion = layout_of(model.laws, model.frequency, reach.displacement, reach.velocity);
  for (const LawSegments& law : model.laws) {
    const auto c = Index(complementary.size());
    complementary.push_back(law.jumps() &&
                            is_complementary(motion.displacement.row(c), force.row(c), law.breakpoint(0)));
  }
}

bool CollocationSolution::agrees() const {
  bool same = newton.converged;
  for (std::size_t c = 0; c < complementary.size() && same; ++c)
    same =
        complementary[c] || same_intervals(newton.iterate.layout, intervals_of_motion, static_cast<int>(c));
  return same;
}

bool CollocationSolution::is_lost() const {
  constexpr double large = 0.5;
  constexpr std::size_t many = 4;
  const bool astray = intervals_of_motion.intervals.size() > many * newton.iterate.layout.intervals.size();
  return !(newton.residual < large) || (!newton.converged && astray);
}

}  // namespace wavebalance::solvers::detail
