#pragma once
#include <Eigen/Core>
#include <vector>

#include "phases/legendre_integrals.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers::detail {

/// How an instant moves with those of two passages; -1 for none.
struct Drift {
  int first = -1, second = -1;
  double by_first = 0.0, by_second = 0.0;
};

/// An interval on which the force of a contact is one polynomial, in periods: begin < end <= begin + 1.
struct Panel {
  int contact = 0;
  int phase = 0;  ///< the phase of contact that it is a part of
  double begin = 0.0, end = 0.0;
  Drift begin_drift = {}, end_drift = {};

  double length() const { return end - begin; }
  /// The time of a point x in [-1, 1].
  double time(double x) const { return 0.5 * (begin + end) + 0.5 * length() * x; }
};

/// Where and when displacement and velocity are wanted.
struct Instant {
  int contact = 0;
  double time = 0.0;  ///< periods
};

/// Displacements (m) and velocities (m per period) at K instants, by each of n unknowns.
struct Influence {
  Eigen::MatrixXd displacement;  ///< K x n
  Eigen::MatrixXd velocity;      ///< K x n; empty where not asked for
};

/// How the contacts move where contact forces act periodically, by the poles r and residues R of their
/// compliance: the periodic solutions of y' = r y + f for each pole, and u = -sum R y - constant f. The
/// integrals are exact for forces that are polynomials in time.
///
/// Immutable; may be shared between threads.
class PoleResponse {
 public:
  /// Keeps no reference. The period in s.
  PoleResponse(const ContactDynamics& dynamics, double period);

  int contacts() const { return static_cast<int>(constant_.rows()); }

  /// By forces at the nodes of the panels: columns p q + j belong to a force of 1 N at node j of panel p. The
  /// sign is that of a force which moves the contact towards its obstacle. O(K P (poles q + q^2)).
  Influence influence(const std::vector<Panel>& panels, const LegendreNodes& nodes,
                      const std::vector<Instant>& instants, bool velocity) const;
  /// Displacement (m) and velocity (m per period) of all contacts at K times in periods, C x K each, by
  /// forces with these Legendre coefficients, q x P, N. O(K poles (P + C) + P poles q^2).
  Influence motion(const std::vector<Panel>& panels, const Eigen::MatrixXd& coefficients,
                   const Eigen::VectorXd& times) const;
  /// By impulses of 1 N times a period: one column each. O(K impulses poles).
  Influence impulses(const std::vector<Instant>& impulses, const std::vector<Instant>& instants,
                     bool velocity) const;

 private:
  struct View;   // instants seen from a panel
  struct Waves;  // the states of all poles by one panel

  Waves waves(const Panel& panel, const View& view, Eigen::Index count, bool velocity) const;

  Eigen::VectorXcd exponents_;      // per period, one for each pair
  Eigen::MatrixXcd shapes_, left_;  // C x poles; weight, residue and period are in shapes_
  Eigen::MatrixXd constant_;        // C x C, m/N
  Eigen::MatrixXd jump_;  // C x C: of the velocity, m per period, by a force of 1 N; zero with masses
};

}  // namespace wavebalance::solvers::detail
