#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/compare/error_measure.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// The cheapest converged weighted residual with at most this error, of those whose next size, if it was
/// solved, has converged with at most this error too: a single size may be close to the reference by chance.
/// Where there is none of these, the cheapest of all. Times differ by a tenth from run to run, so that within
/// a tenth the one of the same pair with the fewest functions is taken.
std::optional<SolvePoint> cheapest(const std::vector<SolvePoint>& points, double error);
/// Whether the next size of its series, with twice the functions and points, keeps to the error, or is none.
bool is_steady(const SolvePoint& point, const std::vector<SolvePoint>& points, double error);

/// How the cheapest choice of an error compares with Fourier functions on both sides.
enum class BasisMatters {
  no_choice,      ///< no pair reaches the error
  little,         ///< Fourier:Fourier is the choice, or at most twice its time gives it 1.5 times the error
  much,           ///< Fourier:Fourier takes more than twice its time
  fourier_fails,  ///< Fourier:Fourier does not reach the error
  not_compared    ///< Fourier:Fourier is not among the pairs
};

std::string_view to_string(BasisMatters value);

/// The recommendation for one requested error.
struct Recommendation {
  double error = 0.0;                                 ///< relative rms
  ErrorMeasure measure = ErrorMeasure::displacement;  ///< of what
  /// The cheapest solve, or Fourier:Fourier if at most a tenth slower; empty if no pair reaches the error.
  std::optional<SolvePoint> choice;
  std::optional<SolvePoint> fourier;  ///< the cheapest of Fourier:Fourier
  /// The cheapest of all other pairs, if the choice is Fourier:Fourier; or one with at most twice the time
  /// and 1.5 times the error of the choice, if that is faster.
  std::optional<SolvePoint> runner_up;
  /// One with at most half the time and 1.5 times the error of the choice.
  std::optional<SolvePoint> near_miss;
  /// Fourier:Fourier with at most twice the time and 1.5 times the error of the choice.
  std::optional<SolvePoint> fourier_near_miss;
  /// The fastest exact solution, if it is faster than the choice, or no pair reaches the error.
  std::optional<SolvePoint> phases;
  BasisMatters matters = BasisMatters::no_choice;
  std::string sentences;   ///< two, and one on the exact solution where it is faster
  std::string time_table;  ///< "[time]\ntrial = ...": to be pasted into a scene; empty without a choice
  std::string stability;   ///< of the choice's motion; empty where it was not computed

  /// Time of Fourier:Fourier over the time of the choice; NaN without one of them.
  double fourier_time_ratio() const;
};

/// Largest fraction of a requested error that the reference may have.
inline constexpr double known_share = 0.25;

/// The recommendation from points whose errors are relative to a reference with a known error. If that is
/// above a quarter of `error`, no pair is known to reach it. `time` holds the common settings of all
/// points, `measure` the meaning of SolvePoint::error.
Recommendation recommend(const std::vector<SolvePoint>& points, double error, double reference_error,
                         const Time& time, ErrorMeasure measure = ErrorMeasure::displacement);

}  // namespace wavebalance::app
