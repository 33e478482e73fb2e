#include <algorithm>
#include <cmath>

#include "files/number_text.hpp"
#include "scene/keys/key_tables.hpp"
#include "scene/keys/law_keys.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// The interval of a sweep over `parts`.
auto interval_over(int parts) {
  return [parts](const Scene& scene) {
    const auto [from, to] = sweep_interval(scene.analysis);
    return std::abs(to - from) / parts;
  };
}

SceneValue first_step_by_default(const Scene& scene) {
  return std::min(std::get<double>(SceneValue(interval_over(1000)(scene))), scene.analysis.largest_step);
}

/// A sweep needs its interval; a diagram has one of both.
void add_intervals(std::vector<SceneKey>& keys) {
  const Section over_frequency(keys, "analysis", analysis_part,
                               analysis_is({"frequency_sweep", "bifurcation_diagram"}));
  const Section over_amplitude(keys, "analysis", analysis_part,
                               analysis_is({"amplitude_sweep", "bifurcation_diagram"}));
  const Property one_of_both = derived("none beside an interval of the other kind", 0.0);
  const Property of_frequency = required_with(analysis_is({"frequency_sweep"}));
  const Property of_amplitude = required_with(analysis_is({"amplitude_sweep"}));
  over_frequency(&Analysis::frequency_from, "frequency_from", "Hz", "where the branch or the diagram starts",
                 positive, one_of_both, of_frequency);
  over_frequency(&Analysis::frequency_to, "frequency_to", "Hz", "where it ends, above or below its start",
                 positive, one_of_both, of_frequency);
  over_amplitude(
      &Analysis::amplitude_from, "amplitude_from", "N",
      "where the branch or the diagram starts: a value of forcing.amplitude, with which all loads but static "
      "ones vary in proportion; where that is 0, of the first of forcing.terms that is not static, in its "
      "unit",
      positive, one_of_both, of_amplitude);
  over_amplitude(&Analysis::amplitude_to, "amplitude_to", "N", "where it ends, above or below its start",
                 positive, one_of_both, of_amplitude);
}

void add_sweep(std::vector<SceneKey>& keys) {
  const Section over_frequency(keys, "analysis", analysis_part, analysis_is({"frequency_sweep"}));
  const Section sweep(keys, "analysis", analysis_part, of_sweeps());
  sweep(
      &Analysis::largest_step, "largest_step", "Hz or N",
      "longest step of arc length; in it a change of the displacement by one amplitude, or by the gap where that is less, counts as a 20th of the interval",
      positive, derived("an 80th of the interval", interval_over(80)));
  sweep(&Analysis::first_step, "first_step", "Hz or N", "first step along the branch", positive,
        derived("a 1000th of the interval, or largest_step where that is less", first_step_by_default));
  sweep(&Analysis::max_points, "max_points", "", "the branch is given up after so many",
        within(2, 10'000'000), optional);
  sweep(
      &Analysis::exact, "exact", "",
      "true follows the motions of the structure themselves, by phases of contact, in place of those of the "
      "balance, which gives the first point: folds and other special points have ten digits, and motions the "
      "tolerance 1e-9",
      optional);
  over_frequency(&Analysis::branches, "branches", "",
                 "true also follows the curves that begin at period doublings and at branch points",
                 optional);
  over_frequency(
      &Analysis::isolas, "isolas", "",
      "true also seeks motions that lie on no curve of the sweep, near resonances that the law moves and by "
      "settling from rest and random states, and follows the curves through them, closed ones too",
      optional, only_with(by_balance()));
  over_frequency(
      &Analysis::isola_spacing, "isola_spacing", "Hz",
      "with isolas, the distance of the frequencies at which motions are sought: no more, so that a curve "
      "that is wider has one of them",
      positive, derived("a 20th of the interval", interval_over(20)), only_with(by_balance()));
  over_frequency(
      &Analysis::isola_starts, "isola_starts", "",
      "with isolas, random states, beside that of rest, from which the structure settles at each of these "
      "frequencies",
      within(0, 1'000'000), optional, only_with(by_balance()));
}

