#include "wavebalance/app/analysis/curve_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "analysis/motion_files.hpp"
#include "analysis/summary_parts.hpp"
#include "analysis/sweep_axis.hpp"
#include "wavebalance/app/analysis/contact_motion.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

/// Measures responses of the curve of `sweep`.
class MotionsOfCurve {
 public:
  MotionsOfCurve(const Scene& scene, const StructureModel& model, const Sweep& sweep)
      : scene_(scene), model_(model), sweep_(sweep), problem_(compose_problem(scene, model)) {}

  CurveMotion peak() {
    const auto& points = sweep_.curve.points;
    const auto highest = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
      return a.max_displacement < b.max_displacement;
    });
    return measured("peak", parameter_of(*highest, sweep_.curve.parameter), highest->unknown);
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
    motion.contact = leading_contact(motion.contacts, model_.gaps);
    if (scene_.analysis.motion_points > 0)
      motion.structure =
          problem_.structure_motion(response, scene_.analysis.motion_points).displacement;
    motion.stability.status.clear();
    if (scene_.analysis.stability && motion.converged)
      motion.stability = problem_.stability(response);
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

std::vector<Cell> row_of(const CurveMotion& motion) {
  const solvers::Motion leading = motion.contacts.contact(motion.contact);
  Summary values;
  append_motion(values, leading);
  std::vector<Cell> row{motion.name + ".csv", motion.at, motion.place};
  for (const auto& [name, value] : values) row.emplace_back(std::get<double>(value));
  row.emplace_back(motion.stability.unstable < 0 ? missing : double(motion.stability.unstable));
  row.emplace_back(motion.residual);
  row.emplace_back(motion.converged);
  return row;
}

std::string place_of(const CurveMotion& motion, const SweepAxis& axis) {
  if (motion.at == axis.quantity) return fmt::format("at {} {}", cell_text(motion.place), axis.unit);
  std::string type = motion.at;
  std::replace(type.begin(), type.end(), '_', ' ');
  return fmt::format("at the {}, {:.7g} {}", type, motion.place, axis.unit);
}

void append_files(Record& record, const StructureModel& model, const CurveMotion& motion,
                  const std::string& place) {
  const std::string about = "motion of the curve " + place;
  const bool several = motion.contacts.rows() > 1;
  record.files.push_back({motion.name + ".csv",
                          csv_text(response_table(motion.contacts.contact(motion.contact))),
                          about + (several ? ": the leading contact" : "")});
  if (several)
    record.files.push_back({motion.name + "_contacts.csv", csv_text(contacts_table(motion.contacts)),
                            about + ": every contact"});
  for (RecordFile& file : motion_files(model, motion.structure, motion.name)) {
    file.about = about + ": the whole structure";
    record.files.push_back(std::move(file));
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

void append_motions(Record& record, const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const std::vector<CurveMotion>& motions) {
  if (scene.analysis.motion_at.empty()) return;
  const SweepAxis axis = sweep_axis(sweep);
  Table table({"file", "at", axis.column(), "max_displacement_m", "min_displacement_m", "rms_displacement_m",
               "max_contact_force_N", "contact_fraction", "unstable_multipliers", "residual", "converged"});
  for (const CurveMotion& motion : motions) {
    table.append_row(row_of(motion));
    append_files(record, model, motion, place_of(motion, axis));
    if (!motion.converged)
      record.warnings.push_back("The motion " + place_of(motion, axis) +
                                " was not solved for to the tolerance: " + motion.name +
                                ".csv holds the last iterate.");
  }
  if (!sweep.motions_left_out.empty())
    record.warnings.push_back(
        fmt::format("analysis.motion_at: the sweep was interrupted before these motions were solved for: {}.",
                    fmt::join(sweep.motions_left_out, ", ")));
  for (const double place : scene.analysis.motion_at.places)
    if (sweep.motions_left_out.empty() &&
        std::none_of(motions.begin(), motions.end(), [&](const CurveMotion& motion) {
          return motion.at == axis.quantity && motion.place == place;
        }))
      record.warnings.push_back(
          fmt::format("analysis.motion_at: the curve does not reach {} {}; no motion is written for it.",
                      cell_text(place), axis.unit));
  record.summary.emplace_back("motions", std::move(table));
}

}  // namespace wavebalance::app
