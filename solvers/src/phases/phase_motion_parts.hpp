#pragma once
#include "phases/phase_newton.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers {

struct PhaseMotion::Parts {
  detail::PhaseModel model;
  detail::PhaseIterate iterate;
  detail::LegendreNodes nodes;
  detail::PanelForces tangent, damping;                  // slopes of the laws, N/m and N s/m
  std::shared_ptr<const ContactDynamics> dynamics = {};  // of motions with friction
};

namespace detail {

/// Gives a motion its phases and its parts, those of a solution.
void set_parts(PhaseMotion& motion, const PhaseModel& model, const PhaseNewtonResult& solved,
               const LegendreNodes& nodes);

}  // namespace detail
}  // namespace wavebalance::solvers
