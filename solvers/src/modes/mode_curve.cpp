#include "modes/mode_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/bordered.hpp"

namespace wavebalance::solvers {

namespace {

CurveState state_of(const Eigen::VectorXd& unknowns) {
  CurveState state;
  state.displacement = unknowns.head(unknowns.size() - 1);
  state.parameter = unknowns[unknowns.size() - 1];
  return state;
}

}  // namespace

FreeMotions::FreeMotions(ModeEquations& equations, const ElasticBackboneOptions& options, double tolerance)
    : equations_(equations), options_(options), tolerance_(tolerance) {
  const ModeProblem& problem = equations.problem();
  const int contacts = problem.contacts(), rows = problem.rows();
  metric_.setZero(problem.size() - 1);
  for (int c = 0; c < contacts; ++c) {
    const double length = problem.unit / problem.model.gaps[c];
    metric_.segment(c * rows, rows) = length * length / contacts * problem.transform.mean_square;
  }
  squared_parameter_scale_ = problem.first_inertia() * options.frequency_scale * options.frequency_scale;
}

double FreeMotions::evaluate(const CurvePoint& point, const Pieces*) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (!point.displacement.allFinite() || !(point.parameter > 0.0)) return none;
  Eigen::VectorXd unknowns(point.displacement.size() + 1);
  unknowns << point.displacement, point.parameter;
  equations_.evaluate(unknowns);
  return residual().allFinite() ? equations_.relative_residual() : none;
}

bool FreeMotions::solve_bordered(const Eigen::VectorXd& row, double last, const Eigen::VectorXd& right,
                                 double last_right, Eigen::VectorXd& change, double& parameter_change) const {
  return solve_bordered_dense(equations_.jacobian(), row, last, right, last_right, change, parameter_change);
}

ModeCurve::ModeCurve(ModeEquations& equations, const ElasticBackboneOptions& options, double tolerance)
    : CurveCorrector(FreeMotions(equations, options, tolerance)),
      equations_(equations),
      options_(options),
      step_(options.initial_step) {}

CurveState ModeCurve::linear_state(double q) const {
  const ModeProblem& problem = equations_.problem();
  const int contacts = problem.contacts(), rows = problem.rows();
  CurveState state;
  state.displacement_tangent.setZero(problem.size() - 1);
  for (int c = 0; c < contacts; ++c)
    state.displacement_tangent[c * rows + problem.transform.real_rows[1]] =
        problem.model.contact_shapes(c, problem.mode) * problem.amplitude / problem.unit;
  state.displacement_tangent[contacts * rows] = 1.0;
  state.displacement = q * state.displacement_tangent;
  state.parameter = problem.linear_omega() / problem.omega();
  normalize(state);
  return state;
}

bool ModeCurve::correct(const CurveState& from, double distance, CurveState& to) {
  // Where a sample comes into contact the tangent may jump by any angle, so that short chords have any
  // direction.
  constexpr double most_chord = 3.0;
  static_cast<CurvePoint&>(to) = ahead(from, distance);
  if (!solve_in(plane_across(from, to), nullptr, to, to.iterations)) return false;
  CurvePoint way = chord(from, to);
  const double longest = std::max(most_chord * std::abs(distance), options_.initial_step);
  if (std::sqrt(inner(way, way)) > longest) return false;
  if (distance < 0.0) way = chord(to, from);
  return tangent_at(to, way);
}

bool ModeCurve::project_onto_curve(CurveState& state) {
  const CurvePoint along = state;
  return solve_in(plane_across(along, along), nullptr, state, state.iterations) && tangent_at(state, along);
}

bool ModeCurve::project_onto_curve_at(double frequency, double direction, CurveState& state) {
  const CurvePlane plane{Eigen::VectorXd::Zero(state.displacement.size()), 1.0, frequency, 1e-9};
  CurvePoint along;
  along.displacement_tangent = plane.row;
  along.parameter_tangent = direction;
  state.parameter = frequency;
  return solve_in(plane, nullptr, state, state.iterations) && tangent_at(state, along);
}

bool ModeCurve::between(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double share, CurveState& state) {
  constexpr double farthest = 0.25;  // from the chord, over its length
  const CurveState from = state_of(a), to = state_of(b);
  return CurveCorrector::between(from, to, share, farthest * distance(from, to), state, state.iterations);
}

bool ModeCurve::advance(CurveState& state) {
  CurveState next;
  int spent = 0;
  return halve_until_taken(step_, options_.min_step, [&] {
    const bool found = correct(state, step_, next);
    spent += next.iterations;
    if (!found) return StepAttempt::too_long;
    last_step_ = step_;
    step_ *= next.iterations <= 3 ? 1.6 : next.iterations <= 5 ? 1.0 : 0.6;
    step_ = std::clamp(step_, options_.min_step, options_.max_step);
    state = next;
    state.iterations = spent;
    return StepAttempt::taken;
  });
}

bool ModeCurve::leap(CurveState& state, const std::function<bool()>& accepts) {
  // A chord much longer than the step leads aside, to another curve.
  constexpr double longest = 1.0, most_chord = 1.2;
  CurveState next;
  for (double length = 2.0 * options_.initial_step; length <= longest; length *= 1.5) {
    if (!correct(state, length, next) || distance(state, next) > most_chord * length) continue;
    curve().evaluate(next, nullptr);
    if (!accepts()) continue;
    last_step_ = length;
    step_ = options_.initial_step;
    state = std::move(next);
    return true;
  }
  return false;
}

}  // namespace wavebalance::solvers
