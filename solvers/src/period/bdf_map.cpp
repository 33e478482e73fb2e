#include "period/bdf_map.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <span>
#include <utility>

#include "linalg/gsl_errors.hpp"
#include "linalg/index.hpp"
#include "period/contact_free_motion.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double first_step = 1e-6;  // periods

/// The largest entry of the state of the response without contact, m/s; 0 where it is unbounded. Harmonics
/// with less than a hundredth of the load do not matter for a size.
double linear_size(const LinearStructure& structure, double frequency, double angular_frequency) {
  constexpr double small = 1e-2;
  Eigen::MatrixXcd loads = structure.load_amplitudes(frequency);
  const Eigen::VectorXd sizes = loads.colwise().norm();
  for (Index m = 0; m < loads.cols(); ++m)
    if (m != 1 && sizes[m] < small * sizes.maxCoeff()) loads.col(m).setZero();
  const Eigen::MatrixXcd response = contact_free_response(structure, loads, frequency);
  double size = 0.0;
  for (Index m = 0; m < loads.cols(); ++m) {
    const double state = angular_frequency * std::max(1.0, double(m)) * response.col(m).cwiseAbs().maxCoeff();
    if (std::isfinite(state)) size = std::max(size, state);
  }
  return size;
}

std::span<const double> view(const double* values, int size) {
  return {values, static_cast<std::size_t>(size)};
}
std::span<double> view(double* values, int size) { return {values, static_cast<std::size_t>(size)}; }

int derivative_callback(double periods, const double* state, double* rate, void* parameters) {
  const auto& system = *static_cast<const FirstOrderSystem*>(parameters);
  const int size = system.states();
  system.derivative(periods, view(state, size), view(rate, size));
  // A step too long can leave the range of an exponential law; any failure makes the integrator halve the
  // step.
  return Eigen::Map<const Eigen::VectorXd>(rate, size).allFinite() ? GSL_SUCCESS : GSL_ERANGE;
}

int jacobian_callback(double periods, const double* state, double* by_state, double* by_time,
                      void* parameters) {
  const auto& system = *static_cast<const FirstOrderSystem*>(parameters);
  const int size = system.states();
  system.jacobian(periods, view(state, size), view(by_state, size * size), view(by_time, size));
  return Eigen::Map<const Eigen::VectorXd>(by_state, size * size).allFinite() ? GSL_SUCCESS : GSL_ERANGE;
}

}  // namespace

/// GSL's evolution objects, with the two ends of the last step.
class BdfMap::Integrator {
 public:
  /// One end of a step.
  struct Instant {
    double time = 0.0;      // periods
    Eigen::VectorXd state;  // 2n, m/s
    Eigen::VectorXd rate;   // 2n, m/s per period
  };

  Integrator(FirstOrderSystem& system, const Eigen::VectorXd& initial, double tolerance, double absolute)
      : dofs_(system.dofs()),
        system_{derivative_callback, jacobian_callback, static_cast<std::size_t>(system.states()), &system},
        driver_(
            gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_msbdf, first_step, absolute, tolerance),
            &gsl_odeiv2_driver_free),
        end_{0.0, initial, Eigen::VectorXd(initial.size())} {
    if (!driver_) throw std::bad_alloc();
    derivative_callback(0.0, end_.state.data(), end_.rate.data(), &system);
  }
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// One accepted step; false when none was found.
  bool advance() {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    begin_ = end_;
    return gsl_odeiv2_evolve_apply(driver_->e, driver_->c, driver_->s, &system_, &end_.time, unlimited,
                                   &step_, end_.state.data()) == GSL_SUCCESS &&
           derivative_callback(end_.time, end_.state.data(), end_.rate.data(), system_.params) == GSL_SUCCESS;
  }

  /// Takes the last step back; the next one is an eighth of it.
  void retry() {
    failed_steps_ += 1 + static_cast<long>(driver_->e->failed_steps);
    gsl_odeiv2_evolve_reset(driver_->e);
    gsl_odeiv2_step_reset(driver_->s);
    step_ = 0.125 * (end_.time - begin_.time);
    end_ = begin_;
  }

  /// The state at a time within the last step: the quintic through y, y' and y'' of the displacement half of
  /// the state at both ends, where y' = 2 pi u'.
  Eigen::VectorXd at(double time) const {
    const int n = dofs_;
    const double h = end_.time - begin_.time, s = (time - begin_.time) / h;
    if (h == 0.0) return end_.state;
    const double slope = 2.0 * std::numbers::pi * h;
    const Eigen::VectorXd first = slope * begin_.state.tail(n),
                          second = 0.5 * slope * h * begin_.rate.tail(n);
    // What the parabola of the begin misses at the end in value, slope and curvature.
    const Eigen::VectorXd value = end_.state.head(n) - begin_.state.head(n) - first - second,
                          rise = slope * end_.state.tail(n) - first - 2.0 * second,
                          bend = 0.5 * slope * h * end_.rate.tail(n) - second;
    const Eigen::VectorXd third = 10.0 * value - 4.0 * rise + bend,
                          fourth = -15.0 * value + 7.0 * rise - 2.0 * bend,
                          fifth = 6.0 * value - 3.0 * rise + bend;
    Eigen::VectorXd state(2 * n);
    state.head(n) =
        begin_.state.head(n) + s * (first + s * (second + s * (third + s * (fourth + s * fifth))));
    state.tail(n) =
        (first + s * (2.0 * second + s * (3.0 * third + s * (4.0 * fourth + 5.0 * s * fifth)))) / slope;
    return state;
  }

  /// Counts the times from the end of a period, which leaves them the digits of steps across a jump of the
  /// force.
  void begin_period() {
    begin_.time -= 1.0;
    end_.time -= 1.0;
  }

  const Instant& begin() const { return begin_; }
  const Instant& end() const { return end_; }
  long failed_steps() const { return failed_steps_ + static_cast<long>(driver_->e->failed_steps); }

 private:
  int dofs_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver_;
  double step_ = first_step;
  Instant begin_, end_;
  long failed_steps_ = 0;  // before the evolution began anew
};

