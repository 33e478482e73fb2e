#include "mode_augmented_lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "linalg/damped_newton.hpp"
#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "modes/mode_option_checks.hpp"

namespace wavebalance::ll10 {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double min_fundamental_share = 0.5;  // of the kinetic energy, of the mode itself

std::span<const double> view(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

ModalModel checked(ModalModel model, const LagrangianModeOptions& options) {
  options.validate();
  model.validate();
  const int mode = options.mode;
  if (mode < 1 || mode > model.modes())
    solvers::detail::reject("LagrangianMode", "mode", mode,
                            ("in 1.." + std::to_string(model.modes())).c_str());
  if (model.contact_shapes.col(mode - 1).isZero(0.0))
    throw std::invalid_argument("LagrangianMode: mode " + std::to_string(mode) +
                                " does not move any contact point");
  return model;
}

// The contact that the linear mode reaches first as it grows.
Eigen::Index first_contact(const ModalModel& model, int mode) {
  Eigen::Index contact = 0;
  model.contact_shapes.col(mode - 1).cwiseQuotient(model.gaps).cwiseAbs().maxCoeff(&contact);
  return contact;
}

double first_gap(const ModalModel& model, int mode) { return model.gaps[first_contact(model, mode)]; }

double grazing_amplitude(const ModalModel& model, int mode) {
  const Eigen::Index contact = first_contact(model, mode);
  return model.gaps[contact] / std::abs(model.contact_shapes(contact, mode - 1));
}

ModalModel scaled(const ModalModel& model, int mode) {
  const double gap = first_gap(model, mode), amplitude = grazing_amplitude(model, mode);
  return {model.omega_squared / model.omega_squared[mode - 1], model.contact_shapes * (amplitude / gap),
          model.gaps / gap};
}

// A Newton step. If the matrix is singular, as for a motion without contact, which may be shifted in time, it
// is the step of least norm.
bool newton_step(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) {
  constexpr double tiny = 1e-14;
  const solvers::detail::Lu<double> lu(hessian);
  step = lu.is_singular(tiny) ? solvers::detail::least_squares(hessian, gradient) : lu.solve(gradient);
  return step.allFinite();
}

}  // namespace

std::string_view to_string(LagrangianStatus status) {
  using enum LagrangianStatus;
  return solvers::detail::name_in<LagrangianStatus>({{converged, "converged"},
                                                     {linear, "linear"},
                                                     {inner_stalled, "inner_stalled"},
                                                     {inner_limit, "inner_limit"},
                                                     {singular, "singular"},
                                                     {outer_stalled, "outer_stalled"},
                                                     {outer_limit, "outer_limit"},
                                                     {internal_resonance, "tongue"},
                                                     {left_mode, "left_mode"}},
                                                    status);
}

void LagrangianModeOptions::validate() const {
  constexpr const char* who = "LagrangianModeOptions";
  solvers::detail::require_mode_discretisation(who, mode, harmonics, samples);
  solvers::detail::require_positive(who, "inner_tolerance", inner_tolerance);
  solvers::detail::require_at_least(who, "max_inner_iterations", max_inner_iterations, 1);
  solvers::detail::require_at_least(who, "max_outer_iterations", max_outer_iterations, 1);
  solvers::detail::require_at_least(who, "max_step_halvings", max_step_halvings, 0);
}

int LagrangianPoint::newton_iterations() const {
  int total = 0;
  for (const OuterIteration& iteration : history) total += iteration.newton_iterations;
  return total;
}

LagrangianMode::LagrangianMode(ModalModel model, LagrangianModeOptions options)
    : model_(checked(std::move(model), options)),
      options_(options),
      amplitude_(grazing_amplitude(model_, options.mode)),
      gap_(first_gap(model_, options.mode)),
      functional_(scaled(model_, options.mode), {options.harmonics, options.cosine_only}, options.samples,
                  options.formulation) {}

double LagrangianMode::linear_omega() const { return std::sqrt(model_.omega_squared[options_.mode - 1]); }

LagrangianStart LagrangianMode::linear_start(double energy_ratio) const {
  if (!(energy_ratio >= 0.0 && std::isfinite(energy_ratio)))
    solvers::detail::reject("LagrangianMode", "energy_ratio", energy_ratio, "zero or positive, and finite");
  const Eigen::Index contact = first_contact(model_, options_.mode);
  const double sign = model_.contact_shapes(contact, options_.mode - 1) > 0.0 ? 1.0 : -1.0;
  LagrangianStart start{Eigen::MatrixXcd::Zero(model_.modes(), options_.harmonics + 1), {}};
  start.amplitudes(options_.mode - 1, 1) = 0.5 * sign * amplitude_ * std::sqrt(energy_ratio);
  return start;
}

Eigen::VectorXd LagrangianMode::to_unknowns(const Eigen::MatrixXcd& amplitudes) const {
  const FourierLayout& layout = functional_.layout();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(functional_.unknowns());
  for (int block = 0; block < layout.blocks(); ++block) {
    const int n = layout.harmonic(block);
    if (n >= amplitudes.cols()) break;
    auto part = x.segment(Eigen::Index(block) * model_.modes(), model_.modes());
    const double both = n == 0 ? 1.0 : 2.0;
    if (layout.is_sine(block))
      part = -both / amplitude_ * amplitudes.col(n).imag();
    else
      part = both / amplitude_ * amplitudes.col(n).real();
  }
  return x;
}

Eigen::MatrixXcd LagrangianMode::to_amplitudes(const Eigen::VectorXd& x) const {
  const FourierLayout& layout = functional_.layout();
  Eigen::MatrixXcd amplitudes = Eigen::MatrixXcd::Zero(model_.modes(), options_.harmonics + 1);
  for (int block = 0; block < layout.blocks(); ++block) {
    const auto part = x.segment(Eigen::Index(block) * model_.modes(), model_.modes());
    const std::complex<double> unit = layout.is_sine(block) ? std::complex<double>(0.0, -0.5)
                                      : block == 0          ? std::complex<double>(1.0)
                                                            : std::complex<double>(0.5);
    amplitudes.col(layout.harmonic(block)) += amplitude_ * unit * part;
  }
  return amplitudes;
}

void LagrangianMode::require_fit(const Multipliers& multipliers, const LagrangianStart& start) const {
  if (multipliers.inequalities() != constraints() || multipliers.equalities() != 1)
    throw std::invalid_argument(
        "LagrangianMode: the strategy has " + std::to_string(multipliers.inequalities()) +
        " inequality and " + std::to_string(multipliers.equalities()) +
        " equality constraints; it must have " + std::to_string(constraints()) + " and 1");
  if (start.amplitudes.rows() != model_.modes() || start.amplitudes.cols() > options_.harmonics + 1)
    throw std::invalid_argument(
        "LagrangianMode: start.amplitudes is " + std::to_string(start.amplitudes.rows()) + " x " +
        std::to_string(start.amplitudes.cols()) + "; it must be " + std::to_string(model_.modes()) + " x " +
        std::to_string(options_.harmonics + 1) + " or have fewer columns");
  const bool fits = start.force.rows() == model_.contacts() && start.force.cols() == options_.samples;
  if (start.force.size() != 0 && !fits)
    throw std::invalid_argument("LagrangianMode: start.force is " + std::to_string(start.force.rows()) +
                                " x " + std::to_string(start.force.cols()) + "; it must be empty or " +
                                std::to_string(model_.contacts()) + " x " + std::to_string(options_.samples));
}

// lambda = 2 force / m in scaled units, and mu from x . (stationarity) = 0, where x . grad r = 0:
// x . (2/m)(A - rho D) x + <lambda, u> + 2 mu (h + gamma) = 0.
void LagrangianMode::start_multipliers(Multipliers& multipliers, const Eigen::VectorXd& x,
                                       const Eigen::MatrixXd& force, std::optional<double> frozen) const {
  const RayleighQuotient& quotient = functional_.quotient();
  const double m = quotient.mass().value(x);
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(constraints());
  if (force.size() != 0) {
    const double unit = model_.omega_squared[options_.mode - 1] * amplitude_ * amplitude_ / gap_;
    Eigen::Map<RowMajor>(lambda.data(), force.rows(), force.cols()) =
        (2.0 / (m * unit) * force).cwiseMax(0.0);
  }
  double virial = x.dot(functional_.generalised_force(lambda));
  if (frozen) virial += 2.0 * (quotient.value(x) - *frozen);
  multipliers.restart(view(lambda), -virial / (2.0 * functional_.normalisation(x)));
}

// The stationarity condition for damped_newton().
class LagrangianMode::Stationarity {
 public:
  Stationarity(const LagrangianMode& mode, double gamma, const Multipliers& multipliers,
               std::optional<double> frozen)
      : mode_(mode), gamma_(gamma), multipliers_(multipliers), frozen_(frozen) {}

