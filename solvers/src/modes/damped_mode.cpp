#include "wavebalance/solvers/modes/damped_mode.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "modes/damped_equations.hpp"

namespace wavebalance::solvers {
namespace {

/// Follows the curve of a damped mode.
class DampedFollower : private CurveCorrector<DampedMotions> {
 public:
  DampedFollower(const DampedProblem& problem, const DampedBackboneOptions& options)
      : CurveCorrector(DampedMotions(problem, options)), problem_(problem), options_(options) {}

  DampedBackbone follow() {
    if (!start()) return result_;
    const double last = std::log(options_.last_amplitude);
    double step = options_.initial_step;
    while (state_.parameter < last) {
      if (!goes_on(options_.observer, progress())) return ended(DampedBackboneStatus::cancelled);
      if (static_cast<int>(result_.points.size()) >= options_.max_points)
        return ended(DampedBackboneStatus::point_limit);
      if (!advance(step, last)) return ended(DampedBackboneStatus::lost);
      if (state_.parameter < std::log(options_.first_amplitude)) return ended(DampedBackboneStatus::lost);
      keep();
    }
    return ended(DampedBackboneStatus::reached_amplitude);
  }

 private:
  bool start() {
    const int rows = problem_.rows(), last = problem_.contacts() * rows;
    state_.displacement.setZero(problem_.unknowns());
    for (int c = 0; c < problem_.contacts(); ++c)
      state_.displacement[c * rows + problem_.transform.pair.real_rows[1]] = problem_.linear_shape()[c];
    state_.displacement[last] = 1.0;
    state_.displacement[last + 1] = problem_.linear_damping();
    state_.parameter = std::log(options_.first_amplitude);
    CurvePoint along;
    along.displacement_tangent.setZero(problem_.unknowns());
    along.parameter_tangent = 1.0;
    if (!solve_in(plane_at(state_.parameter), nullptr, state_, iterations_)) return false;
    if (!tangent_at(state_, along)) return false;
    keep();
    return true;
  }

  CurvePlane plane_at(double parameter) const {
    return {Eigen::VectorXd::Zero(problem_.unknowns()), 1.0, parameter, 1e-12};
  }

  bool advance(double& step, double last) {
    return halve_until_taken(step, options_.min_step, [&] {
      CurvePoint next = ahead(state_, step);
      const bool ends = next.parameter >= last;
      if (ends) next = ahead(state_, (last - state_.parameter) / state_.parameter_tangent);
      const CurvePlane plane = ends ? plane_at(last) : plane_across(state_, next);
      if (!solve_in(plane, nullptr, next, iterations_) || !is_near(next, step)) return StepAttempt::too_long;
      CurvePoint way = chord(state_, next);
      if (!tangent_at(next, way) || !orient(next)) return StepAttempt::too_long;
      state_ = std::move(next);
      if (ends) state_.parameter = last;
      step = std::clamp(step * (iterations_ <= 3   ? 1.6
                                : iterations_ <= 6 ? 1.0
                                                   : 0.6),
                        options_.min_step, options_.max_step);
      return StepAttempt::taken;
    });
  }

  // Where contacts begin to slip the curve turns within a step, so that its chord does not give the
  // direction. The last part of the way does, which is halved until the tangent lies along it.
  bool orient(CurvePoint& next) {
    constexpr double along = 0.7;
    constexpr int halvings = 12;
    CurvePoint from = state_;
    for (int n = 0; n < halvings; ++n) {
      const CurvePoint way = chord(from, next);
      const double length = std::sqrt(inner(way, way)), cosine = inner(next, way) / length;
      if (std::abs(cosine) > along) {
        next.displacement_tangent *= std::copysign(1.0, cosine);
        next.parameter_tangent *= std::copysign(1.0, cosine);
        return true;
      }
      CurvePoint middle;
      int corrections = 0;
      if (!between(from, next, 0.5, length, middle, corrections)) return false;
      from = std::move(middle);
    }
    return false;
  }

  // Where a contact begins to slip the tangent jumps, so that short chords have any direction.
  bool is_near(const CurvePoint& next, double step) const {
    const CurvePoint way = chord(state_, next);
    return std::sqrt(inner(way, way)) <= std::max(3.0 * step, options_.initial_step);
  }

  void keep() {
    const int last = problem_.contacts() * problem_.rows();
    DampedMotions& motions = curve();
    DampedPoint point;
    point.residual = motions.evaluate(state_, nullptr);
    point.amplitude = std::exp(state_.parameter);
    point.omega = state_.displacement[last] * problem_.omega;
    point.xi = state_.displacement[last + 1] * problem_.omega;
    point.iterations = iterations_;
    point.displacement = motions.displacement().transpose();
    point.force = motions.force().transpose();
    result_.points.push_back(std::move(point));
  }

