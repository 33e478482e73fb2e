#pragma once
#include <Eigen/Core>
#include <concepts>
#include <vector>

#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::solvers {

/// The laws of all contacts of a structure: one law for all of them, or one each, in the order of
/// LinearStructure::contact_directions. Samples are contact-major: contact c has entries [c N, (c + 1) N).
class ContactLaws {
 public:
  /// No contact.
  ContactLaws() : laws_(1) {}

  /// One law for all contacts: any ContactLaw, or an AnyContactLaw.
  template <class Law>
  requires(!std::same_as<Law, ContactLaws> && ContactLaw<Law>) ContactLaws(Law law)
      : laws_{AnyContactLaw(std::move(law))} {}  // NOLINT: a law is meant to convert

  /// One law each. Throws std::invalid_argument when empty.
  ContactLaws(std::vector<AnyContactLaw> laws);  // NOLINT

  /// The law of contact c >= 0.
  const AnyContactLaw& operator[](int contact) const {
    return laws_.size() == 1 ? laws_.front() : laws_[static_cast<std::size_t>(contact)];
  }
  /// Throws std::invalid_argument when there are neither one nor `contacts` laws.
  void require(int contacts) const;
  /// The gaps of `contacts` contacts, m.
  Eigen::VectorXd gaps(int contacts) const;
  /// The largest finite |gap|, m; 0 when none is finite. A length that the motion in contact has.
  double largest_gap() const;

  /// Whether no law is rigid: one whose force beyond the gap is infinite.
  bool have_finite_force() const;
  /// Those of `contacts` contacts whose law is rigid.
  std::vector<int> rigid(int contacts) const;
  /// Whether all laws are unilateral.
  bool unilateral() const;
  /// Whether the force form may solve for all of them.
  bool have_force_form() const;
  /// Whether the force of one depends on the velocity.
  bool depend_on_velocity() const;
  /// The laws of the force form: the resolvents of the laws for a flexibility 1 / epsilon (m/N) per contact.
  ContactLaws resolvents(const Eigen::VectorXd& flexibility) const;

  /// Force (N) and tangent (N/m) at displacements (m) of `contacts` contacts with equally many samples each;
  /// the three vectors have one length. O(samples).
  void evaluate(int contacts, const Eigen::VectorXd& displacement, Eigen::VectorXd& force,
                Eigen::VectorXd& tangent) const;
  /// The same for laws that depend on the velocities (m/s), too, with the slopes by them (N s/m).
  void evaluate(int contacts, const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                Eigen::VectorXd& force, Eigen::VectorXd& tangent, Eigen::VectorXd& damping) const;
  /// Throws std::invalid_argument that names the contact (from 1) and the displacement if the force or its
  /// slope, at rest, is not a number at one of the displacements (m), which are contact-major. Displacements
  /// that are not finite or beyond 1e9 m, where powers overflow, are left out. O(samples).
  void require_numbers(int contacts, const Eigen::VectorXd& displacement) const;
  /// The forces (N) at displacements (m), contacts x points each. O(contacts points).
  Eigen::MatrixXd force(const Eigen::MatrixXd& displacement) const;
  /// The same at velocities (m/s) that belong to them.
  Eigen::MatrixXd force(const Eigen::MatrixXd& displacement, const Eigen::MatrixXd& velocity) const;

 private:
  std::vector<AnyContactLaw> laws_;
};

}  // namespace wavebalance::solvers
