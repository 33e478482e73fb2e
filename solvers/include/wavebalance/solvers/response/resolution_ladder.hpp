#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

enum class LadderStatus {
  converged,      ///< the estimated error meets the tolerance
  size_limit,     ///< the next rung would have more functions or points than allowed
  not_converged,  ///< no response was found on two rungs in a row, neither from the one before nor from
                  ///< afar
  stagnated,      ///< rungs do not come closer any more: rounding, or Newton's tolerance
  cancelled       ///< the observer asked to stop
};

std::string_view to_string(LadderStatus status);

/// One resolution that the ladder climbed. Errors are relative rms of the contact displacement over the
/// period, NaN where they are not known.
struct LadderRung {
  int functions = 0;             ///< M
  int points = 0;                ///< N
  double estimated_error = 0.0;  ///< of this rung; unknown on the first, and where no response was found
  double truncation = 0.0;       ///< share of what M functions cannot represent
  double quadrature = 0.0;  ///< share of the sums over N points: aliasing, instants of contact between points
  double change = 0.0;      ///< distance to the rung before
  double residual = 0.0;    ///< of the response
  int iterations = 0;       ///< Newton iterations
  bool restarted = false;   ///< solved from the contact-free response, not from the rung before
  double seconds = 0.0;     ///< wall time
};

struct LadderOptions {
  double tolerance = 1e-4;  ///< on the relative rms error of the contact displacement
  int first_functions = 7;
  int first_points = 8;
  int max_functions = 1 << 16;
  int max_points = 1 << 17;
  ForcedResponseOptions solver = {};
  /// Called during each solve and after it, then with the estimated error; solver.observer is not used here.
  Observer observer = {};

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// Composes the problem of a resolution, its frequency set. It is asked for M = 2^k (first_functions + 1) - 1
/// functions when first_functions is odd and for 2^k first_functions otherwise, and for 2^j first_points
/// points.
using ProblemFactory = std::function<CondensedProblem(int functions, int points)>;

struct LadderResponse {
  LadderStatus status = LadderStatus::not_converged;
  double estimated_error = 0.0;             ///< relative rms, of the last rung
  std::vector<LadderRung> ladder;           ///< in the order climbed
  PeriodicResponse response;                ///< of the last rung that has one
  std::optional<CondensedProblem> problem;  ///< of that rung
  double seconds = 0.0;                     ///< wall time of the whole ladder

  bool converged() const { return status == LadderStatus::converged; }
};

/// The periodic response to a tolerance: solves a small problem, then finer ones, each from the response
/// before.
///
/// The distance of two rungs is the error of the coarser one. Harmonics beyond its functions are its
/// truncation, the others the share of its points (pairs of Fourier functions; any other pair refines both
/// together). The error of the finer rung follows with orders below those that forces with kinks show - 1.5
/// for the points, at most 3 for the functions and no more than their two highest octaves show - and a factor
/// 1.5. Of contacts that no point sees, or one or two, what a point at their maximum would feel beyond them
/// is added: the force at the vertex of the parabola through three displacements, yielding to itself. What
/// dominates is refined next. It is an estimate, not a bound.
///
/// Problems of fewer than 32 points tell smooth motions from the others: they end the ladder only where the
/// estimate is below a thousandth of the tolerance, are solved without homotopy, and are no start for the
/// next rung unless they lie near one another.
///
/// Newton starts from the response before: its harmonics, or straight between its samples in contact, which a
/// stiff law holds. Where neither leads to a response and sizes in between were left out, these come next;
/// the path of the homotopy is the last resort.
///
/// Where several responses exist the ladder stays on one. A later rung that lies farther from the one before
/// than that did, and by more than 3 %, is solved anew from the contact-free response, and the nearer of the
/// two is kept.
///
/// Throws std::invalid_argument for options out of range and what `make_problem` throws. The cost is near
/// that of the last rung: sizes grow geometrically, and Newton starts near the solution.
LadderResponse response_to_tolerance(const ProblemFactory& make_problem, const ContactLaws& laws,
                                     const LadderOptions& options);

}  // namespace wavebalance::solvers
