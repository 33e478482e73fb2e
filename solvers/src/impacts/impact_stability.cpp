#include <vector>

#include "impacts/impact_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers {
namespace {

// Effect of an impact on perturbations: alpha b + beta A b is subtracted from the states, alpha =
// velocity_gain v + alpha_gain u and beta = beta_gain u, with displacement u and velocity v of the contact.
struct ImpactSlopes {
  double velocity_gain, alpha_gain, beta_gain;
};

ImpactSlopes slopes_of(const detail::ImpactSolution& motion, std::size_t i) {
  const detail::ImpactModel& model = *motion.model;
  const Impact& impact = motion.impacts[i];
  const int c = impact.contact;
  const Index before = i == 0 ? motion.states.cols() - 1 : Index(i) - 1;
  const Impact& last = motion.impacts[static_cast<std::size_t>(before)];
  const double since = impact.time - last.time + (i == 0 ? 1.0 : 0.0);
  const Eigen::VectorXcd state = model.growth(since * model.period()).cwiseProduct(motion.states.col(before));
  const double acceleration = model.motion(state, impact.time).acceleration[c];
  const double gain = (1.0 + model.restitution()[c]) / model.inverse_mass()(c, c);
  return {gain, -gain * acceleration / impact.velocity_before, impact.impulse / impact.velocity_before};
}

// The impact that the longest flight follows, and how long that is, in periods.
struct LongestFlight {
  std::size_t end = 0;
  double length = 0.0;
};

LongestFlight longest_flight(const detail::ImpactSolution& motion) {
  LongestFlight longest;
  for (std::size_t i = 0; i < motion.impacts.size(); ++i) {
    const double before = i == 0 ? motion.impacts.back().time - 1.0 : motion.impacts[i - 1].time;
    const double length = motion.impacts[i].time - before;
    if (length > longest.length) longest = {i, length};
  }
  return longest;
}

// Map of the remaining states, from right before the impact at the end of the longest flight on.
Eigen::MatrixXd monodromy_of(const detail::ImpactSolution& motion) {
  const PoleStates poles(motion.model->problem().dynamics, motion.model->period());
  const Eigen::MatrixXd impulse = poles.after_impulse(0.0),
                        rate = detail::product(poles.generator(), impulse);  // of the states after it
  const Eigen::MatrixXd displacement = poles.free_motion(0.0), velocity = poles.free_velocity(0.0);
  const LongestFlight longest = longest_flight(motion);
  const std::vector<Index> left = poles.left_after(longest.length);
  Eigen::MatrixXd states = Eigen::MatrixXd::Identity(poles.size(), poles.size())(Eigen::all, left);
  const std::size_t count = motion.impacts.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (longest.end + k) % count, next = (i + 1) % count;
    const int c = motion.impacts[i].contact;
    const ImpactSlopes slopes = slopes_of(motion, i);
    const Eigen::RowVectorXd u = displacement.row(c) * states, v = velocity.row(c) * states;
    states -= impulse.col(c) * (slopes.velocity_gain * v + slopes.alpha_gain * u);
    states -= rate.col(c) * (slopes.beta_gain * u);
    poles.advance(motion.impacts[next].time - motion.impacts[i].time + (next <= i ? 1.0 : 0.0), states);
  }
  return states(left, Eigen::all);
}

}  // namespace

namespace detail {

Eigen::VectorXcd multipliers_of(const ImpactSolution& motion) {
  Eigen::VectorXcd all = map_multipliers(monodromy_of(motion));
  return all.allFinite() ? all : Eigen::VectorXcd();
}

}  // namespace detail
}  // namespace wavebalance::solvers
