#include "drawing/figures.hpp"

#include <numbers>
#include <tuple>

#include "plot/plot_parts.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

constexpr int single_height = 420, one_of_several = 320;

/// A column of a mode's table at its motions, or at those on an internal resonance; elsewhere not numbers.
std::vector<double> motions_in(const Table& backbone, std::string_view name, bool on_resonance = false) {
  std::vector<double> values = backbone.numbers(name);
  const std::vector<std::string> statuses = backbone.texts("status");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool accepted = statuses[i] == "converged" || statuses[i] == "linear";
    if (on_resonance ? statuses[i] != "tongue" : !accepted) values[i] = std::nan("");
  }
  return values;
}

/// The end of the axis of energies: linear grazing is shown, and `largest` only where the curve comes near.
double shown_energy(const std::vector<double>& energies, double largest) {
  double reached = 1.0;
  for (const double one : energies) reached = std::fmax(reached, one);
  constexpr double margin = 1.05;
  return std::min(largest, margin * reached);
}

bool is_damped(const Table& backbone) { return backbone.has_column("damping_ratio"); }

/// Frequencies as points, since neighbours may lie either side of an internal resonance, and those on one.
void add_frequencies(Panel& panel, const Table& backbone, const std::vector<double>& x,
                     std::string_view column) {
  panel.add({"ω", x, motions_in(backbone, column), SeriesStyle::points});
  Series resonances =
      Series("on an internal resonance", x, motions_in(backbone, column, true), SeriesStyle::points)
          .in(Colour::grey);
  resonances.marker = 3;
  panel.add(std::move(resonances));
}

/// Whether contacts can but slip, under given normal loads, so that a mode is linear until one does.
bool slip_alone(const Scene& scene) {
  const auto slides = [](const SceneContact& one) {
    return has_friction(one.law) && direction_name(one) != "normal";
  };
  return std::ranges::all_of(contacts_of(scene), slides);
}

/// An empty panel over the vibration of an output, which is scaled, with the end of the linear range.
Panel panel_over(const Scene& scene, bool damped, const ModeOutput& one, std::vector<double>& vibration) {
  double largest = 0.0;
  for (const double value : vibration) largest = std::fmax(largest, value);
  const Scale scale = axis_scale(largest, one.output.unit);
  for (double& value : vibration) value *= scale.factor;
  Panel panel;
  panel.x.label = vibration_title(one.output);
  if (!one.output.unit.empty()) panel.x.label += " (" + scale.prefix + one.output.unit + ")";
  panel.x.logarithmic = largest > 0.0 && (damped || scene.plot.log);
  if (!panel.x.logarithmic) panel.x.lower = 0.0;
  if (!std::isfinite(one.at_onset)) return panel;
  panel.mark_x(scale.factor * one.at_onset);
  panel.title = slip_alone(scene) ? " (dotted: slip onset)" : " (dotted: end of the linear range)";
  return panel;
}

/// Frequency and, of a damped mode, damping ratio over the vibration of an output.
std::vector<Panel> panels_over(const Scene& scene, const Table& backbone, const ModeOutput& one) {
  std::vector<double> x = backbone.numbers(one.output.column_of("half_peak_to_peak"));
  const bool damped = is_damped(backbone);
  std::vector<Panel> panels(damped ? 2 : 1, panel_over(scene, damped, one, x));
  panels.front().y.label = "Frequency (Hz)";
  if (!damped) {
    panels.front().title.insert(0, "Frequency");
    add_frequencies(panels.front(), backbone, x, "frequency_Hz");
    return panels;
  }
  panels.back().y.label = "Damping ratio";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].title.insert(0, i == 0 ? "Frequency" : "Damping");
    panels[i].add(
        Series("", x, backbone.numbers(i == 0 ? "frequency_Hz" : "damping_ratio")).in(Colour::blue));
  }
  return panels;
}

Figure empty_mode_figure(const Scene& scene) {
  Figure figure;
  figure.title = method_title(scene);
  figure.panel_width = 640;
  figure.panel_height = one_of_several;
  return figure;
}

/// `y` where `shown`, and next to such a point if `beside`.
std::vector<double> selected(const std::vector<double>& y, const std::vector<bool>& shown, bool beside) {
  std::vector<double> result(y.size(), std::nan(""));
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool near = beside && ((i > 0 && shown[i - 1]) || (i + 1 < y.size() && shown[i + 1]));
    if (shown[i] || near) result[i] = y[i];
  }
  return result;
}

/// The bifurcation points on the frequencies of a panel, each on the line of the mode that is nearest in
/// energy and frequency.
std::vector<PlacedPoint> placed_on(const Series& drawn, const Table& backbone,
                                   const solvers::BackboneStability& stability) {
  const std::vector<double> energy = backbone.numbers("energy_ratio"),
                            frequency = backbone.numbers("frequency_Hz");
  std::vector<PlacedPoint> marks;
  for (const solvers::ModeSpecialPoint& point : stability.special_points) {
    const double hertz = point.omega / (2.0 * std::numbers::pi);
    const auto distance = [&](std::size_t i) {
      return std::hypot(energy[i] / point.energy_ratio - 1.0, frequency[i] / hertz - 1.0);
    };
    double least = std::numeric_limits<double>::infinity();
    PlacedPoint mark{point.type};
    for (std::size_t i = 0; i + 1 < drawn.x.size(); ++i) {
      const double before = distance(i), sum = before + distance(i + 1);
      if (!std::isfinite(drawn.y[i] + drawn.y[i + 1]) || !(sum < least)) continue;
      least = sum;
      mark.x = std::lerp(drawn.x[i], drawn.x[i + 1], before / sum);
      mark.y = std::lerp(drawn.y[i], drawn.y[i + 1], before / sum);
    }
    if (std::isfinite(least)) marks.push_back(mark);
  }
  return marks;
}

