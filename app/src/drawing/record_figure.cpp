#include "drawing/figures.hpp"

#include <iomanip>
#include <sstream>
#include <tuple>

#include "analysis/analysis_parts.hpp"
#include "plot/plot_parts.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

std::string basis_title(const std::string& basis) {
  if (const int coefficients = daubechies_coefficients(basis); coefficients > 0)
    return "Daubechies " + std::to_string(coefficients);
  return basis == "fourier" ? "Fourier" : basis == "haar" ? "Haar" : "B-spline";
}

std::string structure_title(const Scene& scene) {
  const Structure& structure = scene.structure;
  if (structure.type == StructureType::bar) return std::to_string(structure.elements) + " elements";
  const std::string kind = structure.type == StructureType::blade ? "blade" : "matrices";
  const int contacts = whole_contact_count(scene);
  return kind + ", " + std::to_string(contacts) + (contacts == 1 ? " contact" : " contacts");
}

/// Common parts of the panels of a motion.
struct MotionPicture {
  const Response& response;
  PeriodWindow window;
  std::vector<std::pair<double, double>> spans;  ///< of contact
  std::string name;                              ///< of the contact, where there are several
};

void add_motion(Figure& figure, const MotionPicture& picture, const std::string& quantity,
                const std::string& unit, const Eigen::VectorXd& values) {
  const Response& response = picture.response;
  const std::vector<std::pair<double, double>>& spans = picture.spans;
  const Scale scale = axis_scale(values.cwiseAbs().maxCoeff());
  Panel& panel = figure.add_panel(quantity + picture.name + (spans.empty() ? "" : " (shaded: contact)"));
  for (const auto& [begin, end] : spans)
    panel.rectangles.push_back({begin, scale.factor * values.minCoeff(), end,
                                scale.factor * values.maxCoeff(), Colour::sky_blue, 0.35});
  panel.x = picture.window.axis();
  panel.y.label = quantity + " (" + scale.prefix + unit + ")";
  Series series = picture.window.curve(scale.factor * values);
  if (!response.converged && !response.recorded) {
    series.colour = Colour::grey;
    series.dash = Dash::dashed;
  }
  panel.add(extremes_of_runs(series));
}

/// The 99th percentile of `values`, not empty, where single ones lie far beyond it; the largest otherwise.
double top_of_most(std::vector<double> values) {
  std::ranges::sort(values);
  const double most = values[static_cast<std::size_t>(0.99 * static_cast<double>(values.size() - 1))];
  constexpr double far_beyond = 1.5;
  return most > 0.0 && values.back() > far_beyond * most ? most : values.back();
}

/// The largest of the curve before it runs away: before all its last points within 1 % of its range from its
/// last frequency. The largest of all where nothing is left, or where the end is hardly higher.
double top_before_the_end(const std::vector<double>& place, const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(place.begin(), place.end());
  const double near = 0.01 * (*most - *least);
  std::size_t left = place.size();
  while (left > 0 && std::abs(place[left - 1] - place.back()) <= near) --left;
  const double largest = *std::ranges::max_element(values);
  if (left == 0) return largest;
  const double before = *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(left));
  constexpr double far_beyond = 1.5;
  return before > 0.0 && largest > far_beyond * before ? before : largest;
}

using PointValue = double solvers::SweepPoint::*;

/// One quantity along a curve.
std::vector<double> values_along(const solvers::FrequencySweep& curve, PointValue value) {
  std::vector<double> values;
  for (const auto& point : curve.points) values.push_back(point.*value);
  return values;
}

/// Frequencies or amplitudes of its points.
std::vector<double> places_along(const solvers::FrequencySweep& curve) {
  std::vector<double> places;
  for (const auto& point : curve.points) places.push_back(parameter_of(point, curve.parameter));
  return places;
}

/// All displacements that a picture of the sweep shows.
std::vector<double> displacements_of(const std::vector<SweepLine>& lines) {
  std::vector<double> values = values_along(lines.front().curve, &solvers::SweepPoint::rms_displacement);
  for (const SweepLine& line : lines)
    for (const auto& point : line.curve.points) values.push_back(point.max_displacement);
  return values;
}

/// The displacement up to which a sweep is drawn, of those in `values`: where the curve did not end well,
/// neither one wild point nor an end without bound sets the axis.
double shown_top(const Sweep& sweep, const std::vector<double>& values) {
  if (sweep.converged()) return *std::ranges::max_element(values);
  if (sweep.curve.status != solvers::SweepStatus::unbounded) return top_of_most(values);
  const auto top = [&, place = places_along(sweep.curve)](PointValue value) {
    return top_before_the_end(place, values_along(sweep.curve, value));
  };
  return std::max(top(&solvers::SweepPoint::max_displacement), top(&solvers::SweepPoint::rms_displacement));
}

