#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wavebalance::app {

/// Analyses, analysis.type.
enum class AnalysisType {
  forced_response,
  frequency_sweep,
  amplitude_sweep,
  time_stepping,
  shooting,
  motions,
  nonlinear_mode,
  limit_cycle,
  bifurcation_diagram
};

/// Method of an analysis: equations of functions or modes, time integration, event-driven collocation, or
/// integration from event to event.
enum class MotionsBy { equations, time, collocation, events };

/// The words and flags in which analyses differ.
struct AnalysisKind {
  AnalysisType type;
  std::string_view name;     ///< analysis.type
  std::string_view heading;  ///< of its page
  MotionsBy motions_by;
  bool under_load;        ///< a load drives it
  bool at_one_frequency;  ///< it needs forcing.frequency
  bool keeps_part;        ///< an interruption leaves what was found so far
  bool any_matrices;      ///< damping and stiffness need no symmetry

  bool is_exact() const { return motions_by == MotionsBy::collocation || motions_by == MotionsBy::events; }
};
inline constexpr std::array<AnalysisKind, 9> analysis_kinds{{
    {AnalysisType::forced_response, "forced_response", "Forced response", MotionsBy::equations, true, true,
     false, true},
    {AnalysisType::frequency_sweep, "frequency_sweep", "Frequency response", MotionsBy::equations, true,
     false, true, true},
    {AnalysisType::amplitude_sweep, "amplitude_sweep", "Response over the amplitude of the load",
     MotionsBy::equations, true, true, true, true},
    {AnalysisType::time_stepping, "time_stepping", "Response by time stepping", MotionsBy::time, true, true,
     false, true},
    {AnalysisType::shooting, "shooting", "Exact periodic solution", MotionsBy::collocation, true, true, false,
     true},
    {AnalysisType::motions, "motions", "Coexisting motions", MotionsBy::collocation, true, true, true, true},
    {AnalysisType::nonlinear_mode, "nonlinear_mode", "Nonlinear mode", MotionsBy::equations, false, false,
     false, false},
    {AnalysisType::limit_cycle, "limit_cycle", "Limit cycle", MotionsBy::events, false, false, false, true},
    {AnalysisType::bifurcation_diagram, "bifurcation_diagram", "Bifurcation diagram", MotionsBy::time, true,
     false, true, true},
}};
const AnalysisKind& kind_of(AnalysisType type);

/// Whether the equation of motion is integrated in time, so that there are no functions.
bool integrates_in_time(AnalysisType type);
/// Whether motions are followed over the frequency or the amplitude of the load.
bool is_sweep(AnalysisType type);

/// The points of a sweep whose motions are written, analysis.motion_at.
struct MotionAt {
  bool peak = false;     ///< the point of the largest displacement
  bool special = false;  ///< the bifurcation and grazing points of the curve
  /// > 0, frequencies (Hz) or amplitudes in the unit of reference_load(): each point at which the curve
  /// passes one of them.
  std::vector<double> places = {};

  bool empty() const { return !peak && !special && places.empty(); }
  bool operator==(const MotionAt&) const = default;
};

/// Least number for batch statistics of time stepping.
inline constexpr int least_recorded_periods = 40;

/// The analysis and the resolution of its output.
struct Analysis {
  AnalysisType type = AnalysisType::forced_response;
  int output_points = 1024;  ///< uniform points of one period in the output

  int motion_points = -1;  ///< instants of the period at which the whole structure's motion is written
  /// forced_response, sweeps: whether the motion of the structure near the response, or near every point of
  /// the curve, has an exact periodic solution
  bool exact_near = false;
  /// sweeps: whether the curve consists of exact periodic solutions
  bool exact = false;
  bool stability = true;  ///< forced_response, frequency_sweep: whether Floquet multipliers are counted
  /// sweeps, with stability: whether the points of the curve between which counts or contacts change are
  /// located
  bool special_points = true;
  /// forced_response, frequency_sweep: periods of the load after which motions repeat. Functions and points
  /// of [time] and output_points then refer to all of them.
  int subharmonic = 1;
  bool branches = false;  ///< frequency_sweep: whether curves that begin at bifurcation points are followed
  /// frequency_sweep: whether to search for motions on no known curve, at frequencies that are at most
  /// isola_spacing (Hz) apart, from rest and isola_starts random states, and their curves followed
  bool isolas = false;
  double isola_spacing = 0.0;
  int isola_starts = 4;

