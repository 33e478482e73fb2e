#include "wavebalance/solvers/balance/coupled_law.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {
namespace {

constexpr std::size_t most_rows = 3;

}  // namespace

void AnyCoupledLaw::evaluate(const PeriodKinematics& motion, PeriodForces& out) const {
  const auto rows = std::size_t(rows_), points = std::size_t(motion.points);
  std::array<double, most_rows> u{}, force{};
  std::array<double, most_rows * most_rows> slopes{};
  for (std::size_t l = 0; l < points; ++l) {
    for (std::size_t i = 0; i < rows; ++i) u[i] = motion.displacement[i * points + l];
    const Values here(u.data(), rows);
    if (!(penetration_(here, slopes) > 0.0)) continue;
    closed_(here, force, slopes);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t own = i * points + l;
      out.force[own] = force[i];
      out.piece[own] = 1;
      out.displacement_slope[own] = slopes[i * rows + i];
      for (std::size_t j = 0; j < rows; ++j)
        if (j != i) out.others.push_back({int(own), int(j * points + l), slopes[i * rows + j]});
    }
  }
}

// Newton's method on u + flexibility F(u) = v. Where v touches nothing there is no force.
void AnyCoupledLaw::start(std::span<const double> v, std::span<const double> flexibility,
                          std::span<double> force) const {
  constexpr int most = 50;
  constexpr double rounding = 1e-15;
  const auto rows = std::size_t(rows_);
  std::array<double, most_rows * most_rows> slopes{};
  std::fill(force.begin(), force.end(), 0.0);
  if (!(penetration_(v, slopes) > 0.0)) return;
  std::array<double, most_rows> u{};
  std::copy_n(v.begin(), rows, u.begin());
  Eigen::MatrixXd matrix(rows_, rows_);
  Eigen::VectorXd residual(rows_);
  for (int n = 0; n < most; ++n) {
    closed_({u.data(), rows}, force, slopes);
    for (std::size_t i = 0; i < rows; ++i) {
      residual[Eigen::Index(i)] = u[i] + flexibility[i] * force[i] - v[i];
      for (std::size_t j = 0; j < rows; ++j)
        matrix(Eigen::Index(i), Eigen::Index(j)) =
            (i == j ? 1.0 : 0.0) + flexibility[i] * slopes[i * rows + j];
    }
    const Eigen::VectorXd step = detail::Lu<double>(matrix).solve(residual);
    for (std::size_t i = 0; i < rows; ++i) u[i] -= step[Eigen::Index(i)];
    if (!(step.norm() > rounding * std::hypot(u[0], u[1]))) break;
  }
  closed_({u.data(), rows}, force, slopes);
}

void AnyCoupledLaw::advance(std::span<const double> /*before*/, std::span<const double> v,
                            std::span<const double> flexibility, std::span<double> force) const {
  start(v, flexibility, force);
}

}  // namespace wavebalance::solvers
