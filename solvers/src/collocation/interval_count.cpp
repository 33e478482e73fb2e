#include "collocation/interval_count.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "stability/winding.hpp"

namespace wavebalance::solvers::detail {
namespace {

using std::numbers::pi;

// A block of the free part of a map: one state of a real pole, two of a pair.
struct PoleBlock {
  Index begin;
  bool pair;
  std::complex<double> multiplier;
};

std::vector<PoleBlock> blocks_of(const Eigen::MatrixXd& free) {
  std::vector<PoleBlock> blocks;
  for (Index i = 0; i < free.rows();) {
    const bool pair = i + 1 < free.rows() && free(i + 1, i) != 0.0;
    blocks.push_back({i, pair, {free(i, i), pair ? free(i + 1, i) : 0.0}});
    i += pair ? 2 : 1;
  }
  return blocks;
}

// det(I + V (mu - D)^-1 U) on the unit circle, mu = exp(i nu). Parts that decay within the period act only
// by 1 / mu.
class UnknownsDeterminant {
 public:
  explicit UnknownsDeterminant(const PeriodMap& map) {
    constexpr double decayed = 1e-18;
    std::vector<Index> lasting, gone;
    for (const PoleBlock& block : blocks_of(map.free)) {
      const bool lasts = std::abs(block.multiplier) > decayed;
      if (lasts) blocks_.push_back({Index(lasting.size()), block.pair, block.multiplier});
      auto& states = lasts ? lasting : gone;
      states.push_back(block.begin);
      if (block.pair) states.push_back(block.begin + 1);
    }
    by_ = map.by_unknowns(lasting, Eigen::all);
    unknowns_ = map.unknowns_by(Eigen::all, lasting);
    gone_ = product(map.unknowns_by(Eigen::all, gone), map.by_unknowns(gone, Eigen::all));
  }

  // Free multipliers outside the circle; -1 where some lie on it, so that the determinant has poles there.
  int outside() const {
    int count = 0;
    for (const PoleBlock& block : blocks_) {
      if (std::abs(std::abs(block.multiplier) - 1.0) <= rounding) return -1;
      if (std::abs(block.multiplier) > 1.0) count += block.pair ? 2 : 1;
    }
    return count;
  }

  // With the arguments of the free multipliers near the circle, where the determinant turns quickly.
  std::vector<double> points() const {
    constexpr int uniform = 16;
    constexpr double near = 0.3;
    std::vector<double> all;
    for (int i = 0; i <= uniform; ++i) all.push_back(pi * i / uniform);
    for (const PoleBlock& block : blocks_)
      if (block.pair && std::abs(std::log(std::abs(block.multiplier))) < near)
        all.push_back(std::abs(std::arg(block.multiplier)));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // The logarithm and its derivative by i nu.
  FloquetDeterminant::Value operator()(double nu) const {
    const std::complex<double> mu = std::polar(1.0, nu);
    const Eigen::MatrixXcd once = resolved(by_, mu);
    Eigen::MatrixXcd matrix = times(unknowns_, once) + gone_ / mu;
    Eigen::MatrixXcd slope = -times(unknowns_, resolved(once, mu)) - gone_ / (mu * mu);
    matrix.diagonal().array() += 1.0;
    const Lu<std::complex<double>> factor(matrix);
    return {factor.log_determinant(), mu * factor.solve(slope).trace()};
  }

 private:
  static Eigen::MatrixXcd times(const Eigen::MatrixXd& a, const Eigen::MatrixXcd& b) {
    Eigen::MatrixXcd result(a.rows(), b.cols());
    result.real() = product(a, b.real());
    result.imag() = product(a, b.imag());
    return result;
  }

  // (mu - D)^-1 times rows of states.
  template <class Matrix>
  Eigen::MatrixXcd resolved(const Matrix& right, std::complex<double> mu) const {
    Eigen::MatrixXcd result(right.rows(), right.cols());
    for (const PoleBlock& block : blocks_) {
      const double a = block.multiplier.real(), b = block.multiplier.imag();
      const Index i = block.begin;
      if (!block.pair) {
        result.row(i) = right.row(i) / (mu - a);
        continue;
      }
      const std::complex<double> determinant = (mu - a) * (mu - a) + b * b;
      result.row(i) = ((mu - a) * right.row(i) - b * right.row(i + 1)) / determinant;
      result.row(i + 1) = (b * right.row(i) + (mu - a) * right.row(i + 1)) / determinant;
    }
    return result;
  }

  static constexpr double rounding = 1e-10;
  std::vector<PoleBlock> blocks_;
  Eigen::MatrixXd by_, unknowns_, gone_;
};

}  // namespace

int count_by_determinant(const PeriodMap& map, int max_evaluations) {
  const UnknownsDeterminant determinant(map);
  const int own = determinant.outside();
  if (own < 0) return -1;
  const auto turned =
      argument_change([&](double nu) { return determinant(nu); }, determinant.points(), max_evaluations);
  if (!turned) return -1;
  const double count = own - *turned / pi, rounded = std::round(count);
  return std::abs(count - rounded) < 1e-3 && rounded >= 0.0 ? static_cast<int>(rounded) : -1;
}

int count_unstable(const PeriodMap& map, int max_evaluations) {
  constexpr double of_eigenvalues = 25.0, expected = 150.0, most_operations = 1e12;
  const double s = double(map.free.rows()), n = double(map.unknowns_by.rows()),
               of_evaluation = n * n * (16.0 * s + 8.0 * n), of_all = of_eigenvalues * s * s * s;
  if (of_all < expected * of_evaluation) {
    if (of_all > most_operations) return -1;
    return count_outside_circle(map.all());
  }
  const int affordable = static_cast<int>(std::min(2e9, most_operations / of_evaluation));
  return count_by_determinant(map, std::min(max_evaluations, affordable));
}

}  // namespace wavebalance::solvers::detail
