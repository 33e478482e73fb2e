#include "wavebalance/app/analysis/sweep.hpp"

#include <fmt/format.h>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {
namespace {

/// Measures responses of the curve of `sweep`.
class MotionsOfCurve {
 public:
  MotionsOfCurve(const Scene& scene, const StructureModel& model, const Sweep& sweep)
      : scene_(scene), model_(model), sweep_(sweep), problem_(compose_problem(scene, model)) {}

  CurveMotion peak() {
    if (sweep_.solved_peak) return measured("peak", sweep_.solved_peak->value, sweep_.solved_peak->unknown);
    const solvers::SweepPoint& highest = sweep_.curve.points[sweep_.peak()];
    return measured("peak", parameter_of(highest, sweep_.curve.parameter), highest.unknown);
  }

  CurveMotion special(std::size_t index) {
    const auto& point = sweep_.stability.special_points[index];
    return measured(std::string(to_string(point.type)), point.unknown_parameter, point.unknown);
  }

  /// At a frequency or amplitude of the load.
  std::vector<CurveMotion> at_place(double place) {
    std::vector<CurveMotion> motions;
    for (const auto& response : problem_.responses_at(sweep_.curve, place))
      motions.push_back(measured(over_amplitude_ ? "amplitude" : "frequency", place, response));
    return motions;
  }

 private:
  CurveMotion measured(std::string at, double value, const Eigen::VectorXd& unknown) {
    return measured(std::move(at), value, problem_.response(sweep_.curve, value, unknown));
  }

  CurveMotion measured(std::string at, double place, const solvers::PeriodicResponse& response) {
    CurveMotion motion;
    motion.at = std::move(at);
    motion.place = place;
    motion.converged = response.converged();
    motion.residual = response.residual;
    motion.contacts = problem_.motion(response, scene_.analysis.output_points);
    motion.contact = leading_contact(scene_, motion.contacts, model_.gaps);
    if (scene_.analysis.motion_points > 0)
      motion.structure = problem_.structure_motion(response, scene_.analysis.motion_points).displacement;
    if (model_.plane.size() > 0)
      motion.plane =
          model_.plane * problem_.structure_motion(response, scene_.analysis.output_points).displacement;
    motion.stability.status.clear();
    if (!motion.converged || !(scene_.analysis.stability || scene_.analysis.exact_near)) return motion;
    std::optional<solvers::ExactNearResponse> near = solvers::exact_near(problem_, response);
    if (near) motion.exact = {near->motion.status, near->displacement_error, near->force_error, {}, 0, {}};
    if (scene_.analysis.stability)
      motion.stability = problem_.stability(response, near ? &near->motion : nullptr);
    if (near && near->motion.parts != nullptr) motion.near = std::move(near);
    return motion;
  }

  const Scene& scene_;
  const StructureModel& model_;
  const Sweep& sweep_;
  solvers::ContactProblem problem_;
  const bool over_amplitude_ = sweep_.curve.parameter == solvers::SweepParameter::load_scale;
};

void append_numbered(std::vector<CurveMotion>& all, std::vector<CurveMotion> motions,
                     const std::string& stem) {
  const bool several = motions.size() > 1;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    motions[i].name = several ? fmt::format("{}_{}", stem, i + 1) : stem;
    all.push_back(std::move(motions[i]));
  }
}

}  // namespace

std::vector<CurveMotion> curve_motions(const Scene& scene, const StructureModel& model, Sweep& sweep,
                                       const Observer& observer) {
  const MotionAt& wanted = scene.analysis.motion_at;
  std::vector<CurveMotion> motions;
  if (wanted.empty() || sweep.curve.points.empty()) return motions;
  MotionsOfCurve curve(scene, model, sweep);
  const auto goes_on_to = [&](const std::string& motion) {
    const bool stopped = sweep.stopped() || !goes_on(observer, {"motions", int(motions.size())});
    if (stopped) sweep.motions_left_out.push_back(motion);
    return !stopped;
  };
  if (wanted.peak && goes_on_to("peak")) {
    motions.push_back(curve.peak());
    motions.back().name = "motion_peak";
  }
  if (wanted.special) {
    std::map<std::string, int> counts;
    for (std::size_t i = 0; i < sweep.stability.special_points.size(); ++i) {
      const std::string type(to_string(sweep.stability.special_points[i].type));
      const std::string name = fmt::format("{}_{}", type, ++counts[type]);
      if (!goes_on_to(name)) continue;
      motions.push_back(curve.special(i));
      motions.back().name = "motion_" + name;
    }
  }
  for (const double place : wanted.places) {
    const std::string name = cell_text(place) + sweep_axis(sweep).suffix;
    if (goes_on_to(name)) append_numbered(motions, curve.at_place(place), "motion_" + name);
  }
  return motions;
}

}  // namespace wavebalance::app