  double evaluate(const Eigen::VectorXd& x) {
    x_ = x;
    gradient_ = mode_.functional_.gradient(x, gamma_, multipliers_, frozen_);
    return norm();
  }
  double norm() const { return gradient_.norm(); }
  double largest() const { return gradient_.cwiseAbs().maxCoeff(); }
  bool is_solved() const { return largest() <= mode_.options_.inner_tolerance; }
  bool direction(Eigen::VectorXd& direction) const {
    return newton_step(mode_.functional_.hessian(x_, gamma_, multipliers_, frozen_), gradient_, direction);
  }
  bool goes_on(int) const { return true; }

 private:
  const LagrangianMode& mode_;
  double gamma_;
  const Multipliers& multipliers_;
  std::optional<double> frozen_;
  Eigen::VectorXd x_, gradient_;
};

LagrangianMode::Newton LagrangianMode::critical_point(Eigen::VectorXd& x, double gamma,
                                                      const Multipliers& multipliers,
                                                      std::optional<double> frozen) const {
  constexpr double min_step = 1.0 / (1 << 29);
  Stationarity condition(*this, gamma, multipliers, frozen);
  const solvers::detail::NewtonRun run =
      solvers::detail::damped_newton(condition, x, options_.max_inner_iterations, min_step);
  const auto status = [&] {
    switch (run.end) {
      case solvers::detail::NewtonEnd::solved:
        return LagrangianStatus::converged;
      case solvers::detail::NewtonEnd::iteration_limit:
        return LagrangianStatus::inner_limit;
      case solvers::detail::NewtonEnd::singular:
        return LagrangianStatus::singular;
      case solvers::detail::NewtonEnd::stalled:
      case solvers::detail::NewtonEnd::cancelled:
        break;
    }
    return LagrangianStatus::inner_stalled;
  };
  return {status(), run.iterations, condition.largest()};
}

LagrangianPoint LagrangianMode::solve(double energy_ratio, Multipliers& multipliers,
                                      const LagrangianStart& given,
                                      std::optional<double> predicted_rayleigh) const {
  if (!(energy_ratio > 0.0))
    solvers::detail::reject("LagrangianMode", "energy_ratio", energy_ratio, "positive");
  const bool contact = energy_ratio > 1.0;
  const LagrangianStart& start = contact ? given : linear_start(energy_ratio);
  require_fit(multipliers, start);
  Eigen::VectorXd x = to_unknowns(start.amplitudes);
  std::optional<double> frozen;
  if (options_.eigenvalue == EigenvalueUpdate::sequential)
    frozen = contact && predicted_rayleigh ? *predicted_rayleigh / model_.omega_squared[options_.mode - 1]
                                           : functional_.quotient().value(x);
  start_multipliers(multipliers, x, start.force, frozen);
  LagrangianPoint point;
  point.prescribed_ratio = energy_ratio;
  for (int outer = 0; outer < options_.max_outer_iterations; ++outer)
    if (const auto status = outer_iteration(point, x, multipliers, frozen)) {
      point.status = *status;
      break;
    }
  return point;
}

// The status if the iteration ends here.
std::optional<LagrangianStatus> LagrangianMode::outer_iteration(LagrangianPoint& point, Eigen::VectorXd& x,
                                                                Multipliers& multipliers,
                                                                std::optional<double> frozen) const {
  const double gamma = 0.25 * point.prescribed_ratio;
  const Newton inner = critical_point(x, gamma, multipliers, frozen);
  const Eigen::VectorXd g = functional_.gap_function(x);
  const double h = functional_.normalisation(x) - gamma;
  Eigen::VectorXd multiplier(g.size()), tangent(g.size());
  const auto count = static_cast<std::size_t>(g.size());
  multipliers.inequality_force(view(g), {multiplier.data(), count}, {tangent.data(), count});
  measure(point, x, multiplier, multipliers.equality_force(h), frozen);
  point.history.push_back({inner.iterations, inner.gradient, solvers::missing, solvers::missing});
  if (inner.status != LagrangianStatus::converged) return inner.status;
  const MultiplierReport report = multipliers.update(view(g), h);
  point.history.back().inequality_measure = report.inequality_measure;
  point.history.back().equality_measure = report.equality_measure;
  if (report.converged) return classify(point);
  if (report.stalled) return LagrangianStatus::outer_stalled;
  return {};
}

void LagrangianMode::measure(LagrangianPoint& point, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& multiplier, double pull,
                             std::optional<double> frozen) const {
  const RayleighQuotient& quotient = functional_.quotient();
  const Eigen::VectorXd elastic = quotient.stiffness().apply(x), inertia = quotient.mass().apply(x);
  const double unit = model_.omega_squared[options_.mode - 1];
  const double m = x.dot(inertia), r = x.dot(elastic) / m;
  double squared = r;  // omega^2 over its value in the linear mode
  const Eigen::MatrixXd gaps = (model_.gaps / gap_).replicate(1, options_.samples);
  const Eigen::Map<const RowMajor> lambda(multiplier.data(), model_.contacts(), options_.samples);
  if (options_.formulation == ModeFormulation::consistent)
    squared += 0.5 * lambda.cwiseProduct(gaps).sum() / options_.samples;
  // All blocks are multiplied by their weights w_b.
  const Eigen::VectorXd residual =
      elastic - squared * inertia + 0.5 * m * functional_.generalised_force(multiplier);
  const double balance = frozen.value_or(r) - 0.5 * m * pull;
  point.energy_ratio = 2.0 * m;
  point.rayleigh = unit * r;
  point.omega = std::sqrt(unit * squared);
  point.amplitudes = to_amplitudes(x);
  point.force = (0.5 * m * unit * amplitude_ * amplitude_ / gap_) * lambda;
  point.equation_residual = residual.norm() / elastic.norm();
  point.virial_residual = std::abs(squared - balance) / squared;
  const Eigen::VectorXd g = functional_.gap_function(x);
  point.max_penetration =
      Eigen::Map<const RowMajor>(g.data(), gaps.rows(), gaps.cols()).cwiseQuotient(gaps).maxCoeff();
  point.min_force = point.force.minCoeff();
  measure_shares(point);
}

void LagrangianMode::measure_shares(LagrangianPoint& point) const {
  const Eigen::Index harmonics = point.amplitudes.cols() - 1;
  const Eigen::RowVectorXd n = Eigen::RowVectorXd::LinSpaced(harmonics, 1.0, double(harmonics));
  Eigen::MatrixXd shares =
      point.amplitudes.rightCols(harmonics).cwiseAbs2() * n.cwiseAbs2().asDiagonal();  // r x N, from n = 1
  shares /= shares.sum();
  point.fundamental_share = shares.col(0).sum();
  point.resonance = {};
  for (Eigen::Index column = 1; column < harmonics; ++column) {
    Eigen::Index mode = 0;
    const double share = shares.col(column).maxCoeff(&mode);
    if (share > point.resonance.share)
      point.resonance = {static_cast<int>(column + 1), static_cast<int>(mode + 1), share};
  }
}

LagrangianStatus LagrangianMode::classify(const LagrangianPoint& point) const {
  if (point.fundamental_share < min_fundamental_share) return LagrangianStatus::left_mode;
  if (point.force.isZero(0.0)) return LagrangianStatus::linear;
  if (point.resonance.share < solvers::resonance_share) return LagrangianStatus::converged;
  const double omega_j = std::sqrt(model_.omega_squared[point.resonance.mode - 1]);
  const double detuning = std::abs(point.resonance.harmonic * point.omega - omega_j) / omega_j;
  return detuning <= solvers::resonance_detuning ? LagrangianStatus::internal_resonance
                                                 : LagrangianStatus::converged;
}

std::vector<LagrangianPoint> LagrangianMode::branch(std::span<const double> energy_ratios,
                                                    const contact::MultiplierUpdate& strategy,
                                                    const LagrangianStart& start) const {
  std::vector<LagrangianPoint> points, path;  // path holds the points between, too
  for (const double target : energy_ratios) {
    double ratio = target;
    for (int halvings = 0;;) {
      const Prediction from = predict(path, ratio, start);
      contact::MultiplierUpdate fresh(strategy);
      const LagrangianPoint point = solve(ratio, fresh, from.start, from.rayleigh);
      if (point.accepted()) path.push_back(point);
      const bool given_up = !point.accepted() && (path.empty() || halvings == options_.max_step_halvings);
      if (given_up || (point.accepted() && ratio == target)) points.push_back(point);
      if (given_up) return points;
      if (point.accepted() && ratio == target) break;
      halvings += point.accepted() ? 0 : 1;
      ratio = point.accepted() ? target : 0.5 * (ratio + path.back().prescribed_ratio);
    }
  }
  return points;
}

LagrangianMode::Prediction LagrangianMode::predict(const std::vector<LagrangianPoint>& points,
                                                   double energy_ratio, const LagrangianStart& start) const {
  if (points.empty()) return {start, {}};
  const LagrangianPoint& last = points.back();
  if (last.status == LagrangianStatus::linear) return {start, {}};
  Prediction result{{last.amplitudes, last.force}, last.rayleigh};
  if (points.size() < 2) return result;
  const LagrangianPoint& before = points[points.size() - 2];
  const double width = last.prescribed_ratio - before.prescribed_ratio;
  // The branch has a kink at grazing, so a secant across it is no prediction.
  if (before.status == LagrangianStatus::linear || width == 0.0) return result;
  const double t = (energy_ratio - last.prescribed_ratio) / width;
  result.start.amplitudes += t * (last.amplitudes - before.amplitudes);
  result.start.force = (last.force + t * (last.force - before.force)).cwiseMax(0.0);
  result.rayleigh = last.rayleigh + t * (last.rayleigh - before.rayleigh);
  return result;
}

}  // namespace wavebalance::ll10