/// A stable curve of many points is thinned.
void add_curve(Panel& panel, const Series& curve, const std::vector<solvers::PointStability>& points,
               const std::vector<PlacedPoint>& special) {
  const bool unstable = std::ranges::any_of(points, [](const auto& point) { return point.unstable > 0; });
  if (unstable)
    draw_by_stability(panel, curve, points, special);
  else
    panel.add(extremes_of_runs(curve));
}

/// A quantity of impacts along a curve and its branches, in a separate panel.
void add_impacts_along(Figure& figure, const Sweep& sweep, double PointImpacts::*value,
                       const std::string& title, const std::string& unit) {
  double largest = 0.0;
  for (const auto& along : sweep.impacts)
    for (const PointImpacts& point : along) largest = std::max(largest, point.*value);
  const Scale scale = axis_scale(largest);
  Panel& panel = figure.add_panel(title, sweep_axis(sweep).label(), "Largest (" + scale.prefix + unit + ")");
  panel.y.lower = 0.0;
  const std::vector<SweepLine> lines = lines_of(sweep);
  for (std::size_t i = 0; i < std::min(lines.size(), sweep.impacts.size()); ++i) {
    if (lines[i].curve.points.empty()) continue;
    std::vector<double> values;
    for (const PointImpacts& point : sweep.impacts[i]) values.push_back(point.*value);
    add_curve(panel, lines[i].series("", values, scale.factor), lines[i].stability.points, {});
  }
}

/// Whether the largest displacement of contacts hides how they vibrate.
bool vibrates_about_a_mean(const Scene& scene) {
  const auto& terms = scene.forcing.terms;
  const bool is_loaded =
      !scene.forcing.weight.empty() || std::ranges::any_of(terms, [](const ForcingTerm& one) {
        return one.harmonic == 0 && one.samples.empty();
      });
  return is_loaded || has_friction(scene) || is_rigid(scene.contact.law);
}

bool has_gaps(const Scene& scene) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  return std::ranges::any_of(
      contacts, [](const SceneContact& one) { return has_gap(one.law) && !has_friction(one.law); });
}

/// One entry of the legend for the parts of a branch, the series from `first` on: dashes mean the same in
/// all.
void label_once(Panel& panel, std::size_t first) {
  if (panel.series.size() < first + 2) return;
  Series &stable = panel.series[first], &unstable = panel.series[first + 1];
  unstable.label = "";
  if (std::ranges::any_of(stable.y, [](double y) { return !std::isnan(y); })) return;
  unstable.label = std::move(stable.label);
  panel.series.erase(panel.series.begin() + static_cast<std::ptrdiff_t>(first));
}

/// A curve below the largest displacements.
struct Second {
  std::string label;
  PointValue value;
};

/// The largest displacements along one of the curves of a sweep, and others of the first.
void add_displacements_of(Panel& panel, const SweepLine& line, const std::vector<PlacedPoint>& special,
                          double factor, const Second& second) {
  const bool main = line.name.empty();
  if (line.curve.points.empty()) return;
  const Series largest =
      line.series(main ? "largest" : line.long_name,
                  values_along(line.curve, &solvers::SweepPoint::max_displacement), factor);
  if (!main) {
    const std::size_t before = panel.series.size();
    draw_by_stability(panel, largest, line.stability.points, special);
    return label_once(panel, before);
  }
  Series other = line.series(second.label, values_along(line.curve, second.value), factor);
  other.colour = Colour::orange;
  add_curve(panel, largest, line.stability.points, special);
  add_curve(panel, other, line.stability.points, {});
}

/// Largest displacement of the contacts with their gap, and the rms one; below a panel with the rms without
/// mean the least.
void add_displacements_along(Figure& figure, const Scene& scene, const Sweep& sweep) {
  const std::vector<SweepLine> lines = lines_of(sweep);
  const std::vector<double> values = displacements_of(lines);
  const double largest = *std::ranges::max_element(values);
  const double top = shown_top(sweep, values);
  const bool below = !figure.panels.empty();
  const Second second = below ? Second{"least", &solvers::SweepPoint::min_displacement}
                              : Second{"rms including mean", &solvers::SweepPoint::rms_displacement};
  const Scale scale = axis_scale(top);
  const std::string unit = displacement_unit(scene);
  Panel& panel = figure.add_panel("Displacement of the contacts", sweep_axis(sweep).label(),
                                  "Displacement (" + scale.prefix + unit + ")");
  std::vector<PlacedPoint> marks;
  for (const SweepLine& line : lines) {
    const std::vector<PlacedPoint> special =
        line.placed([&](const solvers::SpecialPoint& one) { return scale.factor * one.max_displacement; });
    add_displacements_of(panel, line, special, scale.factor, second);
    marks.insert(marks.end(), special.begin(), special.end());
  }
  draw_special_points(panel, marks);
  if (top < largest) {
    panel.y.upper = 1.1 * scale.factor * top;
    if (below) panel.y.lower = -*panel.y.upper;
  }
  if (const double gap = common_gap(scene); !std::isnan(gap))
    panel.mark_level(scale.factor * gap, "gap", quantity(gap, unit));
}

}  // namespace

