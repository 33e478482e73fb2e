#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "impacts/impact_equations.hpp"
#include "impacts/impact_parts.hpp"
#include "wavebalance/solvers/continuation/curve_corrector.hpp"
#include "wavebalance/solvers/exact/problem_family.hpp"

namespace wavebalance::solvers::detail {

/// Instants and impulses of impacts and a parameter, with their tangent.
using ImpactPoint = solvers::CurvePoint;

/// Constants along a curve of motions with impacts.
struct ImpactPathScales {
  int periods = 1;         ///< of the load
  double impulse = 1.0;    ///< N s
  double parameter = 1.0;  ///< Hz or load scale
};

/// The equations of K impacts and a parameter for CurveCorrector: u has the instants (periods), then the
/// impulses over ImpactPathScales::impulse. The residual is relative to its rounding errors.
class ImpactCurveEquations {
 public:
  struct Pieces {};

  ImpactCurveEquations(const ProblemFamily& family, const ImpactPathScales& scales,
                       std::vector<int> contacts);

  double evaluate(const ImpactPoint& at, const Pieces*);
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
  /// Derivative of displacement less gap of impact i along a tangent of the others, at the last evaluation.
  double height_slope(Eigen::Index i, const ImpactPoint& tangent) const;
  /// The unit vector of unknowns that changes the equations least, where they were evaluated last.
  Eigen::VectorXd null_direction() const;
  /// The solution at the place evaluated last, and whether it is a motion of the structure.
  ImpactSolution solution(const ImpactPoint& at) const;

 private:
  const ProblemFamily& family_;
  ImpactPathScales scales_;
  std::vector<int> contacts_;
  std::shared_ptr<const ImpactModel> model_;
  std::optional<ImpactEquations> equations_;
  Eigen::VectorXd slope_;  // of the residual by the parameter, where it was evaluated last
};

/// With these unknowns, without a tangent.
ImpactPoint impact_point(Eigen::VectorXd unknowns, double value);

/// A place of a curve with K impacts, and the solution there.
struct ImpactPlace {
  ImpactPoint point;
  ImpactSolution solution;
};

/// The curve of K impacts.
class ImpactPath : private CurveCorrector<ImpactCurveEquations> {
 public:
  ImpactPath(const ProblemFamily& family, const ImpactPathScales& scales, std::vector<int> contacts);

  const std::vector<int>& contacts() const { return curve().contacts(); }
  /// The unknowns of impacts in ascending order.
  Eigen::VectorXd unknowns_of(const std::vector<Impact>& impacts) const {
    return values_of(impacts, scales_.impulse);
  }
  /// Unknowns by their arc lengths.
  Eigen::VectorXd lengths(const Eigen::VectorXd& unknowns) const;
  using CurveCorrector::chord;
  using CurveCorrector::curve;
  using CurveCorrector::inner;
  using CurveCorrector::normalize;
  using CurveCorrector::tangent_at;  // where it was solved for last
  /// With the direction in which only the parameter increases or decreases as tangent.
  ImpactPoint along_parameter(bool grows) const;

  /// The place at a value of the parameter near these unknowns, without a tangent.
  std::optional<ImpactPlace> at_value(const Eigen::VectorXd& unknowns, double value);
  /// The place near a start at which impact i has no impulse, without a tangent.
  std::optional<ImpactPlace> at_grazing(const ImpactPoint& start, Eigen::Index i);
  /// The place at an arc length along the tangent of another, with its tangent; how many corrections it took.
  std::optional<ImpactPlace> ahead(const ImpactPoint& from, double step, int* corrections = nullptr);

 private:
  std::optional<ImpactPlace> in_plane(const CurvePlane& plane, ImpactPoint start);

  ImpactPathScales scales_;
};

}  // namespace wavebalance::solvers::detail
