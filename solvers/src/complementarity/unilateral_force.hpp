#pragma once
#include "complementarity/complementarity_path.hpp"

namespace wavebalance::solvers {

/// The flexibility, over the largest compliance, below which an obstacle is not made stiffer: K over more
/// samples than there are functions is singular, and this much keeps the digits.
constexpr double least_flexibility = 1e-12;

/// Solves the complementarity problem of obstacles by paths, one after the other until one arrives. The
/// nearest comes first: obstacles about as stiff as the structure are lowered, which takes about one corner a
/// sample in contact, and then stiffened by factors, smaller ones where a leg is long. Where short legs of
/// no factor arrive, longer ones are allowed: with a thousand samples in contact a leg may take thousands of
/// corners and one by another factor forty. Then the obstacles are lowered at their own stiffness, and last
/// unevenly (fixed seed), from other stiffnesses by other factors.
class UnilateralForce {
 public:
  UnilateralForce(CondensedProblem& problem, ComplementarityPath::Observer observer);

  /// `goal`: with the flexibilities wanted, taken no lower than the least. False when no path arrives: the
  /// force is then that of the stiffest obstacles solved for, none perhaps.
  bool solve(const Obstacles& goal);
  /// From the solution to other obstacles nearby; false leaves the force as it was.
  bool follow(const Obstacles& goal);

  const Eigen::VectorXd& force() const { return force_; }  ///< N
  double flexibility() const { return reached_; }          ///< m/N, down to which obstacles were stiffened
  double condition() const { return condition_; }          ///< of its last system, see ComplementarityPath
  int corners() const { return path_.corners(); }

 private:
  Obstacles scaled(const Obstacles& goal, double least) const;
  bool lower(const Obstacles& goal, double flexibility, const Eigen::VectorXd& cover);
  bool arrived(const Obstacles& goal) const;
  bool stiffen(const Obstacles& goal, double factor, double smallest);
  bool even_paths(const Obstacles& goal, const Eigen::VectorXd& even);
  bool uneven_paths(const Obstacles& goal, const Eigen::VectorXd& even);
  void keep(double flexibility);

  ComplementarityPath path_;
  double largest_compliance_ = 0.0, least_ = 0.0;  // the largest compliance and the least flexibility, m/N
  double scale_ = 1.0, level_ = 0.0, reached_ = 0.0, condition_ = 0.0;
  bool stopped_ = false;
  Eigen::VectorXd force_;
};

}  // namespace wavebalance::solvers
