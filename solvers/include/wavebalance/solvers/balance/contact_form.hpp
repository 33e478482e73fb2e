#pragma once
#include <Eigen/Core>
#include <string_view>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::solvers {

/// The unknown in which contact is solved for; see CondensedProblem.
enum class ContactForm {
  automatic,     ///< force for a rigid law and one that is stiff compared with the structure, else
                 ///< displacement
  displacement,  ///< u at the points, with the law's force at u
  force          ///< u + E lambda / epsilon, with the law's resolvent
};

std::string_view to_string(ContactForm form);

/// 1 / epsilon of each contact (m/N) for the force form, empty for the displacement form: the argument of
/// ContactOperator. Needs the problem's frequency. `automatic` uses the force form if all laws are
/// unilateral and the slope of one, at the penetration of the linear response, exceeds 1e4 /
/// contact_compliance(). epsilon is 30 / contact_compliance(), or 1 / (2 high_frequency_compliance()) where
/// this is more. Throws std::invalid_argument for a rigid law in the displacement form or at contacts with
/// mass [contacts_are_massless], and for a law in the force form that depends on the velocity, or acts
/// below its gap and is not declared monotone.
Eigen::VectorXd contact_series_flexibility(const CondensedProblem& problem, const ContactLaws& laws,
                                           ContactForm form);

/// Throws std::invalid_argument that names the contacts where a rigid law acts at contacts with mass: a
/// continuum of motions satisfies both without a law of impact.
void require_massless_rigid_contacts(const LinearStructure& structure, const ContactLaws& laws);

}  // namespace wavebalance::solvers
