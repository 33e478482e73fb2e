#include "exact/impact_path.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/bordered.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "wavebalance/solvers/flow/attractor_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr double instant_scale = 0.05;  // periods

}  // namespace

ImpactCurveEquations::ImpactCurveEquations(const ProblemFamily& family, const ImpactPathScales& scales,
                                           std::vector<int> contacts)
    : family_(family), scales_(scales), contacts_(std::move(contacts)) {}

double ImpactCurveEquations::evaluate(const ImpactPoint& at, const Pieces*) {
  constexpr double share = 1e-5;
  const bool over_frequency = family_.parameter() == SweepParameter::frequency;
  if (!at.displacement.allFinite() || !std::isfinite(at.parameter) ||
      (over_frequency && !(at.parameter > 0.0)))
    return missing;
  const auto problem_at = [&](double value) { return over_periods(family_.at(value), scales_.periods); };
  model_ = std::make_shared<const ImpactModel>(problem_at(at.parameter), model_.get());
  equations_.emplace(*model_, contacts_, scales_.impulse);
  equations_->evaluate(at.displacement);
  const double step = share * (at.parameter == 0.0 ? scales_.parameter : at.parameter);
  const Eigen::MatrixXcd after = problem_at(at.parameter + step).linear_motion,
                         before = problem_at(at.parameter - step).linear_motion;
  slope_ = equations_->by_parameter(
      {(after - before) / (2.0 * step), over_frequency ? model_->problem().frequency / at.parameter : 0.0});
  double largest = 0.0;
  for (Index i = 0; i < residual().size(); ++i)
    largest = std::max(largest, std::abs(residual()[i]) / equations_->rounding()[i]);
  return residual().allFinite() ? largest : missing;
}

bool ImpactCurveEquations::solve_bordered(const Eigen::VectorXd& row, double number,
                                          const Eigen::VectorXd& right, double right_number,
                                          Eigen::VectorXd& change, double& parameter_change) {
  Eigen::MatrixXd jacobian(row.size(), row.size() + 1);
  jacobian << equations_->matrix(), slope_ * scales_.parameter;
  const bool solved = solve_bordered_dense(jacobian, row, number * scales_.parameter, right, right_number,
                                           change, parameter_change);
  parameter_change *= scales_.parameter;
  return solved && change.allFinite() && std::isfinite(parameter_change);
}

Eigen::VectorXd ImpactCurveEquations::weighted(const Eigen::VectorXd& u) const {
  Eigen::VectorXd result = u;
  result.head(impacts()) /= instant_scale * instant_scale;
  return result;
}

double ImpactCurveEquations::height_slope(Index i, const ImpactPoint& tangent) const {
  return equations_->matrix().row(i).dot(tangent.displacement_tangent) +
         slope_[i] * tangent.parameter_tangent;
}

Eigen::VectorXd ImpactCurveEquations::null_direction() const {
  const auto modes = symmetric_eigen(transposed_product(equations_->matrix(), equations_->matrix()));
  if (!modes) return Eigen::VectorXd::Zero(equations_->matrix().cols());
  return modes->vectors.col(0);
}

ImpactSolution ImpactCurveEquations::solution(const ImpactPoint& at) const {
  ImpactSolution found = solution_of(model_, {contacts_, at.displacement, scales_.impulse});
  found.residual = residual().size() > 0 ? residual().cwiseAbs().maxCoeff() : 0.0;
  return found;
}

ImpactPoint impact_point(Eigen::VectorXd unknowns, double value) {
  ImpactPoint point;
  point.displacement = std::move(unknowns);
  point.parameter = value;
  return point;
}

ImpactPath::ImpactPath(const ProblemFamily& family, const ImpactPathScales& scales, std::vector<int> contacts)
    : CurveCorrector(ImpactCurveEquations(family, scales, std::move(contacts))), scales_(scales) {}

Eigen::VectorXd ImpactPath::lengths(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd result = unknowns;
  result.head(curve().impacts()) /= instant_scale;
  return result;
}

ImpactPoint ImpactPath::along_parameter(bool grows) const {
  ImpactPoint along;
  along.displacement_tangent = Eigen::VectorXd::Zero(2 * curve().impacts());
  along.parameter_tangent = grows ? scales_.parameter : -scales_.parameter;
  return along;
}

std::optional<ImpactPlace> ImpactPath::in_plane(const CurvePlane& plane, ImpactPoint start) {
  int corrections = 0;
  if (!solve_in(plane, nullptr, start, corrections)) return std::nullopt;
  return ImpactPlace{start, curve().solution(start)};
}

std::optional<ImpactPlace> ImpactPath::at_value(const Eigen::VectorXd& unknowns, double value) {
  constexpr double rounding = 1e-14;
  const double place = value / scales_.parameter;
  return in_plane({Eigen::VectorXd::Zero(unknowns.size()), 1.0 / scales_.parameter, place,
                   rounding * std::max(1.0, std::abs(place))},
                  impact_point(unknowns, value));
}

std::optional<ImpactPlace> ImpactPath::at_grazing(const ImpactPoint& start, Index i) {
  constexpr double rounding = 1e-14;
  const Index count = curve().impacts();
  return in_plane({Eigen::VectorXd::Unit(2 * count, count + i), 0.0, 0.0, rounding}, start);
}

std::optional<ImpactPlace> ImpactPath::ahead(const ImpactPoint& from, double step, int* corrections) {
  ImpactPoint to;
  int taken = 0;
  if (!correct(from, step, nullptr, to, taken)) return std::nullopt;
  if (corrections != nullptr) *corrections = taken;
  ImpactSolution solution = curve().solution(to);
  return ImpactPlace{std::move(to), std::move(solution)};
}

}  // namespace wavebalance::solvers::detail
