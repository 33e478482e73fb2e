#pragma once

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Quantity over the frequency: a measure of the contact displacement, or the vibration of an output.
struct OverlayQuantity {
  std::string name;         ///< "max", "min", "max_abs" or "rms", or the output's name
  std::string column;       ///< of sweep.csv
  std::string words;        ///< "Largest displacement"
  std::string unit = "m";   ///< empty of a ratio
  std::string motion = {};  ///< of an output its column in outputs.csv

  bool is_output() const { return !motion.empty(); }
};

/// A curve of displacements over the frequency from the results of a run, one point of a response, or its
/// motion, or the values of a bifurcation diagram whose motions are of one kind.
struct OverlayCurve {
  std::string label;
  /// "frequency_sweep", "amplitude_sweep", "branch", "isola", "nonlinear_mode", "response" or "motion"; of a
  /// diagram "periodic", "quasi_periodic" or "aperiodic".
  std::string kind;
  std::vector<double> frequency;  ///< Hz, or amplitudes of the load: Overlay::axis
  std::vector<double> time;       ///< of a motion, as fractions of its period; empty otherwise
  std::vector<double>
      displacement;              ///< or another quantity, in its unit; NaN where a backbone is interrupted
  std::vector<double> unstable;  ///< Floquet multipliers outside the unit circle; NaN where not known
  std::vector<double> second_frequency = {};  ///< Hz, of quasi-periodic motions; empty of others

  bool of_diagram() const { return kind == "periodic" || kind == "quasi_periodic" || kind == "aperiodic"; }
};

/// The curves of several folders of results, of one structure.
struct Overlay {
  std::vector<OverlayCurve> curves;  ///< motions where all folders hold responses, else none is a motion
  std::vector<std::string> warnings;
  SweepAxis axis;    ///< over which curves are
  double gap = 0.0;  ///< m, of all contacts of all folders; NaN where they differ
  OverlayQuantity quantity;
  bool logarithmic = false;  ///< plot.log of a scene
};

/// Whether motions over their period are laid over each other, and no curves over the frequency.
bool is_over_time(const Overlay& overlay);

/// Reads sweep.csv, backbone.csv, envelope.csv or response.csv of each folder; motions are of the contact
/// with the largest force in the first. The quantity is one of OverlayQuantity::name or by default the
/// first output of the first folder if all have it, else "max". Throws IoError for a folder without results
/// or without that output, and std::invalid_argument for no quantity, and if one is of another structure
/// than the first, which names the key: mass, stiffness and places of contact must agree; damping,
/// reduction, load, law and gap may differ. All curves are over the frequency, or over the amplitude of the
/// load.
Overlay read_overlay(std::span<const std::filesystem::path> folders, const std::string& quantity);

/// All curves in one panel: modes black, sweeps coloured, dashed where unstable, responses as points.
Figure overlay_figure(const Overlay& overlay);

/// curve, kind, frequency_Hz or the amplitude, of motions time_fraction, displacement_m or the output's
/// column, unstable, and with quasi-periodic motions second_frequency_Hz.
Table overlay_table(const Overlay& overlay);

/// The values of envelope.csv in a folder of a bifurcation diagram, with a curve of points each for
/// periodic, quasi-periodic and other motions: of an output half the way between its extremes over all
/// recorded periods. Throws as read_overlay().
std::vector<OverlayCurve> diagram_curves(const std::filesystem::path& folder, const Scene& scene,
                                         const std::string& label, const OverlayQuantity& quantity);

}  // namespace wavebalance::app
