#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"

namespace wavebalance::app {

/// One of the curves of a sweep as pictures draw it.
struct SweepLine {
  std::string name;       ///< "branch 1", "isola 1"; empty of the curve of the sweep itself
  std::string long_name;  ///< "branch 1, 2 periods"
  const solvers::FrequencySweep& curve;
  StabilityAlong stability;
  const std::vector<solvers::SpecialPoint>& special_points;
  const std::vector<MeasuredPoint>* measured;  ///< of its outputs; null where there are none
  Colour colour;

  bool is_unstable() const;
  /// Half the peak-to-peak value at each point, or the rms without the mean, of an output or else of the
  /// contacts.
  std::vector<double> vibration(std::optional<std::size_t> output, bool rms = false) const;
  /// The amplitude of harmonic `n` of the load, from 1, of an output at each point.
  std::vector<double> harmonic(std::size_t output, int n) const;
  /// `values` at its points, times `factor`, over its frequencies or amplitudes.
  Series series(const std::string& label, const std::vector<double>& values, double factor) const;
  /// Its bifurcation and grazing points at the ordinates that `height` has for them.
  std::vector<PlacedPoint> placed(const std::function<double(const solvers::SpecialPoint&)>& height) const;
};

/// The curve of a sweep, its branches and its isolas, which `sweep` and `outputs` hold.
std::vector<SweepLine> lines_of(const Sweep& sweep, const SweepOutputs& outputs = {});

}  // namespace wavebalance::app
