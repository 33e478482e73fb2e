
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
  over_amplitude(&Analysis::amplitude_from, "amplitude_from", "N",
                 "where the branch or the diagram starts: a value of forcing.amplitude, or, if that is 0, "
                 "of the first non-static term of forcing.terms, in its unit; all non-static loads vary "
                 "in proportion",
                 positive, one_of_both, of_amplitude);
  over_amplitude(&Analysis::amplitude_to, "amplitude_to", "N", "where it ends, above or below its start",
                 positive, one_of_both, of_amplitude);
}

void add_sweep(std::vector<SceneKey>& keys) {
  const Section over_frequency(keys, "analysis", analysis_part, analysis_is({"frequency_sweep"}));
  const Section sweep(keys, "analysis", analysis_part, of_sweeps());
  sweep(&Analysis::largest_step, "largest_step", "Hz or N",
        "largest arc-length step; a change of the displacement by one amplitude (or by the gap, "
        "if smaller) counts as a 20th of the interval",
        positive, derived("an 80th of the interval", interval_over(80)));
  sweep(&Analysis::first_step, "first_step", "Hz or N", "first step along the branch", positive,
        derived("a 1000th of the interval, at most largest_step", first_step_by_default));
  sweep(&Analysis::max_points, "max_points", "", "the continuation stops after this number of points",
        within(2, 10'000'000), optional);
  sweep(&Analysis::exact, "exact", "",
        "true follows exact periodic solutions, started from harmonic balance: bifurcation "
        "points have ten digits, and motions the tolerance 1e-9",
        optional);
  sweep(&Analysis::branches, "branches", "",
        "true also follows the branches that begin at period doublings and branch points", optional);
  over_frequency(&Analysis::isolas, "isolas", "",
                 "true also searches for isolated branches, closed ones included: near shifted resonances "
                 "and by time integration from rest and random states",
                 optional, only_with(by_balance()));
  over_frequency(
      &Analysis::isola_spacing, "isola_spacing", "Hz",
      "with isolas, the largest spacing of the frequencies of the search; wider branches contain one of them",
      positive, derived("a 20th of the interval", interval_over(20)), only_with(by_balance()));
  over_frequency(&Analysis::isola_starts, "isola_starts", "",
                 "with isolas, random initial states for time integration at each of these frequencies, "
                 "in addition to rest",
                 within(0, 1'000'000), optional, only_with(by_balance()));
}

/// Contacts move each for itself; many would make a wide table.
SceneValue contact_outputs_by_default(const Scene& scene) {
  const bool sweep = is_sweep(scene.analysis.type);
  constexpr int most = 6;
  const int contacts = contact_count(scene);
  return sweep && scene.contact.law != no_law && contacts > 1 && contacts <= most;
}

/// A number is a row or a bar's node.
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
  const Condition moves =
      analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "time_stepping", "nonlinear_mode",
                   "limit_cycle", "bifurcation_diagram"});
  const Section outputs(keys, "analysis", analysis_part, moves);
  outputs(&Analysis::outputs, "outputs", "",
          "places whose motion is written and shown first: \"row 7\" or 7 of matrices, with "
          "dof_map \"node 1052 z\", \"node 3\" or 3 of a bar, counted from its clamp; also "
          "\"velocity of node 1052 z\", \"absolute acceleration of node 1052 z in g\", \"relative "
          "displacement of row 7 in mm\" and \"transmissibility of row 7\". Each gets its largest "
          "and least value, half peak to peak, rms, mean and harmonics",
          optional, places_of_outputs, only_with(structure_is({"matrices", "bar"})));
  outputs(&Analysis::contact_outputs, "contact_outputs", "",
          "true makes each contact an output, with its force",
          derived("true in a sweep with 2 to 6 contact degrees of freedom", contact_outputs_by_default));
  outputs(&Analysis::output_harmonics, "output_harmonics", "",
          "forcing harmonics, or harmonics of a mode, whose amplitude and phase are written for each output",
          within(0, 1000), optional);
  const Section sweep(keys, "analysis", analysis_part, of_sweeps());
  sweep(&Analysis::peak_of, "peak_of", "",
        "output that defines the peak, as \"node 1052 z\", \"row 17\" or \"contact 2\": its "
        "largest half peak-to-peak value, instead of the largest displacement towards an obstacle",
        optional);
}

void add_time_stepping(std::vector<SceneKey>& keys) {
  const Section stepping(keys, "analysis", analysis_part, analysis_is({"time_stepping"}));
  stepping(&Analysis::tolerance, "tolerance", "",
           "relative rms difference of two successive periods at which integration ends", above(0, 1),
           optional);
  const Section recording(keys, "analysis", analysis_part, analysis_is({"time_stepping", "forced_response"}));
  recording(&Analysis::recorded_periods, "recorded_periods", "",
            "forcing periods recorded after max_periods if the motion has not repeated, for "
            "statistics, a Poincare section and a spectrum; also of a forced response that is aperiodic, "
            "after 200 periods; 0 for none",
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
          "longest period of a motion in forcing periods; longer ones count as none", within(1, 64),
          optional);
}

