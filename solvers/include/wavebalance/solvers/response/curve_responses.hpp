#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::solvers {

/// The solution of a point of a curve, without a tangent.
CurvePoint solution_of(const FrequencySweep& curve, std::size_t index);
/// The scaled distances in which chords between points of a curve are perpendicular to planes.
ArcLengthOptions arc_scales(const FrequencySweep& curve);

/// The response of a curve's solution `unknown` (samples() values, m) at `value`, the frequency (Hz) or load
/// scale: a point of a curve that frequency_sweep() or amplitude_sweep() traced on `problem` with
/// keep_unknowns, or one of its bifurcation and grazing points. The problem is left at that value in the
/// displacement form. Throws std::invalid_argument for another length. O(C N log N), and a condensation.
PeriodicResponse curve_response(CondensedProblem& problem, const ContactLaws& laws,
                                const FrequencySweep& curve, double value, const Eigen::VectorXd& unknown);

/// The responses at exactly `value`, the frequency (Hz) or load scale, in the order in which the curve
/// passes it: one each time. A point of the curve is searched for between the two neighbours, in planes
/// perpendicular to the previous chord, so that near a fold either side has its own, also where the curve
/// turns between two of its points, and Newton's method solves for it at that value. If that does not
/// converge, the status reports it. A point of the curve that is at `value` to rounding is one of them.
/// Empty where the curve does not pass it. The problem is left at another value in the displacement form.
/// Throws std::invalid_argument for a curve without unknowns. About ten solutions each.
std::vector<PeriodicResponse> responses_at(CondensedProblem& problem, const ContactLaws& laws,
                                           const FrequencySweep& curve, double value);

}  // namespace wavebalance::solvers
