#pragma once
#include "complementarity/complementarity_path.hpp"
#include "wavebalance/solvers/balance/newton.hpp"
#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

namespace wavebalance::solvers {

/// The least flexibility of an obstacle, over the largest compliance. K over more samples than there are
/// functions is singular, and this flexibility makes its systems solvable to working precision.
constexpr double least_flexibility = 1e-12;

/// Solves the linear complementarity problem of obstacles by paths (see ComplementarityPath), which are tried
/// one after the other until one reaches its goal. A soft obstacle is lowered first, with about one pivot per
/// sample in contact. Its flexibility is then divided by a factor repeatedly. Each division is a segment,
/// which is again such a path; when it fails, the factor is reduced. Strategy lists the paths in their order.
class LcpHomotopy {
 public:
  LcpHomotopy(CondensedProblem& problem, const ComplementarityOptions& options, Observer observer);

  /// Flexibilities of `goal` below least_flexibility are raised to it. False when no path reaches the goal:
  /// the force is then that of the stiffest obstacles solved for, or empty, and status() gives the reason.
  bool solve(const Obstacles& goal);
  /// Moves from the solution to other obstacles nearby. When it fails, the force is unchanged.
  bool follow(const Obstacles& goal);

  /// How the last solve() ended: converged, stalled, effort_limit or cancelled.
  SolveStatus status() const;
  Strategy strategy() const { return strategy_; }          ///< the path that solved last, none if no path did
  const Eigen::VectorXd& force() const { return force_; }  ///< N
  double flexibility() const { return reached_; }          ///< m/N, the least flexibility solved for
  double condition() const { return condition_; }  ///< ComplementarityPath::condition() of the last system
  int pivots() const { return path_.pivots(); }

 private:
  Obstacles scaled(const Obstacles& goal, double least) const;
  bool lower(const Obstacles& goal, double flexibility, const Eigen::VectorXd& covering_vector);
  bool is_stiff_enough(const Obstacles& goal) const;
  bool stiffen(const Obstacles& goal, double factor, double smallest);
  Strategy even_paths(const Obstacles& goal, const Eigen::VectorXd& even);
  Strategy random_paths(const Obstacles& goal, const Eigen::VectorXd& even);
  void keep(double flexibility);

  ComplementarityOptions options_;
  ComplementarityPath path_;
  double largest_compliance_ = 0.0, least_ = 0.0;  // the largest compliance and the least flexibility, m/N
  double scale_ = 1.0, level_ = 0.0, reached_ = 0.0, condition_ = 0.0;
  bool cancelled_ = false;
  Strategy strategy_ = Strategy::none;
  Eigen::VectorXd force_;
};

}  // namespace wavebalance::solvers