/// Contacts move each for itself; many would make a wide table.
SceneValue contact_outputs_by_default(const Scene& scene) {
  const bool sweep = is_sweep(scene.analysis.type);
  constexpr int most = 6;
  const int contacts = contact_count(scene);
  return sweep && scene.contact.law != no_law && contacts > 1 && contacts <= most;
}

/// A number is that of a row or of a bar's node.
void set_outputs(Scene& scene, const SceneValue& value) {
  scene.analysis.outputs.clear();
  const std::string noun = scene.structure.type == StructureType::bar ? "node " : "row ";
  for (const NumberOrText& one : std::get<std::vector<NumberOrText>>(value)) {
    const auto* number = std::get_if<double>(&one);
    scene.analysis.outputs.push_back(number == nullptr ? std::get<std::string>(one)
                                     : *number < 0.0   ? "-" + noun + number_text(-*number)
                                                       : noun + number_text(*number));
  }
}

void places_of_outputs(SceneKey& key) { key.set = set_outputs; }

void add_outputs(std::vector<SceneKey>& keys) {
  const Condition moves = analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep",
                                       "time_stepping", "limit_cycle", "bifurcation_diagram"});
  const Section outputs(keys, "analysis", analysis_part, moves);
  outputs(
      &Analysis::outputs, "outputs", "",
      "places whose motion is written, which pictures and sentences begin with: \"row 7\" or 7 of matrices, with "
      "dof_map \"node 1052 z\", \"node 3\" or 3 of a bar from its clamp on; of each also \"velocity of node 1052 "
      "z\", \"absolute acceleration of node 1052 z in g\", \"relative displacement of row 7 in mm\" and "
      "\"transmissibility of row 7\"; largest and least value, half the peak-to-peak value, rms, mean and harmonics "
      "of each",
      optional, places_of_outputs, only_with(structure_is({"matrices", "bar"})));
  outputs(&Analysis::contact_outputs, "contact_outputs", "",
          "true makes an output of each contact, with its force",
          derived("true of a sweep with 2 to 6 directions of contact", contact_outputs_by_default));
  outputs(&Analysis::output_harmonics, "output_harmonics", "",
          "harmonics of the load whose amplitude and phase are written of each output", within(0, 1000),
          optional);
  const Section sweep(keys, "analysis", analysis_part, of_sweeps());
  sweep(&Analysis::peak_of, "peak_of", "",
        "an output, as \"node 1052 z\", \"row 17\" or \"contact 2\": the peak is then where its vibration is "
        "largest, by half the peak-to-peak value, and not where the displacement towards an obstacle is",
        optional);
}

