#pragma once
#include <cmath>

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

/// Distance of two responses of one motion, in relative rms of the contact displacement.
struct LevelDifference {
  double resolved_part = 0.0;   ///< difference of the harmonics that both have
  double truncated_part = 0.0;  ///< harmonics that only the finer one has

  double whole() const { return std::hypot(resolved_part, truncated_part); }
};

/// Pairs of Fourier functions are compared harmonic by harmonic. Any others are compared at the coarser
/// one's points, and the whole difference is the `truncated_part`. The number of points of the finer
/// problem must be a multiple of the coarser one's. O(M + N).
LevelDifference level_difference(const CondensedProblem& coarse, const PeriodicResponse& coarse_response,
                                 const CondensedProblem& fine, const PeriodicResponse& fine_response);

/// Change of the displacement, relative rms, if the force were summed over every second point with twice its
/// value; contact is kept as it is. One product with K.
double halved_quadrature(CondensedProblem& problem, const PeriodicResponse& response);

/// Whether some contact lasts for fewer than three points, so that its force may change by the force of a
/// whole point.
bool has_brief_contact(const PeriodicResponse& response, int points);

/// Displacement, relative rms, that contact between the points may cause: the parabola through three samples
/// may exceed the gap where no sample does. Two products with K per contact at most.
double missed_contacts(CondensedProblem& problem, const PeriodicResponse& response, const ContactLaws& laws);

/// The order with which the harmonics decay from the second highest octave to the highest; 0 for fewer than
/// four harmonics, NaN where both vanish.
double decay_order(const PeriodicResponse& response, int functions);

}  // namespace wavebalance::solvers
