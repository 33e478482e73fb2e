#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "impacts/impact_equations.hpp"
#include "impacts/impact_parts.hpp"
#include "wavebalance/solvers/continuation/curve_corrector.hpp"
#include "wavebalance/solvers/impacts/impact_curve.hpp"

namespace wavebalance::solvers::detail {

/// What does not change along a curve of motions with impacts.
struct ImpactPathScales {
  int periods = 1;         ///< of the load
  double impulse = 1.0;    ///< N s
  double parameter = 1.0;  ///< Hz or load scale
};

/// The equations of K impacts and a parameter, as CurveCorrector takes them: u has the instants (periods),
/// then the impulses over ImpactPathScales::impulse. The residual is relative to its rounding errors.
class ImpactCurveEquations {
 public:
  struct Pieces {};

  ImpactCurveEquations(const ImpactFamily& family, const ImpactPathScales& scales, std::vector<int> contacts);

  double evaluate(const CurvePoint& at, const Pieces*);
  const Eigen::VectorXd& residual() const { return equations_->residual(); }
  bool solve_bordered(const Eigen::VectorXd& row, double number, const Eigen::VectorXd& right,
                      double right_number, Eigen::VectorXd& change, double& parameter_change);
  int determinant_sign() const { return 0; }
  Eigen::VectorXd weighted(const Eigen::VectorXd& u) const;
  double squared_parameter_scale() const { return scales_.parameter * scales_.parameter; }
  double tolerance() const { return 1.0; }
  int max_corrections(bool) const { return 8; }

  const std::vector<int>& contacts() const { return contacts_; }
  Eigen::Index impacts() const { return static_cast<Eigen::Index>(contacts_.size()); }
  /// Of the displacement less gap of impact i along a tangent of the others, where it was evaluated last.
  double height_slope(Eigen::Index i, const Eigen::VectorXd& tangent, double parameter_tangent) const;
  /// The unit vector of unknowns that changes the equations least, where they were evaluated last.
  Eigen::VectorXd null_direction() const;
  /// The motion at the place evaluated last, and whether it is one of the structure.
  ImpactMotion motion(const CurvePoint& at) const;

 private:
  const ImpactFamily& family_;
  ImpactPathScales scales_;
  std::vector<int> contacts_;
  std::shared_ptr<const ImpactModel> model_;
  std::optional<ImpactEquations> equations_;
  Eigen::VectorXd slope_;  // of the residual by the parameter, where it was evaluated last
};

/// A place of a curve with K impacts, and the motion there.
struct ImpactPlace {
  CurvePoint point;
  ImpactMotion motion;
};

/// The curve of K impacts.
class ImpactPath : private CurveCorrector<ImpactCurveEquations> {
 public:
  ImpactPath(const ImpactFamily& family, const ImpactPathScales& scales, std::vector<int> contacts);

  const std::vector<int>& contacts() const { return curve().contacts(); }
  /// The unknowns of impacts in ascending order.
  Eigen::VectorXd unknowns_of(const std::vector<Impact>& impacts) const;
  using CurveCorrector::chord;
  using CurveCorrector::inner;
  using CurveCorrector::normalize;

  /// The place at a value of the parameter, without a tangent.
  std::optional<ImpactPlace> at_value(CurvePoint start, double value);
  /// The place near a start at which impact i has no impulse, without a tangent.
  std::optional<ImpactPlace> at_grazing(CurvePoint start, Eigen::Index i);
  /// The place at an arc length along the tangent of another, with its tangent; how many corrections it took.
  std::optional<ImpactPlace> ahead(const CurvePoint& from, double step, int* corrections = nullptr);
  /// Sets the tangent at a place that was solved for last, on the side of `along`.
  bool set_tangent(CurvePoint& at, const CurvePoint& along);
  /// As of ImpactCurveEquations, where it was solved for last.
  double height_slope(Eigen::Index i, const CurvePoint& tangent) const;
  Eigen::VectorXd null_direction() const { return curve().null_direction(); }

 private:
  ImpactPathScales scales_;
};

}  // namespace wavebalance::solvers::detail
