#pragma once
#include <Eigen/Core>
#include <functional>

#include "modes/mode_equations.hpp"
#include "wavebalance/solvers/continuation/curve_corrector.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"

namespace wavebalance::solvers {

/// A point of the curve of free motions: its displacement holds the unknowns of ModeEquations but the last,
/// omega over omega_m, which is the parameter.
struct CurveState : CurvePoint {
  int iterations = 0;
};

/// ModeEquations as the equations of a curve. The length of a change dy combines the contacts' samples, rms
/// over their gaps, and the frequency over the scale of the options.
class FreeMotions {
 public:
  struct Pieces {};

  FreeMotions(ModeEquations& equations, const ElasticBackboneOptions& options, double tolerance);

  double evaluate(const CurvePoint& point, const Pieces*);
  const Eigen::VectorXd& residual() const { return equations_.residual(); }
  bool solve_bordered(const Eigen::VectorXd& row, double last, const Eigen::VectorXd& right,
                      double last_right, Eigen::VectorXd& change, double& parameter_change) const;
  int determinant_sign() const { return 0; }
  Eigen::VectorXd weighted(const Eigen::VectorXd& change) const { return metric_.cwiseProduct(change); }
  double squared_parameter_scale() const { return squared_parameter_scale_; }
  double tolerance() const { return tolerance_; }
  int max_corrections(bool) const { return 10; }

 private:
  ModeEquations& equations_;
  const ElasticBackboneOptions& options_;
  double tolerance_, squared_parameter_scale_;
  Eigen::VectorXd metric_;
};

/// The curve of free motions by arc length.
class ModeCurve : private CurveCorrector<FreeMotions> {
 public:
  ModeCurve(ModeEquations& equations, const ElasticBackboneOptions& options, double tolerance);

  /// The linear mode of amplitude `q` over that at grazing, with a tangent along growing amplitudes.
  CurveState linear_state(double q) const;
  /// Solves in the plane at `distance` from `from` along its tangent, and for the tangent there. False when
  /// Newton's method does not converge, or does so far from the plane's foot.
  bool correct(const CurveState& from, double distance, CurveState& to);
  /// Solves in the plane through `state` across its tangent: from a state near the curve onto it.
  bool project_onto_curve(CurveState& state);
  /// Solves at a frequency, over omega_m; the tangent goes towards higher frequencies for direction = 1,
  /// lower for -1.
  bool project_onto_curve_at(double frequency, double direction, CurveState& state);
  /// One step from `state`, as long as the last one allows. False when even the shortest one fails.
  bool advance(CurveState& state);
  /// A step that passes an obstacle directly ahead: the first of growing length whose end `accepts`.
  bool leap(CurveState& state, const std::function<bool()>& accepts);

  /// Begins with the first step length again.
  void restart() { step_ = options_.initial_step; }

  /// omega of a state over omega of the linear mode without a time basis.
  double frequency(const CurveState& state) const { return state.parameter; }
  /// A state between two unknowns of ModeEquations, in the plane across their chord at `share` of it. False
  /// where Newton's method does not converge, or does so farther from the chord than a quarter of its length.
  bool between(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double share, CurveState& state);
  ModeEquations& equations() { return equations_; }
  /// Arc length of the last advance().
  double last_step() const { return last_step_; }

 private:
  ModeEquations& equations_;
  const ElasticBackboneOptions& options_;
  double step_, last_step_ = 0.0;
};

}  // namespace wavebalance::solvers
