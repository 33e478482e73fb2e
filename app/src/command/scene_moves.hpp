#pragma once

#include "command/commands.hpp"

/// Changes of a scene that may lead on where it was not solved. Each is made for the scene that is given,
/// or is none where it cannot help there; next_steps() checks whether the rules of scenes accept it.
namespace wavebalance::app::moves {

using Move = std::function<std::optional<NextStep>(const Scene&)>;

/// The same for every scene.
Move always(const std::string& words, const SceneChange& change = {});

/// "`words` key": a number of the scene times `factor`, `most` at most. None where the scene has no such
/// number, a list of them, or 0.0.
Move scaled(const std::string& words, const std::string& key, double factor,
            double most = std::numeric_limits<double>::infinity());

// Remedies for harmonic or wavelet balance.
std::optional<NextStep> more_functions(const Scene& scene);
std::optional<NextStep> odd_functions(const Scene& scene);
std::optional<NextStep> more_points(const Scene& scene);
std::optional<NextStep> tolerance_in_place(const Scene& scene);
std::optional<NextStep> sizes_in_place(const Scene& scene);
std::optional<NextStep> dropped_nyquist(const Scene& scene);

// Remedies that change the analysis or its method.
std::optional<NextStep> balance(const Scene& scene);
std::optional<NextStep> response(const Scene& scene);
std::optional<NextStep> response_of_periods(const Scene& scene);

// Remedies that change structure, load or contact.
std::optional<NextStep> more_damping(const Scene& scene);
std::optional<NextStep> fewer_modes(const Scene& scene);
std::optional<NextStep> elastic_friction(const Scene& scene);
std::optional<NextStep> damping_depth(const Scene& scene);
std::optional<NextStep> no_rebound(const Scene& scene);
std::optional<NextStep> more_rebound(const Scene& scene);
std::optional<NextStep> stiff_law(const Scene& scene);

// Remedies for curves.
std::optional<NextStep> reversed(const Scene& scene);
std::optional<NextStep> other_start(const Scene& scene);
std::optional<NextStep> exact_curve(const Scene& scene);
std::optional<NextStep> curve_of_balance(const Scene& scene);
std::optional<NextStep> smaller_step(const Scene& scene);

// Remedies for modes, time stepping and the search for motions.
std::optional<NextStep> samples_of_harmonics(const Scene& scene);
std::optional<NextStep> more_harmonics(const Scene& scene);
std::optional<NextStep> more_starts(const Scene& scene);

}  // namespace wavebalance::app::moves
