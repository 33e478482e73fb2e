#pragma once
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::extremes {

/// By how much a converged response violates the conditions that it must meet, computed from its samples at
/// the quadrature points, apart from the solver. NaN where a measure does not apply.
struct Residuals {
  /// max over k of |Z(k) a(k) - load(k) + e contact(k)| over the largest sum of the sizes of its terms, the
  /// motion of every degree of freedom and the contact force being those of the record.
  double motion = std::numeric_limits<double>::quiet_NaN();
  /// The part of `motion` that rounding of the samples explains, as four standard deviations. Far above the
  /// natural frequencies inertia amplifies it.
  double motion_rounding = 0.0;
  /// With a law: the distance of the force from the forces that the law gives within a billionth of the
  /// motion about the displacement, over the largest force. With a rigid obstacle: the largest of negative
  /// force over the largest force, of penetration over the largest displacement with or without the obstacle,
  /// and of their product. In the force form both hold at w = v - f / epsilon; that v - u is f / epsilon for
  /// all weighting functions, relative to the motion, counts too.
  double complementarity = std::numeric_limits<double>::quiet_NaN();
  /// Relative change of displacement and velocity, in the energy norm, over one period of time stepping from
  /// the response at t = 0. It shows the error of the time basis, amplified by the multipliers of the motion.
  /// It is left out where the period is longer than a hundred passages of a wave through the bar, and where
  /// the law is more than ten thousand times as stiff as an element.
  double periodicity = std::numeric_limits<double>::quiet_NaN();
};

/// The measures of `response`, which holds the full history at scene.time.quadrature_points points. O(n N log
/// N) and, where time stepping applies (a law, continuous trial functions, at most `stepped_elements`),
/// O(steps n^2).
Residuals residuals(const app::Scene& scene, const app::Response& response, int stepped_elements = 30);

/// The response with the full history at the quadrature points, as residuals() needs it.
app::Response solve(app::Scene scene);

enum class Outcome {
  solved,         ///< converged, every sample finite, residuals within their bounds
  error,          ///< an exception that says what is wrong
  not_converged,  ///< the record says so, and why
  wrong           ///< reported as converged, but a sample is not finite or a residual is beyond its bound
};

std::string to_string(Outcome outcome);

/// One input and what it must lead to.
struct Case {
  std::string group;
  std::string scene;                   ///< file below reproduce/scenes/extremes
  std::vector<std::string> overrides;  ///< "section.key=value"
  Outcome must = Outcome::solved;
  std::string named = {};      ///< words that the error or status must hold
  bool may_be_solved = false;  ///< where rounding decides: solved with all conditions met is right, too
};

struct CheckResult {
  Outcome outcome = Outcome::wrong;
  std::string text;  ///< the error, the status, or the condition that is violated; empty if solved
  Residuals residuals;
  double seconds = 0.0;  ///< of the processor, the checks included
};

/// True if the input led to what it must: a solved response whose conditions all hold, or an error or status
/// whose text holds the words of `item.named`, or either where it may be solved. Throws std::invalid_argument
/// if an error or status is due and no words are given, because any text would hold them.
bool led_to_what_it_must(const Case& item, const CheckResult& result);

constexpr double largest_motion_residual = 1e-6;  ///< a stiff law's force holds to a millionth at least
constexpr double largest_complementarity = 1e-6;  ///< what rigid responses promise

/// Solves `scene` and checks the response; what goes wrong is in the result, and nothing is thrown.
/// `stepped_elements` as for residuals().
CheckResult check_residuals(const app::Scene& scene, int stepped_elements = 30);
/// The same for a scene file.
CheckResult check_residuals(const Case& item, const std::filesystem::path& scenes);

}  // namespace wavebalance::extremes
