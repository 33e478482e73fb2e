#pragma once
#include <algorithm>
#include <cmath>

#include "collocation/exact_solution_parts.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {
namespace testing {

// By what the force of a contact grows where intervals end and begin, N.
inline double force_jump(const detail::CollocationIterate& iterate, int contact, double time) {
  const auto is_now = [time](double at) { return std::abs(at - time - std::round(at - time)) < 1e-12; };
  double jump = 0.0;
  for (std::size_t p = 0; p < iterate.layout.intervals.size(); ++p) {
    const detail::LayoutInterval& interval = iterate.layout.intervals[p];
    if (interval.contact != contact || interval.begin < 0) continue;
    const double begin = iterate.layout.begin(interval), end = iterate.layout.end(interval);
    if (is_now(begin)) jump += iterate.forces.in_interval(static_cast<int>(p), begin);
    if (is_now(end)) jump -= iterate.forces.in_interval(static_cast<int>(p), end);
  }
  return jump;
}

}  // namespace testing

/// D(t) along a motion to rounding, with exact intervals: for unstable_multipliers(), floquet_exponents()
/// and monodromy(), which are then exact. Its status is no_response for a motion that has not converged,
/// and unsupported_law for one of flow_motion(), which has only its multipliers.
inline PeriodicStiffness contact_stiffness(const ExactSolution& motion) {
  PeriodicStiffness result;
  if (!motion.converged()) {
    result.status = StabilityStatus::no_response;
    return result;
  }
  if (motion.parts->multipliers) {
    result.status = StabilityStatus::unsupported_law;
    return result;
  }
  const detail::CollocationModel& model = motion.parts->model;
  for (const ForceInterval& interval : motion.intervals)
    result.intervals.push_back({interval.contact, interval.begin, interval.end});
  if (std::ranges::any_of(model.laws, [](const detail::LawSegments& law) { return law.rigid(); })) {
    result.status = StabilityStatus::no_finite_stiffness;
    return result;
  }
  result.tangent = [motion](int contact, double time) {
    return motion.parts->tangent.at(contact, time) + motion.parts->model.holding;
  };
  if (!model.velocity) return result;
  result.damping = [motion](int contact, double time) { return motion.parts->damping.at(contact, time); };
  result.impulse = [motion](int contact, double time) {
    const double speed = motion.velocity(Eigen::VectorXd::Constant(1, time))(contact, 0);
    return speed != 0.0 ? testing::force_jump(motion.parts->iterate, contact, time) / speed : 0.0;
  };
  return result;
}

}  // namespace wavebalance::solvers
