#pragma once
#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The table with the columns of all outputs. Rows have those of their points, null or empty where they were
/// not measured.
Table with_outputs(const Table& table, const std::vector<Output>& outputs,
                   const std::vector<const MeasuredPoint*>& points, int harmonics);

/// Puts the output that leads and what is known of each of analysis.outputs right behind how the run ended.
void insert_outputs(Summary& summary, const Scene& scene, const std::vector<Output>& outputs,
                    Summary entries);

/// Adds the columns of the outputs to the record's sweep table, which is complete, their peaks to its
/// summary, and their picture.
void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs);

/// Adds the motion of the scene's outputs over one period to the record, what is measured of them to its
/// summary, and their picture. The response has the structure's motion at all output_points instants. The
/// load is that of the scene or, of a free motion, none.
void append_outputs(Record& record, const Scene& scene, const StructureModel& model, const Response& response,
                    const LoadAt& load);

/// The same of a motion that does not repeat: what the recorded periods say of the outputs that are
/// displacements of a place, to the summary. One period alone gives no motion of the structure.
void append_outputs(Record& record, const Scene& scene, const RecordedMotion& motion);

/// Puts the motion of the leading output before that of the contacts in the record's picture.
void lead_with_output(Record& record, const Scene& scene);

}  // namespace wavebalance::app
