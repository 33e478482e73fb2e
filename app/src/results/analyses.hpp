#pragma once

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

/// The solver of each analysis. The rest of the program needs only this, its row of analysis_kinds, its
/// keys and its rules.
namespace wavebalance::app {

/// forced_response and shooting.
Record forced_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// frequency_sweep and amplitude_sweep, with stability, exact solutions and isolas.
Record curve_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// time_stepping, with the statistics of aperiodic motions.
Record stepping_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// The table `motions` in the summary, and the files of each.
Record motions_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// nonlinear_mode: a curve or one motion.
Record mode_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// The same with friction or dampers: frequency and damping over the amplitude.
Record damped_mode_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// limit_cycle: a response at the frequency of the cycle, with period, multipliers and starts.
Record limit_cycle_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);
/// The points of a diagram as the table `section`, intervals of equal period and of hysteresis in the
/// summary, and the exact curve in exact_curve.csv.
Record diagram_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how);

/// The lines of describe_scene() on how motions are found.
std::string stepping_plan(const Scene& scene);
std::string motions_plan(const Scene& scene);
std::string limit_cycle_plan(const Scene& scene);
std::string diagram_plan(const Scene& scene);

/// The functions of an analysis.
struct AnalysisPart {
  AnalysisType type;
  Record (*record)(const Scene&, const StructureModel&, const AnalysisOptions&);
  std::string (*plan)(const Scene&) = nullptr;  ///< none where equations of functions or modes are solved
};
inline constexpr std::array<AnalysisPart, 9> analysis_parts{{
    {AnalysisType::forced_response, forced_record},
    {AnalysisType::frequency_sweep, curve_record},
    {AnalysisType::amplitude_sweep, curve_record},
    {AnalysisType::time_stepping, stepping_record, stepping_plan},
    {AnalysisType::shooting, forced_record},
    {AnalysisType::motions, motions_record, motions_plan},
    {AnalysisType::nonlinear_mode, mode_record},
    {AnalysisType::limit_cycle, limit_cycle_record, limit_cycle_plan},
    {AnalysisType::bifurcation_diagram, diagram_record, diagram_plan},
}};
const AnalysisPart& part_of(AnalysisType type);

}  // namespace wavebalance::app
