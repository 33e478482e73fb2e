#pragma once
#include <string>
#include <vector>

#include "jl14.hpp"
#include "wavebalance/app/analysis/analysis.hpp"

namespace wavebalance::jl14 {

/// The frequency response of one scene with some pairs, and of the same without contact.
struct Resonance {
  std::vector<Pair> pairs;
  std::vector<app::Sweep> sweeps;  ///< one per pair
  app::Sweep free;
  double gap = 0.0;  ///< m
};

/// Follows the response of the scene `file`; a curve that ends early is noted in the artefact.
Resonance swept(report::Artefact& artefact, const std::string& file, const std::vector<Pair>& pairs);
/// Fourier:Fourier with 63 functions, 31 full harmonics, and steps of 1 Hz at most.
app::Sweep swept_with_full_harmonics(report::Artefact& artefact, const std::string& file);
/// Notes where the scene's sweep meets resonances of the discretisation itself (see nyquist_resonances()),
/// which `full` does not have.
void note_nyquist_resonances(report::Artefact& artefact, const std::string& file, const app::Sweep& full);
/// All turning points of the scene's curve with a pair, those of small returns included, as "6 at 1315.034 to
/// 1338.035 Hz" and the status if the curve ends early. Every grazing point is solved for.
std::string all_turning_points_text(report::Artefact& artefact, const std::string& file, const Pair& pair);
/// The curve of a sweep in mm over Hz.
Series sweep_series(const std::string& label, const app::Sweep& sweep);

/// The point of the largest displacement.
solvers::SweepPoint peak(const app::Sweep& sweep);
/// "1337.73 Hz and 1315.01 Hz"
std::string turning_points_text(const app::Sweep& sweep);
/// Largest distance of a turning point from that of the first sweep, Hz; NaN where their numbers differ.
double turning_points_spread(const std::vector<app::Sweep>& sweeps);

/// One panel: the pairs' curves, the response without contact dashed, turning points of the first pair, the
/// gap.
app::Panel sweep_panel(const std::string& title, const Resonance& resonance);

/// Columns trial, weight, frequency_Hz, max_displacement_m, rms_displacement_m of all pairs.
Table sweeps_table(const Resonance& resonance);

}  // namespace wavebalance::jl14
