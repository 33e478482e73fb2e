#include "wavebalance/solvers/response/motion_periods.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

double change_after(const CondensedProblem& problem, const PeriodicResponse& response, int periods) {
  detail::require_at_least("change_after", "periods", periods, 1);
  const double shift = 2.0 * std::numbers::pi * periods / load_periods(problem);
  double change = 0.0, whole = 0.0;
  Eigen::VectorXcd harmonics;
  for (Eigen::Index c = 0; c < response.coefficients.cols(); ++c) {
    problem.pair().spread(response.coefficients.col(c), harmonics);
    for (Eigen::Index n = 1; n < harmonics.size(); ++n) {
      const double angle = std::remainder(shift * double(n), 2.0 * std::numbers::pi);
      whole += std::norm(harmonics[n]);
      change += std::norm(harmonics[n]) * 4.0 * std::pow(std::sin(0.5 * angle), 2);
    }
  }
  return whole > 0.0 ? std::sqrt(change / whole) : 0.0;
}

int motion_periods(const CondensedProblem& problem, const PeriodicResponse& response, double tolerance) {
  const int all = load_periods(problem);
  for (int periods = 1; periods < all; ++periods)
    if (all % periods == 0 && change_after(problem, response, periods) <= tolerance) return periods;
  return all;
}

}  // namespace wavebalance::solvers
