#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curve_parts.hpp"
#include "figures.hpp"
#include "forced_blade.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/report/artefact.hpp"

namespace wavebalance::blade {
using app::Colour;
using report::axis;
using report::styled;

namespace {

struct Pair {
  const char* label;
  const char* column;
  const char* trial;
  const char* weight;
  Colour colour;
};
/// In the colours of JL14.
constexpr Pair pairs[] = {{"Fourier", "fourier_fourier", "fourier", "fourier", Colour::blue},
                          {"DB6", "daubechies6_daubechies6", "daubechies6", "daubechies6", Colour::green},
                          {"Haar:Fourier", "haar_fourier", "haar", "fourier", Colour::purple}};

using Responses = std::vector<BladeResponse>;

/// The responses of forced_response.toml.
struct Study {
  app::Scene scene;
  Responses linear;               ///< without contact
  app::Sweep traced;              ///< Fourier, by arc length
  CurveParts parts;               ///< of that curve, with their stability
  std::vector<Responses> curves;  ///< one per pair, upwards in steps
  Responses down;                 ///< Fourier, downwards in steps

  double gap() const { return scene.contact.gap; }
  double frequency() const { return scene.forcing.frequency; }
};

/// Thinner from one pair to the next, so that all show where they agree.
double width(std::size_t pair) { return 2.8 - 0.9 * static_cast<double>(pair); }

std::vector<std::string> pair_overrides(const Pair& pair) {
  return {std::string("time.trial=\"") + pair.trial + "\"",
          std::string("time.weight=\"") + pair.weight + "\""};
}

std::vector<double> over_gap(std::vector<double> values, double gap) {
  for (double& value : values) value /= gap;
  return values;
}

std::vector<double> frequencies(const Responses& responses) {
  std::vector<double> result;
  for (const auto& response : responses) result.push_back(response.frequency);
  return result;
}

app::Series points_of(const std::string& label, const Responses& responses, double gap, Colour colour,
                      int marker) {
  return styled({label, frequencies(responses), over_gap(largest_displacements(responses), gap),
                 app::SeriesStyle::points},
                colour, {.marker = marker});
}

app::Axis frequency_axis(const Study& study) {
  auto result = axis("Frequency (Hz)", study.linear.front().frequency, study.linear.back().frequency);
  result.ticks = {550.0, 600.0, 650.0, 700.0};
  return result;
}

app::Axis time_axis() { return axis("Time (fraction of a period)", 0.0, 1.0); }

/// The curve by arc length, dashed where it is unstable, with its folds.
void add_traced(app::Panel& panel, const Study& study) {
  std::vector<double> x, y;
  for (const auto& point : study.traced.curve.points) {
    x.push_back(point.frequency);
    y.push_back(point.max_displacement / study.gap());
  }
  const auto traced = styled({"curve", x, y}, Colour::black, {.width = 1.2});
  std::vector<app::PlacedPoint> folds;
  for (const auto& fold : study.parts.folds)
    folds.push_back({solvers::SpecialPointType::fold, fold.frequency, fold.max_displacement / study.gap()});
  app::draw_by_stability(panel, traced, study.parts.points, folds);
  app::draw_special_points(panel, folds);
}

void add_curves(app::Figure& figure, const Study& study) {
  auto& panel = figure.add_panel("frequency response");
  panel.x = frequency_axis(study);
  panel.y = axis("Largest u_z over the gap", 0.0, 9.0);
  panel.add(styled({"without contact", frequencies(study.linear),
                    over_gap(largest_displacements(study.linear), study.gap())},
                   Colour::grey, {.dash = app::Dash::dashed}));
  add_traced(panel, study);
  panel.add(points_of("steps up", study.curves[0], study.gap(), pairs[0].colour, 1));
  panel.add(points_of("steps down", study.down, study.gap(), Colour::sky_blue, 4))
      .mark_y(1.0)
      .mark_x(study.frequency());
}

/// The other pairs against Fourier, whose points they would hide in the panel of the curves.
void add_differences(app::Figure& figure, const Study& study) {
  auto& panel = figure.add_panel("other pairs less Fourier, upwards");
  panel.x = frequency_axis(study);
  panel.y.label = "Difference over the gap";
  const auto fourier = largest_displacements(study.curves[0]);
  for (std::size_t i = 1; i < study.curves.size(); ++i) {
    auto values = largest_displacements(study.curves[i]);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] -= fourier[k];
    panel.add(styled({pairs[i].label + std::string(" less Fourier"), frequencies(study.curves[i]),
                      over_gap(values, study.gap()), app::SeriesStyle::line_points},
                     pairs[i].colour, {.marker = static_cast<int>(i) + 1}));
  }
  panel.mark_y(0.0);
}

/// t/T of the samples, and 1.
std::vector<double> closed_times(Eigen::Index samples) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(samples + 1, 0.0, 1.0);
  return {times.begin(), times.end()};
}