BdfMap::BdfMap(const LinearStructure& structure, const ContactLaws& laws, double frequency_hz, int samples,
               double step_floor)
    : system_(structure, laws, frequency_hz),
      step_floor_(step_floor),
      linear_size_(linear_size(structure, frequency_hz, system_.angular_frequency())),
      gaps_(laws.gaps(structure.contacts())),
      states_(system_.states(), samples) {
  for (int c = 0; c < gaps_.size(); ++c)
    if (!laws[c].unilateral()) gaps_[c] = std::numeric_limits<double>::infinity();
}

BdfMap::~BdfMap() = default;

PeriodState BdfMap::state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const {
  return {system_.state(displacement, velocity), {}};
}

long BdfMap::failed_steps() const { return failed_steps_ + (integrator_ ? integrator_->failed_steps() : 0); }

// The tolerances are relative to the response without contact, or to the initial state when that is larger;
// to 1 m/s when both vanish.
void BdfMap::start(const PeriodState& begin, double tolerance) {
  failed_steps_ = failed_steps();
  const double size = std::max(linear_size_, begin.motion.cwiseAbs().maxCoeff());
  integrator_ = std::make_unique<Integrator>(system_, begin.motion, tolerance,
                                             tolerance * step_floor_ * (size > 0.0 ? size : 1.0));
  tolerance_ = tolerance;
}

// The contacts that press on their obstacles.
std::vector<bool> BdfMap::closed_contacts(const Eigen::VectorXd& state) const {
  const Eigen::VectorXd displacement =
      system_.contact_directions() * state.head(system_.dofs()) / system_.angular_frequency();
  const Eigen::VectorXd velocity = system_.contact_directions() * state.tail(system_.dofs());
  std::vector<bool> closed(static_cast<std::size_t>(gaps_.size()));
  for (int c = 0; c < gaps_.size(); ++c)
    closed[static_cast<std::size_t>(c)] =
        std::isfinite(gaps_[c]) && system_.laws()[c].force(displacement[c], velocity[c]) != 0.0;
  return closed;
}

// Whether a contact changes twice or more within the last step. The estimate of its error, by the ends, does
// not show the force in between.
bool BdfMap::hides_changes() const {
  constexpr int parts = 8;
  constexpr double shortest = 1e-9;  // periods
  const double begin = integrator_->begin().time, length = integrator_->end().time - begin;
  if (length < shortest || gaps_.size() == 0 || !std::isfinite(gaps_.minCoeff())) return false;
  std::vector<bool> before = closed_contacts(integrator_->begin().state);
  std::vector<int> changes(before.size(), 0);
  for (int i = 1; i <= parts; ++i) {
    const std::vector<bool> now =
        closed_contacts(i < parts ? integrator_->at(begin + length * i / parts) : integrator_->end().state);
    for (std::size_t c = 0; c < now.size(); ++c)
      if (now[c] != before[c] && ++changes[c] > 1) return true;
    before = now;
  }
  return false;
}

Motion BdfMap::contacts() const {
  const int n = system_.dofs();
  Motion motion{system_.contact_directions() * states_.topRows(n) / system_.angular_frequency(),
                system_.contact_directions() * states_.bottomRows(n),
                {}};
  motion.force = system_.laws().force(motion.displacement, motion.velocity);
  return motion;
}

Motion BdfMap::structure() const {
  const int n = system_.dofs();
  return {states_.topRows(n) / system_.angular_frequency(), states_.bottomRows(n), {}};
}

Period BdfMap::advance(const PeriodState& begin, const StepControl& control) {
  const detail::SilencedGslErrors silence;
  if (!integrator_ || begin.motion != end_.motion || control.tolerance != tolerance_)
    start(begin, control.tolerance);
  const double limit = operations() + control.max_operations;
  const Index samples = states_.cols();
  Eigen::MatrixXd states(states_.rows(), samples);
  Period period;
  for (Index next = 0;;) {
    for (; next < samples; ++next) {
      const double time = double(next) / double(samples);
      if (time > integrator_->end().time) break;
      states.col(next) = integrator_->at(time);
    }
    if (integrator_->end().time >= 1.0) break;
    if (operations() >= limit) return period;
    ++steps_;
    if (!integrator_->advance()) {
      period.ended = Period::End::step_failure;
      return period;
    }
    if (hides_changes()) integrator_->retry();
  }
  states_ = std::move(states);
  end_.motion = integrator_->at(1.0);
  integrator_->begin_period();
  period.ended = Period::End::complete;
  period.state = end_;
  period.contacts = contacts();
  return period;
}

}  // namespace wavebalance::solvers
