#pragma once
#include "wavebalance/report/artefact.hpp"

/// Figures of the blade beyond the papers, one function each.
namespace wavebalance::blade {

void campbell_diagram(report::Artefact& artefact);
void forced_response(report::Artefact& artefact);

}  // namespace wavebalance::blade
