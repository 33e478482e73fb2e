#pragma once
#include <cstddef>
#include <vector>

#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"

namespace wavebalance::app {

/// The outputs along a nonlinear mode.
struct ModeOutputs {
  std::vector<Output> outputs;
  std::vector<MeasuredPoint> points;  ///< of each row of the mode's table; empty where there is no motion
  bool cancelled = false;             ///< the observer stopped it before the last point

  bool empty() const { return outputs.empty(); }
};

/// Measures the outputs of the scene at each point of its mode, with what sweeps measure. Nothing without
/// outputs. With friction or dampers a condensation for each point. The points of a curve that was
/// interrupted are solutions, and all of them are measured.
ModeOutputs measure_outputs(const ModeStudy& study, const Backbone& curve);
ModeOutputs measure_outputs(const DampedStudy& study, const solvers::DampedBackbone& curve,
                            const Observer& observer = {});

}  // namespace wavebalance::app
