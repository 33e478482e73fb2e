#pragma once
#include <string>
#include <vector>

#include "jl14.hpp"
#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::jl14 {

/// The frequency response of one scene with some pairs, and of the same without contact.
struct Resonance {
  std::vector<Pair> pairs;
  std::vector<app::Sweep> sweeps;  ///< one per pair, the first with its stability
  app::Sweep free;
  double gap = 0.0;   ///< m
  int functions = 0;  ///< of every pair
};

/// Follows the response of the scene `file`; a curve that ends early is noted in the artefact.
Resonance swept(report::Artefact& artefact, const std::string& file, const std::vector<Pair>& pairs,
                const std::vector<std::string>& overrides = {});
/// Fourier:Fourier with 63 functions, 31 full harmonics, and steps of 1 Hz at most.
app::Sweep swept_with_full_harmonics(report::Artefact& artefact, const std::string& file);
/// Choices of the continuation that the paper leaves open, and the Nyquist coefficient of its 64 functions.
struct SweepReading {
  double largest_step = 0.0;  ///< Hz
  bool keeps_nyquist = true;

  std::string name() const;  ///< "steps up to 2 Hz, Nyquist coefficient kept"
};
/// The first is used by the scene.
std::vector<SweepReading> sweep_readings(const app::Scene& scene);
/// The scene's curves of all pairs under a reading, without stability.
std::vector<app::Sweep> swept_under(report::Artefact& artefact, const std::string& file,
                                    const SweepReading& reading);
/// turning_points_text() of a curve that passes the interval; else where it was left.
std::string end_text(const app::Sweep& sweep);

/// Notes where the scene's sweep meets resonances of the discretisation itself (see nyquist_resonances()).
void note_nyquist_resonances(report::Artefact& artefact, const std::string& file);
/// Adds the curve of a sweep of Fourier:Fourier in mm over Hz, dashed where it is unstable.
void add_stable_sweep(app::Panel& panel, const app::Sweep& sweep);

/// The point of the largest displacement.
solvers::SweepPoint peak(const app::Sweep& sweep);
/// "1337.73 Hz and 1315.01 Hz"
std::string turning_points_text(const app::Sweep& sweep);
/// Largest distance between turning points of two curves, Hz; NaN where their numbers differ or one ends
/// early.
double turning_points_distance(const app::Sweep& sweep, const app::Sweep& other);

/// Where the motions of a sweep are unstable, "from the fold at 1337.7 Hz to the fold at 1315 Hz"; "nowhere";
/// or "not known".
std::string unstable_text(const app::Sweep& sweep);

/// A panel with the linear response, broad, and the gap, and with its legend at the side.
app::Panel sweep_panel(const std::string& title, const Resonance& resonance);
/// max |u| over the frequency, mm over Hz.
Series modulus_curve(const std::string& label, const app::Sweep& sweep);
/// Every `every`-th point of a pair's curve from `first` on, in the colour and with the symbol of the pair.
void add_points(app::Panel& panel, const Pair& pair, const std::string& label, const app::Sweep& sweep,
                int first, int every);
/// The bifurcation and grazing points of a sweep with its stability.
void add_special_points(app::Panel& panel, const app::Sweep& sweep);

/// Columns trial, weight, frequency_Hz, max_displacement_m, rms_displacement_m, max_abs_displacement_m,
/// unstable (multipliers outside the unit circle, missing where it was not counted), functions; of all pairs.
Table sweeps_table(const Resonance& resonance);
/// Adds the rows of one more curve.
void append_sweep(Table& table, const Pair& pair, int functions, const app::Sweep& sweep);
/// The turning points of a sweep, as rows of that table: its stability need not be known.
void append_turning_points(Table& table, const std::string& curve, const app::Sweep& sweep);
/// Adds the bifurcation and grazing points of a sweep: curve, type, frequency_Hz, max_displacement_m.
Table special_points_table();
void append_special_points(Table& table, const std::string& curve, const app::Sweep& sweep);

}  // namespace wavebalance::jl14
