#include "sweeps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nyquist_resonances.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"

namespace wavebalance::jl14 {
namespace {

/// The displacement of sweep points or turning points over the frequency.
template <class Points>
Series curve(const std::string& label, const Points& points) {
  std::vector<double> x, y;
  for (const auto& point : points) {
    x.push_back(point.frequency);
    y.push_back(millimetres * point.max_displacement);
  }
  return Series(label, x, y);
}

std::vector<app::PlacedPoint> placed(const std::vector<solvers::SpecialPoint>& points) {
  std::vector<app::PlacedPoint> marks;
  for (const auto& point : points)
    marks.push_back({point.type, point.frequency, millimetres * point.max_displacement});
  return marks;
}

/// The sweep of a scene with its stability.
app::Sweep stable_sweep(const app::Scene& scene) {
  const auto model = app::make_model(scene);
  app::Sweep sweep = app::frequency_sweep(scene, model);
  app::add_stability(scene, model, sweep);
  return sweep;
}

}  // namespace

Resonance swept(report::Artefact& artefact, const std::string& file, const std::vector<Pair>& pairs,
                const std::vector<std::string>& overrides) {
  Resonance resonance{pairs, {}, {}, 0.0, 0};
  for (const auto& pair : pairs) {
    std::vector<std::string> all{"time.trial=" + pair.trial, "time.weight=" + pair.weight};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const auto scene = artefact.scene(file, all);
    resonance.sweeps.push_back(resonance.sweeps.empty() ? stable_sweep(scene) : app::frequency_sweep(scene));
    resonance.gap = scene.contact.gap;
    resonance.functions = scene.time.functions;
    const auto& sweep = resonance.sweeps.back();
    if (!sweep.converged())
      artefact.note(pair.label + " in " + file +
                    " ended early: " + std::string(to_string(sweep.curve.status)));
  }
  auto free = artefact.scene(file);
  free.contact = {};
  resonance.free = app::frequency_sweep(app::complete_scene(free));
  return resonance;
}

app::Sweep swept_with_full_harmonics(report::Artefact& artefact, const std::string& file) {
  return stable_sweep(
      artefact.scene(file, {"time.functions=63", "analysis.first_step=0.5", "analysis.largest_step=1.0"}));
}

void add_stable_sweep(app::Panel& panel, const app::Sweep& sweep) {
  app::draw_by_stability(
      panel, report::styled(curve("Fourier, by arc length", sweep.curve.points), app::Colour::black),
      sweep.stability.points, placed(sweep.stability.special_points));
}

void note_nyquist_resonances(report::Artefact& artefact, const std::string& file) {
  const app::Scene full = artefact.scene(file, {"time.functions=63"});
  std::string text;
  for (const auto& pair : pairs()) {
    const auto scene = artefact.scene(file, {"time.trial=" + pair.trial, "time.weight=" + pair.weight});
    std::string listed;
    for (const double frequency :
         nyquist_resonances(scene, scene.analysis.frequency_from, scene.analysis.frequency_to))
      listed += (listed.empty() ? " " : ", ") + report::number(frequency, 6);
    if (!listed.empty()) text += (text.empty() ? "" : "; ") + pair.label + listed + " Hz";
  }
  artefact.note(fmt::format(
      "An even number of functions leaves the coefficient of the Nyquist function without damping in every "
      "pair. The contact force excites it near frequencies that mean nothing to the bar: {}. Fourier:Fourier with "
      "63 functions (31 full harmonics) has {}.",
      text.empty() ? "none in the interval" : text,
      nyquist_resonances(full, full.analysis.frequency_from, full.analysis.frequency_to).empty()
          ? "none"
          : "some too"));
}

solvers::SweepPoint peak(const app::Sweep& sweep) {
  const auto& points = sweep.curve.points;
  return *std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.max_displacement < b.max_displacement;
  });
}

std::string turning_points_text(const app::Sweep& sweep) {
  std::string text;
  for (const auto& turn : sweep.curve.turning_points)
    text += (text.empty() ? "" : " and ") + report::number(turn.frequency, 7) + " Hz";
  return text.empty() ? "none" : text;
}

double turning_points_distance(const app::Sweep& sweep, const app::Sweep& other) {
  const auto &turns = sweep.curve.turning_points, &others = other.curve.turning_points;
  if (turns.size() != others.size() || !sweep.converged() || !other.converged())
    return std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  for (std::size_t k = 0; k < turns.size(); ++k)
    largest = std::max(largest, std::abs(turns[k].frequency - others[k].frequency));
  return largest;
}

std::string unstable_text(const app::Sweep& sweep) {
  std::vector<std::string> ends;
  for (const auto& point : sweep.stability.special_points) {
    if (point.type == solvers::SpecialPointType::grazing) continue;
    std::string kind(to_string(point.type));
    std::replace(kind.begin(), kind.end(), '_', ' ');
    ends.push_back(fmt::format("the {} at {} Hz", kind, report::number(point.frequency, 6)));
  }
  std::vector<solvers::PointStability> points = sweep.stability.points;
  // Where contact has just begun, between two points of the period, its stability is not known.
  std::erase_if(points,
                [](const auto& one) { return one.status == solvers::StabilityStatus::too_few_samples; });
  const auto known = [](const auto& one) { return one.status == solvers::StabilityStatus::converged; };
  if (points.empty() || !std::all_of(points.begin(), points.end(), known)) return "not known";
  std::size_t changes = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    changes += (points[i].unstable > 0) != (points[i - 1].unstable > 0) ? 1 : 0;
  if (changes == 0 && ends.empty()) return points.front().unstable > 0 ? "everywhere" : "nowhere";
  if (changes != ends.size() || points.front().unstable > 0)
    return fmt::format("on parts that end at {}", fmt::join(ends, ", "));
  std::string text;
  for (std::size_t i = 0; i < ends.size(); i += 2)
    text += (i == 0 ? "from " : " and from ") + ends[i] +
            (i + 1 < ends.size() ? " to " + ends[i + 1] : std::string(" on"));
  return text;
}

