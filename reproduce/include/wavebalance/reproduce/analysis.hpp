#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "wavebalance/reproduce/plot.hpp"
#include "wavebalance/reproduce/response.hpp"
#include "wavebalance/reproduce/scene.hpp"
#include "wavebalance/reproduce/table.hpp"
#include "wavebalance/solvers/frequency_sweep.hpp"

namespace wavebalance::reproduce {

/// A curve of responses over the frequency.
struct Sweep {
  solvers::FrequencySweep curve;
  double wall_seconds = 0.0;

  bool converged() const { return curve.status == solvers::SweepStatus::reached_end; }
};

/// The scene's frequency response by arc length. Steps: a change of frequency by 1/20 of the interval and a
/// change of displacement by the gap count alike; analysis.first_step and analysis.largest_step are in Hz of
/// the former.
Sweep frequency_sweep(const Scene& scene, const ProgressObserver& observer = {});

using SummaryValue = std::variant<double, std::int64_t, bool, std::string, std::vector<double>>;
using Summary = std::vector<std::pair<std::string, SummaryValue>>;

/// What an analysis leaves behind: summary.json, response.csv or sweep.csv, and a picture.
struct Record {
  bool converged = false;
  std::string status;
  Summary summary;  ///< in the order in which summary.json holds it; NaN where a value has no meaning
  Table response;   ///< time_fraction, displacement_m, velocity_m_per_s, contact_force_N; empty after a sweep
  Table sweep;      ///< frequency_Hz, max_displacement_m, rms_displacement_m; empty otherwise
  Figure figure;    ///< without panels when there is nothing to draw
};

/// Solves `scene`. A failure to converge is told by the record. Throws std::invalid_argument or
/// solvers::InadmissiblePair for scenes that load_scene() would not have let pass.
Record analyse(const Scene& scene, const ProgressObserver& observer = {});

/// The tables of a record.
Table response_table(const solvers::PeriodSamples& samples);
Table sweep_table(const solvers::FrequencySweep& curve);

/// `summary` as a JSON object in its order; numbers that are not finite become null.
std::string json_text(const Summary& summary);

/// What would be solved, how large it is and whether the pair is admissible, in a few lines of text.
std::string describe_scene(const Scene& scene);

}  // namespace wavebalance::reproduce
