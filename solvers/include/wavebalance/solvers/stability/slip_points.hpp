#pragma once
#include <vector>

#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {

/// Points of a curve with friction at which the first contact begins to slip or to open, or the last one
/// stops doing so: between two neighbours of which one has only sticking contacts. There each contact acts
/// as a spring, so the point is solved for to rounding: the trial functions of the motion, not only their
/// samples, just reach a limit.
///
/// Points have the type `slip`, no multiplier, and the unknowns of the last motion that sticks. None in the
/// force form. Throws std::invalid_argument for a curve without unknowns. One response per neighbours that
/// differ and step of a root search, some ten.
std::vector<SpecialPoint> slip_points(CondensedProblem& problem, const ContactLaws& laws,
                                      const FrequencySweep& curve, int output_points);

}  // namespace wavebalance::solvers
