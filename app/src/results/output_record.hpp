#pragma once
#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The table with the columns of all outputs. Rows have the values of their points, null or empty if not
/// measured.
Table with_outputs(const Table& table, const std::vector<Output>& outputs,
                   const std::vector<const MeasuredPoint*>& points, int harmonics);

/// Puts the output that leads and what is known of each of analysis.outputs right behind how the run ended.
void insert_outputs(Summary& summary, const Scene& scene, const std::vector<Output>& outputs,
                    Summary entries);

/// Adds the columns of the outputs to the record's sweep table, which is complete, their peaks to its
/// summary, and their picture.
void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs);

/// Adds the motion of the scene's outputs over one period to the record, their measures to its summary, and
/// their picture. The response has the structure's motion at all output_points instants. The load is the
/// scene's, or none for a free motion.
void append_outputs(Record& record, const Scene& scene, const StructureModel& model, const Response& response,
                    const LoadAt& load);

/// The same for a motion that does not repeat: the summary gets the statistics of outputs that are
/// displacements. One period does not determine the motion of the structure.
void append_outputs(Record& record, const Scene& scene, const RecordedMotion& motion);

/// Puts the motion of the first output before the contacts in the record's picture.
void lead_with_output(Record& record, const Scene& scene);

}  // namespace wavebalance::app
