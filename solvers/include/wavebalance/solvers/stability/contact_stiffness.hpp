#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// Whether the stability of a motion is known, or why it is not.
enum class StabilityStatus {
  converged,            ///< it is known
  no_response,          ///< the response has not converged
  no_finite_stiffness,  ///< a law in contact has no finite stiffness: rigid contact
  too_few_samples,  ///< an interval of contact lies between two samples, so that the response has no force
  /// contact is so stiff that max_harmonics do not resolve it, or its stiffness varies so fast that halved
  /// intervals do not
  too_few_harmonics,
  undamped,        ///< an exponent of the structure without contact lies on the imaginary axis
  on_unit_circle,  ///< a multiplier lies on the unit circle within its own error, and none outside
  /// contacts without mass and damping that deflect each other at once, or whose force depends on the
  /// velocity
  coupled_massless,
  too_many_states,  ///< a law that depends on the velocity, at a structure with more states than max_states
  structural_damping,  ///< it has no equation in time, so that no perturbation grows or decays by it
  effort_limit,        ///< max_evaluations were not enough
  /// friction or a CoupledLaw together with a law that depends on the velocity, both together, friction in
  /// a structure of more than max_states, slip along two tangents, or another law over a period
  unsupported_law
};

std::string_view to_string(StabilityStatus status);

/// An interval of contact in fractions of the period: 0 <= begin < 1, begin < end <= begin + 1. Contact that
/// lasts the whole period has end = begin + 1.
struct ContactInterval {
  int contact = 0;
  double begin = 0.0;
  double end = 0.0;

  double length() const { return end - begin; }
  bool always() const { return end - begin >= 1.0; }
};

/// A time (in periods) within an interval of contact at which the stiffness or its slope jumps.
struct StiffnessCut {
  int contact = 0;
  double time = 0.0;
};

/// A part of the period of a contact with friction along one tangent, in fractions of the period: 0 <= begin
/// < 1, begin < end <= begin + 1.
struct FrictionPart {
  enum class State { open, stick, slip };
  State state = State::stick;
  double begin = 0.0, end = 1.0;
  /// Sign of the friction force in slip along one tangent; in stick, of the slip before it, 0 after
  /// closing.
  double sign = 0.0;
  double ratio =
      0.0;  ///< of stick after closing: the tangential velocity over the normal one at that instant
};

/// State of a contact at an instant.
enum class ContactState { open, closed, stick, slip };

/// States of a contact over a period, to the accuracy of its forces and velocities.
struct FrictionCycle {
  int row = 0;                        ///< the first of its contact directions
  double work = 0.0;                  ///< J, dissipated by friction and its parallel dashpots
  double slip = 0.0;                  ///< m, the distance that the slider moves over its surface
  double wear = 0.0;                  ///< J, the normal force times that distance [Archard]
  std::array<double, 4> shares = {};  ///< of the period, by ContactState

  double& share(ContactState state) { return shares[static_cast<std::size_t>(state)]; }
  double share(ContactState state) const { return shares[static_cast<std::size_t>(state)]; }
};

/// A contact with friction along a motion.
struct FrictionAlong {
  int row = 0;  ///< the first of its contact directions
  FrictionConstants constants;
  /// In the order of time. A contact that sticks always has one part from 0 to 1.
  std::vector<FrictionPart> parts;
  bool always_sticks() const {
    return parts.size() == 1 && parts.front().state == FrictionPart::State::stick;
  }
  /// The part at a time, 0..1.
  const FrictionPart& part_at(double time) const {
    for (const FrictionPart& part : parts)
      for (const double shift : {0.0, 1.0})
        if (time + shift >= part.begin && time + shift < part.end) return part;
    return parts.back();
  }
};

/// The stiffness D(t) of the contacts over one period, zero outside the intervals of contact.
struct PeriodicStiffness {
  StabilityStatus status = StabilityStatus::converged;
  std::vector<ContactInterval> intervals;  ///< by contact, then by begin
  /// Where it is known to be not smooth within them. Rules of Gauss nodes halve what is not resolved else.
  std::vector<StiffnessCut> cuts = {};
  /// The slope of the law, N/m, of a contact at a time (in periods) within one of its intervals.
  std::function<double(int contact, double time)> tangent;
  /// The slope of the force of a contact by the displacement of another of the same law, N/m, likewise; empty
  /// where no law of several rows acts.
  std::function<double(int force, int displacement, double time)> coupling = {};
  /// The slope by the velocity, N s/m, likewise; empty where no law depends on the velocity.
  std::function<double(int contact, double time)> damping = {};
  /// The slope by the velocity of another contact of the same law, N s/m; empty without such laws.
  std::function<double(int force, int velocity, double time)> damping_coupling = {};
  /// N s/m, where the force jumps as an interval begins or ends: the impulse on a perturbation over its
  /// displacement, the force after that instant less the one before it over the velocity of the contact.
  /// Empty where no law depends on the velocity.
  std::function<double(int contact, double time)> impulse = {};
  /// Contacts with friction, whose forces remember where they began to stick. They have no intervals.
  std::vector<FrictionAlong> friction = {};
  /// Whether multipliers follow only from the map of a period, not from a determinant.
  bool needs_map() const { return damping || coupling; }
  bool held = false;  ///< whether springs that hold a free structure were taken back from it
};

/// D(t) - kappa at all times of C contacts, for ContactDynamics::holding(). The stiffness itself where kappa
/// is 0, it is held already or its status is not converged.
PeriodicStiffness held_stiffness(const PeriodicStiffness& stiffness, int contacts, double kappa);

/// D(t) = f_c'(u(t)) of the laws along the motion of a response, whose instants of opening and closing are
/// roots of u(t) - gap to rounding. The motion is the sum of the trial functions: of their harmonics where
/// both bases are band-limited, otherwise a cubic through the samples, or for trial functions without a
/// derivative a line. In the force form u is the displacement at which the law has the force, v - rho(v) /
/// epsilon. A law that also acts below its gap has the intervals between its kinks, less those without slope.
/// Up to 64 times a period at which a contact passes other breakpoints of its law are cuts.
///
/// A CoupledLaw has its intervals for each of its rows, a law that ActsAtInstants has the whole period.
///
/// A law whose force depends on the velocity has its intervals where it acts; the velocity follows from the
/// trial functions or the interpolant.
///
/// Rigid contact has the status no_finite_stiffness and no tangent; the intervals follow from the contact
/// force, but are empty if elastic laws are also in contact.
///
/// The result refers to `laws` no more than by copies. O(C (N + intervals M)).
/// Throws std::invalid_argument for laws that are neither one nor one per contact, and for samples of another
/// length than the problem's.
PeriodicStiffness contact_stiffness(const CondensedProblem& problem, const ContactLaws& laws,
                                    const PeriodicResponse& response);

/// The unknowns of a balance at its C contacts: displacements u, or v in the force form.
struct ContactUnknowns {
  Eigen::MatrixXcd coefficients;  ///< K + 1 x C, spectra over translates of the trial functions
  Eigen::MatrixXd samples;        ///< N x C, m, of the same
  Eigen::VectorXd flexibility;    ///< C, 1 / epsilon of the force form, m/N; empty for displacements
  double first_sample = 0.0;      ///< time of the first sample, periods
  double frequency = 0.0;         ///< Hz; for laws that depend on the velocity
};

/// The same of such unknowns. Throws std::invalid_argument for laws that are neither one nor one per contact.
PeriodicStiffness contact_stiffness(const AnyTimeBasis& trial, const ContactLaws& laws,
                                    const ContactUnknowns& unknowns);

}  // namespace wavebalance::solvers
