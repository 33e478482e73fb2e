#include "outputs/peaks.hpp"

#include "outputs/point_measurer.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::app {
namespace {

/// Half the peak-to-peak value of an output, or its largest modulus, between the samples, too.
double height_of(const OutputMeasures& measures, bool vibration) {
  return vibration ? 0.5 * (measures.highest - measures.lowest)
                   : std::max(measures.highest, -measures.lowest);
}

/// Solves for the highest points of outputs along a sweep.
class PeakSolver {
 public:
  PeakSolver(const Scene& scene, const StructureModel& model, const SweepOutputs& found, const Sweep& sweep)
      : found_(found),
        sweep_(sweep),
        exact_(!sweep.exact_motions.empty()),
        dynamics_(exact_ ? model.contact_dynamics() : nullptr),
        problem_(problem_of(scene, model, sweep)),
        measurer_(scene, model, found.outputs, problem_of(scene, model, sweep),
                  exact_ ? sweep.periods : scene.analysis.subharmonic) {}

  OutputPeak operator()(std::size_t output, bool vibration) {
    OutputPeak peak;
    const std::optional<std::size_t> index = highest(found_.curves[0], output, vibration);
    if (!index) return peak;
    peak.at.value = parameter_of(sweep_.curve.points[*index], sweep_.curve.parameter);
    peak.measures = found_.curves[0][*index][output];
    peak.at.height = height_of(peak.measures, vibration);
    if (!(peak.at.height > 0.0) || found_.outputs[output].is_contact()) return peak;
    if (*index == 0 || *index + 1 >= found_.curves[0].size()) return peak;  // at an end of the curve
    return exact_ ? between_exact(peak, *index, output, vibration) : between(*index, output, vibration);
  }

 private:
  static solvers::ContactProblem problem_of(const Scene& scene, const StructureModel& model,
                                            const Sweep& sweep) {
    if (sweep.exact_motions.empty()) return compose_problem(scene, model);
    solvers::ContactProblem problem = exact_problem(scene, model);
    return sweep.periods == 1 ? std::move(problem) : problem.over_periods(sweep.periods);
  }

  OutputPeak between(std::size_t index, std::size_t output, bool vibration) {
    const solvers::FrequencySweep& curve = sweep_.curve;
    const auto measured = [&](double value, const Eigen::VectorXd& unknown) {
      return measurer_.measured(curve, value, unknown)[output];
    };
    OutputPeak peak;
    peak.solved = true;
    peak.at = problem_.peak(curve, index, [&](double value, const Eigen::VectorXd& unknown) {
      return height_of(measured(value, unknown), vibration);
    });
    peak.measures = measured(peak.at.value, peak.at.unknown);
    return peak;
  }

  /// The curve is followed again from the point before with short steps, and the polynomial through the
  /// heights of its points has the maximum; the polynomial through two more points estimates its error.
  OutputPeak between_exact(const OutputPeak& sampled, std::size_t index, std::size_t output, bool vibration) {
    if (dynamics_ == nullptr) return sampled;
    if (!traced_.contains(index)) traced_[index] = followed_again(index, output, vibration);
    const std::vector<Traced>& points = traced_[index];
    std::vector<double> places, heights;
    for (const Traced& point : points) {
      places.push_back(point.value);
      heights.push_back(height_of(point.measures[output], vibration));
    }
    if (heights.empty()) return sampled;
    const auto top = std::size_t(std::ranges::max_element(heights) - heights.begin());
    constexpr double rounding = 1e-7;
    const auto narrow = polynomial_peak(places, heights, top, 2),
               wide = polynomial_peak(places, heights, top, 3);
    if (!narrow || !wide || heights[top] < sampled.at.height * (1.0 - rounding)) return sampled;
    OutputPeak peak;
    peak.solved = true;
    peak.measures = points[top].measures[output];
    peak.at.value = wide->place;
    peak.at.height = wide->height;
    peak.at.value_error = std::abs(wide->place - narrow->place);
    peak.at.height_error = std::abs(wide->height / narrow->height - 1.0);
    return peak;
  }

