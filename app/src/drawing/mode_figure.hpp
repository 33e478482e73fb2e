#pragma once
#include <limits>
#include <vector>

#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::app {

/// An output of a mode as pictures draw it.
struct ModeOutput {
  Output output;
  /// Half its peak-to-peak value where contacts begin to act; not a number where that is not known.
  double at_onset = std::numeric_limits<double>::quiet_NaN();
};

/// Frequency over energy from a backbone_table(): accepted points, the root of the generalised Rayleigh
/// quotient, and points on internal resonances as marks. The output that leads comes before it.
Figure backbone_figure(const Scene& scene, const Table& backbone, const ModeOutput* leading = nullptr);

/// Frequency and damping ratio from a damped_table(), over the amplitude or the vibration of the output that
/// leads.
Figure damped_figure(const Scene& scene, const Table& backbone, const ModeOutput* leading = nullptr);

/// Frequency and, where the table has it, damping ratio over the vibration of each output.
Figure outputs_figure(const Scene& scene, const Table& backbone, const std::vector<ModeOutput>& outputs);

/// Draws the stability of a backbone_table(), unstable parts dashed, in each panel of a figure of it, whose
/// first series are frequencies, with the bifurcation and grazing points.
void draw_stability(Figure& figure, const Table& backbone, const solvers::BackboneStability& stability);

}  // namespace wavebalance::app
