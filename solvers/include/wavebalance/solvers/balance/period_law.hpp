#pragma once
#include <Eigen/Core>
#include <concepts>
#include <span>
#include <vector>

namespace wavebalance::solvers {

/// Input of a law over a period: the displacements of its rows at N samples, row after row, and velocities
/// if it reads them. A row is a contact direction of the structure. The samples are periodic: the one
/// before the first is the last.
struct PeriodKinematics {
  int points = 0;                        ///< N
  std::span<const double> displacement;  ///< m, rows x N values
  std::span<const double> velocity;      ///< m/s; empty where no law of the structure reads velocities
};

/// One entry of the derivative of the forces by the motion.
struct SlopeEntry {
  int force = 0;         ///< the sample of the force
  int displacement = 0;  ///< the sample of the displacement
  double slope = 0.0;    ///< N/m
  double damping = 0.0;  ///< N s/m: by the velocity of that sample; 0 where velocities are not read
};

/// The forces of a law over a period along its rows, and their derivative. All are zero before, so that a law
/// writes where it acts.
struct PeriodForces {
  std::span<double> force;               ///< N, rows x N values
  std::span<double> displacement_slope;  ///< N/m: of each force by the displacement of the same sample
  std::span<double> velocity_slope;      ///< N s/m: by its velocity; empty like PeriodKinematics::velocity
  std::vector<SlopeEntry>& others;       ///< by other samples, which count in the law
  std::span<int> piece;                  ///< the analytic piece of the law on which each force lies
};

/// A law whose force follows from the motion over a whole period: of several rows, or with memory. Its
/// forces along the rows oppose positive displacements. A law of one instant, ContactLaw, is the case of
/// one row whose force depends only on the motion of the same sample.
template <class Law>
concept PeriodLaw = std::copy_constructible<Law> &&
    requires(const Law& law, const PeriodKinematics& motion, PeriodForces& forces) {
  { law.rows() } -> std::convertible_to<int>;  // consecutive contact directions, at least 1
  law.evaluate(motion, forces);                // any displacements that are finite
};

/// A law over a period that also goes on step by step, from the forces that it has: integration in time
/// needs that. The displacements are linear in time from `before` to v - flexibility f, f the force along
/// the same row at the end of the step, flexibilities at least 0, m/N. `force` has the forces before the
/// step and receives those after it; start() gives the forces after rest at the displacements.
template <class Law>
concept AdvancesInSteps = PeriodLaw<Law> &&
    requires(const Law& law, std::span<const double> rows, std::span<double> force) {
  law.advance(rows, rows, rows, force);  // before, v, flexibility, force
  law.start(rows, rows, force);          // v, flexibility, force
};

/// A law over a period that the force form may solve for: it declares whether it is rigid, so that no force
/// follows from displacements, and offers the law in series with springs, which is not, of displacements u
/// + flexibility f along its rows.
template <class Law>
concept OffersPeriodResolvent = PeriodLaw<Law> && requires(const Law& law, std::span<const double> rows) {
  { law.rigid() } -> std::convertible_to<bool>;
  { law.resolvent(rows) } -> PeriodLaw;
};

/// A law over a period whose forces follow from displacements and, if declared, velocities of the same
/// instant: it may be evaluated at single instants.
template <class Law>
concept ActsAtInstants = PeriodLaw<Law> && requires(const Law& law) {
  { law.depends_on_velocity() } -> std::convertible_to<bool>;
};

/// The numbers of a Coulomb contact, of which its motions follow. Its rows are the normal direction, where
/// there is one, then the tangents.
struct FrictionConstants {
  double friction = 0.0;              ///< mu
  double tangential_stiffness = 0.0;  ///< N/m
  double normal_stiffness = 0.0;      ///< N/m; 0 without a normal direction
  double normal_load = 0.0;           ///< N, at zero displacement, negative beyond a gap
  int normal_rows = 0;                ///< 1 with a normal direction
  int tangents = 1;
  double static_friction = 0.0;                           ///< >= mu, that ends sticking
  double surface_speed = 0.0;                             ///< m/s, of the surface along the tangent
  double tangential_damping = 0.0, normal_damping = 0.0;  ///< N s/m, parallel to the springs
  bool needs_states = false;  ///< whether its force follows from a machine of states, and not from steps
};

/// A law of elastic Coulomb friction, which lists its constants. `piece` of its tangents is 0 where the
/// contact is open, 1 where it sticks, 2 and 3 where it slips, with one tangent under a positive and a
/// negative force.
template <class Law>
concept IsElasticFriction = AdvancesInSteps<Law> && requires(const Law& law) {
  { law.friction() } -> std::convertible_to<double>;
  { law.tangential_stiffness() } -> std::convertible_to<double>;
  { law.normal_stiffness() } -> std::convertible_to<double>;
  { law.raw_normal_force(0.0) } -> std::convertible_to<double>;  // N, at zero displacement
  { law.normal_rows() } -> std::convertible_to<int>;
  { law.tangents() } -> std::convertible_to<int>;
  { law.static_friction() } -> std::convertible_to<double>;
  { law.surface_speed() } -> std::convertible_to<double>;
  { law.tangential_damping() } -> std::convertible_to<double>;
  { law.normal_damping() } -> std::convertible_to<double>;
  { law.needs_states() } -> std::convertible_to<bool>;
};

/// The derivative of the contact forces over a period by the motion of the contacts, samples contact-major.
struct PeriodSlopes {
  Eigen::VectorXd displacement;    ///< N/m: of each force by the displacement of the same sample
  Eigen::VectorXd velocity;        ///< N s/m: by its velocity; empty where no law reads velocities
  std::vector<SlopeEntry> others;  ///< by other samples
};

}  // namespace wavebalance::solvers
