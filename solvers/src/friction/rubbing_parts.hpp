#pragma once
#include "friction/rubbing_equations.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers::detail {

/// Gives a motion its phases, its contacts with friction and its parts, those of a solution.
void set_rubbing_parts(PhaseMotion& motion, const RubbingModel& model, const RubbingIterate& solved,
                       const LegendreNodes& nodes, const ContactDynamics& dynamics);

}  // namespace wavebalance::solvers::detail
