#pragma once
#include <optional>

#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/flow/periodic_flow.hpp"

namespace wavebalance::solvers {

/// The exact motion that time integration converges to.
struct ExactAttractor {
  FlowMotion settled;    ///< what was integrated
  int load_periods = 1;  ///< after which the motion repeats
  ExactSolution motion;  ///< of a problem over so many periods
};

/// Where a structure is let go: states of the poles at a time, with contacts that touch nothing.
struct PoleStart {
  double begin = 0.0;  ///< periods
  Eigen::VectorXcd poles;
};

/// The problem over several periods of its load.
ExactProblem over_periods(const ExactProblem& problem, int times);

/// The motion that the structure converges to from contacts at rest or a start, integrate_by_events(), and
/// from there to the tolerance of the exact motion, flow_motion_from(). It is tried once two periods agree
/// to a thousandth; if the motion found is unstable, integration continues. An unstable motion is returned
/// if it converges to none, and the one near the closest return of a period if none is solved to the
/// tolerance or if it has more than eight periods: `settled` describes the attractor. Laws must be state
/// machines: impacts, friction and others together, of structures that may be free to move. Throws as
/// integrate_by_events(), and for options out of range.
ExactAttractor attractor_motion(const ExactProblem& problem, TimeSteppingOptions stepping,
                                const CollocationOptions& options,
                                const std::optional<PoleStart>& start = {});

}  // namespace wavebalance::solvers
