#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "period/period_map.hpp"
#include "wavebalance/solvers/period/first_order_system.hpp"

namespace wavebalance::solvers {

/// The map by the variable-step, variable-order (1..5) backward differentiation of GSL (msbdf) with the
/// analytic Jacobian. Steps do not end at the samples or at the ends of periods: states there are those of
/// the quintic that matches displacement, velocity and acceleration at both ends of a step, and an
/// integration goes on with its steps where a period begins at the state that the last one ended with. The
/// motion of a state is that of FirstOrderSystem, and forces have no part in it. A period begins at t = 0.
class BdfMap final : public PeriodMap {
 public:
  /// `samples` per period. States below step_floor * (largest response without contact) count as that large.
  BdfMap(const LinearStructure& structure, const ContactLaws& laws, double frequency_hz, int samples,
         double step_floor);
  ~BdfMap() override;

  using PeriodMap::state;
  PeriodState state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const override;
  double size(const PeriodState& state) const override { return state.motion.norm(); }
  Period advance(const PeriodState& begin, const StepControl& control) override;
  double operations() const override { return operations_of_step() * double(steps_); }

  /// The operations of a step that is accepted, without the factorizations of the Jacobian.
  double operations_of_step() const { return double(system_.states()) * system_.states(); }
  long steps() const { return steps_; }  ///< accepted so far
  long failed_steps() const;
  /// All degrees of freedom in the last period.
  Motion structure() const;

 private:
  class Integrator;

  void start(const PeriodState& begin, double tolerance);
  bool hides_changes() const;
  std::vector<bool> closed_contacts(const Eigen::VectorXd& state) const;
  Motion contacts() const;

  FirstOrderSystem system_;
  double step_floor_, linear_size_;  // m/s: the largest entry of the state without contact
  Eigen::VectorXd gaps_;
  std::unique_ptr<Integrator> integrator_;
  Eigen::MatrixXd states_;             // 2n x samples, of the last period
  PeriodState end_;                    // of the last period
  double tolerance_ = 0.0;             // of the steps under way
  long steps_ = 0, failed_steps_ = 0;  // the latter of the integrators before
};

}  // namespace wavebalance::solvers
