#pragma once
#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Adds the columns of the outputs to the record's sweep table, which is complete, their peaks to its
/// summary, and their picture.
void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs);

/// Adds the motion of the scene's outputs over one period to the record, what is measured of them to its
/// summary, and their picture. The response has the structure's motion at all output_points instants.
void append_outputs(Record& record, const Scene& scene, const StructureModel& model,
                    const Response& response);

/// The same of a motion that does not repeat: what the recorded periods say of the outputs that are
/// displacements of a place, to the summary. One period alone gives no motion of the structure.
void append_outputs(Record& record, const Scene& scene, const RecordedMotion& motion);

/// Puts the motion of the leading output before that of the contacts in the record's picture.
void lead_with_output(Record& record, const Scene& scene);

}  // namespace wavebalance::app
