#pragma once
#include <span>

#include "wavebalance/contact/multipliers.hpp"

namespace wavebalance::ll10 {

/// Result of one outer iteration. The measures are Powell's G_i and G_e before the update.
struct MultiplierReport {
  bool converged = false;
  bool stalled = false;  ///< the same problem would follow
  double inequality_measure = 0.0;
  double equality_measure = 0.0;
};

/// The outer iteration on theta and kappa: the terms
///   1/2 sum kappa (g + theta)_+^2 + 1/2 kappa_e (h + theta_e)^2   [LL10, eq. (18)]
/// of inequality constraints g <= 0 and of one equality constraint h = 0, and their update [LL10, Algorithm
/// 3].
class Multipliers {
 public:
  virtual ~Multipliers() = default;
  virtual int inequalities() const = 0;
  virtual int equalities() const { return 1; }
  /// kappa (g + theta)_+, and kappa where g + theta >= 0, else 0.
  virtual void inequality_force(std::span<const double> g, std::span<double> force,
                                std::span<double> tangent) const = 0;
  virtual double equality_force(double h) const = 0;  ///< kappa_e (h + theta_e)
  virtual double equality_penalty() const = 0;        ///< kappa_e
  /// Begins anew from multipliers kappa theta and kappa_e theta_e.
  virtual void restart(std::span<const double> inequality, double equality) = 0;
  virtual MultiplierReport update(std::span<const double> g, double h) = 0;
};

/// Multipliers of the augmented Lagrangian; refers to the update, which must outlive this.
class AugmentedMultipliers final : public Multipliers {
 public:
  explicit AugmentedMultipliers(contact::MultiplierUpdate& update) : update_(update) {}
  int inequalities() const override { return update_.inequalities(); }
  int equalities() const override { return update_.equalities(); }
  void inequality_force(std::span<const double> g, std::span<double> force,
                        std::span<double> tangent) const override {
    update_.inequality_force(g, force, tangent);
  }
  double equality_force(double h) const override {
    double force = 0.0;
    update_.equality_force({&h, 1}, {&force, 1});
    return force;
  }
  double equality_penalty() const override { return update_.equality_penalties()[0]; }
  void restart(std::span<const double> inequality, double equality) override {
    update_.restart(inequality, {&equality, 1});
  }
  MultiplierReport update(std::span<const double> g, double h) override {
    const auto step = update_.update(g, {&h, 1});
    return {step.converged(), step.stalled(), step.inequality_measure, step.equality_measure};
  }

 private:
  contact::MultiplierUpdate& update_;
};

}  // namespace wavebalance::ll10
