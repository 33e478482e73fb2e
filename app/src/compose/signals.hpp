#pragma once
#include "wavebalance/app/compose/structure_model.hpp"

namespace wavebalance::app {

/// Appends a degree of freedom for each periodic stiffness: a spring without mass, whose load makes it the
/// signal that the second row of the law is. O(entries).
void append_signals(solvers::LinearStructure& structure, const Scene& scene);
/// The same, and that it moves nothing of the whole structure.
void append_signals(StructureModel& model, const Scene& scene);

}  // namespace wavebalance::app
