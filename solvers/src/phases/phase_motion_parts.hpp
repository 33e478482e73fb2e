#pragma once
#include "phases/phase_equations.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers {

struct PhaseMotion::Parts {
  detail::PhaseModel model;
  detail::PhaseIterate iterate;
  detail::LegendreNodes nodes;
  detail::PanelForces tangent, damping;  // slopes of the laws, N/m and N s/m
};

}  // namespace wavebalance::solvers
