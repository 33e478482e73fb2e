#include "wavebalance/solvers/impacts/impact_stability.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "impacts/impact_model.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

void require_motion(const ImpactMotion& motion) {
  if (motion.converged()) return;
  throw std::invalid_argument("impact_multipliers: the motion has the status " +
                              std::string(to_string(motion.status)) + "; it must have converged");
}

// What an impact does to perturbations: alpha b + beta A b is taken from the states, alpha = velocity_gain v
// + alpha_gain u and beta = beta_gain u, with displacement u and velocity v of the contact.
struct ImpactSlopes {
  double velocity_gain, alpha_gain, beta_gain;
};

ImpactSlopes slopes_of(const ImpactMotion& motion, std::size_t i) {
  const detail::ImpactModel& model = *motion.model;
  const Impact& impact = motion.impacts[i];
  const int c = impact.contact;
  const Index before = i == 0 ? motion.states.cols() - 1 : Index(i) - 1;
  const Impact& last = motion.impacts[static_cast<std::size_t>(before)];
  const double since = impact.time - last.time + (i == 0 ? 1.0 : 0.0);
  const Eigen::VectorXcd state = model.growth(since * model.period()).cwiseProduct(motion.states.col(before));
  const double acceleration = model.motion(state, impact.time).acceleration[c];
  const double gain = (1.0 + model.problem().restitution[c]) / model.inverse_mass()(c, c);
  return {gain, -gain * acceleration / impact.velocity_before, impact.impulse / impact.velocity_before};
}

// A b, n x C: the rates of the states after unit impulses.
Eigen::MatrixXd rates_after_impulse(const ContactDynamics& dynamics, Index size) {
  Eigen::MatrixXd rates(size, dynamics.contacts());
  Index row = 0;
  for (const ContactPole& pole : dynamics.poles()) {
    const Eigen::RowVectorXcd rate = pole.exponent * pole.left.transpose();
    rates.row(row++) = rate.real();
    if (pole.exponent.imag() != 0.0) rates.row(row++) = rate.imag();
  }
  return rates;
}

// The impact that the longest flight follows, and how long that is, in periods.
struct LongestFlight {
  std::size_t end = 0;
  double length = 0.0;
};

LongestFlight longest_flight(const ImpactMotion& motion) {
  LongestFlight longest;
  for (std::size_t i = 0; i < motion.impacts.size(); ++i) {
    const double before = i == 0 ? motion.impacts.back().time - 1.0 : motion.impacts[i - 1].time;
    const double length = motion.impacts[i].time - before;
    if (length > longest.length) longest = {i, length};
  }
  return longest;
}

Eigen::VectorXcd free_multipliers(const detail::ImpactModel& model) {
  std::vector<Complex> all;
  for (const Complex exponent : model.exponents()) {
    const Complex multiplier = detail::free_multiplier(exponent * model.period());
    all.push_back(multiplier);
    if (exponent.imag() != 0.0) all.push_back(std::conj(multiplier));
  }
  return Eigen::Map<const Eigen::VectorXcd>(all.data(), Index(all.size()));
}

// Of the states that are left, from right before the impact at the end of the longest flight on.
Eigen::MatrixXd monodromy_of(const ImpactMotion& motion) {
  const ContactDynamics& dynamics = motion.model->problem().dynamics;
  const PoleStates poles(dynamics, motion.model->period());
  const Eigen::MatrixXd impulse = poles.after_impulse(0.0),
                        rate = rates_after_impulse(dynamics, poles.size());
  const Eigen::MatrixXd displacement = poles.free_motion(0.0), velocity = poles.free_velocity(0.0);
  const LongestFlight longest = longest_flight(motion);
  const std::vector<Index> left = poles.left_after(longest.length);
  Eigen::MatrixXd states = Eigen::MatrixXd::Identity(poles.size(), poles.size())(Eigen::all, left);
  const std::size_t count = motion.impacts.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (longest.end + k) % count, next = (i + 1) % count;
    const int c = motion.impacts[i].contact;
    const ImpactSlopes slopes = slopes_of(motion, i);
    const Eigen::RowVectorXd u = displacement.row(c) * states, v = velocity.row(c) * states;
    states -= impulse.col(c) * (slopes.velocity_gain * v + slopes.alpha_gain * u);
    states -= rate.col(c) * (slopes.beta_gain * u);
    poles.advance(motion.impacts[next].time - motion.impacts[i].time + (next <= i ? 1.0 : 0.0), states);
  }
  return states(left, Eigen::all);
}

// By an impulse at contact d, how a perturbation of contact c grows: displacement, velocity and acceleration
// a share of the period later, the impulse being repeated z-fold in each period.
struct GrowingGreen {
  Complex value, rate, second;
};

GrowingGreen growing_green(const detail::ImpactModel& model, int c, int d, double share, Complex z) {
  GrowingGreen sum{};
  const auto add = [&](Complex weight, Complex exponent) {
    const Complex term = weight * std::exp(exponent * share * model.period()) /
                         (1.0 - std::exp(exponent * model.period()) / z);
    sum.value += term;
    sum.rate += exponent * term;
    sum.second += exponent * exponent * term;
  };
  for (Index l = 0; l < model.poles(); ++l) {
    const Complex exponent = model.exponents()[l];
    const double half = exponent.imag() == 0.0 ? 1.0 : 0.5;  // the other half is the conjugate's
    const Complex weight = half * model.outputs()(c, l) * model.left()(d, l);
    add(weight, exponent);
    if (exponent.imag() != 0.0) add(std::conj(weight), std::conj(exponent));
  }
  return sum;
}

}  // namespace

Eigen::VectorXcd impact_multipliers(const ImpactMotion& motion) {
  require_motion(motion);
  Eigen::VectorXcd all = motion.impacts.empty() ? free_multipliers(*motion.model)
                                                : detail::map_multipliers(monodromy_of(motion));
  if (!all.allFinite()) return {};
  std::ranges::stable_sort(all, [](Complex a, Complex b) { return std::abs(a) > std::abs(b); });
  return all;
}

int unstable_count(const Eigen::VectorXcd& multipliers) { return detail::count_outside(multipliers); }

Complex impact_determinant(const ImpactMotion& motion, Complex z) {
  require_motion(motion);
  if (z == 0.0) throw std::invalid_argument("impact_determinant: z is 0; it must not be");
  const auto count = Index(motion.impacts.size());
  Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Identity(2 * count, 2 * count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j) {
      const Impact &at = motion.impacts[static_cast<std::size_t>(i)],
                   &from = motion.impacts[static_cast<std::size_t>(j)];
      const double share = at.time - from.time + (j >= i ? 1.0 : 0.0);
      const Complex repeated = j >= i ? 1.0 / z : 1.0;
      const GrowingGreen green = growing_green(*motion.model, at.contact, from.contact, share, z);
      const ImpactSlopes slopes = slopes_of(motion, static_cast<std::size_t>(j));
      matrix(i, j) += repeated * (green.value * slopes.alpha_gain + green.rate * slopes.beta_gain);
      matrix(i, count + j) += repeated * green.value * slopes.velocity_gain;
      matrix(count + i, j) += repeated * (green.rate * slopes.alpha_gain + green.second * slopes.beta_gain);
      matrix(count + i, count + j) += repeated * green.rate * slopes.velocity_gain;
    }
  return count > 0 ? std::exp(detail::Lu<Complex>(matrix).log_determinant()) : Complex(1.0);
}

}  // namespace wavebalance::solvers