Series modulus_curve(const std::string& label, const app::Sweep& sweep) {
  Series series = curve(label, sweep.curve.points);
  for (std::size_t i = 0; i < series.y.size(); ++i)
    series.y[i] = millimetres * sweep.curve.points[i].max_abs_displacement;
  return series;
}

app::Panel sweep_panel(const std::string& title, const Resonance& resonance) {
  app::Panel panel;
  panel.title = title;
  panel.add(report::styled(curve("without contact", resonance.free.curve.points), app::Colour::grey,
                           {.width = 4.0}));  // seen where another curve lies on it
  panel.mark_y(millimetres * resonance.gap);
  panel.x.label = "Forcing frequency (Hz)";
  panel.y.label = "Largest displacement (mm)";
  panel.y.lower = 0.0;
  return panel;
}

void add_points(app::Panel& panel, const Pair& pair, const std::string& label, const app::Sweep& sweep,
                int first, int every) {
  const Series all = curve(label, sweep.curve.points);
  std::vector<double> x, y;
  for (std::size_t i = static_cast<std::size_t>(first); i < all.x.size();
       i += static_cast<std::size_t>(every)) {
    x.push_back(all.x[i]);
    y.push_back(all.y[i]);
  }
  panel.add(report::styled({label, x, y, app::SeriesStyle::points}, pair.colour, {.marker = pair.marker}));
}

void add_special_points(app::Panel& panel, const app::Sweep& sweep) {
  app::draw_special_points(panel, placed(sweep.stability.special_points));
}

std::string SweepReading::name() const {
  return fmt::format("steps up to {} Hz, Nyquist coefficient {}", report::number(largest_step),
                     keeps_nyquist ? "kept" : "dropped");
}

std::vector<SweepReading> sweep_readings(const app::Scene& scene) {
  const double usual = scene.analysis.largest_step;
  std::vector<SweepReading> readings{{usual, true}};
  for (const double step : {1.0, 2.0, 3.0, 5.0, 10.0}) readings.push_back({step, true});
  for (const double step : {usual, 1.0}) readings.push_back({step, false});
  return readings;
}

std::vector<app::Sweep> swept_under(report::Artefact& artefact, const std::string& file,
                                    const SweepReading& reading) {
  std::vector<std::string> overrides{
      fmt::format("analysis.largest_step={}", reading.largest_step),
      fmt::format("analysis.first_step={}", std::min(0.5, reading.largest_step)),
      std::string("time.nyquist=") + (reading.keeps_nyquist ? "keep" : "drop")};
  // With short steps a curve that passes the interval needs fewer points than this; the others end
  // thousands of points later, unbounded.
  constexpr double short_step = 2.0;
  if (reading.largest_step <= short_step) overrides.emplace_back("analysis.max_points=900");
  artefact.scene(file, overrides);
  std::vector<app::Sweep> sweeps;
  for (const Pair& pair : pairs()) {
    auto all = overrides;
    all.insert(all.end(), {"time.trial=" + pair.trial, "time.weight=" + pair.weight});
    sweeps.push_back(app::frequency_sweep(app::load_scene(artefact.scenes() / file, all)));
  }
  return sweeps;
}

std::string end_text(const app::Sweep& sweep) {
  if (sweep.converged()) return turning_points_text(sweep);
  return fmt::format("ends early, last at {} Hz", report::number(sweep.curve.points.back().frequency, 5));
}

void append_sweep(Table& table, const Pair& pair, int functions, const app::Sweep& sweep) {
  const auto& points = sweep.curve.points;
  const auto& stability = sweep.stability.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool counted = i < stability.size() && stability[i].unstable >= 0;
    table.append_row({pair.trial, pair.weight, points[i].frequency, points[i].max_displacement,
                      points[i].rms_displacement, points[i].max_abs_displacement,
                      counted ? static_cast<double>(stability[i].unstable) : solvers::missing,
                      std::int64_t{functions}});
  }
}

Table sweeps_table(const Resonance& resonance) {
  Table table({"trial", "weight", "frequency_Hz", "max_displacement_m", "rms_displacement_m",
               "max_abs_displacement_m", "unstable", "functions"});
  for (std::size_t i = 0; i < resonance.pairs.size(); ++i)
    append_sweep(table, resonance.pairs[i], resonance.functions, resonance.sweeps[i]);
  return table;
}

Table special_points_table() { return Table({"curve", "type", "frequency_Hz", "max_displacement_m"}); }

void append_turning_points(Table& table, const std::string& curve, const app::Sweep& sweep) {
  for (const auto& turn : sweep.curve.turning_points)
    table.append_row({curve, std::string("turning_point"), turn.frequency, turn.max_displacement});
}

void append_special_points(Table& table, const std::string& curve, const app::Sweep& sweep) {
  for (const auto& point : sweep.stability.special_points)
    table.append_row({curve, std::string(to_string(point.type)), point.frequency, point.max_displacement});
}

}  // namespace wavebalance::jl14