void add_mode(std::vector<SceneKey>& keys) {
  const Section mode(keys, "analysis", analysis_part, analysis_is({"nonlinear_mode"}));
  mode(&Analysis::mode, "mode", "", "linear mode from which the nonlinear mode starts", within(1, 10'000'000),
       optional);
  mode(&Analysis::harmonics, "harmonics", "", "harmonics N of the Fourier series in time", within(1, 4096),
       optional);
  mode(&Analysis::samples, "samples", "",
       "time samples per period at which contact is enforced or the contact force is evaluated, "
       "at least 2 x harmonics",
       within(2, 1 << 16),
       derived("2 x harmonics, 8 x with an elastic law, 32 x with friction or dampers",
               [](const Scene& scene) {
                 const int each = takes_energy(scene.contact) ? 32 : is_rigid(scene.contact.law) ? 2 : 8;
                 return each * scene.analysis.harmonics;
               }));
  mode(&Analysis::cosine_only, "cosine_only", "", "true uses cosines only: motions that are even in time",
       optional);
  mode(&Analysis::reference_length, "reference_length", "m",
       "for laws without a gap: displacement of the linear mode at the reference energy", not_negative,
       optional);
  mode(&Analysis::energy_ratio, "energy_ratio", "",
       "one motion at this ratio of energy to grazing energy; 0 for the whole branch", not_negative,
       optional);
  mode(&Analysis::largest_energy, "largest_energy", "", "the branch ends beyond this energy ratio", above(1),
       optional);
  mode(&Analysis::last_frequency_ratio, "last_frequency_ratio", "",
       "the branch also ends beyond this ratio of frequency to linear frequency; 0: no such end",
       not_negative, optional);
  mode(&Analysis::points, "points", "",
       "points of the branch, uniform in frequency up to last_frequency_ratio (without one 1.3, "
       "then less dense); with an elastic law about this number; with friction or dampers about "
       "uniform in the logarithm of the amplitude",
       within(2, 1'000'000), optional);
  mode(&Analysis::amplitude_ratio, "amplitude_ratio", "",
       "with friction or dampers, one motion at this ratio of the amplitude to the one at which "
       "a contact first slips, opens or closes; 0 for the whole branch",
       not_negative, optional);
  mode(&Analysis::largest_amplitude, "largest_amplitude", "",
       "with friction or dampers, amplitude ratio at which the branch ends; it starts at 0.5", above(1),
       optional);
  const auto losing =
      law_names([](const contact::LawEntry& law) { return law.acts_over_period || law.reads_velocity; });
  for (auto key = keys.end() - 2; key != keys.end(); ++key) key->laws = losing;
}

/// Whether counts and grazing points need a few times as long as the curve, or less.
SceneValue stability_by_default(const Scene& scene) {
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  const bool sweep = is_sweep(scene.analysis.type);
  if (!sweep && !mode) return true;
  if (mode && (is_rigid(scene.contact.law) || takes_energy(scene.contact))) return true;  // not known
  constexpr int few = 6;
  constexpr int most_unknowns = 400;  // contacts times functions; beyond, a count may cost tens of points
  const int contacts = contact_count(scene);
  return contacts <= few || (!mode && contacts * scene.time.functions <= most_unknowns);
}

/// For one response they cost little compared with its stability; along a curve as much as the curve, or
/// more.
SceneValue exact_by_default(const Scene& scene) {
  return scene.analysis.type == AnalysisType::forced_response && !solves_exactly(scene) &&
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
  analysis(&Analysis::type, "type", "", "the analysis", optional);
  analysis(&Analysis::output_points, "output_points", "", "uniform points of one period in response.csv",
           within(2, 1 << 24), optional);
  analysis(&Analysis::motion_at, "motion_at", "Hz or N",
           "points of the curve whose motions are written (motion_peak.csv, motion_fold_1.csv, "
           "motion_150Hz.csv, motion_20N.csv, ...): the largest displacement, the bifurcation and "
           "grazing points, and given frequencies or amplitudes at each passage of the curve, as "
           "[\"peak\", 150.0]",
           positive, optional, only_with(of_sweeps()));
  analysis(&Analysis::motion_points, "motion_points", "",
           "time samples per period at which the motion of the whole structure is written: "
           "motion.pvd for ParaView (blade, mesh), motion.mtx with a column per sample (matrices); "
           "in a sweep for motion_at",
           within(0, 9999), derived("32 for a blade or with a mesh, else 0", default_motion_points),
           only_with(structure_is({"blade", "matrices"}) &&
                     analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "motions",
                                  "nonlinear_mode", "limit_cycle"})));
  analysis(
      &Analysis::stability, "stability", "",
      "true counts the Floquet multipliers outside the unit circle, of a motion or at each point of a curve",
      derived("true; with more than 6 contacts false for modes, and for curves if contacts times "
              "functions exceed 400",
              stability_by_default),
      only_with(analysis_is({"forced_response", "frequency_sweep", "amplitude_sweep", "nonlinear_mode"})));
  analysis(&Analysis::special_points, "special_points", "",
           "with stability, true locates the bifurcation and grazing points of a curve, and the exact "
           "ones near them for up to 6 contacts or with phases = true; false only counts multipliers at "
           "its points",
           optional, only_with(of_sweeps() && by_balance()));
  analysis(&Analysis::exact_near, "phases", "",
           "true computes the exact periodic solution near the response: its contact intervals, its "
           "stability and the errors of the response; in a sweep at every point, instead of only at "
           "the peak and the bifurcation points",
           derived("true for a response with contact, false for a sweep", exact_by_default),
           only_with(of_responses() && by_balance()));
  analysis(&Analysis::subharmonic, "subharmonic", "",
           "n computes motions with a period of n forcing periods; functions, quadrature_points and "
           "output_points then refer to n periods",
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
  plot(&Plot::log, "log", "", "true draws curves with logarithmic ordinates", optional);
}

}  // namespace wavebalance::app
