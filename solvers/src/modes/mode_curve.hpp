#pragma once
#include <Eigen/Core>
#include <functional>

#include "modes/mode_equations.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"

namespace wavebalance::solvers {

/// A point of the curve of free motions, in the unknowns of ModeEquations.
struct CurveState {
  Eigen::VectorXd y;
  Eigen::VectorXd tangent;  ///< of length 1 in the metric of ModeCurve
  int iterations = 0;
};

/// The curve of ModeEquations by arc length. The length of a change dy is that of the contacts' samples, rms
/// over their gaps, and of the frequency, over the scale of the options.
class ModeCurve {
 public:
  ModeCurve(ModeEquations& equations, const ElasticBackboneOptions& options, double tolerance);

  /// The linear mode of amplitude `q` over that at grazing, with a tangent along growing amplitudes.
  CurveState linear_state(double q) const;
  /// Solves in the plane at `distance` from `from` along its tangent, and for the tangent there. False when
  /// Newton's method does not converge, or does so far from the plane's foot.
  bool correct(const CurveState& from, double distance, CurveState& to);
  /// Solves in the plane through `state` across its tangent: from a state near the curve onto it.
  bool settle(CurveState& state);
  /// Solves at a frequency, over omega_m; the tangent goes towards higher frequencies for direction = 1,
  /// lower for -1.
  bool settle_at(double frequency, double direction, CurveState& state);
  /// One step from `state`, as long as the last one allows. False when even the shortest one fails.
  bool advance(CurveState& state);
  /// A step that passes what lies directly ahead: the first of growing length whose end `accepts` takes.
  bool leap(CurveState& state, const std::function<bool()>& accepts);

  /// Begins with the first step length again.
  void restart() { step_ = options_.initial_step; }

  /// omega of a state over that of the linear mode without a time basis.
  double frequency(const CurveState& state) const { return state.y[state.y.size() - 1]; }
  double inner(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  ModeEquations& equations() { return equations_; }
  /// Arc length of the last advance().
  double last_step() const { return last_step_; }

 private:
  bool solve(const Eigen::VectorXd& row, double offset, CurveState& state);
  bool set_tangent(CurveState& state, const Eigen::VectorXd& along);

  ModeEquations& equations_;
  const ElasticBackboneOptions& options_;
  double tolerance_;
  Eigen::VectorXd metric_;
  double step_, last_step_ = 0.0;
};

}  // namespace wavebalance::solvers
