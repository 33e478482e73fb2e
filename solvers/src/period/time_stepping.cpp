#include "wavebalance/solvers/period/time_stepping.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <limits>
#include <memory>
#include <new>
#include <numbers>
#include <span>

#include "linalg/dense.hpp"
#include "linalg/gsl_errors.hpp"
#include "linalg/option_checks.hpp"
#include "wavebalance/solvers/period/first_order_system.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double first_step = 1e-6;  // periods

Eigen::VectorXd initial_state(const FirstOrderSystem& system, const TimeSteppingOptions& options) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system.dofs());
  const auto or_zero = [&](const Eigen::VectorXd& values) -> const Eigen::VectorXd& {
    return values.size() == 0 ? zero : values;
  };
  return system.state(or_zero(options.initial_displacement), or_zero(options.initial_velocity));
}

/// The largest entry of the state of the linear response to one harmonic of the load, m/s.
double linear_state(const LinearStructure& structure, double angular_frequency, double harmonic,
                    const Eigen::VectorXcd& load) {
  using Complex = std::complex<double>;
  const double omega = harmonic * angular_frequency;
  const Eigen::MatrixXcd impedance = Eigen::MatrixXcd(
      structure.stiffness.cast<Complex>() - Complex(omega * omega) * structure.mass.cast<Complex>() +
      Complex(0.0, omega) * structure.damping.cast<Complex>());
  const Eigen::VectorXcd response = detail::Lu<Complex>(impedance).solve(load);
  const double state = angular_frequency * std::max(1.0, harmonic) * response.cwiseAbs().maxCoeff();
  return std::isfinite(state) ? state : 0.0;
}

/// The size of the state, m/s, that the tolerances are relative to: the amplitude of the response without
/// contact, or the initial state when that is larger; 1 when both vanish. Harmonics with less than a
/// hundredth of the load do not matter for a size.
double state_scale(const LinearStructure& structure, double angular_frequency,
                   const Eigen::VectorXd& initial) {
  constexpr double small = 1e-2;
  const Eigen::MatrixXcd loads = structure.load_amplitudes(angular_frequency / (2.0 * std::numbers::pi));
  const Eigen::VectorXd sizes = loads.colwise().norm();
  double linear = 0.0;
  for (Eigen::Index m = 0; m < loads.cols(); ++m)
    if (m == 1 || (sizes[m] > 0.0 && sizes[m] >= small * sizes.maxCoeff()))
      linear = std::max(linear, linear_state(structure, angular_frequency, double(m), loads.col(m)));
  const double scale = std::max(linear, initial.cwiseAbs().maxCoeff());
  return scale > 0.0 ? scale : 1.0;
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

/// One end of a step.
struct Instant {
  double time = 0.0;      // periods
  Eigen::VectorXd state;  // 2n, m/s
  Eigen::VectorXd rate;   // 2n, m/s per period
};

/// GSL's evolution objects, with the two ends of the last step.
class Integrator {
 public:
  Integrator(FirstOrderSystem& system, const Eigen::VectorXd& initial, const TimeSteppingOptions& options,
             double scale)
      : system_{derivative_callback, jacobian_callback, static_cast<std::size_t>(system.states()), &system},
        driver_(gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_msbdf, first_step,
                                              options.step_tolerance * options.step_floor * scale,
                                              options.step_tolerance),
                &gsl_odeiv2_driver_free),
        end_{0.0, initial, Eigen::VectorXd(initial.size())} {
    if (!driver_) throw std::bad_alloc();
    derivative_callback(0.0, end_.state.data(), end_.rate.data(), &system);
  }
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// One accepted step, which does not pass `limit` (periods); false when none was found.
  bool advance(double limit) {
    begin_ = end_;
    ++steps_;
    return gsl_odeiv2_evolve_apply(driver_->e, driver_->c, driver_->s, &system_, &end_.time, limit, &step_,
                                   end_.state.data()) == GSL_SUCCESS &&
           derivative_callback(end_.time, end_.state.data(), end_.rate.data(), system_.params) == GSL_SUCCESS;
  }

  const Instant& begin() const { return begin_; }
  const Instant& end() const { return end_; }
  long steps() const { return steps_; }
  long failed_steps() const { return static_cast<long>(driver_->e->failed_steps); }

 private:
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver_;
  double step_ = first_step;
  long steps_ = 0;
  Instant begin_, end_;
};

