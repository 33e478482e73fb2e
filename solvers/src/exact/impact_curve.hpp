#pragma once
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers::detail {

/// exact_curve() from a motion with impacts only, between which no contact exerts a force: by pseudo arc
/// length on the equations of impact_motion() and the parameter. The unknowns are instants and impulses, a
/// 20th of the period and velocity_scale / J of which have length 1.
///
/// A motion ends where an impulse vanishes, and where a contact touches its obstacle between impacts. Both
/// are solved for as the equations of impacts of which one has no impulse, which are regular there. From this
/// grazing motion the curve goes on with one impact less, or more, on the side on which the motions are ones
/// of the structure. Where two impacts of different contacts pass each other, it goes on in the other order.
/// O(K^2 poles + K^3) for each step of Newton's method, and the multipliers for each point.
ExactCurve impact_curve(const ProblemFamily& family, const ExactSolution& first,
                        const ExactCurveOptions& options);

/// doubled_curve() from such a curve.
ExactCurve doubled_impacts(const ProblemFamily& family, const ExactEvent& event,
                           const ExactCurveOptions& options);

}  // namespace wavebalance::solvers::detail
