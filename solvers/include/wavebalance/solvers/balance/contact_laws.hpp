#pragma once
#include <Eigen/Core>
#include <concepts>
#include <functional>
#include <memory>
#include <vector>

#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::solvers {

/// The forces of all contacts over a period, samples contact-major.
struct ContactForces {
  Eigen::VectorXd force;  ///< N
  PeriodSlopes slopes;
  Eigen::ArrayXi pieces;  ///< of laws over a period, 0 of others; empty where there is none
};

/// The laws of all contacts of a structure: one law for all of them, or one each, in the order of
/// LinearStructure::contact_directions. Samples are contact-major: contact c has entries [c N, (c + 1) N).
/// A PeriodLaw acts on as many consecutive directions as it has rows; it is never one law for several
/// contacts.
class ContactLaws {
 public:
  /// No contact.
  ContactLaws() : ContactLaws(AnyContactLaw()) {}

  /// One law for all contacts: any ContactLaw, or an AnyContactLaw; a PeriodLaw for its rows.
  template <class Law>
  requires(!std::same_as<Law, ContactLaws> && std::constructible_from<AnyContactLaw, Law>)
      ContactLaws(Law law)  // NOLINT: a law is meant to convert
      : ContactLaws(std::vector<AnyContactLaw>{AnyContactLaw(std::move(law))}) {}

  /// One law each. Throws std::invalid_argument when empty.
  ContactLaws(std::vector<AnyContactLaw> laws);  // NOLINT

  /// Laws that vary with the frequency of the load, Hz: those at one frequency, and how others are made,
  /// which must have the same rows, gaps and kinds.
  using AtFrequency = std::function<ContactLaws(double load_frequency)>;
  static ContactLaws over_frequency(AtFrequency make, double load_frequency);
  bool follow_frequency() const { return make_ != nullptr; }
  /// Those at a frequency of the load; these where they do not follow it, or at 0.
  ContactLaws at(double load_frequency) const;

  /// The law of contact c >= 0.
  const AnyContactLaw& operator[](int contact) const {
    return laws_.size() == 1 ? laws_.front() : laws_[law_of_row_[static_cast<std::size_t>(contact)]];
  }
  /// Whether contact c >= 0 is the first row of its law.
  bool begins(int contact) const {
    const auto row = static_cast<std::size_t>(contact);
    if (law_of_row_.size() == 1 || contact == 0) return true;
    return law_of_row_[row] != law_of_row_[row - 1];
  }
  /// Throws std::invalid_argument when the rows of the laws are neither one nor `contacts`.
  void require(int contacts) const;
  /// The gaps of `contacts` contacts, m.
  Eigen::VectorXd gaps(int contacts) const;
  /// The largest finite |gap|, m; 0 when none is finite. A length that the motion in contact has.
  double largest_gap() const;

  /// Whether no law is rigid: one whose force beyond the gap is infinite.
  bool have_finite_force() const;
  /// Which of `contacts` contacts have a rigid law; with friction the tangents.
  std::vector<int> rigid(int contacts) const;
  /// Whether one has a restitution, so that motions have impacts.
  bool have_impacts() const;
  /// Whether all of `contacts` contacts do.
  bool have_impacts_alone(int contacts) const;
  /// The restitution of each of `contacts` contacts. Throws std::invalid_argument where one has none.
  Eigen::VectorXd restitution(int contacts) const;
  /// Whether all laws are unilateral.
  bool unilateral() const;
  /// The largest of contact forces (N, contacts x points): the maximum for unilateral laws, the largest
  /// modulus for others, and the norm over its rows for a CoupledLaw.
  double largest_force(const Eigen::MatrixXd& force) const;
  /// Whether the force form may solve for all of them.
  bool have_force_form() const;
  /// Whether the force of one depends on the velocity.
  bool depend_on_velocity() const;
  /// Whether one is a PeriodLaw.
  bool act_over_period() const;
  /// Whether those that are AdvancesInSteps, so that motions can be integrated in time.
  bool advance_in_steps() const;
  /// The laws of the force form: the resolvents of the laws for a flexibility 1 / epsilon (m/N) per contact.
  ContactLaws resolvents(const Eigen::VectorXd& flexibility) const;

  /// Force (N) and tangent (N/m) at displacements (m) of `contacts` contacts with equally many samples each;
  /// the three vectors have one length. O(samples).
  void evaluate(int contacts, const Eigen::VectorXd& displacement, Eigen::VectorXd& force,
                Eigen::VectorXd& tangent) const;
  /// The forces of a motion over a period and their derivative. `velocity` (m/s) may be empty where no law
  /// depends on it. O(samples), and the cost of laws over a period.
  void evaluate(int contacts, const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                ContactForces& forces) const;
  /// Throws std::invalid_argument that names the contact (from 1) and the displacement if the force or its
  /// slope, at rest, is not a number at one of the displacements (m), which are contact-major. Displacements
  /// that are not finite or beyond 1e9 m, where powers overflow, are left out. O(samples).
  void require_numbers(int contacts, const Eigen::VectorXd& displacement) const;
  /// The forces (N) at displacements (m), contacts x points each; for laws over a period the points span
  /// one period. O(contacts points).
  Eigen::MatrixXd force(const Eigen::MatrixXd& displacement) const;
  /// The same at velocities (m/s) that belong to them.
  Eigen::MatrixXd force(const Eigen::MatrixXd& displacement, const Eigen::MatrixXd& velocity) const;

 private:
  void evaluate_law(int row, int points, const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                    ContactForces& forces) const;

  std::vector<AnyContactLaw> laws_;
  std::vector<std::size_t> law_of_row_;
  std::shared_ptr<const AtFrequency> make_;  // null where they do not follow the frequency
};

}  // namespace wavebalance::solvers
