#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

/// How a refinement ended.
enum class RefinementStatus {
  converged,      ///< the estimated error meets the tolerance
  size_limit,     ///< the next level would have more functions or points than allowed
  not_converged,  ///< two levels in a row have no response, neither from the previous one nor from the
                  ///< linear response
  stagnated,      ///< levels do not come closer any more: rounding, or Newton's tolerance
  cancelled       ///< the observer returned false
};

std::string_view to_string(RefinementStatus status);

/// One resolution of a refinement. Errors are relative rms of the contact displacement over the period, NaN
/// where they are not known.
struct RefinementLevel {
  int functions = 0;             ///< M
  int points = 0;                ///< N
  double estimated_error = 0.0;  ///< NaN on the first level, and where no response was found
  double truncation = 0.0;       ///< the part that M functions cannot represent
  double quadrature = 0.0;       ///< the part from N points: aliasing, contact that starts between points
  double change = 0.0;           ///< distance to the previous level's response
  double residual = 0.0;         ///< relative residual of the response
  int iterations = 0;            ///< Newton iterations
  bool restarted = false;        ///< solved from the linear response, not from the previous level
  double seconds = 0.0;          ///< wall time
};

/// When a refinement ends, and where it starts.
struct RefinementOptions {
  double tolerance = 1e-4;  ///< on the relative rms error of the contact displacement
  int first_functions = 7;  ///< M of the first level
  int first_points = 8;     ///< N of the first level, at least first_functions
  int max_functions = 1 << 16;
  int max_points = 1 << 17;
  ForcedResponseOptions solver = {};  ///< each level's solver
  /// Called during each solve and after it, then with the estimated error; solver.observer is not used here.
  Observer observer = {};

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// Composes the problem of a resolution, its frequency set. It is called with M = 2^k (first_functions + 1) -
/// 1 functions when first_functions is odd and with 2^k first_functions otherwise, and with 2^j first_points
/// points.
using ProblemFactory = std::function<CondensedProblem(int functions, int points)>;

/// Result of a refinement.
struct RefinementResult {
  RefinementStatus status = RefinementStatus::not_converged;
  double estimated_error = 0.0;             ///< relative rms, of the last level
  std::vector<RefinementLevel> levels;      ///< in the order solved
  PeriodicResponse response;                ///< the last response found
  std::optional<CondensedProblem> problem;  ///< its problem
  double seconds = 0.0;                     ///< wall time of all levels

  bool converged() const { return status == RefinementStatus::converged; }
};

/// The periodic response to a tolerance: solves a small problem, then finer ones, each from the previous
/// response.
///
/// The distance of two levels estimates the error of the coarser one, as in Richardson extrapolation [Hairer,
/// Norsett, Wanner 1993, section II.4]. Harmonics above its highest are its truncation, the others its
/// quadrature error (pairs of Fourier functions; any other pair refines both together). The error of the
/// finer level follows from an assumed order, a factor 1.5 included:
///
///   quantity    order assumed                                 order observed where forces have kinks
///   points      1.5                                           2
///   functions   at most 3, and at most what the two highest   3.5
///               octaves of the level's harmonics show
///
/// The orders, the factor, and the following correction are this library's own; the tests compare the
/// estimate with the true error. A contact between the points is not in the distance. Where no point touches,
/// or only one or two do, the force at the maximum of the parabola through three samples is added, with the
/// compliance it acts on. The larger part of the error is reduced next. The result is an estimate, not a
/// bound.
///
/// Levels of fewer than 32 points screen for smooth motions. They end the refinement only if the estimate is
/// below a thousandth of the tolerance, they are solved without homotopy, and the next level starts from them
/// only if they are close to each other.
///
/// Newton starts from the previous response. Its prolongation is by harmonics or, where a stiff law holds the
/// samples in contact, linear between those. When neither converges and sizes in between were left out, these
/// are solved next; the path of the homotopy is the last resort.
///
/// Where several responses exist the refinement keeps to one. If the change of a later level exceeds the
/// previous one and 3 %, the level is solved anew from the linear response, and the nearer of the two
/// responses is kept.
///
/// Throws std::invalid_argument for options out of range and the exceptions of `make_problem`. The cost is
/// near the cost of the last level: sizes grow geometrically, and Newton starts near the solution.
RefinementResult response_to_tolerance(const ProblemFactory& make_problem, const ContactLaws& laws,
                                       const RefinementOptions& options);

}  // namespace wavebalance::solvers
