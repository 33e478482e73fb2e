#pragma once
#include <concepts>
#include <span>

namespace wavebalance::ll10 {

/// Requirements of the augmented Lagrangian on the outer iteration on theta and kappa: the terms
///   1/2 sum kappa (g + theta)_+^2 + 1/2 sum kappa_e (h + theta_e)^2   [LL10, eq. (18)]
/// of the inequality constraints g <= 0 and equality constraints h = 0, and their update [LL10, Algorithm 3].
/// contact::MultiplierUpdate is one.
template <class Strategy>
concept MultiplierStrategy = requires(Strategy& strategy, const Strategy& fixed, std::span<const double> in,
                                      std::span<double> out) {
  { fixed.inequalities() } -> std::convertible_to<int>;
  { fixed.equalities() } -> std::convertible_to<int>;
  fixed.inequality_force(in, out, out);  // for g: kappa (g + theta)_+, and kappa where g + theta >= 0, else 0
  fixed.equality_force(in, out);         // for h: kappa_e (h + theta_e)
  { fixed.inequality_term(in) } -> std::convertible_to<double>;
  { fixed.equality_term(in) } -> std::convertible_to<double>;
  { fixed.equality_penalties()[0] } -> std::convertible_to<double>;
  strategy.restart(in, in);  // begin anew from multipliers kappa theta and kappa_e theta_e
  { strategy.update(in, in).converged() } -> std::convertible_to<bool>;  // measures of g and h
  { strategy.update(in, in).stalled() } -> std::convertible_to<bool>;    // the same problem would follow
  { strategy.update(in, in).inequality_measure } -> std::convertible_to<double>;  // Powell's G_i, G_e,
  { strategy.update(in, in).equality_measure } -> std::convertible_to<double>;    // before the update
};

/// What one outer iteration did.
struct MultiplierReport {
  bool converged = false;
  bool stalled = false;
  double inequality_measure = 0.0;
  double equality_measure = 0.0;
};

/// A strategy behind an interface, so that the solver is compiled once.
class Multipliers {
 public:
  virtual ~Multipliers() = default;
  virtual int inequalities() const = 0;
  virtual int equalities() const = 0;
  virtual void inequality_force(std::span<const double> g, std::span<double> force,
                                std::span<double> tangent) const = 0;
  virtual double equality_force(double h) const = 0;
  virtual double equality_penalty() const = 0;
  virtual double terms(std::span<const double> g, double inequality_weight, double h) const = 0;
  virtual void restart(std::span<const double> inequality, double equality) = 0;
  virtual MultiplierReport update(std::span<const double> g, double h) = 0;
};

/// Refers to a strategy with one equality constraint; it must outlive this.
template <MultiplierStrategy Strategy>
class MultipliersOf final : public Multipliers {
 public:
  explicit MultipliersOf(Strategy& strategy) : strategy_(strategy) {}
  int inequalities() const override { return strategy_.inequalities(); }
  int equalities() const override { return strategy_.equalities(); }
  void inequality_force(std::span<const double> g, std::span<double> force,
                        std::span<double> tangent) const override {
    strategy_.inequality_force(g, force, tangent);
  }
  double equality_force(double h) const override {
    double force = 0.0;
    strategy_.equality_force(std::span<const double>(&h, 1), std::span<double>(&force, 1));
    return force;
  }
  double equality_penalty() const override { return strategy_.equality_penalties()[0]; }
  double terms(std::span<const double> g, double inequality_weight, double h) const override {
    return inequality_weight * strategy_.inequality_term(g) +
           strategy_.equality_term(std::span<const double>(&h, 1));
  }
  void restart(std::span<const double> inequality, double equality) override {
    strategy_.restart(inequality, std::span<const double>(&equality, 1));
  }
  MultiplierReport update(std::span<const double> g, double h) override {
    const auto step = strategy_.update(g, std::span<const double>(&h, 1));
    return {step.converged(), step.stalled(), step.inequality_measure, step.equality_measure};
  }

 private:
  Strategy& strategy_;
};

}  // namespace wavebalance::ll10
