#include "adaptive_rigid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "dense_solve.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

using ActiveSet = std::vector<int>;

// y = q - K force <= 0, force >= 0, product 0: y the penetration at the end of each cell.
class CellProblem {
 public:
  CellProblem(Eigen::MatrixXd compliance, Eigen::VectorXd free_penetration, double size)
      : k_(std::move(compliance)), q_(std::move(free_penetration)), size_(size) {}

  const Eigen::VectorXd& force() const { return force_; }
  ActiveSet where_positive(const Eigen::VectorXd& values) const {
    ActiveSet active;
    for (int i = 0; i < values.size(); ++i)
      if (values[i] > 0.0) active.push_back(i);
    return active;
  }

  // The active set of the rigid obstacle from a given one; false when it cycles or becomes singular.
  bool solve_rigid(ActiveSet active, int max_iterations) {
    constexpr double rounding = 1e-10;
    for (int iteration = 0; iteration < max_iterations; ++iteration, ++iterations) {
      const Eigen::VectorXd pressed = detail::dense_solve(k_(active, active), q_(active));
      if (pressed.size() != static_cast<Eigen::Index>(active.size())) return false;  // singular
      const Eigen::VectorXd y = q_ - k_(Eigen::all, active) * pressed;
      force_.setZero(q_.size());
      force_(active) = pressed;
      const double largest = force_.cwiseAbs().maxCoeff();
      ActiveSet next;
      std::size_t place = 0;
      for (int i = 0; i < q_.size(); ++i) {
        const bool was = place < active.size() && active[place] == i;
        if (was ? pressed[static_cast<Eigen::Index>(place)] > -rounding * largest : y[i] > rounding * size_)
          next.push_back(i);
        if (was) ++place;
      }
      if (next == active) {
        force_ = force_.cwiseMax(0.0);
        return force_.allFinite();
      }
      active = std::move(next);
    }
    return false;
  }

  // Newton on y = q - K stiffness max(y, 0) from an active set, which it improves; false when it cycles.
  bool solve_spring(double stiffness, ActiveSet& active, int max_iterations) {
    for (int iteration = 0; iteration < max_iterations; ++iteration, ++iterations) {
      Eigen::MatrixXd matrix = stiffness * k_(active, active);
      matrix.diagonal().array() += 1.0;
      const Eigen::VectorXd pressed = detail::dense_solve(matrix, q_(active));
      if (pressed.size() != static_cast<Eigen::Index>(active.size())) return false;  // singular
      const Eigen::VectorXd y = q_ - stiffness * (k_(Eigen::all, active) * pressed).eval();
      ActiveSet next = where_positive(y);
      if (next == active) return true;
      active = std::move(next);
    }
    return false;
  }

  // A spring is stiffened until its active set is that of the rigid obstacle.
  bool stiffen(int max_iterations) {
    const double unit = 1.0 / k_.cwiseAbs().maxCoeff();
    constexpr double softest = -12.0, stiffest = 18.0, smallest = 1e-4;
    double reached = softest, step = 1.0;
    ActiveSet active = where_positive(q_);
    if (!solve_spring(unit * std::exp(softest), active, max_iterations)) return false;
    while (reached < stiffest && step >= smallest) {
      ActiveSet next = active;
      if (!solve_spring(unit * std::exp(reached + step), next, max_iterations)) {
        step *= 0.5;
        continue;
      }
      const bool changed = next != active;
      active = std::move(next);
      reached += step;
      step = std::min(1.0, 1.5 * step);
      if (!changed && reached > 2.0 && solve_rigid(active, max_iterations)) return true;
    }
    return solve_rigid(active, max_iterations);
  }

  int iterations = 0;

 private:
  Eigen::MatrixXd k_;
  Eigen::VectorXd q_;
  double size_;
  Eigen::VectorXd force_;
};

int end_of(const ForceCells& cells, std::size_t i, int points) {
  return i + 1 < cells.size() ? cells[i + 1] : points;
}

void require_cells(const CondensedProblem& problem, const ForceCells& cells, double gap,
                   const Eigen::VectorXd& start) {
  const auto fail = [](const std::string& text) { throw std::invalid_argument("cell_response: " + text); };
  const int points = problem.points();
  if (!std::isfinite(gap)) fail("gap must be finite");
  if (problem.contact_free_response().size() != points)
    fail("the problem has " + std::to_string(problem.contact_free_response().size()) + " samples and " +
         std::to_string(points) + " points; it must have one contact and a frequency");
  if (cells.empty() || cells.front() != 0 || cells.back() >= points ||
      std::adjacent_find(cells.begin(), cells.end(), std::greater_equal<>()) != cells.end())
    fail("the cells must begin with 0 and ascend below the " + std::to_string(points) + " points");
  if (start.size() != 0 && start.size() != points)
    fail("start has " + std::to_string(start.size()) + " samples; it must be empty or have " +
         std::to_string(points));
}

// Means over the cells of N samples.
Eigen::VectorXd means(const ForceCells& cells, const Eigen::VectorXd& samples) {
  const int points = static_cast<int>(samples.size());
  Eigen::VectorXd result(static_cast<Eigen::Index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i)
    result[static_cast<Eigen::Index>(i)] =
        samples.segment(cells[i], end_of(cells, i, points) - cells[i]).mean();
  return result;
}

