#pragma once
#include <Eigen/Core>
#include <vector>

#include "phases/phase_layout.hpp"
#include "phases/phase_model.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers::detail {

using RubbingState = FrictionPart::State;

/// A contact with friction along one tangent.
struct RubbingContact {
  int normal = -1;  ///< its row; -1 without a normal direction
  int tangent = 0;
  FrictionConstants constants;
  AnyContactLaw law;

  bool has_normal() const { return normal >= 0; }
  int row() const { return has_normal() ? normal : tangent; }
  /// N, negative where the contact is open, at the displacements of all rows (m).
  double normal_force(const Eigen::Ref<const Eigen::VectorXd>& displacement) const {
    return constants.normal_load + (has_normal() ? constants.normal_stiffness * displacement[normal] : 0.0);
  }
  /// By how much the force of a contact that slips under a force of this sign would leave the limit if it
  /// stuck, N per time, at the velocities of all rows.
  double slip_rate(const Eigen::Ref<const Eigen::VectorXd>& velocity, double sign) const {
    const double of_limit =
        has_normal() ? constants.friction * constants.normal_stiffness * velocity[normal] : 0.0;
    return sign * constants.tangential_stiffness * velocity[tangent] - of_limit;
  }
};

/// What does not change while a motion with friction is sought.
struct RubbingModel {
  PhaseModel poles;
  std::vector<RubbingContact> contacts;
};

/// A part of the period in which a contact is open, sticks, or slips one way.
struct RubbingPhase {
  int contact = 0;
  RubbingState state = RubbingState::stick;
  double sign = 0.0;              ///< of the force in slip; of stick, in the slip before it, 0 after closing
  int begin = -1, end = -1;       ///< numbers of instants; -1 of a phase that lasts the whole period
  double turns = 1.0;             ///< added to the time of `end`, so that it comes after that of `begin`
  int normal = -1, tangent = -1;  ///< the phases of the layout that hold its forces; -1 where it has none
  int slider = -1;                ///< the number of its unknown position, -1 where it has none
  double held = 0.0;              ///< N, k_t times the position of a slider that does not move

  bool always() const { return begin < 0; }
};

/// An instant at which a contact changes its phase: the passages of the layout of its rows.
struct RubbingInstant {
  int normal = -1, tangent = -1;
  int before = 0, after = 0;  ///< numbers of phases
};

/// The phases of all contacts, their instants, and the panels on which forces are polynomials.
struct RubbingLayout {
  Layout panels;
  std::vector<RubbingPhase> phases;  ///< by contact, in the order of time
  std::vector<RubbingInstant> instants;
  int sliders = 0;  ///< that are unknown

  double time(int instant) const {
    return panels.passages[static_cast<std::size_t>(instants[static_cast<std::size_t>(instant)].tangent)]
        .time;
  }
  double begin(const RubbingPhase& phase) const { return phase.always() ? 0.0 : time(phase.begin); }
  double end(const RubbingPhase& phase) const { return phase.always() ? 1.0 : time(phase.end) + phase.turns; }
  void shift(int instant, double by);
  /// Takes the cuts of normal and tangential forces together, so that both have the same panels.
  void join_cuts();
  /// Whether all contacts have the same states in the same order, from any instant on.
  bool has_states_of(const RubbingLayout& other) const;
};

/// The phases of a motion that is sampled at times l / N: displacements, m, and velocities, m per period, C x
/// N each. The law over the period says what each sample does; instants between them are roots of a line.
/// What the law cannot do without a phase shorter than a sample, it is given: stick between two ways of slip,
/// and slip between stick and opening.
RubbingLayout rubbing_layout(const std::vector<RubbingContact>& contacts, const ContactMotion& motion);

}  // namespace wavebalance::solvers::detail
