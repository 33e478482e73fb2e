#pragma once
#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "period_oracle/shooting_modes.hpp"
#include "period_oracle/shooting_step_table.hpp"
#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::oracle {

/// The period map of the structure in contact. Steps have the lengths T / (base_steps 2^level); a step is
/// halved while the polynomial of the contact force misses the law at its ends by too much, so that steps
/// shrink about the instants where contact starts and ends. Tables are made once per level. Not to be shared
/// between threads.
class ContactPropagator {
 public:
  /// Called at the start of every step of the coarsest level, with its number and the state there.
  using Recorder = std::function<void(int step, const Eigen::VectorXd& state)>;

  ContactPropagator(ModalStructure modes, solvers::AnyContactLaw law, double load_scale, int base_steps,
                    double tolerance);

  /// Takes state (2n) over one period from t = 0; multiplies sensitivity
  /// (2n x columns), unless null, by the derivative of the period map. False when a step of the finest level
  /// is not accurate enough.
  bool propagate_period(Eigen::VectorXd& state, Eigen::MatrixXd* sensitivity, int coarsest_level = 0,
                        const Recorder& recorder = {});

  const ModalStructure& modes() const { return modes_; }
  int base_steps() const { return base_steps_; }
  long steps() const { return steps_; }  ///< accepted so far

 private:
  struct Attempt {
    bool accepted = false;
    Eigen::VectorXd state;
    StepTable::NodeVector force, tangent;
  };

  const StepTable& table(int level);
  double linear_contact(double periods) const;
  void attempt_step(const StepTable& step, double begin, double length, const Eigen::VectorXd& state);
  bool solve_nodes(const StepTable& step, StepTable::NodeVector& displacement, double begin_force);
  void propagate_sensitivity(const StepTable& step, Eigen::MatrixXd& sensitivity) const;

  ModalStructure modes_;
  solvers::AnyContactLaw law_;
  double load_scale_;
  int base_steps_;
  double tolerance_;
  Eigen::VectorXcd linear_contact_;  // m, of the contact without its force, by harmonics
  std::vector<StepTable> tables_;    // by level
  Attempt attempt_;
  long steps_ = 0;
};

}  // namespace wavebalance::oracle
