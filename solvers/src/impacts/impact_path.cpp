#include "impacts/impact_path.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr double instant_scale = 0.05;  // periods

}  // namespace

ImpactCurveEquations::ImpactCurveEquations(const ImpactFamily& family, const ImpactPathScales& scales,
                                           std::vector<int> contacts)
    : family_(family), scales_(scales), contacts_(std::move(contacts)) {}

double ImpactCurveEquations::evaluate(const CurvePoint& at, const Pieces*) {
  const bool over_frequency = family_.parameter() == SweepParameter::frequency;
  if (!at.displacement.allFinite() || !std::isfinite(at.parameter) ||
      (over_frequency && !(at.parameter > 0.0)))
    return missing;
  model_ = std::make_shared<const ImpactModel>(family_.at(at.parameter, scales_.periods));
  equations_.emplace(*model_, contacts_, scales_.impulse);
  equations_->evaluate(at.displacement);
  slope_ = equations_->by_parameter(
      {family_.contact_free_slope(at.parameter, scales_.periods), family_.frequency_slope(scales_.periods)});
  double largest = 0.0;
  for (Index i = 0; i < residual().size(); ++i)
    largest = std::max(largest, std::abs(residual()[i]) / equations_->rounding()[i]);
  return residual().allFinite() ? largest : missing;
}

bool ImpactCurveEquations::solve_bordered(const Eigen::VectorXd& row, double number,
                                          const Eigen::VectorXd& right, double right_number,
                                          Eigen::VectorXd& change, double& parameter_change) {
  const Index size = row.size();
  Eigen::MatrixXd matrix(size + 1, size + 1);
  matrix.topLeftCorner(size, size) = equations_->matrix();
  matrix.topRightCorner(size, 1) = slope_ * scales_.parameter;
  matrix.bottomLeftCorner(1, size) = row.transpose();
  matrix(size, size) = number * scales_.parameter;
  Eigen::VectorXd whole(size + 1);
  whole << right, right_number;
  const Lu<double> factors(matrix);
  if (factors.is_singular()) return false;
  const Eigen::VectorXd solution = factors.solve(whole);
  change = solution.head(size);
  parameter_change = solution[size] * scales_.parameter;
  return solution.allFinite();
}

Eigen::VectorXd ImpactCurveEquations::weighted(const Eigen::VectorXd& u) const {
  Eigen::VectorXd result = u;
  result.head(impacts()) /= instant_scale * instant_scale;
  return result;
}

double ImpactCurveEquations::height_slope(Index i, const Eigen::VectorXd& tangent,
                                          double parameter_tangent) const {
  return equations_->matrix().row(i).dot(tangent) + slope_[i] * parameter_tangent;
}

Eigen::VectorXd ImpactCurveEquations::null_direction() const {
  const Eigen::JacobiSVD<Eigen::MatrixXd> decomposition(equations_->matrix(), Eigen::ComputeFullV);
  return decomposition.matrixV().rightCols(1);
}

ImpactMotion ImpactCurveEquations::motion(const CurvePoint& at) const {
  ImpactMotion found;
  found.residual = residual().size() > 0 ? residual().cwiseAbs().maxCoeff() : 0.0;
  return motion_of(model_, {contacts_, at.displacement, scales_.impulse}, std::move(found));
}

ImpactPath::ImpactPath(const ImpactFamily& family, const ImpactPathScales& scales, std::vector<int> contacts)
    : CurveCorrector(ImpactCurveEquations(family, scales, std::move(contacts))), scales_(scales) {}

Eigen::VectorXd ImpactPath::unknowns_of(const std::vector<Impact>& impacts) const {
  const auto count = Index(impacts.size());
  Eigen::VectorXd unknowns(2 * count);
  for (Index i = 0; i < count; ++i) {
    unknowns[i] = impacts[static_cast<std::size_t>(i)].time;
    unknowns[count + i] = impacts[static_cast<std::size_t>(i)].impulse / scales_.impulse;
  }
  return unknowns;
}

std::optional<ImpactPlace> ImpactPath::at_value(CurvePoint start, double value) {
  constexpr double rounding = 1e-14;
  const CurvePlane plane{Eigen::VectorXd::Zero(start.displacement.size()), 1.0 / scales_.parameter,
                         value / scales_.parameter,
                         rounding * std::max(1.0, std::abs(value) / scales_.parameter)};
  int corrections = 0;
  if (!solve_in(plane, nullptr, start, corrections)) return std::nullopt;
  return ImpactPlace{start, curve().motion(start)};
}

std::optional<ImpactPlace> ImpactPath::at_grazing(CurvePoint start, Index i) {
  constexpr double rounding = 1e-14;
  const Index count = curve().impacts();
  const CurvePlane plane{Eigen::VectorXd::Unit(2 * count, count + i), 0.0, 0.0, rounding};
  int corrections = 0;
  if (!solve_in(plane, nullptr, start, corrections)) return std::nullopt;
  return ImpactPlace{start, curve().motion(start)};
}

std::optional<ImpactPlace> ImpactPath::ahead(const CurvePoint& from, double step, int* corrections) {
  CurvePoint to;
  int taken = 0;
  if (!correct(from, step, nullptr, to, taken)) return std::nullopt;
  if (corrections != nullptr) *corrections = taken;
  ImpactMotion motion = curve().motion(to);
  return ImpactPlace{std::move(to), std::move(motion)};
}

bool ImpactPath::set_tangent(CurvePoint& at, const CurvePoint& along) { return tangent_at(at, along); }

double ImpactPath::height_slope(Index i, const CurvePoint& tangent) const {
  return curve().height_slope(i, tangent.displacement_tangent, tangent.parameter_tangent);
}

}  // namespace wavebalance::solvers::detail