void add_time_stepping(std::vector<SceneKey>& keys) {
  const Section stepping(keys, "analysis", analysis_part, analysis_is({"time_stepping"}));
  stepping(&Analysis::tolerance, "tolerance", "",
           "relative rms difference of two successive periods to be reached", above(0, 1), optional);
  stepping(&Analysis::recorded_periods, "recorded_periods", "",
           "periods of the load that are recorded behind max_periods where the motion has not repeated, for "
           "statistics, a Poincare section and a spectrum; 0 for none",
           within(0, 100'000), optional);
  const Section settling(keys, "analysis", analysis_part, analysis_is({"time_stepping", "limit_cycle"}));
  settling(
      &Analysis::max_periods, "max_periods", "",
      "given up after so many periods of the load; of a limit cycle so many of the slowest mode from each "
      "start",
      within(1, 100'000'000), optional);
}

void add_diagram(std::vector<SceneKey>& keys) {
  const Section diagram(keys, "analysis", analysis_part, analysis_is({"bifurcation_diagram"}));
  diagram(&Analysis::values, "values", "", "of the frequency or the amplitude, uniform over the interval",
          within(2, 1'000'000), optional);
  diagram(&Analysis::transient_periods, "transient_periods", "",
          "periods of the load at each value before those that are recorded; each value begins where the one "
          "before has ended",
          within(0, 10'000'000), optional);
  diagram(
      &Analysis::section_points, "section_points", "",
      "periods of the load that are recorded at each value, a point of the Poincare section each; motions "
      "of up to a quarter of them are told by their period",
      within(8, 1'000'000), optional);
  diagram(&Analysis::section_tolerance, "section_tolerance", "",
          "distance of two points of the section that count as one, relative to the size of the motion",
          above(0, 1), optional);
  diagram(&Analysis::both_ways, "both_ways", "",
          "true passes the values once more the other way, where hysteresis shows", optional);
  diagram(
      &Analysis::exact_curve, "exact_curve", "",
      "true also follows the exact curve of periodic motions over the interval, which the picture has with "
      "its unstable parts",
      optional);
}

void add_motions(std::vector<SceneKey>& keys) {
  const Section starts(keys, "analysis", analysis_part, analysis_is({"motions", "limit_cycle"}));
  const Section motions(keys, "analysis", analysis_part, analysis_is({"motions"}));
  starts(&Analysis::random_starts, "random_starts", "",
         "random states, beside that of rest, from which the structure settles to a motion",
         within(0, 1'000'000), optional);
  starts(&Analysis::seed, "seed", "", "of the random states: the same seed gives the same ones",
         within(0, 2'147'483'647), optional);
  motions(&Analysis::longest_period, "longest_period", "",
          "periods of the load after which a motion may repeat; one that takes more counts as none",
          within(1, 64), optional);
}

void add_mode(std::vector<SceneKey>& keys) {
  const Section mode(keys, "analysis", analysis_part, analysis_is({"nonlinear_mode"}));
  mode(&Analysis::mode, "mode", "", "the linear mode that the nonlinear one continues", within(1, 10'000'000),
       optional);
  mode(&Analysis::harmonics, "harmonics", "", "harmonics N of the Fourier series in time", within(1, 4096),
       optional);
  mode(&Analysis::samples, "samples", "",
       "uniform times of one period at which contact is enforced, at least 2 x harmonics; with an elastic "
       "law those of its force, and with friction or dampers too",
       within(2, 1 << 16),
       derived("2 x harmonics, 8 x with an elastic law, 32 x with friction or dampers",
               [](const Scene& scene) {
                 const int each = takes_energy(scene.contact) ? 32 : is_rigid(scene.contact.law) ? 2 : 8;
                 return each * scene.analysis.harmonics;
               }));
  mode(&Analysis::cosine_only, "cosine_only", "", "true seeks motions that are even in time only", optional);
  mode(
      &Analysis::reference_length, "reference_length", "m",
      "of laws without a gap, the displacement at which the linear mode has the energy that others are told by",
      not_negative, optional);
  mode(&Analysis::energy_ratio, "energy_ratio", "",
       "the one motion of this energy, over that of the linear mode that just touches; 0 for the curve",
       not_negative, optional);
  mode(&Analysis::largest_energy, "largest_energy", "", "the curve ends beyond this energy ratio", above(1),
       optional);
  mode(&Analysis::last_frequency_ratio, "last_frequency_ratio", "",
       "or beyond this ratio of the frequency to the linear one; 0: it ends by its energy alone",
       not_negative, optional);
  mode(
      &Analysis::points, "points", "",
      "of the curve, uniform in frequency up to last_frequency_ratio, or to 1.3 without one, beyond which they are less dense; about "
      "as many with an elastic law; with friction or dampers about uniform in the logarithm of the amplitude",
      within(2, 1'000'000), optional);
  mode(
      &Analysis::amplitude_ratio, "amplitude_ratio", "",
      "with friction or dampers, the one motion of this amplitude, over that at which a contact first slips, opens or "
      "closes; 0 for the curve",
      not_negative, optional);
  mode(&Analysis::largest_amplitude, "largest_amplitude", "",
       "with friction or dampers, the curve from half that amplitude on ends at this multiple of it",
       above(1), optional);
  const auto losing =
      law_names([](const contact::LawEntry& law) { return law.acts_over_period || law.reads_velocity; });
  for (auto key = keys.end() - 2; key != keys.end(); ++key) key->laws = losing;
}

/// Whether counts take a few times as long as the curve, or less.
SceneValue stability_by_default(const Scene& scene) {
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  const bool sweep = is_sweep(scene.analysis.type);
  if (!sweep && !mode) return true;
  if (mode && (is_rigid(scene.contact.law) || takes_energy(scene.contact))) return true;  // not known
  constexpr int few = 6;
  constexpr int most_unknowns = 400;  // contacts times functions, beyond which a count takes tens of points
  const int contacts = contact_count(scene);
  return contacts <= few || (!mode && contacts * scene.time.functions <= most_unknowns);
}

/// Of one response they cost little beside its stability; along a curve as much as the curve, or more.
SceneValue phases_by_default(const Scene& scene) {
  return scene.analysis.type == AnalysisType::forced_response && !solves_by_phases(scene) &&
         !solves_by_impacts(scene) && scene.contact.law != no_law;
}

SceneValue default_motion_points(const Scene& scene) {
  const bool sweep = is_sweep(scene.analysis.type);
  const bool motion = !sweep || !scene.analysis.motion_at.empty();
  const bool meshed = scene.structure.type == StructureType::blade || !scene.structure.matrices.mesh.empty();
  return std::int64_t{meshed && motion ? 32 : 0};
}

}  // namespace

void add_analysis_keys(std::vector<SceneKey>& keys) {
  const Section analysis(keys, "analysis", analysis_part);
  analysis(&Analysis::type, "type", "", "what is computed", optional);
  analysis(&Analysis::output_points, "output_points", "", "uniform points of one period in response.csv",
           within(2, 1 << 24), optional);
  analysis(
      &Analysis::motion_at, "motion_at", "Hz or N",
      "points of the curve whose motions are written to motion_peak.csv, motion_fold_1.csv, "
      "motion_150Hz.csv, motion_20N.csv and so on: that of the largest displacement, the special points, "
      "and those at frequencies, of an amplitude sweep at amplitudes, solved for there, each time that "
      "the curve passes one; [\"peak\", 150.0] is an example",
      positive, optional, only_with(of_sweeps()));
  analysis(
      &Analysis::motion_points, "motion_points", "",
      "instants of one motion's period at which the whole structure is written: a blade to motion.pvd "
      "for ParaView, matrices to motion.mtx, a column an instant, with a mesh also for ParaView; of a sweep the motions of motion_at",
      within(0, 9999),
      derived("32 for a blade and with a mesh, 0 without and where there is no motion",
              default_motion_points),
      only_with(structure_is({"blade", "matrices"}) &&
                analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "motions",
                             "nonlinear_mode", "limit_cycle"})));
  analysis(
      &Analysis::stability, "stability", "",
      "true counts the Floquet multipliers outside the unit circle, of a motion or of each point of a "
      "curve, and finds the curve's special points",
      derived("true; with more than 6 contacts false for modes, and for curves where contacts times "
              "functions exceed 400",
              stability_by_default),
      only_with(analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "nonlinear_mode"})));
  analysis(
      &Analysis::special_points, "special_points", "",
      "with stability, true locates the special points of a curve, and those of the structure beside it; false "
      "counts multipliers at the points of the curve alone, which of many contacts takes far less time",
      optional, only_with(of_sweeps() && by_balance()));
  analysis(
      &Analysis::phases, "phases", "",
      "true solves for the motion of the structure itself near the response, by phases of contact: its "
      "instants of contact, the errors of the response, and the stability of the structure; of a sweep "
      "errors and stability at every point of its curves, in place of the peak and the special points alone",
      derived("true of a response with contact, false of a sweep", phases_by_default),
      only_with(of_responses() && by_balance()));
  analysis(&Analysis::subharmonic, "subharmonic", "",
           "n seeks motions that repeat after n periods of the load; functions, quadrature_points and "
           "output_points are then those of n periods",
           within(1, 1024), optional,
           only_with(analysis_is({"forced_response", "frequency_sweep"}) && by_balance()));
  add_intervals(keys);
  add_sweep(keys);
  add_outputs(keys);
  add_time_stepping(keys);
  add_diagram(keys);
  add_motions(keys);
  add_mode(keys);
}

void add_plot_keys(std::vector<SceneKey>& keys) {
  const Section plot(keys, "plot", plot_part);
  plot(
      &Plot::log, "log", "",
      "true draws curves over frequency, amplitude, energy or parameters of a study with logarithmic ordinates",
      optional);
}

}  // namespace wavebalance::app
