#include "collocation/collocation_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;
constexpr double turn = 2.0 * std::numbers::pi;

// A sum of harmonics at the angle with this cosine and sine, times (2 pi i n)^derivative, by Horner's rule.
double sum_of_harmonics(const Eigen::MatrixXcd& amplitudes, int contact, double cosine, double sine,
                        int derivative) {
  double re = 0.0, im = 0.0;
  for (Index n = amplitudes.cols() - 1; n >= 0; --n) {
    Complex own = amplitudes(contact, n);
    if (derivative > 0) own = turn * double(n) * Complex(-own.imag(), own.real());
    const double before = re;
    re = before * cosine - im * sine + own.real();
    im = before * sine + im * cosine + own.imag();
  }
  return re;
}

Eigen::VectorXd sums_of_harmonics(const Eigen::MatrixXcd& amplitudes, const std::vector<Instant>& instants,
                                  int derivative) {
  Eigen::VectorXd values(Index(instants.size()));
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double angle = turn * instants[i].time;
    values[Index(i)] =
        sum_of_harmonics(amplitudes, instants[i].contact, std::cos(angle), std::sin(angle), derivative);
  }
  return values;
}

}  // namespace

CollocationModel::CollocationModel(const ExactProblem& problem, double length)
    : response(problem.dynamics, 1.0 / problem.frequency),
      linear_motion(problem.linear_motion),
      frequency(problem.frequency),
      holding(problem.dynamics.holding()) {
  if (problem.laws.act_over_period()) return;
  for (int c = 0; c < problem.dynamics.contacts(); ++c) {
    const Yielding yielding{response.displacement_at_once(c), frequency * response.velocity_at_once(c)};
    laws.emplace_back(problem.laws[c], length, problem.dynamics.holding(), yielding);
  }
  velocity = problem.laws.depend_on_velocity() ||
             std::any_of(laws.begin(), laws.end(), [](const LawSegments& law) { return law.jumps(); });
}

Eigen::VectorXd CollocationModel::free_displacement(const std::vector<Instant>& instants) const {
  return sums_of_harmonics(linear_motion, instants, 0);
}

Eigen::VectorXd CollocationModel::free_velocity(const std::vector<Instant>& instants) const {
  return sums_of_harmonics(linear_motion, instants, 1);
}

ContactMotion CollocationModel::free_motion(const Eigen::VectorXd& times) const {
  ContactMotion result{Eigen::MatrixXd(response.contacts(), times.size()),
                       Eigen::MatrixXd(response.contacts(), times.size())};
  for (Index l = 0; l < times.size(); ++l) {
    const double cosine = std::cos(turn * times[l]), sine = std::sin(turn * times[l]);
    for (int c = 0; c < response.contacts(); ++c) {
      result.displacement(c, l) = sum_of_harmonics(linear_motion, c, cosine, sine, 0);
      result.velocity(c, l) = sum_of_harmonics(linear_motion, c, cosine, sine, 1);
    }
  }
  return result;
}

ContactMotion CollocationModel::motion(const PanelForces& forces, const PeriodCells& period,
                                       const Eigen::VectorXd& times) const {
  ContactMotion result = free_motion(times);
  const ContactMotion forced = response.motion(period, forces.coefficients(), times);
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
