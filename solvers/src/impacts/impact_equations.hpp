#pragma once
#include <Eigen/Core>
#include <vector>

#include "impacts/impact_model.hpp"

namespace wavebalance::solvers::detail {

/// The motion without contact by a parameter of a curve: slopes by it.
struct ParameterSlopes {
  Eigen::MatrixXcd linear_motion;  ///< C x (H + 1), m per unit
  double frequency = 0.0;          ///< Hz per unit
};

/// The 2 K equations of K impacts in ascending order: displacement less gap over the scale of
/// displacements, then (p J / (1 + e) - v) over the scale of velocities. Unknowns: instants (periods), then
/// impulses (N s) over impulse_scale. The Green function between two instants depends on their order, so
/// that the equations are smooth where impacts pass each other.
class ImpactEquations {
 public:
  /// `impulse_scale`, N s.
  ImpactEquations(const ImpactModel& model, std::vector<int> contacts, double impulse_scale);

  Eigen::Index impacts() const { return static_cast<Eigen::Index>(contacts_.size()); }

  /// Evaluates residual, matrix and rounding errors.
  void evaluate(const Eigen::VectorXd& unknowns);
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }
  /// 2 K: how large the residual may be by rounding.
  const Eigen::VectorXd& rounding() const { return rounding_; }
  bool is_solved() const { return (residual_.array().abs() <= rounding_.array()).all(); }
  /// The slope of the residual by a parameter, at the unknowns evaluated last.
  Eigen::VectorXd by_parameter(const ParameterSlopes& slopes) const;

 private:
  double share(Eigen::Index i, Eigen::Index j) const;
  void add_free(Eigen::Index i);
  void add_impact(Eigen::Index i, Eigen::Index j);

  const ImpactModel& model_;
  std::vector<int> contacts_;
  double impulse_scale_;
  Eigen::VectorXd unknowns_, residual_, rounding_;
  Eigen::MatrixXd matrix_, value_by_period_, rate_by_period_;
};

}  // namespace wavebalance::solvers::detail
