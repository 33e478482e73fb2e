#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {

/// A solution of a curve that was traced with keep_unknowns: one of its points or bifurcation and grazing
/// points.
struct CurvePlace {
  double value = 0.0;                                     ///< of the curve's parameter, Hz or a load scale
  std::reference_wrapper<const Eigen::VectorXd> unknown;  ///< PeriodicResponse::unknown there
};

/// The motion of the structure near a solution of a curve.
struct ExactAtPoint {
  ExactStatus status = ExactStatus::not_found;
  double displacement_error = missing, force_error = missing;  ///< as of ExactNearResponse
  /// Stability of the exact motion, with ExactAlongOptions::stability and if it has converged.
  std::optional<MotionStability> stability{};
  std::size_t place = 0;  ///< which of the solutions that were tried it is near to
  /// The motion itself at ExactAlongOptions::kept, where it was found.
  std::optional<ExactSolution> motion{};
};

/// Results along a curve, and number of threads.
struct ExactAlongOptions {
  CollocationOptions exact{};
  /// Largest ExactNearResponse::displacement_error. A motion farther away is another one, and none is near.
  double max_distance = 0.1;
  bool stability = true;              ///< of the motions found
  std::optional<std::size_t> kept{};  ///< the entry of which the motion is kept, too
  int threads = 1;                    ///< that process the solutions one by one; 0: one per core
  Observer observer{};                ///< called only by the caller's thread

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// ContactProblem::exact_near() of a response, with the status not_found where the motion found is farther
/// away than options.max_distance.
std::optional<ExactNearResponse> exact_near(ContactProblem& problem, const PeriodicResponse& response,
                                            const ExactAlongOptions& options = {});

/// The motions of the structure near solutions of a curve.
struct ExactAlongCurve {
  std::vector<std::optional<ExactAtPoint>> points;  ///< one for each entry; empty where it was stopped before
  bool cancelled = false;                           ///< the observer returned false
};

/// Makes the problem on which a curve was traced, once for each thread.
using ProblemMaker = std::function<ContactProblem()>;

/// exact_near() along a curve: for each entry of `places`, none of them empty, near the first of its
/// solutions that has an exact motion nearby, or else the first. The folds of exact and balance curves
/// differ slightly, so at a fold frequency only one of both has a motion: neighbouring solutions show
/// whether there is one at all. Entries are independent: neither their order nor the threads change a
/// digit. Without points where the structure has no modes to compute. Throws std::invalid_argument for
/// options out of range, and as ContactProblem::response() does. A condensation and a exact_near_response()
/// for each solution tried, and with stability a motion_stability().
ExactAlongCurve exact_along(const ProblemMaker& make, const FrequencySweep& curve,
                            const std::vector<std::vector<CurvePlace>>& places,
                            const ExactAlongOptions& options = {});

}  // namespace wavebalance::solvers
