#pragma once
#include "friction/rubbing_equations.hpp"

namespace wavebalance::solvers::detail {

/// What the motion of a solution says about its phases.
struct RubbingAgreement {
  bool agrees = true;  ///< open contacts are apart, stuck ones below the limit, sliders move the way of slip
  /// By how much k_t times the position of a slider that does not move has to change, N, by phase; zero of
  /// others. It lies where the contact sticks all the time, where there is such a place.
  std::vector<double> moved;
  double largest_move = 0.0;  ///< over the largest force
};

/// At instants within all phases and panels, of which more lie near their ends. `allowed` is how far a limit
/// may be passed, over the largest force. O(instants (poles + panels)).
RubbingAgreement agreement_of(const RubbingModel& model, const RubbingIterate& solved,
                              const LegendreNodes& nodes, double allowed);

}  // namespace wavebalance::solvers::detail