  Progress progress() const {
    const double from = std::log(options_.first_amplitude), to = std::log(options_.last_amplitude);
    return {"damped mode", static_cast<int>(result_.points.size()), std::exp(state_.parameter), "m",
            (state_.parameter - from) / (to - from)};
  }

  DampedBackbone ended(DampedBackboneStatus status) {
    result_.status = status;
    return std::move(result_);
  }

  const DampedProblem& problem_;
  const DampedBackboneOptions& options_;
  CurvePoint state_;
  int iterations_ = 0;
  DampedBackbone result_;
};

}  // namespace

std::string_view to_string(DampedBackboneStatus status) {
  using enum DampedBackboneStatus;
  return detail::name_in<DampedBackboneStatus>({{reached_amplitude, "reached_amplitude"},
                                                {lost, "lost"},
                                                {no_start, "no_start"},
                                                {point_limit, "point_limit"},
                                                {cancelled, "cancelled"}},
                                               status);
}

void DampedBackboneOptions::validate() const {
  constexpr const char* who = "DampedBackboneOptions";
  detail::require_positive(who, "first_amplitude", first_amplitude);
  detail::require_positive(who, "last_amplitude", last_amplitude);
  if (!(last_amplitude > first_amplitude))
    detail::reject(who, "last_amplitude", last_amplitude, "above first_amplitude");
  detail::require_positive(who, "initial_step", initial_step);
  detail::require_positive(who, "min_step", min_step);
  detail::require_positive(who, "max_step", max_step);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_points", max_points, 1);
}

DampedMode::DampedMode(const LinearStructure& structure, const TimePair& pair, ContactLaws laws, int mode) {
  problem_ = std::make_shared<const DampedProblem>(damped_problem(structure, pair, std::move(laws), mode));
}

double DampedMode::linear_omega() const { return problem_->omega; }

double DampedMode::linear_damping_ratio() const { return 0.5 * problem_->linear_damping(); }

int DampedMode::unknowns() const { return problem_->unknowns(); }

double DampedMode::linear_amplitude() const {
  constexpr int points = 64;
  constexpr double rounding = 1e-9;
  const int contacts = problem_->contacts();
  const Eigen::VectorXd shape = problem_->linear_shape();
  Eigen::MatrixXd wave(points, contacts), rate(points, contacts);
  for (int l = 0; l < points; ++l) {
    const double angle = 2.0 * std::numbers::pi * l / points;
    wave.row(l) = std::cos(angle) * shape.transpose();
    rate.row(l) = -linear_omega() * std::sin(angle) * shape.transpose();
  }
  const auto departs = [&](double amplitude) {
    const Eigen::MatrixXd motion = amplitude * wave;
    const Eigen::MatrixXd samples = motion.rowwise() + problem_->rest.transpose();
    ContactForces forces;
    const Eigen::VectorXd velocity = amplitude * rate.reshaped();
    problem_->laws.evaluate(contacts, samples.reshaped(), velocity, forces);
    const Eigen::MatrixXd linear = motion * problem_->rest_slope.transpose();
    const Eigen::MatrixXd rest =
        (forces.force.reshaped(points, contacts) - linear).rowwise() - problem_->rest_force.transpose();
    const double scale = linear.cwiseAbs().maxCoeff() + problem_->rest_force.cwiseAbs().maxCoeff();
    return rest.cwiseAbs().maxCoeff() > rounding * scale;
  };
  constexpr double smallest = 1e-30, largest = 1e30;
  if (departs(smallest)) return 0.0;
  if (!departs(largest)) return std::numeric_limits<double>::infinity();
  double below = smallest, above = largest;
  while (above / below - 1.0 > 1e-12) {
    const double middle = std::sqrt(below) * std::sqrt(above);
    (departs(middle) ? above : below) = middle;
  }
  return above;
}

DampedBackbone DampedMode::backbone(const DampedBackboneOptions& options) const {
  options.validate();
  return DampedFollower(*problem_, options).follow();
}

Eigen::MatrixXcd DampedMode::amplitudes(const DampedPoint& point, const Eigen::MatrixXd& places) const {
  const PairTransform& pair = problem_->transform.pair;
  const Eigen::MatrixXd shapes = detail::product(places, problem_->shapes);
  const Eigen::MatrixXcd spectra =
      shapes.cast<std::complex<double>>() * DampedMotions(*problem_, {}).modal_coefficients(point);
  Eigen::MatrixXcd amplitudes = spectra * pair.harmonics.transpose();
  amplitudes += spectra.conjugate() * pair.conjugated.transpose();
  amplitudes.col(0) += places * problem_->rest_state;
  return amplitudes;
}

}  // namespace wavebalance::solvers