  struct Traced {
    double value;
    MeasuredPoint measures;
  };

  /// Past the neighbours of a point in some twenty steps.
  std::vector<Traced> followed_again(std::size_t index, std::size_t output, bool vibration) {
    const auto& points = sweep_.curve.points;
    const auto value = [&](std::size_t i) { return parameter_of(points[i], sweep_.curve.parameter); };
    const auto height = [&](std::size_t i) { return height_of(found_.curves[0][i][output], vibration); };
    const std::size_t from = index - 1;
    const double extent =
        std::max({std::abs(value(index) - value(from)), std::abs(value(index + 1) - value(index)),
                  1e-9 * std::abs(value(index))});
    double length = 0.0;
    for (const std::size_t i : {from, index})
      length += std::hypot((value(i + 1) - value(i)) / extent, height(i + 1) / height(i) - 1.0);
    const double ahead = from > 0 ? value(from) - value(from - 1) : value(index) - value(from);
    const double reach = std::min(100.0 * extent, 0.9 * value(from));
    const bool by_map = !sweep_.friction.empty();  // whose points need tens of milliseconds and more
    solvers::ExactCurveOptions options;
    options.from = value(from);
    options.to = value(from) + (ahead < 0.0 ? -reach : reach);
    options.behind = value(from) - (ahead < 0.0 ? -reach : reach);
    options.parameter_scale = extent;
    options.largest_step = length / (by_map ? 8.0 : 20.0);
    options.first_step = 0.5 * options.largest_step;
    options.max_points = by_map ? 24 : 120;
    options.stability = false;
    solvers::CondensedProblem& condensed = problem_.condensed();
    condensed.set_load_scale(condensed.full_load());
    if (sweep_.curve.parameter == solvers::SweepParameter::load_scale) condensed.set_load_scale(value(from));
    condensed.set_load_frequency(points[from].frequency);
    const solvers::ProblemFamily family(condensed, problem_.laws(), *dynamics_, sweep_.curve.parameter);
    const solvers::ExactCurve near = solvers::exact_curve(family, sweep_.exact_motions[0][from], options);
    std::vector<Traced> traced;
    for (const solvers::ExactPoint& point : near.points)
      traced.push_back({point.value, measurer_(sweep_point_at(point.value), point.motion)});
    return traced;
  }

  solvers::SweepPoint sweep_point_at(double value) const {
    solvers::SweepPoint point = sweep_.curve.points.front();
    (sweep_.curve.parameter == solvers::SweepParameter::frequency ? point.frequency : point.load_scale) =
        value;
    return point;
  }

  const SweepOutputs& found_;
  const Sweep& sweep_;
  bool exact_;
  const solvers::ContactDynamics* dynamics_;
  solvers::ContactProblem problem_;
  PointMeasurer measurer_;
  std::map<std::size_t, std::vector<Traced>> traced_;  // near a point of the curve, of all outputs
};

}  // namespace

std::optional<std::size_t> highest(const std::vector<MeasuredPoint>& points, std::size_t output,
                                   bool vibration) {
  std::optional<std::size_t> best;
  const auto value = [&](std::size_t i) { return height_of(points[i][output], vibration); };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].empty() && (!best || value(i) > value(*best))) best = i;
  return best;
}

/// Only for analysis.outputs.
void solve_for_peaks(const Scene& scene, const StructureModel& model, SweepOutputs& found, const Sweep& sweep,
                     const Observer& observer) {
  if (scene.analysis.outputs.empty() ||
      sweep.curve.points.front().unknown.size() + sweep.exact_motions.size() == 0)
    return;
  PeakSolver solver(scene, model, found, sweep);
  for (std::size_t i = 0; i < scene.analysis.outputs.size(); ++i) {
    if (!goes_on(observer, {"peaks of outputs", int(i)})) return;
    found.peaks.push_back(solver(i, true));
    found.largest.push_back(solver(i, false));
  }
}

}  // namespace wavebalance::app
