#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What of the displacement is drawn over the frequency.
enum class OverlayQuantity { max, min, max_abs, rms };

/// "max", "min", "max_abs" or "rms"; throws std::invalid_argument for another name.
OverlayQuantity overlay_quantity(const std::string& name);

/// A curve of displacements over the frequency from the results of a run, one point of a response, or its
/// motion.
struct OverlayCurve {
  std::string label;
  std::string kind;  ///< "frequency_sweep", "branch", "isola", "nonlinear_mode", "response" or "motion"
  std::vector<double> frequency;     ///< Hz
  std::vector<double> time;          ///< of a motion, as fractions of its period; empty otherwise
  std::vector<double> displacement;  ///< m; NaN where a backbone is interrupted
  std::vector<double> unstable;      ///< Floquet multipliers outside the unit circle; NaN where not known
};

/// The curves of several folders of results, of one structure.
struct Overlay {
  std::vector<OverlayCurve> curves;  ///< motions where all folders hold responses, else none is a motion
  std::vector<std::string> warnings;
  double gap = 0.0;  ///< m, of all contacts of all folders; NaN where they differ
};

/// Whether motions over their period are laid over each other, and no curves over the frequency.
bool is_over_time(const Overlay& overlay);

/// Reads sweep.csv, backbone.csv or response.csv of each folder; motions are of the leading contact
/// in the first. Throws IoError for a folder without results,
/// and std::invalid_argument if one is of another structure than the first, which names the key: mass,
/// stiffness and places of contact must agree; damping, reduction, load, law and gap may differ.
Overlay read_overlay(std::span<const std::filesystem::path> folders, OverlayQuantity quantity);

/// All curves in one panel: modes black, sweeps coloured, dashed where unstable, responses beside curves as
/// points.
Figure overlay_figure(const Overlay& overlay, OverlayQuantity quantity);

/// curve, kind, frequency_Hz, of motions time_fraction, displacement_m, unstable.
Table overlay_table(const Overlay& overlay);

}  // namespace wavebalance::app
