#include "wavebalance/solvers/balance/contact_form.hpp"

#include <stdexcept>

namespace wavebalance::solvers {
namespace {

// epsilon over the stiffness of the contact. The answers of 10 to 30 differ by less than the discretisation
// error; 30 takes the fewest Newton steps on fine grids, and 100 fails at grazing corners.
constexpr double relative_epsilon = 30.0;

}  // namespace

std::string_view to_string(ContactForm form) {
  switch (form) {
    case ContactForm::automatic:
      return "automatic";
    case ContactForm::displacement:
      return "displacement";
    case ContactForm::force:
      return "force";
  }
  return "unknown";
}

Eigen::VectorXd contact_regularization(const CondensedProblem& problem, const ContactLaws& laws,
                                       ContactForm form) {
  const bool rigid = !laws.have_finite_force();
  if (form == ContactForm::displacement) {
    if (!rigid) return {};
    throw std::invalid_argument(
        "contact_regularization: a rigid law has no force at a displacement; take the force form");
  }
  if (form == ContactForm::force && !laws.unilateral())
    throw std::invalid_argument(
        "contact_regularization: a law acts below its gap; it is solved in the displacement form");
  if (form == ContactForm::automatic && !rigid) return {};
  return problem.contact_compliance() / relative_epsilon;
}

}  // namespace wavebalance::solvers