/// The quintic on [0, 1] with given value, slope and curvature at both ends: the factors of these six, [0]
/// for the start and [1] for the end, in its value (first row) and its slope (second row) at s.
struct QuinticWeights {
  explicit QuinticWeights(double s) {
    const double r = 1.0 - s;
    fill(0, r, s, 1.0);
    fill(1, s, r, -1.0);
  }
  double value[2], slope[2], curvature[2];
  double value_rate[2], slope_rate[2], curvature_rate[2];

 private:
  /// near is 1 at the end that is filled, far is 1 - near; direction is +1 where far grows with s.
  void fill(int end, double near, double far, double direction) {
    const double near2 = near * near;
    value[end] = near2 * near * (1.0 + 3.0 * far + 6.0 * far * far);
    slope[end] = direction * near2 * near * far * (1.0 + 3.0 * far);
    curvature[end] = 0.5 * near2 * near * far * far;
    value_rate[end] = -direction * 30.0 * near2 * far * far;
    slope_rate[end] = near2 * (1.0 - 3.0 * far) * (1.0 + 5.0 * far);
    curvature_rate[end] = direction * 0.5 * near2 * far * (2.0 - 5.0 * far);
  }
};

/// Fills the samples of the period under way from the steps that pass over their times.
class PeriodRecorder {
 public:
  PeriodRecorder(const FirstOrderSystem& system, int points, int longest)
      : system_(system), states_(system.states(), points), longest_(static_cast<std::size_t>(longest)) {}

  /// Records up to the end of the step or of the period; true when the period is complete.
  bool record(const Integrator& step) {
    while (next_ < states_.cols() && time_of(next_) <= step.end().time) interpolate(step, next_++);
    return next_ == states_.cols();
  }

  /// Opens the next period; returns the relative rms difference of this one's contact displacement to the
  /// last one's.
  double close_period() {
    past_.emplace_front(at_contacts(states_.topRows(system_.dofs())).transpose());
    if (past_.size() > longest_ + 1) past_.pop_back();
    next_ = 0;
    ++period_;
    return period_ == 1 ? std::numeric_limits<double>::infinity() : difference_to(1);
  }

  /// The least number of periods, 2 or more, after which the last period repeats one to `tolerance`, and all
  /// in between are clearly others; 0 for none.
  int repeats(double tolerance) const {
    constexpr double apart = 100.0;
    for (std::size_t lag = 1; lag < past_.size(); ++lag) {
      const double difference = difference_to(lag);
      if (lag > 1 && difference < tolerance) return static_cast<int>(lag);
      if (difference < apart * tolerance) return 0;
    }
    return 0;
  }

  Motion contacts() const {
    const int n = system_.dofs();
    Motion motion{at_contacts(states_.topRows(n)) / system_.angular_frequency(),
                  at_contacts(states_.bottomRows(n)),
                  {}};
    motion.force = system_.laws().force(motion.displacement, motion.velocity);
    return motion;
  }

  Motion structure() const {
    const int n = system_.dofs();
    return {states_.topRows(n) / system_.angular_frequency(), states_.bottomRows(n), {}};
  }

 private:
  // Relative rms difference of the last period's contact displacement and that `lag` periods before.
  double difference_to(std::size_t lag) const {
    const double difference = (past_.front() - past_[lag]).norm();
    return difference == 0.0 ? 0.0 : difference / past_.front().norm();
  }

  Eigen::MatrixXd at_contacts(const Eigen::Ref<const Eigen::MatrixXd>& of_all_dofs) const {
    return system_.contact_directions() * of_all_dofs;
  }

  double time_of(Eigen::Index sample) const {
    return period_ + static_cast<double>(sample) / static_cast<double>(states_.cols());
  }

  /// The quintic through y, y' and y'' of the displacement half of the state, where y' = 2 pi u'.
  void interpolate(const Integrator& step, Eigen::Index sample) {
    const int n = system_.dofs();
    const Instant &a = step.begin(), &b = step.end();
    const double h = b.time - a.time;
    const QuinticWeights w((time_of(sample) - a.time) / h);
    const double slope = 2.0 * std::numbers::pi * h, curvature = slope * h;
    states_.col(sample).head(n) =
        w.value[0] * a.state.head(n) + w.value[1] * b.state.head(n) +
        slope * (w.slope[0] * a.state.tail(n) + w.slope[1] * b.state.tail(n)) +
        curvature * (w.curvature[0] * a.rate.tail(n) + w.curvature[1] * b.rate.tail(n));
    states_.col(sample).tail(n) =
        w.value_rate[1] / slope * (b.state.head(n) - a.state.head(n)) + w.slope_rate[0] * a.state.tail(n) +
        w.slope_rate[1] * b.state.tail(n) +
        h * (w.curvature_rate[0] * a.rate.tail(n) + w.curvature_rate[1] * b.rate.tail(n));
  }

