#pragma once
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers {

/// The motion with friction near a start: displacements of the contacts, C x N, m, at the times l / N. All
/// contacts have elastic friction along one tangent, with or without a normal direction. Solves
///
///   u(t) = u_0(t) - integral of G(t - s) f(s) ds - R_0 f(t),
///   f_n = N_0 + k_n u_n   while closed,           0 while open,
///   f_t = k_t (u_t - w)   in stick, w constant,   sign mu f_n in slip,   0 while open,
///
/// G the periodic Green function of the contacts, by collocation of the forces at Gauss nodes of panels.
/// Unknowns are these forces, the instants at which a contact opens, closes, begins to slip or to stick, and
/// the position w of the slider of each stick, which starts where the slip before ended, or where the gap
/// closes. Every instant has one equation: f_n = 0 of opening and closing, |f_t| = mu f_n where slip begins,
/// and a slip rate of zero, f_t' = sign mu f_n', where stick begins. All panels are cut where other contacts
/// change, whatever max_cut_panels: the slope of a force at one end of a panel, which an instant follows
/// from, needs that. Phases that the motion found does not have are exchanged for those that the law over the
/// period has along that motion, until both agree.
///
/// A contact that sticks all the time keeps its slider where the law puts it along the start: within the
/// places at which it does not slip, the one next to the law's position at rest.
///
/// The result is a PhaseMotion with `friction`; its phases are those of the normal rows that are closed, with
/// piece 1, and of the tangents, with piece 1 in stick, 2 and 3 in slip with a positive and a negative force.
/// `estimated_error` is the distance from the solution on fewer nodes. Statuses as of contact_phases(), with
/// slip_in_a_plane for two tangents, mixed_laws beside laws of another kind and free_structure for a
/// structure that is free to move.
///
/// Throws std::invalid_argument for sizes that do not fit and options out of range. Forces of the start
/// (N, as large or empty) say where contacts that stick all the time hold their sliders. A Newton step costs
/// O(n^3 + n^2 poles) for n unknowns.
PhaseMotion friction_phases(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                            const ContactPhasesOptions& options = {},
                            const Eigen::MatrixXd& start_force = {});

/// friction_phases() where a law acts over a period, contact_phases() elsewhere.
PhaseMotion phases_of_any_law(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                              const ContactPhasesOptions& options = {},
                              const Eigen::MatrixXd& start_force = {});

/// What a contact with friction does in a period.
struct FrictionCycle {
  int row = 0;        ///< the first of its contact directions
  double work = 0.0;  ///< J, that friction takes in a period
  double slip = 0.0;  ///< m, the distance that the slider moves while it slips
  double stick_share = 0.0, slip_share = 0.0, open_share = 0.0;  ///< of the period
};

/// Of each contact of a motion with friction, to the accuracy of its forces and velocities. Throws
/// std::invalid_argument without a motion.
std::vector<FrictionCycle> friction_cycles(const PhaseMotion& motion);

}  // namespace wavebalance::solvers
