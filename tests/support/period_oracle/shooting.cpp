#include "period_oracle/shooting.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "linalg/damped_newton.hpp"
#include "linalg/dense.hpp"
#include "period_oracle/shooting_propagator.hpp"

namespace wavebalance::oracle {

using solvers::AnyContactLaw, solvers::LinearStructure;
using solvers::detail::NewtonEnd, solvers::detail::NewtonRun;

namespace {

constexpr int fewest_steps = 512;  // per period

/// Steps of the period such that every output time is the end of one: base 2^level = points repeat.
struct OutputGrid {
  explicit OutputGrid(int points) : base(points) {
    while (base % 2 == 0 && base / 2 >= fewest_steps) {
      base /= 2;
      ++level;
    }
    repeat = (fewest_steps + base - 1) / base;
    base *= repeat;
  }
  int base;        // steps of the coarsest level in the Newton iteration
  int level = 0;   // coarsest level when samples are taken
  int repeat = 1;  // steps of that level per output point
};

double largest_load(const LinearStructure& structure, double frequency_hz) {
  return structure.load_amplitudes(frequency_hz).cwiseAbs().rowwise().sum().maxCoeff();
}

class Shooting {
 public:
  Shooting(const LinearStructure& structure, const AnyContactLaw& law, double frequency_hz,
           const ShootingOptions& options)
      : options_(options),
        law_(law),
        grid_(options.output_points),
        propagator_(ModalStructure(structure, frequency_hz), law, largest_load(structure, frequency_hz),
                    grid_.base, options.step_tolerance) {}

  ShootingResult run() {
    ShootingResult result;
    Eigen::VectorXd state = initial_deviation();
    result.status = settle(state);
    if (result.status == ShootingStatus::converged) result.status = iterate(state, result);
    if (result.status != ShootingStatus::step_failure) record(state, result);
    result.steps = propagator_.steps();
    return result;
  }

 private:
  // A period leaves the state unchanged; for damped_newton().
  class PeriodicityEquation {
   public:
    explicit PeriodicityEquation(Shooting& shooting) : shooting_(shooting) {}

    double evaluate(const Eigen::VectorXd& state) {
      state_ = state;
      return norm_ = shooting_.residual(state, change_, nullptr);
    }
    double norm() const { return norm_; }
    bool is_solved() {
      history_.push_back(norm_);
      return norm_ <= shooting_.options_.tolerance;
    }
    bool direction(Eigen::VectorXd& direction) {
      Eigen::MatrixXd sensitivity;
      if (!std::isfinite(shooting_.residual(state_, change_, &sensitivity))) return false;
      sensitivity.diagonal().array() -= 1.0;
      direction = solvers::detail::Lu<double>(sensitivity).solve(change_);
      return direction.allFinite();
    }
    bool goes_on(int) const { return std::isfinite(norm_); }
    const std::vector<double>& history() const { return history_; }

   private:
    Shooting& shooting_;
    Eigen::VectorXd state_, change_;
    double norm_ = 0.0;
    std::vector<double> history_;
  };

  const ModalStructure& modes() const { return propagator_.modes(); }

  Eigen::VectorXd initial_deviation() const {
    const int n = modes().size();
    const Eigen::VectorXd linear = total(Eigen::VectorXd::Zero(2 * n), 0.0);
    Eigen::VectorXd deviation = Eigen::VectorXd::Zero(2 * n);
    if (options_.initial_displacement.size() > 0)
      deviation.head(n) = modes().projection * options_.initial_displacement - linear.head(n);
    if (options_.initial_velocity.size() > 0)
      deviation.tail(n) = modes().projection * options_.initial_velocity - linear.tail(n);
    return deviation;
  }

  /// Integrates the settling periods; converged when all of them are.
  ShootingStatus settle(Eigen::VectorXd& state) {
    for (int period = 0; period < options_.settling_periods; ++period) {
      if (!propagator_.propagate_period(state, nullptr)) return ShootingStatus::step_failure;
    }
    return ShootingStatus::converged;
  }

  /// The modal state (q, q') at the time t = periods T from its deviation.
  Eigen::VectorXd total(const Eigen::VectorXd& deviation, double periods) const {
    const int n = modes().size();
    Eigen::VectorXd result = deviation;
    for (Eigen::Index m = 0; m < modes().linear_response.cols(); ++m) {
      if (modes().linear_response.col(m).isZero(0.0)) continue;
      const Eigen::VectorXcd linear =
          std::polar(1.0, 2.0 * std::numbers::pi * double(m) * periods) * modes().linear_response.col(m);
      result.head(n) += linear.real();
      result.tail(n) -= double(m) * modes().angular_frequency * linear.imag();
    }
    return result;
  }

