#pragma once
#include <span>
#include <vector>

/// Ways to treat the constraints of a mode other than the augmented Lagrangian, for comparison. Each meets
/// MultiplierStrategy. An iteration ends when both measures of Powell are below 1e-10, as in
/// contact::MultiplierUpdate.
namespace wavebalance::ll10 {

/// What one outer iteration did.
struct StrategyStep {
  double inequality_measure = 0.0;  ///< G_i
  double equality_measure = 0.0;    ///< G_e
  bool converged() const;
  bool stalled() const { return false; }
};

/// The Lagrangian of [LL10, eqs. (14), (15)] without penalty terms: descent on the motion at fixed
/// multipliers, ascent on these by `step` times the constraints.
class MultipliersOnly {
 public:
  MultipliersOnly(int inequalities, double step);
  int inequalities() const { return static_cast<int>(multipliers_.size()); }
  int equalities() const { return 1; }
  void inequality_force(std::span<const double> g, std::span<double> force, std::span<double> tangent) const;
  void equality_force(std::span<const double> h, std::span<double> force) const;
  double inequality_term(std::span<const double> g) const;
  double equality_term(std::span<const double> h) const;
  std::vector<double> equality_penalties() const { return {0.0}; }
  void restart(std::span<const double> inequality, std::span<const double> equality);
  StrategyStep update(std::span<const double> g, std::span<const double> h);

 private:
  double step_;
  std::vector<double> multipliers_;
  double equality_ = 0.0;
};

/// Penalty terms without multipliers, ten times as stiff from one outer iteration to the next.
class PenaltiesOnly {
 public:
  PenaltiesOnly(int inequalities, double penalty) : inequalities_(inequalities), penalty_(penalty) {}
  int inequalities() const { return inequalities_; }
  int equalities() const { return 1; }
  void inequality_force(std::span<const double> g, std::span<double> force, std::span<double> tangent) const;
  void equality_force(std::span<const double> h, std::span<double> force) const;
  double inequality_term(std::span<const double> g) const;
  double equality_term(std::span<const double> h) const;
  std::vector<double> equality_penalties() const { return {penalty_}; }
  void restart(std::span<const double>, std::span<const double>) {}
  StrategyStep update(std::span<const double> g, std::span<const double> h);

 private:
  int inequalities_;
  double penalty_;
};

}  // namespace wavebalance::ll10
