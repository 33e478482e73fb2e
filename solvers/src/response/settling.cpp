#include "wavebalance/solvers/response/settling.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <limits>
#include <numbers>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"
#include "structure/modal_flow.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// Contact forces f at the end of a step with f_c = law_c(predicted_c - (D f)_c), D the compliance of the
// step: Gauss-Seidel, each force by its resolvent for the flexibility D_cc.
void solve_forces(const ContactLaws& laws, const Eigen::MatrixXd& compliance,
                  const Eigen::VectorXd& predicted, Eigen::VectorXd& force) {
  constexpr int max_rounds = 200;
  constexpr double settled = 1e-12;
  for (int round = 0; round < max_rounds; ++round) {
    double change = 0.0;
    for (Eigen::Index c = 0; c < force.size(); ++c) {
      const double others = compliance.row(c).dot(force) - compliance(c, c) * force[c];
      const double next = laws[static_cast<int>(c)].resolvent(predicted[c] - others, compliance(c, c)).force;
      change = std::max(change, std::abs(next - force[c]));
      force[c] = next;
    }
    if (force.size() == 1 || !(change > settled * force.cwiseAbs().maxCoeff())) return;
  }
}

// The force f = law(u - d f, v - m f) of a law that depends on the velocity, by bisection between 0 and the
// force at (u, v): the residual rises with f where no slope is negative. At a jump of the law it is the value
// within.
double implicit_force(const AnyContactLaw& law, double u, double v, double compliance, double mobility) {
  constexpr int halvings = 60;
  double near = 0.0, far = law.force(u, v);
  if (far == 0.0) return 0.0;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (near + far);
    const double excess = middle - law.force(u - compliance * middle, v - mobility * middle);
    (excess * far > 0.0 ? far : near) = middle;
  }
  return 0.5 * (near + far);
}

// The same as solve_forces() where laws depend on the velocity, `mobility` that of the step.
void solve_forces(const ContactLaws& laws, const Eigen::MatrixXd& compliance, const Eigen::MatrixXd& mobility,
                  const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                  Eigen::VectorXd& force) {
  constexpr int max_rounds = 200;
  constexpr double settled = 1e-12;
  for (int round = 0; round < max_rounds; ++round) {
    double change = 0.0;
    for (Eigen::Index c = 0; c < force.size(); ++c) {
      const double d = compliance(c, c), m = mobility(c, c);
      const double u = displacement[c] - compliance.row(c).dot(force) + d * force[c];
      const double v = velocity[c] - mobility.row(c).dot(force) + m * force[c];
      const AnyContactLaw& law = laws[static_cast<int>(c)];
      const double next =
          law.depends_on_velocity() ? implicit_force(law, u, v, d, m) : law.resolvent(u, d).force;
      change = std::max(change, std::abs(next - force[c]));
      force[c] = next;
    }
    if (force.size() == 1 || !(change > settled * force.cwiseAbs().maxCoeff())) return;
  }
}

// Responses of all degrees of freedom without contact to a load of these amplitudes, n x harmonics.
Eigen::MatrixXcd load_responses(const LinearStructure& structure, const Eigen::MatrixXcd& amplitudes,
                                double frequency) {
  Eigen::MatrixXcd responses = Eigen::MatrixXcd::Zero(structure.size(), amplitudes.cols());
  for (Eigen::Index n = 0; n < amplitudes.cols(); ++n) {
    if (amplitudes.col(n).isZero(0.0)) continue;
    const Complex rate(0.0, 2.0 * std::numbers::pi * frequency * double(n));
    const Complex elastic(1.0, n > 0 ? structure.loss_factor : 0.0);
    const Eigen::MatrixXcd impedance = elastic * Eigen::MatrixXcd(structure.stiffness.cast<Complex>()) +
                                       rate * Eigen::MatrixXcd(structure.damping.cast<Complex>()) +
                                       rate * rate * Eigen::MatrixXcd(structure.mass.cast<Complex>());
    responses.col(n) = detail::Lu<Complex>(impedance).solve(Eigen::VectorXcd(amplitudes.col(n)));
  }
  return responses;
}

// The contact-free motion of the contacts at steps k = 0..steps-1, C x steps, from their responses.
Eigen::MatrixXd contact_free_motion(const Eigen::MatrixXcd& responses, int steps) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(responses.rows(), steps);
  for (Eigen::Index n = 0; n < responses.cols(); ++n)
    for (int k = 0; k < steps; ++k) {
      const Complex phase = std::polar(1.0, 2.0 * std::numbers::pi * double(n) * k / steps);
      motion.col(k) += (responses.col(n) * phase).real();
    }
  return motion;
}

