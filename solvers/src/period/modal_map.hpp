#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "period/linear_motion.hpp"
#include "period/modal_flow.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// A structure at the start of a period of its load.
struct PeriodState {
  Eigen::VectorXd motion;  ///< of the modes, so scaled that the norm has a meaning
  Eigen::VectorXd force;   ///< C, N, of the contacts
};

/// The errors that steps may have, and the effort after which they end.
struct StepControl {
  double tolerance = 0.0;       ///< of a step, relative to the size of the state
  double max_operations = 0.0;  ///< in one period
  double least_size = 0.0;      ///< which errors are relative to where the state is smaller
};

/// One period of the load.
struct Period {
  bool complete = false;  ///< false where the operations ran out, or the motion grows
  bool grows = false;     ///< to 1e10 times its first size, or that without contact
  PeriodState state;      ///< at its end; only of a complete period
  Motion contacts;        ///< at uniform instants from its start on; only of a complete period
};

/// The map of a structure in contact over a period of its load, state to state with the contacts in
/// between, by exact motions of the modes. Between contacts a step is a fraction of the period. Where
/// contact forces act, the step is halved until its result differs little from the result of its halves,
/// which are then extrapolated [E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential
/// Equations I, 1993, section II.4]; and where a contact opens or closes, until it differs much less. So an
/// impact of any length is resolved, and a force that jumps. Each step is exact for contact forces that are
/// linear in time. The forces at its end are solved for with the resolvents of the laws, so that any law
/// serves, rigid ones too [M. Jean, Comput. Methods Appl. Mech. Eng. 177, 1999], and friction by its return
/// mapping, with its force as memory. A period begins at the load's maximum. The motion of a state is the
/// deviation of the modes from the linear response, in the energy norm. A free structure has no linear
/// response to static loads, which therefore act on the deviation. For one thread at a time.
class ModalMap {
 public:
  /// `laws` are kept by reference. `flow` has the step of a period of the load over `steps`, which are also
  /// the samples.
  ModalMap(const CondensedProblem& problem, const ContactLaws& laws, int steps, ModalFlow flow);

  /// The state of a displacement (n, m) and a velocity (n, m/s), empty for rest, without contact forces.
  PeriodState state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const;
  /// A state with the forces that the laws have there.
  PeriodState balanced(PeriodState state) const;
  /// The norm of the whole motion of a state, to which distances are relative.
  double size(const PeriodState& state) const { return (state.motion + free_state_).norm(); }
  Period advance(const PeriodState& begin, const StepControl& control);
  double operations() const { return operations_; }  ///< of all periods so far

  const LinearMotion& free_motion() const { return free_; }

 private:
  using Ticks = std::int64_t;
  struct Step {
    PeriodState end;
    Eigen::VectorXd displacement;
  };
  const ModalFlow& flow(int level);
  Eigen::VectorXd forces_at(const PeriodState& state, Ticks time, Eigen::VectorXd velocity,
                            Eigen::VectorXd before, const Eigen::VectorXd& begin) const;
  Eigen::VectorXd free_motion(int derivative, Ticks time) const;
  Eigen::VectorXd displacement(const PeriodState& state, Ticks time) const;
  Eigen::VectorXd velocity(const PeriodState& state, Ticks time) const;
  bool is_clear(const Eigen::VectorXd& displacement) const;
  Step single(const PeriodState& begin, Ticks end, int level);
  Step refined(const PeriodState& begin, Ticks start, int level, double allowed, const Step* whole_step);
  void remember(const Step& before, Step& step, Ticks end);

  const ContactLaws& laws_;
  int steps_;
  LinearMotion free_;
  std::vector<ModalFlow> flows_;  // of the steps halved 0, 1, 2, ... times
  Eigen::VectorXd free_state_;
  Eigen::VectorXd clear_below_;  // C, m: no force at or below
  bool depends_on_velocity_, has_memory_;
  double operations_ = 0.0, max_operations_ = 0.0, far_ = 0.0;
};

}  // namespace wavebalance::solvers
