#include "wavebalance/app/attractors/bifurcation.hpp"

#include "attractors/flow_rows.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/solvers/attractors/long_motion.hpp"

namespace wavebalance::app {
namespace {

/// Whether successive points are nearer to each other in the last quarter of a section than in the first.
/// This holds for transients, not for chaotic or quasi-periodic motions.
bool comes_nearer(const Eigen::MatrixXd& section) {
  constexpr double nearer = 0.25;
  const Eigen::Index moves = section.cols() - 1, quarter = moves / 4;
  const Eigen::MatrixXd change = section.rightCols(moves) - section.leftCols(moves);
  return change.rightCols(quarter).norm() < nearer * change.leftCols(quarter).norm();
}

/// A sine is missed by 3e-4 of its amplitude at most.
constexpr int samples_of_a_period = 128;

std::vector<double> values_of(const Scene& scene) {
  const auto [from, to] = sweep_interval(scene.analysis);
  const int count = scene.analysis.values;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

/// The value of each step: all on the way there, and on the way back again.
std::vector<std::pair<double, bool>> steps_of(const Scene& scene) {
  const std::vector<double> values = values_of(scene);
  std::vector<std::pair<double, bool>> steps;
  for (const double value : values) steps.emplace_back(value, true);
  if (scene.analysis.both_ways)
    for (auto value = values.rbegin(); value != values.rend(); ++value) steps.emplace_back(*value, false);
  return steps;
}

/// The flow at one value after the other, each from where the one before has ended.
class PassedValues {
 public:
  PassedValues(const Scene& scene, FlowRows& rows, const Observer& observer)
      : scene_(scene), rows_(rows), observer_(observer) {}

  /// Nothing where the observer stops it.
  std::optional<DiagramValue> at(double value, bool forwards, double done, double share) {
    const solvers::ExactProblem problem = rows_.at(value);
    auto flow = std::make_unique<solvers::ContactFlow>(problem);
    if (before_) flow->start(*before_);
    solvers::LongMotionOptions options;
    options.transient = scene_.analysis.transient_periods;
    options.recorded = scene_.analysis.section_points;
    options.points = samples_of_a_period;
    options.observer = [&](const Progress& progress) {
      return solvers::goes_on(observer_, {"bifurcation diagram", progress.step, value,
                                          forwards ? "forward" : "backward", done + share * progress.done});
    };
    DiagramValue result{.value = value, .forwards = forwards};
    const solvers::LongMotion motion = solvers::long_motion(
        *flow, options, [&](const solvers::ContactFlow& passed, const solvers::Motion& period) {
          widen(result, solvers::reach_of(passed, period));
        });
    if (motion.cancelled) return std::nullopt;
    if (motion.ended != solvers::FlowStatus::converged) {
      result.failure = to_string(motion.ended);
      before_ = nullptr;
      return result;
    }
    result.displacement = motion.displacement;
    result.velocity = motion.velocity;
    result.period = solvers::section_period(motion, options.recorded / 4, scene_.analysis.section_tolerance,
                                            flow->length(), problem.frequency);
    result.settles = result.period == 0 && comes_nearer(motion.displacement);
    if (result.period == 0 && !result.settles)
      result.curve = solvers::invariant_curve(solvers::section_points(motion, problem.frequency),
                                              largest_curve_residual);
    before_ = std::move(flow);
    return result;
  }

 private:
  static void widen(DiagramValue& value, const solvers::Reach& reach) {
    const bool first = value.highest.size() == 0;
    value.highest = first ? reach.highest : Eigen::VectorXd(value.highest.cwiseMax(reach.highest));
    value.lowest = first ? reach.lowest : Eigen::VectorXd(value.lowest.cwiseMin(reach.lowest));
  }

  const Scene& scene_;
  FlowRows& rows_;
  const Observer& observer_;
  std::unique_ptr<solvers::ContactFlow> before_;
};

/// The contact whose section reaches farthest.
int widest_place(const Diagram& diagram) {
  Eigen::VectorXd least, most;
  for (const DiagramValue& one : diagram.values) {
    if (one.displacement.size() == 0) continue;
    const Eigen::VectorXd low = one.displacement.rowwise().minCoeff(),
                          high = one.displacement.rowwise().maxCoeff();
    least = least.size() == 0 ? low : Eigen::VectorXd(least.cwiseMin(low));
    most = most.size() == 0 ? high : Eigen::VectorXd(most.cwiseMax(high));
  }
  Eigen::Index widest = 0;
  if (least.size() > 0) (most - least).maxCoeff(&widest);
  return int(widest);
}

/// The scene as a sweep by exact motions over the same interval.
std::optional<Scene> exact_scene(const Scene& scene) {
  SceneChange change{.analysis = is_over_amplitude(scene.analysis) ? "amplitude_sweep" : "frequency_sweep",
                     .unset = {"analysis.outputs", "analysis.contact_outputs"}};
  if (!solves_by_impacts(scene)) change.set.emplace_back("analysis.exact=true");
  change.set.emplace_back("analysis.stability=true");
  std::optional<Scene> swept = changed_scene(scene, change);
  if (swept && solves_by_impacts(scene)) swept->analysis.branches = true;  // from period doublings
  return swept;
}

int unstable_at(const Sweep& sweep, std::size_t branch, std::size_t point) {
  const auto& points = sweep.balances_of(branch).points;
  return point < points.size() ? points[point].unstable : -1;
}

/// After the rows of other curves of the diagram.
void add_exact_lines(const Sweep& sweep, int place, Diagram& diagram) {
  const int first = diagram.exact.empty() ? 0 : diagram.exact.back().branch + 1;
  for (std::size_t branch = 0; branch < sweep.exact_motions.size(); ++branch) {
    const auto& motions = sweep.exact_motions[branch];
    if (motions.empty()) continue;
    const auto& points = sweep.curve_of(branch).points;
    const int periods = std::max(1, int(std::lround(points.front().frequency / motions.front().frequency())));
    for (int l = 0; l < periods; ++l) {
      ExactLine line{.branch = first + int(branch), .periods = periods};
      const Eigen::VectorXd begin = Eigen::VectorXd::Constant(1, double(l) / periods);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        line.value.push_back(parameter_of(points[i], sweep.curve.parameter));
        line.displacement.push_back(motions[i].displacement(begin)(place, 0));
        line.velocity.push_back(motions[i].velocity(begin)(place, 0));
        line.unstable.push_back(unstable_at(sweep, branch, i));
      }
      diagram.exact.push_back(std::move(line));
    }
  }
}

/// The same interval from its other end on.
Scene reversed(Scene scene) {
  std::swap(scene.analysis.frequency_from, scene.analysis.frequency_to);
  std::swap(scene.analysis.amplitude_from, scene.analysis.amplitude_to);
  return scene;
}

/// A curve that comes back to its first end, or ends within, omits the motions at the other end, which have
/// a separate curve.
void add_exact_curve(const Scene& scene, const StructureModel& model, const Observer& observer,
                     Diagram& diagram) {
  diagram.exact_status = "not_sought";
  if (!scene.analysis.exact_curve || diagram.places[std::size_t(diagram.place)].output) return;
  const std::optional<Scene> swept = exact_scene(scene);
  diagram.exact_status = "refused";
  if (!swept) return;
  const Sweep sweep = exact_sweep(*swept, model, observer);
  diagram.exact_status = sweep.status();
  add_exact_lines(sweep, diagram.place, diagram);
  if (sweep.curve.status == solvers::SweepStatus::reached_end || sweep.interrupted()) return;
  const Sweep back = exact_sweep(reversed(*swept), model, observer);
  diagram.exact_status_back = back.status();
  add_exact_lines(back, diagram.place, diagram);
}

void pass_values(const Scene& scene, FlowRows& rows, const Observer& observer, Diagram& diagram) {
  const auto steps = steps_of(scene);
  const double share = 1.0 / double(steps.size());
  PassedValues passed(scene, rows, observer);
  for (const auto& [value, forwards] : steps) {
    auto one = passed.at(value, forwards, share * double(diagram.values.size()), share);
    if (!one) {
      diagram.status = "interrupted";
      return;
    }
    if (!one->failure.empty()) diagram.status = "incomplete";
    diagram.values.push_back(*std::move(one));
  }
  const std::string grows(to_string(solvers::FlowStatus::grows));
  if (std::ranges::all_of(diagram.values, [&](const DiagramValue& one) { return one.failure == grows; }))
    diagram.status = grows;
}

}  // namespace

int points_shown(const DiagramValue& value) {
  return value.period > 0 ? value.period : int(value.displacement.cols());
}

Diagram bifurcation_diagram(const Scene& scene, const StructureModel& model, const Observer& observer) {
  const WallClock clock;
  Diagram diagram{.axis = sweep_axis(scene), .exact_status = "not_sought", .status = "no_modes"};
  FlowRows rows(scene, model);
  diagram.places = rows.places();
  if (rows.dynamics() == nullptr) return diagram;
  diagram.status = "converged";
  pass_values(scene, rows, observer, diagram);
  diagram.place = rows.has_outputs() ? rows.contacts() : widest_place(diagram);
  if (diagram.status != "interrupted") add_exact_curve(scene, model, observer, diagram);
  if (diagram.exact_status == "interrupted" || diagram.exact_status_back == "interrupted")
    diagram.status = "interrupted";
  diagram.wall_seconds = clock.seconds();
  return diagram;
}

}  // namespace wavebalance::app
