#include "wavebalance/solvers/balance/contact_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "linalg/enum_table.hpp"
#include "wavebalance/solvers/structure/contact_mass.hpp"

namespace wavebalance::solvers {
namespace {

// epsilon over the stiffness of the contact, which is the inverse of contact_compliance(). Results with 10
// to 30 differ by less than the discretisation error, and 30 needs the fewest Newton iterations with some
// sixty functions. Many functions resolve briefer forces, to which the contact is stiffer. A larger epsilon
// then lets Newton's method converge over longer steps of a curve, ten times as long with 1023 functions.
constexpr double relative_epsilon = 30.0;
// The automatic choice is the force form if a law is more than this many times as stiff as its contact.
constexpr double stiff = 1e4;

// The slope of a law at the penetration that the linear response causes through a spring as flexible as
// the structure.
double working_stiffness(const AnyContactLaw& law, const Eigen::VectorXd& free, double flexibility) {
  if (!std::isfinite(law.gap())) return 0.0;
  const double reach = free.cwiseAbs().maxCoeff();
  const double v = law.gap() + std::max(free.maxCoeff() - law.gap(), 0.1 * reach);
  const double slope = law.resolvent(v, flexibility).tangent;
  const double remainder = 1.0 - slope * flexibility;
  return remainder > 0.0 ? slope / remainder : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd free_of(const CondensedProblem& problem, int contact) {
  return problem.linear_response().segment(contact * problem.points(), problem.points());
}

// Friction is exact if the springs equal the stiffness of the structure there at high frequencies, with its
// masses held: K - E P / epsilon then decays with the frequency. Tangents of one contact use their mean.
void set_flexibility_of_friction(const CondensedProblem& problem, const ContactLaws& laws,
                                 Eigen::VectorXd& flexibility) {
  const Eigen::VectorXd held = compliance_beside_masses(problem.structure());
  for (int c = 0; c < problem.contacts(); c += laws[c].rows()) {
    const auto friction = laws[c].friction();
    if (!friction) continue;
    const Eigen::Index first = c + friction->normal_rows;
    const double own = held.segment(first, friction->tangents).mean();
    if (own > 0.0)
      flexibility.segment(first, friction->tangents).setConstant(own);
    else
      flexibility.segment(first, friction->tangents)
          .setConstant(flexibility.segment(first, friction->tangents).mean());
  }
}

}  // namespace

std::string_view to_string(ContactForm form) {
  using enum ContactForm;
  return detail::name_in<ContactForm>(
      {{automatic, "automatic"}, {displacement, "displacement"}, {force, "force"}}, form);
}

void require_massless_rigid_contacts(const LinearStructure& structure, const ContactLaws& laws) {
  const std::vector<int> rigid = laws.rigid(structure.contacts());
  if (rigid.empty() || contacts_are_massless(structure, rigid)) return;
  std::string names;
  for (const int c : rigid) names += (names.empty() ? "" : ", ") + std::to_string(c);
  throw std::invalid_argument(
      "a rigid law needs contacts without mass, but contacts with mass have one (rigid: " + names +
      "). A continuum of motions satisfies both without a law of impact; expected rows of zeros in the mass at "
      "these contacts, the mass redistributed, or a stiff linear law");
}

Eigen::VectorXd contact_series_flexibility(const CondensedProblem& problem, const ContactLaws& laws,
                                           ContactForm form) {
  if (laws.have_impacts())
    throw std::invalid_argument(
        "a law with restitution has impacts, which no balance solves for; take impact_response(), or a rigid law "
        "without restitution at contacts without mass");
  const bool rigid = !laws.have_finite_force();
  if (form == ContactForm::displacement) {
    if (!rigid) return {};
    throw std::invalid_argument(
        "contact_series_flexibility: a rigid law has no force at a displacement; take the force form");
  }
  if (!laws.have_force_form()) {
    if (form == ContactForm::automatic && !rigid) return {};
    throw std::invalid_argument(
        "contact_series_flexibility: a law acts below its gap without being monotone, or depends on the velocity; it "
        "is solved in the displacement form, and not beside a rigid law");
  }
  if (rigid) require_massless_rigid_contacts(problem.structure(), laws);
  const Eigen::VectorXd compliance = problem.contact_compliance();
  bool needed = form == ContactForm::force || rigid;
  for (int c = 0; c < problem.contacts() && !needed && laws.unilateral(); ++c)
    needed = compliance[c] * working_stiffness(laws[c], free_of(problem, c), compliance[c]) > stiff;
  if (!needed) return {};
  Eigen::VectorXd flexibility =
      (2.0 * problem.high_frequency_compliance()).cwiseMin(compliance / relative_epsilon);
  if (laws.act_over_period()) set_flexibility_of_friction(problem, laws, flexibility);
  return flexibility;
}

}  // namespace wavebalance::solvers