/// Contact force over time and chord, mean of the two faces.
void add_map(app::Figure& figure, const std::string& pair, const BladeResponse& response, double largest) {
  auto& panel = figure.add_panel("contact force, " + pair);
  panel.x = time_axis();
  panel.y.label = "Chord, leading to trailing";
  auto& map = panel.heat_map.emplace();
  const Eigen::Index samples = response.force.cols();
  map.x = closed_times(samples);
  const Eigen::Index stations = response.force.rows() / 2;
  for (Eigen::Index station = 0; station < stations; ++station) {
    map.y.push_back(static_cast<double>(station) / static_cast<double>(stations - 1));
    for (Eigen::Index k = 0; k <= samples; ++k)
      map.values.push_back(
          0.5 * (response.force(2 * station, k % samples) + response.force(2 * station + 1, k % samples)));
  }
  map.largest = largest;
  map.from_zero = true;
  map.label = "N";
}

/// Common limits of the histories of both edges in all pairs, rounded outwards.
std::pair<double, double> history_limits(const std::vector<Responses>& curves, double gap, double frequency,
                                         bool force) {
  double lower = 0.0, upper = 0.0;
  for (const auto& curve : curves) {
    const auto& response = at(curve, frequency);
    const Eigen::MatrixXd samples = force ? response.force : Eigen::MatrixXd(response.displacement / gap);
    for (const Eigen::Index row : {Eigen::Index{0}, samples.rows() - 1}) {
      lower = std::min(lower, samples.row(row).minCoeff());
      upper = std::max(upper, samples.row(row).maxCoeff());
    }
  }
  const double step = force ? 50.0 : 0.5;
  return {std::floor(lower / step) * step, std::ceil(upper / step) * step};
}

void add_history(app::Figure& figure, const std::vector<Responses>& curves, double gap, double frequency,
                 bool force, bool leading) {
  const auto limits = history_limits(curves, gap, frequency, force);
  auto& panel = figure.add_panel(std::string(leading ? "leading" : "trailing") + " edge");
  panel.x = time_axis();
  panel.y = axis(force ? "Contact force (N)" : "u_z over the gap", limits.first, limits.second);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& response = at(curves[i], frequency);
    const Eigen::MatrixXd& samples = force ? response.force : response.displacement;
    const Eigen::VectorXd row = samples.row(leading ? 0 : samples.rows() - 1) / (force ? 1.0 : gap);
    std::vector<double> closed(row.begin(), row.end());
    closed.push_back(row[0]);
    panel.add(
        styled({pairs[i].label, closed_times(row.size()), closed}, pairs[i].colour, {.width = width(i)}));
  }
  if (!force) panel.mark_y(1.0);
}

