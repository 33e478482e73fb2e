#include "phases/phase_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;
constexpr double turn = 2.0 * std::numbers::pi;

// Sums of harmonics at instants, each times (2 pi i n)^derivative, by Horner's rule.
Eigen::VectorXd sum_of_harmonics(const Eigen::MatrixXcd& amplitudes, const std::vector<Instant>& instants,
                                 int derivative) {
  Eigen::VectorXd values(Index(instants.size()));
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double re = std::cos(turn * instants[i].time), im = std::sin(turn * instants[i].time);
    Complex sum = 0.0;
    for (Index n = amplitudes.cols() - 1; n >= 0; --n) {
      Complex own = amplitudes(instants[i].contact, n);
      if (derivative > 0) own = turn * double(n) * Complex(-own.imag(), own.real());
      sum = {sum.real() * re - sum.imag() * im + own.real(), sum.real() * im + sum.imag() * re + own.imag()};
    }
    values[Index(i)] = sum.real();
  }
  return values;
}

}  // namespace

PhaseModel::PhaseModel(const PhasesProblem& problem, double length)
    : response(problem.dynamics, 1.0 / problem.frequency),
      contact_free(problem.contact_free),
      frequency(problem.frequency) {
  if (problem.laws.act_over_period()) return;
  for (int c = 0; c < problem.dynamics.contacts(); ++c) {
    const Yielding yielding{response.displacement_at_once(c), frequency * response.velocity_at_once(c)};
    laws.emplace_back(problem.laws[c], length, problem.dynamics.holding(), yielding);
  }
  velocity = problem.laws.depend_on_velocity() ||
             std::any_of(laws.begin(), laws.end(), [](const LawPieces& law) { return law.jumps(); });
}

Eigen::VectorXd PhaseModel::free_displacement(const std::vector<Instant>& instants) const {
  return sum_of_harmonics(contact_free, instants, 0);
}

Eigen::VectorXd PhaseModel::free_velocity(const std::vector<Instant>& instants) const {
  return sum_of_harmonics(contact_free, instants, 1);
}

ContactMotion PhaseModel::free_motion(const Eigen::VectorXd& times) const {
  ContactMotion result{Eigen::MatrixXd(response.contacts(), times.size()),
                       Eigen::MatrixXd(response.contacts(), times.size())};
  std::vector<Instant> instants(static_cast<std::size_t>(times.size()));
  for (int c = 0; c < response.contacts(); ++c) {
    for (Index l = 0; l < times.size(); ++l) instants[static_cast<std::size_t>(l)] = {c, times[l]};
    result.displacement.row(c) = free_displacement(instants).transpose();
    result.velocity.row(c) = free_velocity(instants).transpose();
  }
  return result;
}

ContactMotion PhaseModel::motion(const PanelForces& forces, const LegendreNodes& nodes,
                                 const Eigen::VectorXd& times) const {
  ContactMotion result = free_motion(times);
  const ContactMotion forced = response.motion(forces.grid(), forces.coefficients(), nodes, times);
  result.displacement -= forced.displacement;
  result.velocity -= forced.velocity;
  return result;
}

std::vector<Instant> instants_of(const std::vector<Panel>& panels, const LegendreNodes& nodes) {
  std::vector<Instant> instants;
  for (const Panel& panel : panels)
    for (const double x : nodes.points) instants.push_back({panel.contact, panel.time(x)});
  return instants;
}

}  // namespace wavebalance::solvers::detail
