#include "wavebalance/solvers/response/rigid_response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "balance/active_block.hpp"
#include "complementarity/lcp_homotopy.hpp"
#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

// The gap of each sample.
Eigen::VectorXd sample_gaps(const Eigen::VectorXd& gaps, int points) {
  return gaps.transpose().replicate(points, 1).reshaped();
}

// Violation of the complementarity, m: the largest penetration `excess`, and the largest |excess| times the
// force there over the largest force.
double violation(const Eigen::VectorXd& excess, const Eigen::VectorXd& force) {
  const double largest = force.maxCoeff();
  return std::max(excess.maxCoeff(), (force / largest).cwiseProduct(excess).cwiseAbs().maxCoeff());
}

// The force for which u = gap at the samples with positive `start`, by least squares, because K is singular
// on more samples than there are functions. Empty if a sign fails.
std::optional<Eigen::VectorXd> solve_active(CondensedProblem& problem, const Eigen::VectorXd& gap,
                                            const Eigen::VectorXd& start, double tolerance) {
  std::vector<int> active;
  for (int l = 0; l < start.size(); ++l)
    if (start[l] > 0.0) active.push_back(l);
  if (active.empty()) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd matrix(count, count);
  fill_active_compliance(problem, active, matrix);
  const Eigen::VectorXd right = (problem.contact_free_response() - gap)(active);
  const double unit = matrix.cwiseAbs().maxCoeff();  // compliances below 1e-154 m/N have squares that vanish
  const Eigen::VectorXd values = detail::least_squares(matrix / unit, right) / unit;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(start.size());
  force(active) = values;
  Eigen::VectorXd product(start.size());
  problem.apply(force, product);
  if (!force.allFinite() || values.minCoeff() < 0.0) return std::nullopt;
  if (!(violation(problem.contact_free_response() - product - gap, force) <= tolerance)) return std::nullopt;
  return force;
}

void require_gaps(const CondensedProblem& problem, const Eigen::VectorXd& gaps) {
  if (gaps.size() != problem.contacts())
    throw std::invalid_argument("rigid_response: gaps has " + std::to_string(gaps.size()) +
                                " entries; the problem has " + std::to_string(problem.contacts()) +
                                " contacts");
  if (!gaps.allFinite()) throw std::invalid_argument("rigid_response: every gap must be finite");
}

// Lowers obstacles with a very small flexibility and then solves their active samples. Fills all of `result`
// except what follows from the force.
void solve_contact(CondensedProblem& problem, const Eigen::VectorXd& gap, const RigidResponseOptions& options,
                   RigidResponse& result) {
  PeriodicResponse& response = result.response;
  const Eigen::VectorXd& free = problem.contact_free_response();
  const double size = std::max(free.cwiseAbs().maxCoeff(), (free - gap).maxCoeff());
  LcpHomotopy obstacles(problem, options.paths, options.observer);
  const bool found = obstacles.solve({gap - free, Eigen::VectorXd::Zero(free.size())});
  response.iterations = obstacles.pivots();
  response.strategy = obstacles.strategy();
  response.status = found ? SolveStatus::stalled : obstacles.status();
  if (obstacles.force().size() == 0) return;
  result.stiffness = 1.0 / obstacles.flexibility();
  response.contact_force = obstacles.force();
  if (const auto exact = solve_active(problem, gap, obstacles.force(), 1e-9 * size)) {
    response.contact_force = *exact;
    result.stiffness = std::numeric_limits<double>::infinity();
  }
  Eigen::VectorXd product;
  problem.apply(response.contact_force, product);
  response.displacement = free - product;
  if (violation(response.displacement - gap, response.contact_force) <= options.tolerance * size)
    response.status = SolveStatus::converged;
}

}  // namespace

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                double gap) {
  return complementarity(displacement, force, Eigen::VectorXd::Constant(1, gap));
}

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                const Eigen::VectorXd& gaps) {
  const auto points = static_cast<int>(displacement.size() / gaps.size());
  const Eigen::VectorXd opening = sample_gaps(gaps, points) - displacement;
  Complementarity result{-opening.minCoeff(), force.minCoeff(), 0.0};
  const double size = std::max(opening.cwiseAbs().maxCoeff(), displacement.cwiseAbs().maxCoeff());
  const double largest = force.cwiseAbs().maxCoeff();
  if (largest > 0.0 && size > 0.0)
    result.product = (force / largest).cwiseProduct(opening / size).cwiseAbs().maxCoeff();
  return result;
}

void RigidResponseOptions::validate() const {
  detail::require_positive("RigidResponseOptions", "tolerance", tolerance);
  paths.validate();
}

RigidResponse rigid_response(CondensedProblem& problem, const Eigen::VectorXd& gaps,
                             const RigidResponseOptions& options) {
  options.validate();
  require_gaps(problem, gaps);
  const int points = problem.points();
  const Eigen::VectorXd gap = sample_gaps(gaps, points);
  RigidResponse result;
  PeriodicResponse& response = result.response;
  response.frequency = problem.frequency();
  response.force_by_balance = true;
  response.displacement = problem.contact_free_response();
  response.contact_force = Eigen::VectorXd::Zero(problem.samples());
  if ((response.displacement - gap).maxCoeff() <= 0.0) {
    response.status = SolveStatus::converged;
    response.strategy = Strategy::newton;
    result.stiffness = std::numeric_limits<double>::infinity();
  } else {
    solve_contact(problem, gap, options, result);
  }
  response.coefficients = problem.coefficients(response.contact_force);
  result.complementarity = complementarity(response.displacement, response.contact_force, gaps);
  for (int c = 0; c < problem.contacts(); ++c)
    result.contact_complementarity.push_back(
        complementarity(response.displacement.segment(c * points, points),
                        response.contact_force.segment(c * points, points), gaps[c]));
  result.active_samples = static_cast<int>((response.contact_force.array() > 0.0).count());
  return result;
}

RigidResponse rigid_response(CondensedProblem& problem, double gap, const RigidResponseOptions& options) {
  return rigid_response(problem, Eigen::VectorXd::Constant(problem.contacts(), gap), options);
}

}  // namespace wavebalance::solvers