app::Table histories(const std::vector<Responses>& curves, double frequency) {
  const auto& first = at(curves[0], frequency);
  app::Table table;
  table.add_column("time_fraction", app::time_fractions(static_cast<int>(first.displacement.cols())));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& response = at(curves[i], frequency);
    const Eigen::Index last = response.force.rows() - 1;
    const std::string name = pairs[i].column;
    table.add_column(name + "_leading_u_z_m", Eigen::VectorXd(response.displacement.row(0)))
        .add_column(name + "_trailing_u_z_m", Eigen::VectorXd(response.displacement.row(last)))
        .add_column(name + "_leading_force_N", Eigen::VectorXd(response.force.row(0)))
        .add_column(name + "_trailing_force_N", Eigen::VectorXd(response.force.row(last)));
  }
  return table;
}

std::size_t peak_of(const Responses& responses) {
  const auto values = largest_displacements(responses);
  std::size_t best = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[best] >= values[i]) && !std::isnan(values[i])) best = i;
  return best;
}

/// How far contact moves and limits the peaks, and how far the other pairs are from Fourier.
void note_peaks(report::Artefact& artefact, const Study& study) {
  const auto& curves = study.curves;
  const double gap = study.gap(), frequency = study.frequency();
  const auto& free = study.linear[peak_of(study.linear)];
  std::string peaks, differences;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& peak = curves[i][peak_of(curves[i])];
    peaks +=
        fmt::format("{}{} {} Hz and {}", i == 0 ? "" : ", ", std::string(pairs[i].label),
                    report::number(peak.frequency, 4), report::number(peak.displacement.maxCoeff() / gap, 3));
    if (i == 0) continue;
    const double difference =
        rms_difference(at(curves[i], frequency).displacement, at(curves[0], frequency).displacement);
    differences += (i == 1 ? "" : ", ") + std::string(pairs[i].label) + " " + report::percent(difference, 2);
  }
  artefact.note(fmt::format("Peaks of the upward steps: {} gaps; without contact {} Hz and {} gaps.", peaks,
                            report::number(free.frequency, 4),
                            report::number(free.displacement.maxCoeff() / gap, 3)));
  artefact.note(
      fmt::format("At {} Hz the motions of all 24 contacts differ from those by Fourier by: {} (rms).",
                  report::number(frequency, 4), differences));
}

void notes(report::Artefact& artefact, const Study& study) {
  std::size_t unsolved = 0;
  for (const auto& curve : study.curves)
    for (const auto& response : curve) unsolved += response.converged ? 0 : 1;
  artefact.note(fmt::format("{} of {} stepped responses did not converge and are missing.", unsolved,
                            study.curves.size() * study.curves[0].size()));
  std::string turns;
  for (const auto& turn : study.traced.curve.turning_points)
    turns += (turns.empty() ? "" : ", ") + report::number(turn.frequency, 5) + " Hz";
  artefact.note(fmt::format(
      "The curve by arc length ({}, {} points) turns at {}. It takes an odd number of functions: an even "
      "one, as wavelets have, keeps here its Nyquist coefficient undamped, whose resonances no curve passes; "
      "steps do.",
      to_string(study.traced.curve.status), study.traced.curve.points.size(),
      turns.empty() ? "no frequency" : turns));
}

void note_stability(report::Artefact& artefact, const CurveParts& parts) {
  if (parts.folds.empty()) return;
  artefact.note(fmt::format(
      "Stability of the curve by arc length, by the number of multipliers outside the unit circle: {}. Dashed is the part between "
      "the folds at {} and {} Hz if both of its points are unstable; counts at all points would take minutes.",
      parts.counts_text(), report::number(parts.folds[0].frequency, 5),
      report::number(parts.folds[1].frequency, 5)));
}

Study solved(report::Artefact& artefact) {
  const std::string file = "forced_response.toml";
  Study study;
  study.scene = artefact.scene(file);
  const auto model = app::make_model(study.scene);
  // A gap of 1 m is never closed; without contact eight functions are as good as any.
  study.linear = stepped_sweep(
      artefact.scene(file, {"contact.gap=1.0", "time.functions=8", "analysis.largest_step=1.0"}), model);
  const app::Scene traced = artefact.scene(
      file, {"time.functions=31", "time.quadrature_points=64", "analysis.first_step=0.2",
             "analysis.largest_step=2.5", "analysis.output_points=256", "analysis.stability=true"});
  study.traced = app::frequency_sweep(traced, model);
  study.parts = curve_parts(traced, model, study.traced);
  for (const Pair& pair : pairs)
    study.curves.push_back(stepped_sweep(artefact.scene(file, pair_overrides(pair)), model));
  study.down = stepped_sweep(reversed(study.scene), model);
  return study;
}

