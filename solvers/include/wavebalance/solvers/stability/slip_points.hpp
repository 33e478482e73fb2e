#pragma once
#include <vector>

#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {

/// Where along a curve with friction the first contact begins to slip or to open, or the last one ceases to:
/// between two neighbours of which one has contacts that stick for the whole period alone. Up to there the
/// force of each contact is a spring's, so that the place is that at which the trial functions of the motion
/// just reach a limit somewhere in the period, solved for to rounding, not one at which a sample does.
///
/// Points have the type `slip`, no multiplier, and the unknowns of the last motion that sticks. None in the
/// force form. Throws std::invalid_argument for a curve without unknowns. One response per neighbours that
/// differ and step of a root search, some ten.
std::vector<SpecialPoint> slip_points(CondensedProblem& problem, const ContactLaws& laws,
                                      const FrequencySweep& curve, int output_points);

}  // namespace wavebalance::solvers
