#include "modes/mode_curve.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {

ModeCurve::ModeCurve(ModeEquations& equations, const ElasticBackboneOptions& options, double tolerance)
    : equations_(equations), options_(options), tolerance_(tolerance), step_(options.initial_step) {
  const ModeProblem& problem = equations.problem();
  const int contacts = problem.contacts(), rows = problem.rows();
  metric_.setZero(problem.size());
  for (int c = 0; c < contacts; ++c) {
    const double length = problem.unit / problem.model.gaps[c];
    metric_.segment(c * rows, rows) = length * length / contacts * problem.transform.mean_square;
  }
  metric_[contacts * rows + 1] =
      1.0 / (problem.first_inertia() * options.frequency_scale * options.frequency_scale);
}

double ModeCurve::inner(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  return metric_.cwiseProduct(a).dot(b);
}

CurveState ModeCurve::linear_state(double q) const {
  const ModeProblem& problem = equations_.problem();
  const int contacts = problem.contacts(), rows = problem.rows();
  CurveState state;
  state.tangent.setZero(problem.size());
  for (int c = 0; c < contacts; ++c)
    state.tangent[c * rows + problem.transform.real_rows[1]] =
        problem.model.contact_shapes(c, problem.mode) * problem.amplitude / problem.unit;
  state.tangent[contacts * rows] = 1.0;
  state.y = q * state.tangent;
  state.y[contacts * rows + 1] = problem.linear_omega() / problem.omega();
  state.tangent /= std::sqrt(inner(state.tangent, state.tangent));
  return state;
}

// Newton's method on the equations and row . y = offset.
bool ModeCurve::solve(const Eigen::VectorXd& row, double offset, CurveState& state) {
  const Eigen::Index size = state.y.size();
  Eigen::MatrixXd matrix(size, size);
  Eigen::VectorXd right(size);
  for (state.iterations = 0; state.iterations <= options_.max_corrections; ++state.iterations) {
    if (!state.y.allFinite() || !(state.y[size - 1] > 0.0)) return false;
    equations_.evaluate(state.y);
    right << equations_.residual(), row.dot(state.y) - offset;
    if (!right.allFinite()) return false;
    const bool on_plane = std::abs(right[size - 1]) <= 1e-9 * row.cwiseProduct(state.y).cwiseAbs().sum();
    if (on_plane && equations_.relative_residual() <= tolerance_) return true;
    matrix << equations_.jacobian(), row.transpose();
    const detail::Lu<double> lu(matrix);
    if (lu.is_singular(0.0)) return false;
    state.y -= lu.solve(right);
  }
  return false;
}

// The tangent at an evaluated state that goes along with `along`.
bool ModeCurve::set_tangent(CurveState& state, const Eigen::VectorXd& along) {
  const Eigen::Index size = state.y.size();
  Eigen::MatrixXd matrix(size, size);
  matrix << equations_.jacobian(), metric_.cwiseProduct(along).transpose();
  const detail::Lu<double> lu(matrix);
  if (lu.is_singular(0.0)) return false;
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(size, size - 1);
  state.tangent = lu.solve(unit);
  state.tangent /= std::sqrt(inner(state.tangent, state.tangent));
  return state.tangent.allFinite();
}

bool ModeCurve::correct(const CurveState& from, double distance, CurveState& to) {
  // Where a sample comes into contact the tangent may jump by any angle, so that short chords have any
  // direction.
  constexpr double most_chord = 3.0;
  const Eigen::VectorXd row = metric_.cwiseProduct(from.tangent);
  to.y = from.y + distance * from.tangent;
  if (!solve(row, row.dot(to.y), to)) return false;
  const Eigen::VectorXd chord = to.y - from.y;
  const double longest = std::max(most_chord * std::abs(distance), options_.initial_step);
  if (std::sqrt(inner(chord, chord)) > longest) return false;
  return set_tangent(to, distance < 0.0 ? Eigen::VectorXd(-chord) : chord);
}

bool ModeCurve::settle(CurveState& state) {
  const Eigen::VectorXd along = state.tangent, row = metric_.cwiseProduct(along);
  return solve(row, row.dot(state.y), state) && set_tangent(state, along);
}

bool ModeCurve::settle_at(double frequency, double direction, CurveState& state) {
  const Eigen::Index last = state.y.size() - 1;
  state.y[last] = frequency;
  const Eigen::VectorXd row = Eigen::VectorXd::Unit(state.y.size(), last);
  return solve(row, frequency, state) && set_tangent(state, direction * row);
}

bool ModeCurve::advance(CurveState& state) {
  CurveState next;
  int spent = 0;
  for (; step_ >= options_.min_step; step_ *= 0.5) {
    const bool found = correct(state, step_, next);
    spent += next.iterations;
    if (!found) continue;
    last_step_ = step_;
    step_ *= next.iterations <= 3 ? 1.6 : next.iterations <= 5 ? 1.0 : 0.6;
    step_ = std::clamp(step_, options_.min_step, options_.max_step);
    state = next;
    state.iterations = spent;
    return true;
  }
  step_ = options_.min_step;
  return false;
}

bool ModeCurve::leap(CurveState& state, const std::function<bool()>& accepts) {
  constexpr double longest = 1.0;
  CurveState next;
  for (double length = 2.0 * options_.initial_step; length <= longest; length *= 1.5) {
    if (!correct(state, length, next)) continue;
    equations_.evaluate(next.y);
    if (!accepts()) continue;
    last_step_ = length;
    step_ = options_.initial_step;
    state = std::move(next);
    return true;
  }
  return false;
}

}  // namespace wavebalance::solvers
