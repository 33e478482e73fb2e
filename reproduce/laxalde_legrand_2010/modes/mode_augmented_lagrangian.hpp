#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mode_augmented_lagrangian_functional.hpp"

namespace wavebalance::ll10 {

using solvers::InternalResonance;

/// How a point of the augmented Lagrangian was found, or why none was.
enum class LagrangianStatus {
  converged,      ///< critical point, and both of Powell's measures below the strategy's tolerances
  linear,         ///< the same without a contact force: the linear mode
  inner_stalled,  ///< Newton could not reduce the gradient
  inner_limit,    ///< Newton reached max_inner_iterations
  singular,       ///< the Hessian is singular to working precision, and its least-squares step is not finite
  outer_stalled,  ///< the strategy could change neither multipliers nor penalties
  outer_limit,    ///< the multipliers reached max_outer_iterations
  internal_resonance,  ///< "tongue": solved, but on an internal resonance, LagrangianPoint::resonance
  left_mode  ///< solved, but too little of the kinetic energy is in harmonic 1: another critical point
};

std::string_view to_string(LagrangianStatus status);

/// How the eigenvalue r follows the motion.
enum class EigenvalueUpdate {
  simultaneous,  ///< r depends on x [LL10, Algorithm 1]
  sequential     ///< r frozen at its prediction, then updated [LL10, Algorithm 2]
};

/// The discretisation of a mode by the augmented Lagrangian, and when its iterations end.
struct LagrangianModeOptions {
  int mode = 1;              ///< the linear mode that the nonlinear one continues, from 1
  int harmonics = 2;         ///< N
  int samples = 20;          ///< m >= 2N
  bool cosine_only = false;  ///< motions that are even in time
  ModeFormulation formulation = ModeFormulation::consistent;
  EigenvalueUpdate eigenvalue = EigenvalueUpdate::simultaneous;
  /// Largest entry of the gradient, in units omega_1 = gap = 1. A blade's is rounded to more than 1e-11.
  double inner_tolerance = 1e-10;
  int max_inner_iterations = 60;  ///< Newton steps per outer iteration
  int max_outer_iterations = 60;  ///< updates of the multipliers per energy
  int max_step_halvings = 12;     ///< halvings of failed energy steps, per energy in branch()

  /// Throws std::invalid_argument for a number out of its range, whatever the model.
  void validate() const;
};

/// One outer iteration. The measures are not a number where Newton failed.
struct OuterIteration {
  int newton_iterations = 0;
  double gradient = 0.0;            ///< largest entry, in units omega_1 = gap = 1
  double inequality_measure = 0.0;  ///< Powell's G_i over the gap [LL10, eq. (25a)]
  double equality_measure = 0.0;    ///< Powell's G_e, in the unit of 4 x the grazing energy
};

/// Where to start: a motion and its contact force, of any number of harmonics up to N (absent ones are zero).
/// A ModePoint of the condensed solver or a point of this one has both members.
struct LagrangianStart {
  Eigen::MatrixXcd amplitudes;  ///< r x (<= N+1), m sqrt(kg), q_n as in ModePoint
  Eigen::MatrixXd force;        ///< c x m, N; or empty: none
};

/// A motion of prescribed energy; series and units as in ModePoint.
struct LagrangianPoint {
  LagrangianStatus status = LagrangianStatus::outer_limit;
  double prescribed_ratio = 0.0;   ///< gamma over its value at linear grazing, as prescribed
  double energy_ratio = 0.0;       ///< m/2 with n^2 of the motion found, over the same
  double omega = 0.0;              ///< rad/s, by the formulation's own formula
  double rayleigh = 0.0;           ///< r, (rad/s)^2 [LL10, eq. (24a)]
  Eigen::MatrixXcd amplitudes;     ///< r x (N+1), m sqrt(kg)
  Eigen::MatrixXd force;           ///< c x m, N, at the samples: lambda m/2
  double equation_residual = 0.0;  ///< norm of K u_n - n^2 omega^2 M u_n + force_n over the norm of K u_n,
                                   ///< all n
  double virial_residual = 0.0;    ///< |omega^2 - (r - mu m/2)| / omega^2, mu the multiplier of h
  double max_penetration = 0.0;    ///< over the gap, at the samples
  double min_force = 0.0;          ///< N
  double fundamental_share = 0.0;  ///< share of the kinetic energy in harmonic 1
  InternalResonance resonance;     ///< the strongest internal resonance, whatever its share
  std::vector<OuterIteration> history;