  double frequency_from = 0.0;  ///< Hz, frequency_sweep: where the branch starts
  double frequency_to = 0.0;    ///< Hz, frequency_sweep: where it ends; may lie below frequency_from
  double amplitude_from = 0.0;  ///< amplitude_sweep: the same in the unit of reference_load()
  double amplitude_to = 0.0;
  double first_step = 0.0;    ///< Hz, or the unit of the amplitude: first step along the branch
  double largest_step = 0.0;  ///< the same: no step along the branch is larger
  int max_points = 20000;     ///< frequency_sweep: the branch is given up after so many points
  MotionAt motion_at = {};    ///< frequency_sweep, amplitude_sweep

  std::vector<std::string> outputs = {};  ///< output_words(), such as "velocity of row 3" or "-node 7 z"
  bool contact_outputs = false;           ///< whether each contact is an output, too
  bool has_outputs() const { return !outputs.empty() || contact_outputs; }
  int output_harmonics = 3;  ///< of the load, whose amplitudes and phases are written of each output
  std::string peak_of = {};  ///< sweeps: the output whose vibration is largest at the peak; or empty

  double tolerance = 1e-7;  ///< time_stepping: relative rms difference of two successive periods
  int max_periods = 5000;   ///< time_stepping, limit_cycle: given up after so many periods

  int random_starts = 24;  ///< motions, limit_cycle: random states from which time integration starts
  int seed = 20140817;     ///< of these states
  int longest_period = 4;  ///< motions: periods of the load after which a motion may repeat

  int recorded_periods = 512;   ///< time_stepping: periods recorded where the motion does not repeat; 0: none
  int values = 101;             ///< bifurcation_diagram: of the frequency or the amplitude
  int transient_periods = 200;  ///< bifurcation_diagram: periods of each value before the section
  int section_points = 64;      ///< bifurcation_diagram: of each value, one a period
  double section_tolerance = 1e-4;  ///< bifurcation_diagram: relative distance of points that count as one
  bool both_ways = true;            ///< bifurcation_diagram: whether the values are also passed the other way
  bool exact_curve = true;          ///< bifurcation_diagram: whether the exact curve is drawn, too

  int mode = 1;                   ///< nonlinear_mode: the linear mode that is continued, from 1
  int harmonics = 10;             ///< nonlinear_mode: N of the Fourier series
  int samples = 0;                ///< nonlinear_mode: m >= 2N uniform times at which contact is enforced
  bool cosine_only = false;       ///< nonlinear_mode: motions that are even in time only
  double reference_length = 0.0;  ///< nonlinear_mode: m, instead of the gap of a law that has none; 0: none
  double energy_ratio = 0.0;      ///< nonlinear_mode: the one motion of this energy; 0: the whole curve
  double largest_energy = 10.0;   ///< nonlinear_mode: energy ratio at which the curve ends
  double last_frequency_ratio = 0.0;  ///< nonlinear_mode: or frequency over the linear one; 0: any
  int points = 200;  ///< nonlinear_mode: uniform in frequency up to last_frequency_ratio or 1.3
  /// nonlinear_mode with friction or dampers, of the amplitude over that at which a contact first acts: the
  /// one motion there, 0 for the whole curve; and where the curve ends
  double amplitude_ratio = 0.0, largest_amplitude = 10.0;

  bool operator==(const Analysis&) const = default;
};

/// Whether a sweep or a diagram varies the amplitude of the load, and not the frequency.
bool is_over_amplitude(const Analysis& analysis);
/// Whether one varies the frequency.
bool varies_frequency(const Analysis& analysis);
/// Where the curve of a sweep starts and ends, Hz, or amplitudes of the load.
std::pair<double, double> sweep_interval(const Analysis& analysis);

}  // namespace wavebalance::app
