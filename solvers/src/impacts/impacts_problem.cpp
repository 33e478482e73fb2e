#include "wavebalance/solvers/impacts/impacts_problem.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "phases/phase_loads.hpp"

namespace wavebalance::solvers {
namespace {

// The velocities (derivative 1) or displacements (0) of the contacts at once by unit impulses.
Eigen::MatrixXd at_once(const ContactDynamics& dynamics, int derivative) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dynamics.contacts(), dynamics.contacts());
  for (const ContactPole& pole : dynamics.poles()) {
    const double weight = pole.exponent.imag() == 0.0 ? 1.0 : 2.0;
    const std::complex<double> rate = derivative == 0 ? 1.0 : pole.exponent;
    sum += weight * (rate * pole.residue * pole.shape * pole.left.transpose()).real();
  }
  return sum;
}

// A contact without mass is displaced at once.
void require_mass(const ContactDynamics& dynamics) {
  constexpr double rounding = 1e-9;
  const Eigen::MatrixXd displaced = at_once(dynamics, 0), moved = at_once(dynamics, 1);
  double fastest = 0.0;
  for (const ContactPole& pole : dynamics.poles()) fastest = std::max(fastest, std::abs(pole.exponent));
  for (Index c = 0; c < moved.rows(); ++c) {
    const bool mass = dynamics.constant()(c, c) == 0.0 && moved(c, c) > 0.0 &&
                      std::abs(displaced(c, c)) * fastest <= rounding * moved(c, c) * double(moved.rows());
    if (!mass)
      throw std::invalid_argument("ImpactsProblem: contact " + std::to_string(c) +
                                  " has no mass, so that an impact there has no impulse; it must have mass");
  }
}

}  // namespace

Eigen::MatrixXd inverse_contact_mass(const ContactDynamics& dynamics) { return at_once(dynamics, 1); }

ImpactsProblem ImpactsProblem::over_periods(int times) const {
  detail::require_at_least("ImpactsProblem", "times", times, 1);
  ImpactsProblem longer{dynamics, {}, frequency / times, gaps, restitution};
  longer.contact_free.setZero(contact_free.rows(), (contact_free.cols() - 1) * times + 1);
  for (Index n = 0; n < contact_free.cols(); ++n) longer.contact_free.col(n * times) = contact_free.col(n);
  return longer;
}

void ImpactsProblem::validate() const {
  const char* who = "ImpactsProblem";
  detail::require_positive(who, "frequency", frequency);
  const Index contacts = dynamics.contacts();
  if (gaps.size() != contacts || restitution.size() != contacts || contact_free.rows() != contacts ||
      contact_free.cols() < 1)
    throw std::invalid_argument("ImpactsProblem: there are " + std::to_string(gaps.size()) + " gaps, " +
                                std::to_string(restitution.size()) + " restitutions and " +
                                std::to_string(contact_free.rows()) + " motions without contact for " +
                                std::to_string(contacts) + " contacts; there must be one each");
  for (const double one : restitution)
    if (!(one >= 0.0 && one <= 1.0)) detail::reject(who, "restitution", one, "in 0..1");
  if (!gaps.allFinite()) throw std::invalid_argument("ImpactsProblem: a gap is not finite; all must be");
  if (dynamics.structurally_damped())
    throw std::invalid_argument(
        "ImpactsProblem: the structure has structural damping, which has no equation in time; the damping "
        "must be viscous");
  if (dynamics.holding() > 0.0)
    throw std::invalid_argument(
        "ImpactsProblem: the structure is free to move, so that impacts have no periodic Green function; it "
        "must be held");
  require_mass(dynamics);
}

ImpactsProblem impacts_problem(const CondensedProblem& problem, const ContactDynamics& dynamics,
                               const Eigen::VectorXd& gaps, const Eigen::VectorXd& restitution) {
  detail::FreeContacts free(problem.structure(), problem.load_harmonics(), dynamics.holding());
  ImpactsProblem result{dynamics, free.at(problem.frequency(), problem.load_factor()), problem.frequency(),
                        gaps, restitution};
  result.validate();
  return result;
}

}  // namespace wavebalance::solvers