// Values at the ends of the cells, of N samples.
Eigen::VectorXd at_ends(const ForceCells& cells, const Eigen::VectorXd& samples) {
  const int points = static_cast<int>(samples.size());
  Eigen::VectorXd result(static_cast<Eigen::Index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = samples[end_of(cells, i, points) % points];
  return result;
}

Eigen::VectorXd spread(const ForceCells& cells, const Eigen::VectorXd& values, int points) {
  Eigen::VectorXd result(points);
  for (std::size_t i = 0; i < cells.size(); ++i)
    result.segment(cells[i], end_of(cells, i, points) - cells[i])
        .setConstant(values[static_cast<Eigen::Index>(i)]);
  return result;
}

// Bisects the fewest cells that hold `fraction` of the indicator; halves keep `narrowest` samples.
ForceCells bisected(const CellResponse& response, double fraction, int most, int narrowest) {
  const ForceCells& cells = response.cells;
  const int points = static_cast<int>(response.displacement.size());
  const auto count = static_cast<Eigen::Index>(cells.size());
  Eigen::VectorXd indicator = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int width = end_of(cells, static_cast<std::size_t>(i), points) - cells[static_cast<std::size_t>(i)];
    const Eigen::VectorXd& force = response.cell_force;
    const double jump = std::max(std::abs(force[i] - force[(i + 1) % count]),
                                 std::abs(force[i] - force[(i + count - 1) % count]));
    if (width >= 2 * narrowest) indicator[i] = std::pow(double(width) / points, 3) * jump * jump;
  }
  std::vector<Eigen::Index> order(cells.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return indicator[a] > indicator[b]; });
  ForceCells result = cells;
  double sum = 0.0;
  const double target = fraction * indicator.sum();
  for (const Eigen::Index i : order) {
    if (sum >= target || indicator[i] == 0.0 || static_cast<int>(result.size()) >= most) break;
    sum += indicator[i];
    const auto place = static_cast<std::size_t>(i);
    result.push_back((cells[place] + end_of(cells, place, points)) / 2);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

ForceCells uniform_cells(int points, int count) {
  if (count < 1 || points % count != 0)
    throw std::invalid_argument("uniform_cells: count is " + std::to_string(count) +
                                "; it must be positive and divide the " + std::to_string(points) + " points");
  ForceCells cells(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) cells[static_cast<std::size_t>(i)] = i * (points / count);
  return cells;
}

CellResponse cell_response(CondensedProblem& problem, double gap, const ForceCells& cells,
                           const NewtonOptions& options, const Eigen::VectorXd& start) {
  require_cells(problem, cells, gap, start);
  const int points = problem.points();
  const auto count = static_cast<Eigen::Index>(cells.size());
  Eigen::MatrixXd compliance(count, count);
  Eigen::VectorXd answer(points);
  for (Eigen::Index j = 0; j < count; ++j) {
    problem.apply(spread(cells, Eigen::VectorXd::Unit(count, j), points), answer);
    compliance.col(j) = at_ends(cells, answer);
  }
  const Eigen::VectorXd& free = problem.contact_free_response();
  CellProblem system(std::move(compliance), at_ends(cells, free).array() - gap, free.cwiseAbs().maxCoeff());
  const bool solved = (start.size() != 0 && system.solve_rigid(system.where_positive(means(cells, start)),
                                                               options.max_iterations)) ||
                      system.stiffen(options.max_iterations);
  CellResponse response;
  response.status = solved ? SolveStatus::converged : SolveStatus::stalled;
  response.iterations = system.iterations;
  response.cells = cells;
  if (!solved) return response;
  response.cell_force = system.force();
  response.contact_force = spread(cells, response.cell_force, points);
  problem.apply(response.contact_force, answer);
  response.displacement = free - answer;
  return response;
}

AdaptiveCellResponse adaptive_rigid_response(CondensedProblem& problem, double gap,
                                             const AdaptiveRigidOptions& options) {
  if (!(options.fraction > 0.0 && options.fraction <= 1.0))
    detail::reject("adaptive_rigid_response", "fraction", options.fraction, "above 0 and at most 1");
  detail::require_positive("adaptive_rigid_response", "tolerance", options.tolerance);
  detail::require_at_least("adaptive_rigid_response", "max_rounds", options.max_rounds, 1);
  AdaptiveCellResponse result;
  ForceCells cells = uniform_cells(problem.points(), options.first_cells);
  const int narrowest = std::max(1, problem.points() / problem.pair().functions());
  CellResponse before;
  for (int round = 0; round < options.max_rounds; ++round) {
    result.rounds.push_back({cell_response(problem, gap, cells, options.newton, before.contact_force)});
    AdaptiveCellRound& current = result.rounds.back();
    if (!current.response.converged()) return result;
    const Eigen::VectorXd& u = current.response.displacement;
    if (round > 0) current.estimate = (u - before.displacement).norm() / u.norm();
    before = current.response;
    result.met_tolerance = current.estimate <= options.tolerance;
    if (result.met_tolerance) return result;
    ForceCells next = bisected(current.response, options.fraction, options.max_cells, narrowest);
    if (next == cells) return result;
    cells = std::move(next);
  }
  return result;
}

}  // namespace wavebalance::solvers