// The amplitudes of a load (n x harmonics) that is `start` periods ahead, so that the first harmonic of
// `series` is at its maximum: a load that comes later then gives the same motion later.
Eigen::MatrixXcd from_maximum(Eigen::MatrixXcd amplitudes, const Eigen::VectorXcd& series, double& start) {
  start = 0.0;
  Eigen::Index first = 1;
  while (first < series.size() && series[first] == 0.0) ++first;
  if (first >= series.size()) return amplitudes;
  start = -std::arg(series[first]) / (2.0 * std::numbers::pi * double(first));
  for (Eigen::Index n = 0; n < amplitudes.cols(); ++n)
    amplitudes.col(n) *= std::polar(1.0, 2.0 * std::numbers::pi * double(n) * start);
  return amplitudes;
}

// Every `step`-th harmonic: those of a load that repeats `step` times within the period.
Eigen::VectorXcd every(int step, const Eigen::VectorXcd& harmonics) {
  if (step == 1) return harmonics;
  const Eigen::Index count = (harmonics.size() + step - 1) / step;
  return Eigen::VectorXcd(harmonics(Eigen::seqN(0, count, step)));
}

// All that acts on the structure of a problem, n x harmonics of one period of the load.
Eigen::MatrixXcd load_amplitudes(const CondensedProblem& problem, int repeats) {
  const LinearStructure& structure = problem.structure();
  const Eigen::VectorXcd harmonics = every(repeats, problem.load_harmonics());
  LinearStructure forced;  // the forces alone
  forced.load = Eigen::VectorXd::Zero(structure.size());
  forced.forces = structure.forces;
  Eigen::MatrixXcd amplitudes = forced.load_amplitudes(repeats * problem.frequency());
  const Eigen::Index before = amplitudes.cols(), count = std::max(before, harmonics.size());
  amplitudes.conservativeResize(Eigen::NoChange, count);
  amplitudes.rightCols(count - before).setZero();
  amplitudes.leftCols(harmonics.size()) += structure.load.cast<Complex>() * harmonics.transpose();
  if (problem.load_scale() != 1.0) amplitudes.rightCols(count - 1) *= problem.load_scale();
  return amplitudes;
}

class Settling {
 public:
  Settling(const CondensedProblem& problem, const ContactLaws& laws, const SettlingOptions& options,
           ModalFlow flow)
      : laws_(laws), options_(options), flow_(std::move(flow)), repeats_(load_periods(problem)) {
    const LinearStructure& structure = problem.structure();
    const double frequency = repeats_ * problem.frequency();
    const bool forces_alone = structure.load.isZero(0.0) && !structure.forces.empty();
    const Eigen::VectorXcd series = forces_alone ? structure.forces.front().amplitudes(frequency)
                                                 : every(repeats_, problem.load_harmonics());
    const Eigen::MatrixXcd amplitudes = from_maximum(load_amplitudes(problem, repeats_), series, start_);
    const Eigen::MatrixXcd responses = load_responses(structure, amplitudes, frequency);
    free_ = contact_free_motion(structure.contact_directions * responses, options.steps);
    if (laws.depend_on_velocity()) {
      Eigen::MatrixXcd rates = structure.contact_directions * responses;
      for (Eigen::Index n = 0; n < rates.cols(); ++n)
        rates.col(n) *= Complex(0.0, 2.0 * std::numbers::pi * frequency * double(n));
      free_velocity_ = contact_free_motion(rates, options.steps);
    }
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(structure.size());
    for (Eigen::Index n = 0; n < responses.cols(); ++n)
      velocity -= 2.0 * std::numbers::pi * frequency * double(n) * responses.col(n).imag();
    // The state is the deviation from the motion without contact.
    free_state_ = flow_.state(responses.real().rowwise().sum(), velocity);
    state_ = -free_state_;
    force_ = Eigen::VectorXd::Zero(free_.rows());
  }

