#pragma once
#include <cmath>

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

/// How far two responses of one motion are apart, in relative rms of the contact displacement.
struct LevelDifference {
  double within = 0.0;  ///< harmonics that the coarser one's functions hold
  double beyond = 0.0;  ///< harmonics beyond them

  double whole() const { return std::hypot(within, beyond); }
};

/// Pairs of Fourier functions are compared harmonic by harmonic, any others at the coarser one's points, all
/// of it `beyond`. The points of the finer problem are a multiple of the coarser one's. O(M + N).
LevelDifference level_difference(const CondensedProblem& coarse, const PeriodicResponse& coarse_response,
                                 const CondensedProblem& fine, const PeriodicResponse& fine_response);

/// Displacement, relative rms, by which sums over half the points would differ, contact left as it is: the
/// force at every other point doubled against the force at all. One product with K.
double halved_quadrature(CondensedProblem& problem, const PeriodicResponse& response);

/// Whether some contact lasts for fewer points than show its shape, so that its force may move by a point's
/// share.
bool has_brief_contact(const PeriodicResponse& response, int points);

/// Displacement, relative rms, that contacts between the points may cause, which no point sees: at a maximum
/// short of the gap the parabola through three samples exceeds it.
double missed_contacts(CondensedProblem& problem, const PeriodicResponse& response, const ContactLaws& laws);

/// The order with which the harmonics fall from the second highest octave to the highest; 0 for fewer than
/// four harmonics, NaN where both vanish.
double decay_order(const PeriodicResponse& response, int functions);

}  // namespace wavebalance::solvers
