#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/scene/structure.hpp"
#include "wavebalance/contact/law_description.hpp"
#include "wavebalance/solvers/balance/contact_form.hpp"

namespace wavebalance::app {

using solvers::ContactForm;

/// Treatment of the contact mass, contact.mass: keep it or redistribute it. `automatic` redistributes it for
/// rigid laws.
enum class ContactMass { automatic, keep, redistribute };
/// Side of the obstacles of a contact degree of freedom, contact.pairs.side.
enum class ObstacleSide { positive, negative, both };

/// The contact.law of a scene without contact.
inline constexpr std::string_view no_law = "none";

/// One entry of [[contact.pairs]]: a direction of contact of matrices, which moves by the sum of
/// coefficients times degrees of freedom, and its law. Complete once loaded: missing keys are taken from
/// [contact].
struct ContactPair {
  std::vector<int> dofs = {};             ///< from 1, none twice
  std::vector<double> coefficients = {};  ///< one each, not all zero; empty before loading: 1, or 1 and -1
  /// Tangents of a law with friction; empty: the direction above is the tangent.
  std::vector<int> tangent = {}, second_tangent = {};
  std::vector<double> tangent_coefficients = {}, second_tangent_coefficients = {};
  ObstacleSide side = ObstacleSide::positive;
  std::string law{no_law};         ///< as in Contact
  contact::LawValues values = {};  ///< as in Contact
  double gap = 0.0;                ///< m, on every side that has an obstacle
  std::string name = {};           ///< shown in texts and pictures; empty: its number is shown
  std::string unit = {};           ///< of its displacement "rad"; empty: m, or from the dof_map

  /// A value by its name. Throws std::out_of_range where none is set.
  double number(std::string_view parameter) const { return contact::number_of(values, parameter); }
  bool operator==(const ContactPair&) const = default;
};

/// The force at a contact as a function of its displacement u towards the obstacle, and how it is solved
/// for. contacts_of() lists the contacts of these keys and MatricesStructure::contact_dofs.
struct Contact {
  std::string law{no_law};  ///< a name of contact::law_catalogue()
  /// The law's parameters other than the gap, as far as they differ from their defaults.
  contact::LawValues values = {};
  ContactForm form = ContactForm::automatic;  ///< the unknown that is solved for
  ContactMass mass = ContactMass::automatic;  ///< of the contact degrees of freedom
  Direction tangent = Direction::y;           ///< blade with friction: along which its tip rubs, x or y
  double gap = 0.0;                           ///< m, displacement at which contact starts
  std::vector<double> gaps = {};              ///< m, one per contact instead of gap; empty: gap holds for all
  /// Contact degrees of freedom instead of MatricesStructure::contact_dofs, each with its law and gap.
  std::vector<ContactPair> pairs = {};

  /// A value by its name. Throws std::out_of_range where none is set.
  double number(std::string_view parameter) const { return contact::number_of(values, parameter); }
  bool operator==(const Contact&) const = default;
};

/// Whether the law of this name begins where the displacement is its gap, contact.gap.
bool has_gap(std::string_view law);
/// Whether its force depends on the velocity.
bool is_damped(std::string_view law);
/// Whether it is a spring that may act below its gap, too.
bool acts_on_both_sides(std::string_view law);
/// Whether it is a spring without a gap, which no motion opens.
bool acts_everywhere(std::string_view law);
/// Whether its force beyond the gap is infinite.
bool is_rigid(std::string_view law);
/// Whether its force follows from the motion over a whole period: friction.
bool has_friction(std::string_view law);
/// Whether it acts along two directions together, beyond a gap along every radius: a ring.
bool acts_in_plane(std::string_view law);
/// Whether its second row is a signal known beforehand: a periodic stiffness.
bool reads_signal(std::string_view law);
/// Whether a law of [contact] or of a pair acts in a plane; whether one reads a signal; whether either.
bool names_plane(const Contact& contact);
bool names_signal(const Contact& contact);
bool names_coupled_rows(const Contact& contact);
/// Whether a law of [contact] or of a pair has friction that sticks or slips.
bool names_friction(const Contact& contact);
/// Whether a law of [contact] or of a pair dissipates energy: friction, or a force of the velocity.
bool takes_energy(const Contact& contact);
/// Whether one of these has friction without tangential_stiffness, which is rigid.
bool names_rigid_friction(const Contact& contact);
/// Whether one of these has friction against a surface that moves, with static_friction above friction, or
/// with dashpots parallel to its springs, so that its force follows from its states only.
bool names_friction_of_states(const Contact& contact);
/// Whether it is a rigid law with contact.restitution, whose motions are found by their impacts.
bool has_impacts(const Contact& contact);

}  // namespace wavebalance::app