  double energy_norm(const Eigen::VectorXd& state) const {
    const int n = modes().size();
    const auto weight =
        modes().stiffness.array().abs().max(modes().angular_frequency * modes().angular_frequency);
    return std::sqrt((weight * state.head(n).array().square()).sum() + state.tail(n).squaredNorm());
  }

  /// Relative change of the state over a period; infinity when it cannot be integrated.
  double residual(const Eigen::VectorXd& state, Eigen::VectorXd& change, Eigen::MatrixXd* sensitivity) {
    change = state;
    if (sensitivity != nullptr) sensitivity->setIdentity(state.size(), state.size());
    if (!propagator_.propagate_period(change, sensitivity)) return std::numeric_limits<double>::infinity();
    change -= state;
    const double size = energy_norm(total(state, 0.0));
    return size > 0.0 ? energy_norm(change) / size : energy_norm(change);
  }

  ShootingStatus iterate(Eigen::VectorXd& state, ShootingResult& result) {
    constexpr double min_step = 1.0 / 8192;
    PeriodicityEquation equation(*this);
    const NewtonRun run = solvers::detail::damped_newton(equation, state, options_.max_iterations, min_step);
    result.iterations = run.iterations;
    result.residual_history = equation.history();
    result.residual = result.residual_history.back();
    if (!std::isfinite(result.residual)) return ShootingStatus::step_failure;
    store_multipliers(state, result);
    switch (run.end) {
      case NewtonEnd::solved:
        return ShootingStatus::converged;
      case NewtonEnd::iteration_limit:
        return ShootingStatus::iteration_limit;
      case NewtonEnd::cancelled:
      case NewtonEnd::singular:
      case NewtonEnd::stalled:
        break;
    }
    return ShootingStatus::stalled;
  }

  void store_multipliers(const Eigen::VectorXd& state, ShootingResult& result) {
    Eigen::VectorXd change;
    Eigen::MatrixXd sensitivity;
    residual(state, change, &sensitivity);
    result.floquet_multipliers = solvers::detail::eigenvalues(sensitivity);
    std::stable_sort(result.floquet_multipliers.begin(), result.floquet_multipliers.end(),
                     [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  }

  void record(const Eigen::VectorXd& start, ShootingResult& result) {
    const int n = modes().size(), points = options_.output_points;
    Eigen::MatrixXd q(n, points), v(n, points);
    Eigen::VectorXd state = start;
    propagator_.propagate_period(
        state, nullptr, grid_.level, [&](int step, const Eigen::VectorXd& deviation) {
          if (step % grid_.repeat != 0) return;
          const int point = step / grid_.repeat;
          const Eigen::VectorXd at = total(deviation, static_cast<double>(point) / points);
          q.col(point) = at.head(n);
          v.col(point) = at.tail(n);
        });
    result.displacement = modes().shapes * q.col(0);
    result.velocity = modes().shapes * v.col(0);
    result.contacts.displacement = modes().contact.transpose() * q;
    result.contacts.velocity = modes().contact.transpose() * v;
    result.contacts.force = result.contacts.displacement.unaryExpr([&](double u) { return law_.force(u); });
    if (options_.full_history) result.structure = {modes().shapes * q, modes().shapes * v, {}};
  }

  const ShootingOptions& options_;
  const AnyContactLaw& law_;
  OutputGrid grid_;
  ContactPropagator propagator_;
};

}  // namespace

ShootingResult shoot(const LinearStructure& structure, const AnyContactLaw& law, double frequency_hz,
                     const ShootingOptions& options) {
  if (!(frequency_hz > 0.0 && std::isfinite(frequency_hz)))
    throw std::invalid_argument("shoot: frequency_hz is " + std::to_string(frequency_hz) +
                                "; it must be positive and finite");
  structure.validate();
  require_single_contact(structure, "shoot");
  if (law.depends_on_velocity())
    throw std::invalid_argument(
        "shoot: the force of the law depends on the velocity; integrate_by_events takes such laws");
  return Shooting(structure, law, frequency_hz, options).run();
}

}  // namespace wavebalance::oracle
