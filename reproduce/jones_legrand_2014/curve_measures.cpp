#include "curve_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace wavebalance::jl14 {
namespace {

void require_divisor(int parts, Eigen::Index values) {
  if (parts < 1 || values % parts != 0)
    throw std::invalid_argument(
        fmt::format("{} parts of {} values; the one must divide the other", parts, values));
}

}  // namespace

double total_variation(const Eigen::VectorXd& values) {
  const Eigen::Index n = values.size();
  if (n < 2) return 0.0;
  return (values.tail(n - 1) - values.head(n - 1)).cwiseAbs().sum() + std::abs(values[0] - values[n - 1]);
}

double excess_variation(const Eigen::VectorXd& values, const Eigen::VectorXd& reference) {
  return total_variation(values) / total_variation(reference) - 1.0;
}

double largest_change(const Eigen::VectorXd& values, int steps) {
  const Eigen::Index n = values.size();
  double largest = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    largest = std::fmax(largest, std::abs(values[(i + steps) % n] - values[i]));
  return largest;
}

Mask whole_cells(const Mask& where, int cells) {
  require_divisor(cells, where.size());
  const Eigen::Index width = where.size() / cells;
  return Mask::NullaryExpr(where.size(),
                           [&](Eigen::Index i) { return where.segment(i / width * width, width).all(); });
}

Eigen::VectorXd best_constants(const Eigen::VectorXd& values, int cells) {
  require_divisor(cells, values.size());
  const Eigen::Index width = values.size() / cells;
  return Eigen::VectorXd::NullaryExpr(
      values.size(), [&](Eigen::Index i) { return values.segment(i / width * width, width).mean(); });
}

Eigen::VectorXd thinned(const Eigen::VectorXd& values, int points) {
  require_divisor(points, values.size());
  const Eigen::Index step = values.size() / points;
  return Eigen::VectorXd::NullaryExpr(points, [&](Eigen::Index i) { return values[i * step]; });
}

Eigen::VectorXd central_differences(const Eigen::VectorXd& values, int points, double period) {
  const Eigen::VectorXd u = thinned(values, points);
  return Eigen::VectorXd::NullaryExpr(points, [&](Eigen::Index i) {
    return (u[(i + 1) % points] - u[(i + points - 1) % points]) * points / (2.0 * period);
  });
}

int coefficients_needed(const Eigen::VectorXd& coefficients, double share) {
  std::vector<double> squares;
  for (const double c : coefficients) squares.push_back(c * c);
  std::sort(squares.begin(), squares.end());
  double allowed = share * share * coefficients.squaredNorm();
  std::size_t left_out = 0;
  while (left_out < squares.size() && (allowed -= squares[left_out]) >= 0.0) ++left_out;
  return static_cast<int>(squares.size() - left_out);
}

Eigen::VectorXd select(const Eigen::VectorXd& values, const Mask& where) {
  Eigen::VectorXd selected(where.count());
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (where[i]) selected[next++] = values[i];
  return selected;
}

double relative_mean_error(const Eigen::VectorXd& values, const Eigen::VectorXd& reference) {
  return (values - reference).cwiseAbs().mean() / reference.cwiseAbs().mean();
}

Eigen::VectorXd cell_midpoints(const Eigen::VectorXd& values, int cells) {
  require_divisor(2 * cells, values.size());
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
  double gain = 0.0;
  for (Eigen::Index i = 0; i + 1 < coarse.size(); ++i)
    gain = std::fmax(gain, std::abs(fine[2 * i + 1] - 0.5 * (coarse[i] + coarse[i + 1])));
  return gain;
}

}  // namespace wavebalance::jl14