void write_data(report::Artefact& artefact, const Study& study) {
  app::Table table;
  table.add_column("frequency_Hz", frequencies(study.curves[0]));
  for (std::size_t i = 0; i < study.curves.size(); ++i)
    table.add_column(pairs[i].column, largest_displacements(study.curves[i]));
  auto falling = largest_displacements(study.down);
  std::reverse(falling.begin(), falling.end());
  table.add_column("fourier_fourier_downwards", falling);
  artefact.data(table, "Hz; largest radial displacement of a contact node in m; missing where not converged");
  app::Table free;
  free.add_column("frequency_Hz", frequencies(study.linear))
      .add_column("max_displacement_m", largest_displacements(study.linear));
  artefact.more_data("without_contact", free, "Hz; largest radial displacement of a contact node in m");
  app::Table curve = app::sweep_table(study.traced.curve);
  std::vector<double> unstable(curve.rows(), solvers::missing);
  for (std::size_t i = 0; i < study.parts.points.size(); ++i)
    if (study.parts.points[i].unstable >= 0) unstable[i] = study.parts.points[i].unstable;
  curve.add_column("unstable", unstable);
  artefact.more_data(
      "curve", curve,
      "Hz, m; Fourier by arc length, points in their order along the curve; unstable: multipliers outside "
      "the unit circle in this part of the curve, missing where not known");
  app::Table folds({"type", "frequency_Hz", "max_displacement_m"});
  for (const auto& fold : study.parts.folds)
    folds.append_row({std::string("fold"), fold.frequency, fold.max_displacement});
  artefact.more_data("special_points", folds, "Hz and m; of the curve by arc length");
  artefact.more_data(
      "histories", histories(study.curves, study.frequency()),
      fmt::format(
          "one period at {} Hz: radial displacement in m and contact force in N at the first node of the "
          "leading and the last of the trailing edge",
          report::number(study.frequency(), 4)));
}

app::Figure drawn(const Study& study) {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 350;
  figure.panel_height = 300;
  add_curves(figure, study);
  add_differences(figure, study);
  double largest = 0.0;
  for (const std::size_t pair : {std::size_t{0}, study.curves.size() - 1})
    largest = std::max(largest, at(study.curves[pair], study.frequency()).force.maxCoeff());
  for (const std::size_t pair : {std::size_t{0}, study.curves.size() - 1})
    add_map(figure, pairs[pair].label, at(study.curves[pair], study.frequency()), largest);
  for (const bool force : {false, true})
    for (const bool leading : {true, false})
      add_history(figure, study.curves, study.gap(), study.frequency(), force, leading);
  return figure;
}

}  // namespace

void forced_response(report::Artefact& artefact) {
  const Study study = solved(artefact);
  write_data(artefact, study);
  artefact.picture(drawn(study));
  artefact.caption(fmt::format(
      "Response of the open blade to a harmonic force at the tip, the next step that JL14 names. Steps of the frequency "
      "with {} functions and {} points go up and down again. (a) Fourier: black the curve by arc length, dashed where "
      "unstable; dark blue steps up, light blue steps down. (b) Largest displacement of the other pairs less Fourier. "
      "(c), (d) Force over the chord, mean of both faces. (e) to (h) Histories at {} Hz.",
      study.scene.time.functions, study.scene.time.quadrature_points, report::number(study.frequency(), 4)));
  note_peaks(artefact, study);
  notes(artefact, study);
  note_stability(artefact, study.parts);
}

}  // namespace wavebalance::blade
