#include "wavebalance/app/analysis/curve_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "analysis/motion_files.hpp"
#include "analysis/stability.hpp"
#include "analysis/summary_parts.hpp"
#include "analysis/sweep_options.hpp"
#include "wavebalance/app/analysis/contact_motion.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/response/curve_responses.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::app {
namespace {

/// Measures responses of the curve of `sweep`, whose frequencies are those of the problem while it lives.
class MotionsOfCurve {
 public:
  MotionsOfCurve(const Scene& scene, const StructureModel& model, Sweep& sweep)
      : scene_(scene), model_(model), sweep_(sweep), composed_(compose_problem(scene, model)) {
    scale(1.0 / sweep_.periods);
  }
  ~MotionsOfCurve() { scale(sweep_.periods); }
  MotionsOfCurve(const MotionsOfCurve&) = delete;
  MotionsOfCurve& operator=(const MotionsOfCurve&) = delete;

  CurveMotion peak() {
    const auto& points = sweep_.curve.points;
    const auto highest = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
      return a.max_displacement < b.max_displacement;
    });
    return measured("peak", at(highest->frequency, highest->unknown));
  }

  std::vector<CurveMotion> special() {
    std::vector<CurveMotion> motions;
    for (const auto& point : sweep_.stability.special_points)
      motions.push_back(
          measured(std::string(to_string(point.type)), at(point.unknown_parameter, point.unknown)));
    return motions;
  }

  std::vector<CurveMotion> at_frequency(double frequency) {
    std::vector<CurveMotion> motions;
    for (const auto& one :
         solvers::responses_at(composed_.problem, composed_.laws, sweep_.curve, frequency / sweep_.periods)) {
      motions.push_back(measured("frequency", one));
      motions.back().frequency = frequency;
    }
    return motions;
  }

 private:
  void scale(double factor) {
    if (factor == 1.0) return;
    scale_frequencies(sweep_.curve, factor);
    scale_frequencies(sweep_.stability, factor);
  }

  solvers::PeriodicResponse at(double frequency, const Eigen::VectorXd& unknown) {
    return solvers::curve_response(composed_.problem, composed_.laws, sweep_.curve, frequency, unknown);
  }

  CurveMotion measured(std::string at, const solvers::PeriodicResponse& response) {
    CurveMotion motion;
    motion.at = std::move(at);
    motion.frequency = response.frequency * sweep_.periods;
    motion.converged = response.converged();
    motion.residual = response.residual;
    motion.contacts =
        solvers::contact_motion(composed_.problem, response, composed_.laws, scene_.analysis.output_points);
    motion.contact = leading_contact(motion.contacts, model_.gaps);
    if (scene_.analysis.motion_points > 0)
      motion.structure =
          solvers::structure_motion(composed_.problem, response.contact_force, scene_.analysis.motion_points)
              .displacement;
    motion.stability.status.clear();
    if (scene_.analysis.stability && motion.converged)
      motion.stability = response_stability(composed_.problem, composed_.laws, response, model_.structure);
    return motion;
  }

  const Scene& scene_;
  const StructureModel& model_;
  Sweep& sweep_;
  ComposedProblem composed_;
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
  std::vector<Cell> row{motion.name + ".csv", motion.at, motion.frequency};
  for (const auto& [name, value] : values) row.emplace_back(std::get<double>(value));
  row.emplace_back(motion.stability.unstable < 0 ? missing : double(motion.stability.unstable));
  row.emplace_back(motion.residual);
  row.emplace_back(motion.converged);
  return row;
}

std::string place_of(const CurveMotion& motion) {
  if (motion.at == "frequency") return fmt::format("at {} Hz", cell_text(motion.frequency));
  std::string type = motion.at;
  std::replace(type.begin(), type.end(), '_', ' ');
  return fmt::format("at the {}, {:.7g} Hz", type, motion.frequency);
}

void append_files(Record& record, const StructureModel& model, const CurveMotion& motion) {
  const std::string about = "motion of the curve " + place_of(motion);
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

std::vector<CurveMotion> curve_motions(const Scene& scene, const StructureModel& model, Sweep& sweep) {
  const MotionAt& wanted = scene.analysis.motion_at;
  std::vector<CurveMotion> motions;
  if (wanted.empty() || sweep.curve.points.empty()) return motions;
  MotionsOfCurve curve(scene, model, sweep);
  if (wanted.peak) {
    motions.push_back(curve.peak());
    motions.back().name = "motion_peak";
  }
  if (wanted.special) {
    std::map<std::string, int> counts;
    for (CurveMotion& motion : curve.special()) {
      motion.name = fmt::format("motion_{}_{}", motion.at, ++counts[motion.at]);
      motions.push_back(std::move(motion));
    }
  }
  for (const double frequency : wanted.frequencies)
    append_numbered(motions, curve.at_frequency(frequency), fmt::format("motion_{}Hz", cell_text(frequency)));
  return motions;
}

void append_motions(Record& record, const Scene& scene, const StructureModel& model,
                    const std::vector<CurveMotion>& motions) {
  if (scene.analysis.motion_at.empty()) return;
  Table table({"file", "at", "frequency_Hz", "max_displacement_m", "min_displacement_m", "rms_displacement_m",
               "max_contact_force_N", "contact_fraction", "unstable_multipliers", "residual", "converged"});
  for (const CurveMotion& motion : motions) {
    table.append_row(row_of(motion));
    append_files(record, model, motion);
    if (!motion.converged)
      record.warnings.push_back("The motion " + place_of(motion) + " was not solved for to the tolerance: " +
                                motion.name + ".csv holds the last iterate.");
  }
  for (const double frequency : scene.analysis.motion_at.frequencies)
    if (std::none_of(motions.begin(), motions.end(), [&](const CurveMotion& motion) {
          return motion.at == "frequency" && motion.frequency == frequency;
        }))
      record.warnings.push_back(
          fmt::format("analysis.motion_at: the curve does not reach {} Hz; no motion is written for it.",
                      cell_text(frequency)));
  record.summary.emplace_back("motions", std::move(table));
}

}  // namespace wavebalance::app
