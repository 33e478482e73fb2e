#pragma once
#include <vector>

#include "modes/mode_augmented_lagrangian_multipliers.hpp"

/// Ways to treat the constraints of a mode other than the augmented Lagrangian, for comparison. An iteration
/// ends when both measures of Powell are below 1e-10, as in contact::MultiplierUpdate.
namespace wavebalance::ll10 {

/// The Lagrangian of [LL10, eqs. (14), (15)] without penalty terms: descent on the motion at fixed
/// multipliers, ascent on these by `step` times the constraints.
class MultipliersOnly final : public Multipliers {
 public:
  MultipliersOnly(int inequalities, double step)
      : step_(step), multipliers_(static_cast<std::size_t>(inequalities), 0.0) {}
  int inequalities() const override { return static_cast<int>(multipliers_.size()); }
  void inequality_force(std::span<const double> g, std::span<double> force,
                        std::span<double> tangent) const override;
  double equality_force(double) const override { return equality_; }
  double equality_penalty() const override { return 0.0; }
  void restart(std::span<const double> inequality, double equality) override;
  MultiplierReport update(std::span<const double> g, double h) override;

 private:
  double step_;
  std::vector<double> multipliers_;
  double equality_ = 0.0;
};

/// Penalty terms without multipliers, ten times as stiff from one outer iteration to the next.
class PenaltiesOnly final : public Multipliers {
 public:
  PenaltiesOnly(int inequalities, double penalty) : inequalities_(inequalities), penalty_(penalty) {}
  int inequalities() const override { return inequalities_; }
  void inequality_force(std::span<const double> g, std::span<double> force,
                        std::span<double> tangent) const override;
  double equality_force(double h) const override { return penalty_ * h; }
  double equality_penalty() const override { return penalty_; }
  void restart(std::span<const double>, double) override {}
  MultiplierReport update(std::span<const double> g, double h) override;

 private:
  int inequalities_;
  double penalty_;
};

}  // namespace wavebalance::ll10
