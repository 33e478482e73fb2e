#pragma once
#include "complementarity/complementarity_path.hpp"
#include "wavebalance/solvers/balance/newton.hpp"
#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

namespace wavebalance::solvers {

/// The flexibility, over the largest compliance, below which an obstacle is not made stiffer: K over more
/// samples than there are functions is singular, and this much keeps the digits.
constexpr double least_flexibility = 1e-12;

/// Solves the linear complementarity problem of obstacles by paths, one after the other until one arrives
/// (see ComplementarityPath). A soft obstacle is lowered first, with about one pivot per sample in contact.
/// Its flexibility is then divided by a factor again and again; each of these segments is again such a path,
/// and where one does not arrive the factor is reduced. The paths, in their order, are those of Strategy.
class LcpHomotopy {
 public:
  LcpHomotopy(CondensedProblem& problem, const ComplementarityOptions& options, Observer observer);

  /// `goal`: with the flexibilities wanted, taken no lower than the least. False when no path arrives: the
  /// force is then that of the stiffest obstacles solved for, none perhaps, and status() says why.
  bool solve(const Obstacles& goal);
  /// From the solution to other obstacles nearby; false leaves the force as it was.
  bool follow(const Obstacles& goal);

  /// Of the last solve(): converged, stalled, effort_limit or cancelled.
  SolveStatus status() const;
  Strategy strategy() const { return strategy_; }          ///< of the last solve() that converged
  const Eigen::VectorXd& force() const { return force_; }  ///< N
  double flexibility() const { return reached_; }          ///< m/N, down to which obstacles were stiffened
  double condition() const { return condition_; }          ///< of its last system, see ComplementarityPath
  int pivots() const { return path_.pivots(); }

 private:
  Obstacles scaled(const Obstacles& goal, double least) const;
  bool lower(const Obstacles& goal, double flexibility, const Eigen::VectorXd& covering_vector);
  bool arrived(const Obstacles& goal) const;
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
