#pragma once

#include "command/commands.hpp"

/// Changes of a scene that may lead on where it was not solved. Each is made for the scene that is given,
/// or is none where it cannot help there; next_steps() checks whether the rules of scenes accept it.
namespace wavebalance::app::moves {

using Change = std::optional<NextStep>(const Scene&);
using Move = std::function<Change>;

/// The same for every scene.
Move always(const std::string& words, const SceneChange& change = {});

/// "`words` key": a number of the scene times `factor`, `most` at most. None where the scene has no such
/// number, a list of them, or 0.0.
Move scaled(const std::string& words, const std::string& key, double factor,
            double most = std::numeric_limits<double>::infinity());

// Remedies for harmonic or wavelet balance.
Change more_functions, odd_functions, more_points, tolerance_in_place, sizes_in_place, dropped_nyquist;

// Remedies that change the analysis or its method.
Change balance, response, response_of_periods;

// Remedies that change structure, load or contact.
Change more_damping, fewer_modes, elastic_friction, damping_depth, no_rebound, more_rebound, stiff_law;

// Remedies for curves.
Change reversed, other_start, exact_curve, curve_of_balance, smaller_step;

// Remedies for modes, time stepping and the search for motions.
Change samples_of_harmonics, more_harmonics, more_starts;

}  // namespace wavebalance::app::moves
