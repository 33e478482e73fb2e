#pragma once
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::extremes {

/// What a converged response leaves of the conditions it must meet, computed from its samples at the
/// quadrature points alone and by none of the paths that found it. NaN where a measure does not apply.
struct Residuals {
  /// max over k of |Z(k) a(k) - load(k) + e contact(k)| over the largest sum of the sizes of its terms, the
  /// motion of every degree of freedom and the contact force being those of the record.
  double motion = std::numeric_limits<double>::quiet_NaN();
  /// What rounding each sample to the next double may make of `motion`, four standard deviations: far above
  /// the natural frequencies inertia makes much of it.
  double motion_rounding = 0.0;
  /// Of a law: force outside of what it gives within a billionth of the motion about its displacement, over
  /// the largest force. Of a rigid obstacle the largest of: force below zero over the largest force;
  /// penetration over the largest displacement with or without it; their product.
  double complementarity = std::numeric_limits<double>::quiet_NaN();
  /// Change of displacement and velocity, in the energy norm over their own, over one period of time stepping
  /// from the response at t = 0: the error of the time basis shows here, amplified by the multipliers of the
  /// motion. Not where the period is above a hundred times the passage of a wave through the bar, nor
  /// where the law is above ten thousand times as stiff as an element.
  double periodicity = std::numeric_limits<double>::quiet_NaN();
};

/// The measures of `response`, which holds the full history at scene.time.quadrature_points points. O(n N log
/// N) and, where time stepping applies (a law, continuous trial functions, at most `stepped_elements`),
/// O(steps n^2).
Residuals residuals(const app::Scene& scene, const app::Response& response,
                    int stepped_elements = 30);

/// A response as residuals() wants it.
app::Response solve(app::Scene scene);

enum class Outcome {
  solved,         ///< converged, every sample finite, residuals within their bounds
  error,          ///< an exception that says what is wrong
  not_converged,  ///< the record says so, and why
  wrong           ///< converged by its own word, but a sample is not finite or a residual is beyond its bound
};

std::string to_string(Outcome outcome);

/// One input and what it must lead to.
struct Case {
  std::string group;
  std::string scene;                   ///< file below reproduce/scenes/extremes
  std::vector<std::string> overrides;  ///< "section.key=value"
  Outcome must = Outcome::solved;
  std::string named = {};  ///< words that the error or status must hold
};

struct Verdict {
  Outcome outcome = Outcome::wrong;
  std::string text;  ///< the error, the status, or what is wrong
  Residuals residuals;
  double seconds = 0.0;  ///< of the processor, the checks included
  bool holds = false;    ///< what must happen happened, within most_seconds
};

constexpr double most_seconds = 5.0;
constexpr double largest_motion_residual = 1e-6;  ///< a stiff law's force holds to a millionth at least
constexpr double largest_complementarity = 1e-6;  ///< what rigid responses promise

/// Solves and checks; never throws for what the scene is. `holds` is left false. `stepped_elements` as for
/// residuals().
Verdict judge(const app::Scene& scene, int stepped_elements = 30);
/// The same for a scene file.
Verdict judge(const Case& item, const std::filesystem::path& scenes);

}  // namespace wavebalance::extremes