std::string method_title(const Scene& scene) {
  if (is_elastic_mode(scene) || is_damped_mode(scene)) {
    const Time time = mode_time(scene);
    return "Mode " + std::to_string(scene.analysis.mode) + ", " + basis_title(time.trial) + ":" +
           basis_title(time.weight) + ", " + std::to_string(time.functions) + " functions, " +
           structure_title(scene);
  }
  if (scene.analysis.type == AnalysisType::nonlinear_mode)
    return "Mode " + std::to_string(scene.analysis.mode) +
           ", N = " + std::to_string(scene.analysis.harmonics) +
           ", m = " + std::to_string(scene.analysis.samples) + ", " + structure_title(scene);
  if (scene.analysis.type == AnalysisType::time_stepping) return "time stepping";
  if (solves_by_impacts(scene)) return "impacts, " + structure_title(scene);
  if (solves_exactly(scene) || scene.analysis.exact)
    return "exact periodic solution" + std::string(is_sweep(scene.analysis.type) ? "s" : "");
  return basis_title(scene.time.trial) + ":" + basis_title(scene.time.weight) + ", " +
         std::to_string(scene.time.functions) + " functions";
}

Figure response_figure(const Scene& scene, const Response& response) {
  Scene solved = scene;
  solved.time = solved_time(scene.time, response);
  if (response.solved_by == name_of(TimeMethod::exact)) solved.time.method = TimeMethod::exact;
  return motion_figure(solved, response, scene.forcing.frequency);
}

Figure motion_figure(const Scene& scene, const Response& response, double frequency) {
  Figure figure;
  figure.title = method_title(scene) + ", " + quantity(frequency, "Hz", 6);
  if (response.recorded)
    figure.title += ", the last period before recording";
  else if (!response.converged)
    figure.title += " (NOT CONVERGED)";
  figure.panel_height = 240;
  figure.panel_width = 600;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const SceneContact& contact = contacts.at(static_cast<std::size_t>(response.contact));
  const PeriodWindow window(response);
  const MotionPicture picture{response, window, contact_spans(scene, response, window),
                              contacts.size() > 1 ? ", " + plain(name_of(contact)) : ""};
  const std::string unit = displacement_unit(scene, contact);
  add_motion(figure, picture, "Displacement", unit, response.displacement());
  if (response.impacts || !response.struck.empty()) {
    add_velocity_with_jumps(figure, window, "Velocity" + picture.name, response.struck, response.contact,
                            response.velocity());
    add_impulses(figure, window, "Impulses of impacts" + picture.name, response.struck, response.contact);
  } else {
    add_motion(figure, picture, "Velocity", unit + "/s", response.velocity());
  }
  if (response.forces_are_known())
    add_motion(figure, picture,
               has_friction(contact.law) && contact.place > 0 ? "Friction force" : "Contact force",
               force_unit(unit), response.force());
  if (has_gap(contact.law) && !has_friction(contact.law)) {
    const Scale scale = axis_scale(response.displacement().cwiseAbs().maxCoeff());
    figure.panels.front().mark_level(scale.factor * contact.gap, "gap", quantity(contact.gap, unit));
  }
  add_friction(figure, scene, response, window);
  return figure;
}

Figure sweep_figure(const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs) {
  Figure figure;
  figure.title = method_title(scene);
  if (scene.analysis.type == AnalysisType::amplitude_sweep)
    figure.title += ", " + quantity(scene.forcing.frequency, "Hz", 6);
  if (!sweep.converged()) figure.title += " (INCOMPLETE: " + plain(sweep.status()) + ")";
  figure.panel_width = 660;  // two names of "half peak to peak, unstable" fit into one row of the legend
  figure.panel_height = 420;
  const std::optional<std::size_t> output = leading_output(outputs.outputs, scene);
  const bool about_a_mean = vibrates_about_a_mean(scene);
  const std::string unit = displacement_unit(scene);
  if (output || about_a_mean) figure.panels.push_back(vibration_panel(sweep, outputs, output, unit));
  if (output && about_a_mean) figure.panels.push_back(vibration_panel(sweep, outputs, std::nullopt, unit));
  // A rigid obstacle leaves a line at its gap, and without gaps the vibration of the contacts is enough.
  const bool is_shown = !about_a_mean || has_gaps(scene);
  if (is_shown && !is_rigid(scene.contact.law)) add_displacements_along(figure, scene, sweep);
  if (!sweep.impacts.empty()) {
    add_impacts_along(figure, sweep, &PointImpacts::largest_impulse, "Impulses of impacts",
                      force_unit(unit) + " s");
    add_impacts_along(figure, sweep, &PointImpacts::largest_speed, "Speeds of impacts", unit + "/s");
  }
  if (figure.panels.size() == 1)
    figure.panels.front().title = "";
  else
    figure.panel_height = 320;
  scale_amplitudes(figure, sweep_axis(sweep));
  if (scene.plot.log) take_logarithmic_ordinates(figure);
  return figure;
}

}  // namespace wavebalance::app
