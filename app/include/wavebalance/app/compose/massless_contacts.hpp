#pragma once
#include "wavebalance/app/compose/structure_model.hpp"

namespace wavebalance::app {

/// Replaces the structure by solvers::with_massless_contacts() with its `modes` lowest modes. Throws the
/// same errors. O(n^3).
void make_contacts_massless(StructureModel& model, int modes);

/// Largest relative difference of the first ten natural frequencies of two structures without contact, of as
/// many as both have; NaN beyond 1000 degrees of freedom. O(n^3).
double frequency_change(const solvers::LinearStructure& from, const solvers::LinearStructure& to);

}  // namespace wavebalance::app
