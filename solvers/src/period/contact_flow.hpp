#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "period/contact_free_motion.hpp"
#include "period/modal_flow.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::solvers {

/// Integrates a structure under its load and the forces of its contacts, one period of the load after the
/// other. Between contacts a step is a share of the period. Where contact forces act, the step is halved
/// until its result differs little from that of its halves, which are then extrapolated [E. Hairer, S. P.
/// Norsett, G. Wanner, Solving Ordinary Differential Equations I, 1993, section II.4]; and where a contact
/// opens or closes, until it differs much less. So an impact of any length is resolved, and a force that
/// jumps. Each step is exact for contact forces that are linear in time. The forces at its end are solved for
/// with the resolvents of the laws, so that any law serves, rigid ones too [M. Jean, Comput. Methods Appl.
/// Mech. Eng. 177, 1999]. For one thread at a time.
class ContactFlow {
 public:
  /// `laws` are kept by reference. `flow` has the step of a period of the load over `steps`.
  ContactFlow(const CondensedProblem& problem, const ContactLaws& laws, int steps, ModalFlow flow);

  /// At the start of a period of the load.
  struct State {
    Eigen::VectorXd deviation;  // from the motion without contact, as a state of the modes
    Eigen::VectorXd force;      // C, N
  };
  State at_rest() const;
  /// With the forces that the laws have there.
  State balanced(State state) const;
  /// Of the whole state, in the energy norm.
  double size(const State& state) const { return (state.deviation + free_state_).norm(); }

  /// One period of the load, and the contacts at the ends of its steps.
  struct Period {
    State end;
    Eigen::MatrixXd displacement, force;  // C x steps, m and N
    bool complete = false;                // false where the operations ran out
  };
  /// With errors of a step up to `tolerance`, relative to the size of the state.
  Period period_from(const State& begin, double tolerance, double max_operations);

  const ContactFreeMotion& free_motion() const { return free_; }
  double operations() const { return operations_; }  ///< of all periods so far

 private:
  using Ticks = std::int64_t;
  struct Step {
    State end;
    Eigen::VectorXd displacement;
  };
  const ModalFlow& flow(int level);
  Eigen::VectorXd free_displacement(Ticks time) const;
  Eigen::VectorXd free_velocity(Ticks time) const;
  bool is_clear(const Eigen::VectorXd& displacement) const;
  Step single(const State& begin, Ticks end, int level);
  Step refined(const State& begin, Ticks start, int level, double allowed, const Step* whole_step);

  const ContactLaws& laws_;
  int steps_;
  ContactFreeMotion free_;
  std::vector<ModalFlow> flows_;  // of the steps halved 0, 1, 2, ... times
  Eigen::VectorXd free_state_;
  Eigen::VectorXd clear_below_;  // C, m: no force at or below
  bool depends_on_velocity_;
  double operations_ = 0.0, max_operations_ = 0.0;
};

}  // namespace wavebalance::solvers
