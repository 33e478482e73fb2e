#include "impacts/impact_model.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "flow/law_machines.hpp"
#include "linalg/index.hpp"
#include "linalg/one_less_exp.hpp"
#include "linalg/option_checks.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;
constexpr double turn = 2.0 * std::numbers::pi;

// The sum of the moduli of a derivative's harmonics.
double magnitude_of(const ExactProblem& problem, int c, int derivative) {
  double sum = 0.0;
  for (Index n = 0; n < problem.linear_motion.cols(); ++n)
    sum += std::pow(turn * double(n) * problem.frequency, derivative) * std::abs(problem.linear_motion(c, n));
  return sum;
}

}  // namespace

FreeScales free_scales(const ExactProblem& problem) {
  FreeScales scales;
  for (int c = 0; c < problem.dynamics.contacts(); ++c) {
    const double gap = std::abs(problem.laws[c].gap());
    scales.displacement =
        std::max(scales.displacement, magnitude_of(problem, c, 0) + (std::isfinite(gap) ? gap : 0.0));
    scales.velocity = std::max(scales.velocity, magnitude_of(problem, c, 1));
  }
  scales.velocity = std::max(scales.velocity, turn * problem.frequency * scales.displacement * 1e-3);
  return scales;
}

ImpactModel::ImpactModel(const ExactProblem& problem, const ImpactModel* like)
    : problem_(problem),
      gaps_(problem.laws.gaps(problem.dynamics.contacts())),
      restitution_(problem.laws.restitution(problem.dynamics.contacts())),
      period_(1.0 / problem.frequency),
      scales_(free_scales(problem)),
      poles_(like != nullptr ? like->poles_
                             : std::make_shared<const ContactPoles>(problem.dynamics, Eigen::MatrixXcd(),
                                                                    problem.frequency)),
      third_moduli_(like != nullptr ? like->third_moduli_
                                    : std::make_shared<const Eigen::MatrixXd>(outputs(3).cwiseAbs())) {
  difference_.resize(poles());
  last_.resize(poles());
  for (Index l = 0; l < poles(); ++l) {
    const Complex step = exponents()[l] * period_;
    difference_[l] = step.real() > 0.0 ? -one_less_exp(-step) : one_less_exp(step);
    last_[l] = periodic(l, 1.0);
  }
  free_third_.resize(contacts());
  for (int c = 0; c < contacts(); ++c) {
    free_third_[c] = free_magnitude(c, 3);
    free_.emplace_back(problem.linear_motion.row(c).transpose(), turn * problem.frequency);
  }
}

double ImpactModel::free_magnitude(int c, int derivative) const {
  return magnitude_of(problem_, c, derivative);
}

bool ImpactModel::is_resonant() const {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (Index l = 0; l < poles(); ++l)
    if (std::abs(difference_[l]) <= 64.0 * eps * (1.0 + std::abs(exponents()[l] * period_))) return true;
  return false;
}

ContactsAt ImpactModel::free_motion(double time) const {
  const Index contacts = this->contacts();
  ContactsAt state{Eigen::VectorXd(contacts), Eigen::VectorXd(contacts), Eigen::VectorXd(contacts)};
  for (Index c = 0; c < contacts; ++c) {
    const auto [displacement, velocity, acceleration, third] = free_[static_cast<std::size_t>(c)].at(time);
    state.displacement[c] = displacement;
    state.velocity[c] = velocity;
    state.acceleration[c] = acceleration;
  }
  return state;
}

// exp(lambda share T) / (1 - exp(lambda T)), for growing poles without large numbers.
Complex ImpactModel::periodic(Index pole, double share) const {
  const Complex step = exponents()[pole] * period_;
  return std::exp(step * (step.real() > 0.0 ? share - 1.0 : share)) / difference_[pole];
}

GreenValues ImpactModel::green(int c, int d, double share) const {
  GreenValues sum;
  for (Index l = 0; l < poles(); ++l) {
    const Complex value = outputs(0)(c, l) * inputs()(l, d) * periodic(l, share), exponent = exponents()[l];
    const Complex rate = exponent * value;
    // The logarithmic derivative of exp(lambda share T) / (1 - exp(lambda T)) by T, over lambda.
    const Complex by_period = share + last_[l];
    sum.value += value.real();
    sum.rate += rate.real();
    sum.second += (exponent * rate).real();
    sum.value_by_period += (rate * by_period).real();
    sum.rate_by_period += (exponent * rate * by_period).real();
    sum.magnitude += std::abs(value);
    sum.rate_magnitude += std::abs(rate);
  }
  return sum;
}

Eigen::VectorXcd ImpactModel::state_after(int c, double share) const {
  Eigen::VectorXcd state(poles());
  for (Index l = 0; l < poles(); ++l) state[l] = -inputs()(l, c) * periodic(l, share);
  return state;
}

Eigen::VectorXcd ImpactModel::growth(double seconds) const {
  return (exponents() * seconds).array().exp().matrix();
}

ContactsAt ImpactModel::motion(const Eigen::VectorXcd& state, double time) const {
  ContactsAt result = free_motion(time);
  result.displacement += (outputs(0) * state).real();
  result.velocity += (outputs(1) * state).real();
  result.acceleration += (outputs(2) * state).real();
  return result;
}

void require_impacts(const ExactProblem& problem) {
  const char* who = "impact_motion";
  const ContactDynamics& dynamics = problem.dynamics;
  require_positive(who, "frequency", problem.frequency);
  const int contacts = dynamics.contacts();
  if (problem.linear_motion.rows() != contacts || problem.linear_motion.cols() < 1)
    throw std::invalid_argument("impact_motion: there are " + std::to_string(problem.linear_motion.rows()) +
                                " motions without contact for " + std::to_string(contacts) +
                                " contacts; there must be one each");
  problem.laws.require(contacts);
  for (const double one : problem.laws.restitution(contacts))
    if (!(one >= 0.0 && one <= 1.0)) reject(who, "restitution", one, "in 0..1");
  if (!problem.laws.gaps(contacts).allFinite())
    throw std::invalid_argument("impact_motion: a gap is not finite; all must be");
  if (dynamics.structurally_damped())
    throw std::invalid_argument(
        "impact_motion: the structure has structural damping, which has no equation in time; the damping "
        "must be viscous");
  if (dynamics.holding() > 0.0)
    throw std::invalid_argument(
        "impact_motion: the structure is free to move, so that impacts have no periodic Green function; it "
        "must be held");
  for (int c = 0; c < contacts; ++c)
    if (inverse_mass_of(dynamics, c) == 0.0)
      throw std::invalid_argument("impact_motion: contact " + std::to_string(c) +
                                  " has no mass, so that an impact there has no impulse; it must have mass");
}

}  // namespace wavebalance::solvers::detail

namespace wavebalance::solvers {

Eigen::MatrixXd inverse_contact_mass(const ContactDynamics& dynamics) {
  const Eigen::MatrixXcd rates = detail::shapes_of(dynamics) * detail::exponents_of(dynamics).asDiagonal();
  return (rates * detail::inputs_of(dynamics)).real();
}

}  // namespace wavebalance::solvers