  const FirstOrderSystem& system_;
  Eigen::MatrixXd states_;  // 2n x points
  std::size_t longest_;
  std::deque<Eigen::MatrixXd> past_;  // points x contacts, as in the state, the last period first
  Eigen::Index next_ = 0;
  int period_ = 0;
};

/// Whether periods differ as they did 16 periods ago. The difference of a motion that spirals into one of a
/// single period decreases.
bool is_steady(const std::vector<double>& period_error) {
  constexpr std::size_t before = 16;
  constexpr double steady = 1e-3;
  if (period_error.size() <= before) return false;
  const double now = period_error.back(), then = period_error[period_error.size() - 1 - before];
  return std::abs(now - then) <= steady * now;
}

}  // namespace

std::string_view to_string(TimeSteppingStatus status) {
  switch (status) {
    case TimeSteppingStatus::converged:
      return "converged";
    case TimeSteppingStatus::subharmonic:
      return "subharmonic";
    case TimeSteppingStatus::iteration_limit:
      return "iteration_limit";
    case TimeSteppingStatus::step_failure:
      return "step_failure";
    case TimeSteppingStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

void TimeSteppingOptions::validate(int dofs) const {
  constexpr const char* who = "TimeSteppingOptions";
  detail::require_at_least(who, "output_points", output_points, 2);
  detail::require_positive(who, "period_tolerance", period_tolerance);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  detail::require_at_least(who, "longest", longest, 1);
  detail::require_at_least(who, "max_steps_per_period", max_steps_per_period, 1);
  detail::require_positive(who, "step_tolerance", step_tolerance);
  detail::require_positive(who, "step_floor", step_floor);
  detail::require_dofs(who, "initial_displacement", initial_displacement, dofs);
  detail::require_dofs(who, "initial_velocity", initial_velocity, dofs);
}

TimeSteppingResult integrate_to_periodic(const LinearStructure& structure, const ContactLaws& laws,
                                         double frequency_hz, const TimeSteppingOptions& options) {
  detail::require_positive("integrate_to_periodic", "frequency_hz", frequency_hz);
  structure.validate();
  options.validate(structure.size());
  FirstOrderSystem system(structure, laws, frequency_hz);
  const Eigen::VectorXd initial = initial_state(system, options);
  const detail::SilencedGslErrors silence;
  Integrator integrator(system, initial, options,
                        state_scale(structure, system.angular_frequency(), initial));
  PeriodRecorder recorder(system, options.output_points, options.longest);
  TimeSteppingResult result;
  const auto run = [&] {
    while (result.periods < options.max_periods) {
      if (integrator.steps() >= long{options.max_steps_per_period} * (result.periods + 1))
        return TimeSteppingStatus::iteration_limit;
      if (!integrator.advance(options.max_periods)) return TimeSteppingStatus::step_failure;
      while (recorder.record(integrator)) {
        const double difference = recorder.close_period();
        result.contacts = recorder.contacts();
        if (options.full_history) result.structure = recorder.structure();
        if (++result.periods > 1) result.period_error.push_back(difference);
        const double done = std::log(difference) / std::log(options.period_tolerance);
        const bool stop =
            !goes_on(options.observer, {"time stepping", result.periods, difference,
                                        "relative difference of periods", std::clamp(done, 0.0, 1.0)});
        if (difference < options.period_tolerance) return TimeSteppingStatus::converged;
        if (is_steady(result.period_error) && options.longest > 1) {
          const int periods = recorder.repeats(options.period_tolerance);
          if (periods > 1) result.attractor_periods = periods;
          if (periods > 1) return TimeSteppingStatus::subharmonic;
        }
        if (stop) return TimeSteppingStatus::cancelled;
      }
    }
    return TimeSteppingStatus::iteration_limit;
  };
  result.status = run();
  if (result.status == TimeSteppingStatus::converged) result.attractor_periods = 1;
  const bool long_enough = result.periods == options.max_periods && result.periods > 2 * options.longest;
  if (result.status == TimeSteppingStatus::iteration_limit && long_enough) result.attractor_periods = 0;
  result.steps = integrator.steps();
  result.failed_steps = integrator.failed_steps();
  return result;
}

}  // namespace wavebalance::solvers
