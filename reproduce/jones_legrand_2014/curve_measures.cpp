#include "curve_measures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace wavebalance::jl14 {
namespace {

void require_equal(Eigen::Index a, Eigen::Index b, const char* function) {
  if (a != b)
    throw std::invalid_argument(
        fmt::format("{}: the lengths are {} and {}; they must be equal", std::string(function), a, b));
}

}  // namespace

double total_variation(const Eigen::VectorXd& values) {
  const Eigen::Index n = values.size();
  if (n < 2) return 0.0;
  return (values.tail(n - 1) - values.head(n - 1)).cwiseAbs().sum() + std::abs(values[0] - values[n - 1]);
}

double excess_variation(const Eigen::VectorXd& values, const Eigen::VectorXd& reference) {
  const double variation = total_variation(reference);
  if (!(variation > 0.0))
    throw std::invalid_argument("excess_variation: the reference is constant; it must vary");
  return total_variation(values) / variation - 1.0;
}

double largest_change(const Eigen::VectorXd& values, int steps) {
  const Eigen::Index n = values.size();
  if (steps < 1 || steps >= n)
    throw std::invalid_argument(
        fmt::format("largest_change: steps is {}; it must be in 1..{}", steps, n - 1));
  double largest = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    largest = std::fmax(largest, std::abs(values[(i + steps) % n] - values[i]));
  return largest;
}

Eigen::VectorXd select(const Eigen::VectorXd& values, const Eigen::Array<bool, Eigen::Dynamic, 1>& where) {
  require_equal(values.size(), where.size(), "select");
  Eigen::VectorXd selected(where.count());
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (where[i]) selected[next++] = values[i];
  return selected;
}

double relative_mean_error(const Eigen::VectorXd& values, const Eigen::VectorXd& reference) {
  require_equal(values.size(), reference.size(), "relative_mean_error");
  return (values - reference).cwiseAbs().mean() / reference.cwiseAbs().mean();
}

Eigen::VectorXd cell_midpoints(const Eigen::VectorXd& values, int cells) {
  if (cells < 1 || values.size() % (2 * cells) != 0)
    throw std::invalid_argument(
        fmt::format("cell_midpoints: cells is {}; twice that must divide {} values", cells, values.size()));
  const Eigen::Index width = values.size() / cells;
  return Eigen::VectorXd::NullaryExpr(cells, [&](Eigen::Index j) { return values[j * width + width / 2]; });
}

int sign_changes(const Eigen::VectorXd& values) {
  int changes = 0;
  double previous = 0.0;
  for (const double value : values) {
    if (value == 0.0) continue;
    changes += previous * value < 0.0 ? 1 : 0;
    previous = value < 0.0 ? -1.0 : 1.0;
  }
  return changes;
}

double refinement_gain(const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine) {
  require_equal(2 * coarse.size() - 1, fine.size(), "refinement_gain");
  double gain = 0.0;
  for (Eigen::Index i = 0; i + 1 < coarse.size(); ++i)
    gain = std::fmax(gain, std::abs(fine[2 * i + 1] - 0.5 * (coarse[i] + coarse[i + 1])));
  return gain;
}

}  // namespace wavebalance::jl14
