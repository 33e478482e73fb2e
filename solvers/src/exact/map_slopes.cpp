#include "exact/map_slopes.hpp"

#include "flow/closed_period.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Rows and columns scaled to one another. Where a body is free to move somewhere the shortest solution leaves
// it.
Eigen::VectorXd solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  constexpr double singular = 1e-9;
  const Eigen::VectorXd rows = matrix.rowwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd by_rows = rows.asDiagonal() * matrix;
  const Eigen::VectorXd columns = by_rows.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = by_rows * columns.asDiagonal();
  const Eigen::VectorXd all = rows.cwiseProduct(right);
  const Lu<double> lu(scaled);
  return columns.cwiseProduct(lu.is_singular(singular) ? least_squares(scaled, all, singular)
                                                       : Eigen::VectorXd(lu.solve(all)));
}

}  // namespace

Eigen::VectorXd MapSlopes::step(const Eigen::VectorXd& held, const Eigen::VectorXd& right,
                                double held_right) const {
  const std::vector<Index> free = free_states(map);
  const auto count = Index(free.size()), states = map.rows();
  Eigen::MatrixXd matrix(count + 1, count + 1);
  Eigen::VectorXd all(count + 1);
  matrix.topLeftCorner(count, count) =
      Eigen::MatrixXd::Identity(count, count) - Eigen::MatrixXd(map(free, free));
  matrix(count, count) = held[states];
  for (const Index i : rest) matrix(count, count) += held[i] * by_parameter[i];
  for (Index i = 0; i < count; ++i) {
    matrix(i, count) = -by_parameter[free[std::size_t(i)]];
    matrix(count, i) = held[free[std::size_t(i)]];
    all[i] = right[free[std::size_t(i)]];
  }
  all[count] = held_right;
  const Eigen::VectorXd found = solved(matrix, all);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(states + 1);
  for (const Index i : rest) result[i] = by_parameter[i] * found[count];
  for (Index i = 0; i < count; ++i) result[free[std::size_t(i)]] = found[i];
  result[states] = found[count];
  return result;
}

void MapSlopes::learn(const Eigen::VectorXd& left, const Eigen::VectorXd& step,
                      const Eigen::VectorXd& plane) {
  const Eigen::VectorXd share = plane / plane.dot(step);
  const Index states = left.size();
  for (const Index i : free_states(map)) {
    map.row(i) += left[i] * share.head(states).transpose();
    by_parameter[i] += left[i] * share[states];
  }
}

Eigen::MatrixXd MapSlopes::moves_that_return(const std::vector<Index>& free) const {
  const auto count = Index(free.size()), sliders = Index(rest.size());
  Eigen::MatrixXd inputs(count, sliders + 1);
  for (Index j = 0; j < sliders; ++j) inputs.col(j) = map.col(rest[std::size_t(j)])(free);
  inputs.col(sliders) = by_parameter(free);
  if (count == 0) return inputs;
  return Lu<double>(Eigen::MatrixXd::Identity(count, count) - Eigen::MatrixXd(map(free, free))).solve(inputs);
}

std::vector<Index> at_rest(const Eigen::MatrixXd& map) {
  std::vector<Index> result;
  for (Index i = 0; i < map.rows(); ++i)
    if (map(i, i) == 1.0 && map.row(i).cwiseAbs().sum() == 1.0) result.push_back(i);
  return result;
}

Eigen::VectorXd off_center(const ContactFlow& flow, const std::vector<Index>& rest) {
  const Eigen::VectorXd all = flow.off_center();
  const Index memories = flow.state().size() - all.size();
  Eigen::VectorXd result(Index(rest.size()));
  for (std::size_t i = 0; i < rest.size(); ++i) result[Index(i)] = all[rest[i] - memories];
  return result;
}

}  // namespace wavebalance::solvers::detail