  bool accepted() const {
    return status == LagrangianStatus::converged || status == LagrangianStatus::linear;
  }
  int newton_iterations() const;
};

/// Nonlinear modes with rigid contact by the augmented Lagrangian of [LL10, sections 3.3 and 4]: critical
/// points of ModeLagrangian by Newton, inside an outer iteration on the multipliers. Newton's steps are
/// halved until the gradient's norm decreases; L itself is not minimised, since modes are saddle points. All
/// r (2N + 1) unknowns in one dense matrix, as the paper describes it; NonlinearMode is much faster.
///
///     contact::MultiplierUpdate outer(std::vector<double>(mode.constraints(), 300.0), {300.0});
///     const LagrangianPoint point = mode.solve(1.5, outer, mode.linear_start(1.5));
///
/// The strategy works in units omega_1 = gap = 1, of the continued mode and of the contact that it reaches
/// first; the mode's amplitude at grazing is 1. Penalties of 1e2 to 1e3 and tolerances are in these units.
/// Cold starts, in energy steps from grazing, work for N <= 2; for more harmonics start from a condensed
/// point. Immutable.
class LagrangianMode {
 public:
  /// Throws std::invalid_argument for a model or options out of range, options first.
  LagrangianMode(ModalModel model, LagrangianModeOptions options);

  const LagrangianModeOptions& options() const { return options_; }
  const ModeLagrangian& functional() const { return functional_; }  ///< in units omega_1 = gap = 1
  int constraints() const { return functional_.constraints(); }     ///< c m
  double linear_omega() const;                                      ///< rad/s

  /// The linear mode at an energy ratio >= 0, without force; it penetrates above 1.
  LagrangianStart linear_start(double energy_ratio) const;

  /// The motion of prescribed energy ratio. At ratios <= 1 the start is the linear mode, whatever is given.
  /// predicted_rayleigh: r to freeze in the sequential way, (rad/s)^2; from the start if absent. Throws
  /// std::invalid_argument if the strategy has other than c m and 1 constraints, or the start does not fit.
  /// A Newton step is O((r (2N + 1))^3).
  LagrangianPoint solve(double energy_ratio, Multipliers& multipliers, const LagrangianStart& start,
                        std::optional<double> predicted_rayleigh = {}) const;
  LagrangianPoint solve(double energy_ratio, contact::MultiplierUpdate& strategy,
                        const LagrangianStart& start, std::optional<double> predicted_rayleigh = {}) const {
    AugmentedMultipliers multipliers(strategy);
    return solve(energy_ratio, multipliers, start, predicted_rayleigh);
  }

  /// Energy steps [LL10, Algorithms 1 and 2], each predicted by the secant through the two before (the first
  /// from `start`). A step that fails is halved, up to max_step_halvings times per energy; the points between
  /// are not returned. The branch ends at the first point that is not accepted even so; that point is kept
  /// with its status and its ratio. The strategy is copied for each point, so that penalties do not grow from
  /// one point to the next.
  std::vector<LagrangianPoint> branch(std::span<const double> energy_ratios,
                                      const contact::MultiplierUpdate& strategy,
                                      const LagrangianStart& start) const;

 private:
  struct Prediction {
    LagrangianStart start;
    std::optional<double> rayleigh;
  };
  class Stationarity;
  struct Newton {
    LagrangianStatus status;
    int iterations;
    double gradient;
  };

  Prediction predict(const std::vector<LagrangianPoint>& points, double energy_ratio,
                     const LagrangianStart& start) const;
  std::optional<LagrangianStatus> outer_iteration(LagrangianPoint& point, Eigen::VectorXd& x,
                                                  Multipliers& multipliers,
                                                  std::optional<double> frozen) const;
  Newton critical_point(Eigen::VectorXd& x, double gamma, const Multipliers& multipliers,
                        std::optional<double> frozen) const;
  void require_fit(const Multipliers& multipliers, const LagrangianStart& start) const;
  void start_multipliers(Multipliers& multipliers, const Eigen::VectorXd& x, const Eigen::MatrixXd& force,
                         std::optional<double> frozen) const;
  void measure(LagrangianPoint& point, const Eigen::VectorXd& x, const Eigen::VectorXd& multiplier,
               double pull, std::optional<double> frozen) const;
  void measure_shares(LagrangianPoint& point) const;
  LagrangianStatus classify(const LagrangianPoint& point) const;
  Eigen::VectorXd to_unknowns(const Eigen::MatrixXcd& amplitudes) const;
  Eigen::MatrixXcd to_amplitudes(const Eigen::VectorXd& x) const;

  ModalModel model_;
  LagrangianModeOptions options_;
  double amplitude_, gap_;  // units of modal amplitude and of displacement
  ModeLagrangian functional_;
};

}  // namespace wavebalance::ll10