  SettledMotion run() {
    SettledMotion result;
    result.start = start_ / repeats_;
    result.displacement = free_.replicate(1, repeats_);
    result.force = Eigen::MatrixXd::Zero(free_.rows(), repeats_ * free_.cols());
    std::deque<Eigen::VectorXd> past{state_};
    while (result.periods < options_.max_periods) {
      integrate_period(result);
      ++result.periods;
      if (!state_.allFinite()) return result;  // an undamped mode that is loaded at its own frequency
      const double scale = (state_ + free_state_).norm();
      const double change = (state_ - past.front()).norm() / scale;
      double least = 0.0;
      const int repeats = periods_to(past, least);
      past.push_front(state_);
      if (past.size() > static_cast<std::size_t>(options_.longest)) past.pop_back();
      constexpr int transient = 50;  // before a motion is taken for one of several periods
      // A spiral towards a motion of fewer periods comes near past states too, and nearly as near later ones.
      constexpr double apart = 100.0;
      const bool subharmonic = repeats > 1 && least > apart * options_.tolerance * scale;
      if (repeats == 1 || (subharmonic && result.periods > transient)) {
        result.attractor_periods = repeats;
        return result;
      }
      const Progress progress{"settling", result.periods, change, "relative change per period",
                              double(result.periods) / options_.max_periods};
      result.cancelled = !goes_on(options_.observer, progress);
      if (result.cancelled) return result;
    }
    result.attractor_periods = 0;
    return result;
  }

 private:
  // After how many periods the state repeats one of the past ones, the latest first; 0 for none. `least` is
  // set to its least distance from later ones.
  int periods_to(const std::deque<Eigen::VectorXd>& past, double& least) const {
    const double close = options_.tolerance * (state_ + free_state_).norm();
    least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < past.size(); ++i) {
      const double distance = (state_ - past[i]).norm();
      if (distance <= close) return static_cast<int>(i) + 1;
      least = std::min(least, distance);
    }
    return 0;
  }

  void integrate_period(SettledMotion& result) {
    const Eigen::MatrixXd& compliance = flow_.step_compliance();
    for (int k = 0; k < options_.steps; ++k) {
      const int next = k + 1 < options_.steps ? k + 1 : 0;
      const int column = ((result.periods % repeats_) * options_.steps + k + 1) % (repeats_ * options_.steps);
      Eigen::VectorXd end = flow_.advance(state_, force_);
      const Eigen::VectorXd predicted = free_.col(next) + flow_.contact_displacement(end);
      if (free_velocity_.size() > 0)
        solve_forces(laws_, compliance, flow_.step_mobility(), predicted,
                     free_velocity_.col(next) + flow_.contact_velocity(end), force_);
      else
        solve_forces(laws_, compliance, predicted, force_);
      flow_.add_force(end, force_);
      state_.swap(end);
      result.displacement.col(column) = predicted - compliance * force_;
      result.force.col(column) = force_;
    }
  }

  const ContactLaws& laws_;
  const SettlingOptions& options_;
  ModalFlow flow_;
  int repeats_ = 1;                       // periods of the load within that of the problem
  double start_ = 0.0;                    // periods of the load after t = 0 at which the motion starts
  Eigen::MatrixXd free_, free_velocity_;  // the latter empty where no law depends on it
  Eigen::VectorXd free_state_, state_, force_;
};

}  // namespace

void SettlingOptions::validate() const {
  constexpr const char* who = "SettlingOptions";
  detail::require_at_least(who, "steps", steps, 1);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  detail::require_at_least(who, "longest", longest, 1);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_modes", max_modes, 1);
  detail::require_at_least(who, "max_size", max_size, 0);
}

SettledMotion settle(const CondensedProblem& problem, const ContactLaws& laws,
                     const SettlingOptions& options) {
  options.validate();
  laws.require(problem.contacts());
  const LinearStructure& structure = problem.structure();
  if (structure.size() > options.max_size || structure.is_free()) return {};
  const double frequency = load_periods(problem) * problem.frequency();
  const double step = 1.0 / (frequency * options.steps);
  auto flow = ModalFlow::make(structure, frequency, step, options.max_modes);
  if (!flow) return {};
  return Settling(problem, laws, options, *std::move(flow)).run();
}

Eigen::VectorXd resample(const Eigen::MatrixXd& by_contact, int points, double start) {
  const Eigen::Index steps = by_contact.cols();
  Eigen::VectorXd samples(by_contact.rows() * points);
  for (Eigen::Index c = 0; c < by_contact.rows(); ++c)
    for (int l = 0; l < points; ++l) {
      const double shifted = double(l) / points - start;
      const double at = (shifted - std::floor(shifted)) * double(steps);
      const auto before = static_cast<Eigen::Index>(at);
      const double share = at - double(before);
      samples[c * points + l] =
          (1.0 - share) * by_contact(c, before % steps) + share * by_contact(c, (before + 1) % steps);
    }
  return samples;
}

}  // namespace wavebalance::solvers
