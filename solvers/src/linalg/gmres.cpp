#include "linalg/gmres.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

// The least-squares problem min ||beta e_1 - H y|| of a growing Hessenberg matrix, by plane rotations.
class HessenbergLeastSquares {
 public:
  explicit HessenbergLeastSquares(double beta) : right_{beta} {}

  // `column`: the next column of H, one entry longer than the last. False when it adds nothing to the range.
  bool add(Eigen::VectorXd column) {
    const auto j = Index(rotations_.size());
    const double size = column.norm();
    for (Index i = 0; i < j; ++i) rotate(rotations_[static_cast<std::size_t>(i)], column[i], column[i + 1]);
    const double length = std::hypot(column[j], column[j + 1]);
    constexpr double rounding = 1e3 * std::numeric_limits<double>::epsilon();
    if (!(length > rounding * size)) return false;
    const Rotation rotation{column[j] / length, column[j + 1] / length};
    rotations_.push_back(rotation);
    rotate(rotation, column[j], column[j + 1]);
    right_.push_back(0.0);
    rotate(rotation, right_[right_.size() - 2], right_.back());
    columns_.push_back(std::move(column));
    return true;
  }

  double residual() const { return std::abs(right_.back()); }

  Eigen::VectorXd solution() const {
    const auto size = Index(columns_.size());
    Eigen::VectorXd y(size);
    for (Index i = size - 1; i >= 0; --i) {
      double value = right_[static_cast<std::size_t>(i)];
      for (Index j = i + 1; j < size; ++j) value -= columns_[static_cast<std::size_t>(j)][i] * y[j];
      y[i] = value / columns_[static_cast<std::size_t>(i)][i];
    }
    return y;
  }

 private:
  struct Rotation {
    double cosine, sine;
  };
  static void rotate(const Rotation& by, double& first, double& second) {
    const double turned = by.cosine * first + by.sine * second;
    second = by.cosine * second - by.sine * first;
    first = turned;
  }

  std::vector<Rotation> rotations_;
  std::vector<Eigen::VectorXd> columns_;  // columns of the triangular factor
  std::vector<double> right_;
};

}  // namespace

GmresResult gmres(const LinearMap& map, const Eigen::VectorXd& right, double target, int max_iterations,
                  Eigen::VectorXd& x) {
  GmresResult result;
  result.residual = right.norm();
  x.setZero(right.size());
  if (result.residual <= target) {
    result.solved = true;
    return result;
  }
  if (!std::isfinite(result.residual)) return result;
  HessenbergLeastSquares least(result.residual);
  std::vector<Eigen::VectorXd> basis{right / result.residual};
  Eigen::VectorXd next;
  while (result.residual > target && result.iterations < max_iterations) {
    map(basis.back(), next);
    Eigen::VectorXd column(Index(basis.size()) + 1);
    for (std::size_t i = 0; i < basis.size(); ++i) {
      column[Index(i)] = basis[i].dot(next);
      next -= column[Index(i)] * basis[i];
    }
    const double length = next.norm();
    column[column.size() - 1] = length;
    if (!std::isfinite(length) || !least.add(std::move(column))) break;
    ++result.iterations;
    result.residual = least.residual();
    if (length == 0.0) break;
    basis.emplace_back(next / length);
  }
  const Eigen::VectorXd weights = least.solution();
  for (Index i = 0; i < weights.size(); ++i) x += weights[i] * basis[static_cast<std::size_t>(i)];
  result.solved = result.residual <= target;
  return result;
}

}  // namespace wavebalance::solvers
