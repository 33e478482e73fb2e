#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What is drawn over the frequency: of the displacement of contacts, or the vibration of an output.
struct OverlayQuantity {
  std::string name;         ///< "max", "min", "max_abs" or "rms", or that of the output
  std::string column;       ///< of sweep.csv
  std::string words;        ///< "Largest displacement"
  std::string unit = "m";   ///< empty of a ratio
  std::string motion = {};  ///< of an output its column in outputs.csv

  bool is_output() const { return !motion.empty(); }
};

/// A curve of displacements over the frequency from the results of a run, one point of a response, or its
/// motion.
struct OverlayCurve {
  std::string label;
  std::string kind;  ///< "frequency_sweep", "branch", "isola", "nonlinear_mode", "response" or "motion"
  std::vector<double> frequency;  ///< Hz
  std::vector<double> time;       ///< of a motion, as fractions of its period; empty otherwise
  std::vector<double>
      displacement;              ///< or another quantity, in its unit; NaN where a backbone is interrupted
  std::vector<double> unstable;  ///< Floquet multipliers outside the unit circle; NaN where not known
};

/// The curves of several folders of results, of one structure.
struct Overlay {
  std::vector<OverlayCurve> curves;  ///< motions where all folders hold responses, else none is a motion
  std::vector<std::string> warnings;
  double gap = 0.0;  ///< m, of all contacts of all folders; NaN where they differ
  OverlayQuantity quantity;
  bool logarithmic = false;  ///< plot.log of a scene
};

/// Whether motions over their period are laid over each other, and no curves over the frequency.
bool is_over_time(const Overlay& overlay);

/// Reads sweep.csv, backbone.csv or response.csv of each folder; motions are of the leading contact
/// in the first. The quantity is one of OverlayQuantity::name or, where none is said, the output that leads
/// in the first folder and that all have, else "max". Throws IoError for a folder without results or without
/// that output, and std::invalid_argument for no quantity, and if one is of another structure than the first,
/// which names the key: mass, stiffness and places of contact must agree; damping, reduction, load, law and
/// gap may differ.
Overlay read_overlay(std::span<const std::filesystem::path> folders, const std::string& quantity);

/// All curves in one panel: modes black, sweeps coloured, dashed where unstable, responses beside curves as
/// points.
Figure overlay_figure(const Overlay& overlay);

/// curve, kind, frequency_Hz, of motions time_fraction, displacement_m or the output's column, unstable.
Table overlay_table(const Overlay& overlay);

}  // namespace wavebalance::app