void draw_stability_in(Panel& panel, const Table& backbone, const solvers::BackboneStability& stability) {
  const Series drawn = panel.series.front();
  const std::vector<double> unstable = backbone.numbers("unstable");
  const std::size_t count = drawn.y.size();
  std::vector<bool> is_stable(count), is_unstable(count), is_unknown(count);
  bool any_unstable = false, any_unknown = false;
  for (std::size_t i = 0; i < count; ++i) {
    is_stable[i] = unstable[i] == 0.0;
    is_unstable[i] = unstable[i] > 0.0;
    is_unknown[i] = std::isnan(unstable[i]) && !std::isnan(drawn.y[i]);
    any_unstable = any_unstable || (is_unstable[i] && !std::isnan(drawn.y[i]));
    any_unknown = any_unknown || is_unknown[i];
  }
  const auto part = [&](const char* more, const std::vector<bool>& shown, bool beside) {
    return Series(drawn.label + more, drawn.x, selected(drawn.y, shown, beside)).in(Colour::blue);
  };
  panel.series.front() = part("", is_stable, false);
  auto next = panel.series.begin() + 1;
  if (any_unstable) {
    Series dashed = part(", unstable", is_unstable, true);
    dashed.dash = Dash::dashed;
    next = panel.series.insert(next, std::move(dashed)) + 1;
  }
  if (any_unknown) {
    Series unknown = part(", stability unknown", is_unknown, false);
    unknown.style = SeriesStyle::points;
    panel.series.insert(next, std::move(unknown));
  }
  draw_special_points(panel, placed_on(drawn, backbone, stability));
}

}  // namespace

Figure backbone_figure(const Scene& scene, const Table& backbone, const ModeOutput* leading) {
  Figure figure = empty_mode_figure(scene);
  if (leading == nullptr)
    figure.panel_height = single_height;
  else
    figure.panels = panels_over(scene, backbone, *leading);
  Panel& panel = figure.add_panel("",
                                  scene.analysis.reference_length > 0.0
                                      ? "Energy / energy of the linear mode at the reference length"
                                      : "Energy / grazing energy of the linear mode",
                                  "Frequency / linear frequency");
  panel.x.lower = 0.0;
  panel.x.upper = shown_energy(motions_in(backbone, "energy_ratio"), scene.analysis.largest_energy);
  const std::vector<double> energy = backbone.numbers("energy_ratio");
  if (leading != nullptr) panel.title = "Frequency over the energy";
  add_frequencies(panel, backbone, energy, "frequency_ratio");
  Series rayleigh("√r, Rayleigh quotient", energy, motions_in(backbone, "rayleigh_frequency_ratio"),
                  SeriesStyle::points);
  panel.series.insert(panel.series.begin() + 1, std::move(rayleigh));
  panel.mark_x(1.0);
  return figure;
}

Figure damped_figure(const Scene& scene, const Table& backbone, const ModeOutput* leading) {
  Figure figure = empty_mode_figure(scene);
  if (leading != nullptr) {
    figure.panels = panels_over(scene, backbone, *leading);
    return figure;
  }
  for (const auto& [title, column, label] : {std::tuple{"Frequency", "frequency_Hz", "Frequency (Hz)"},
                                             {"Damping", "damping_ratio", "Damping ratio"}}) {
    Panel& panel = figure.add_panel(
        title,
        slip_alone(scene) ? "Amplitude / amplitude of slip onset" : "Amplitude / largest linear amplitude",
        label);
    panel.x.logarithmic = true;
    panel.add(Series("", backbone, "amplitude_ratio", column).in(Colour::blue)).mark_x(1.0);
  }
  return figure;
}

Figure outputs_figure(const Scene& scene, const Table& backbone, const std::vector<ModeOutput>& outputs) {
  Figure figure = empty_mode_figure(scene);
  if (outputs.size() > most_drawn_outputs)
    figure.title +=
        ", the first " + std::to_string(most_drawn_outputs) + " of " + std::to_string(outputs.size());
  for (std::size_t i = 0; i < std::min(outputs.size(), most_drawn_outputs); ++i)
    for (Panel& panel : panels_over(scene, backbone, outputs[i])) figure.panels.push_back(std::move(panel));
  return figure;
}

void draw_stability(Figure& figure, const Table& backbone, const solvers::BackboneStability& stability) {
  if (stability.points.empty()) return;
  for (Panel& panel : figure.panels) draw_stability_in(panel, backbone, stability);
}

}  // namespace wavebalance::app
