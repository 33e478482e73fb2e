#pragma once
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers {

/// The motion near a start that comes back after a period of the flow from event to event, ContactFlow: any
/// laws that are state machines, also together; structures may be free. The start has displacements, R x N,
/// m, and forces, N, of the contacts at the times l / N; without forces they follow from the laws over the
/// period.
///
/// The states of the poles and the positions of stuck sliders between two events of the start are the
/// unknowns of Newton's method on the map of the period; the states of the contacts follow from the laws
/// and need not be right in the start. A slider that does not move stays where the start has it. The
/// tolerance of the flow is refined until two solutions differ by less than a third of the tolerance of the
/// options, whose max_iterations and observer also apply.
///
/// The result has `friction` where a contact has it. Its intervals are those in which a row has a force: of a
/// normal direction with friction with piece 1, of a tangent with piece 1 in stick, 2 and 3 in slip with a
/// positive and a negative force, of two tangents 2 in slip. `unknowns` are the states; `estimated_error` is
/// the distance of the last two solutions, and at least what their panels leave out and rounding.
///
/// Statuses: slip_in_a_plane for rigid friction along two tangents, law_over_period for one without states,
/// rigid_contact at a contact with mass without a restitution, structural_damping, resonant, not_found,
/// tolerance_missed, cancelled. Throws std::invalid_argument for sizes that do not fit and options out of
/// range. O(periods panels ((rows q)^3 + states^2 rows q)), q = 12.
ExactSolution flow_motion(const ExactProblem& problem, const Eigen::MatrixXd& start,
                          const CollocationOptions& options = {}, const Eigen::MatrixXd& start_force = {});
/// The same near a state at a time that is far from all events, as impulses need it.
ExactSolution flow_motion_from(const ExactProblem& problem, const PeriodStart& start,
                               const CollocationOptions& options = {});

/// The same of a structure without periodic load, whose period is an unknown: 1 / problem.frequency is its
/// start. Time 0 of the motion is the first instant at which a contact begins to stick, or else its first
/// event, or the start. The multiplier of 1 of a perturbation along the motion is left out.
ExactSolution autonomous_motion_from(const ExactProblem& problem, const PeriodStart& start,
                                     const CollocationOptions& options = {});

/// collocation_motion(), which is faster, if all laws are laws of one instant, and flow_motion() with
/// friction, and where that finds no motion or has too many intervals.
ExactSolution exact_motion(const ExactProblem& problem, const Eigen::MatrixXd& start,
                           const CollocationOptions& options = {}, const Eigen::MatrixXd& start_force = {});

}  // namespace wavebalance::solvers
