#pragma once
#include "wavebalance/report/artefact.hpp"

/// What the blade is computed for beyond the papers, each a function that makes one figure.
namespace wavebalance::blade {

void campbell_diagram(report::Artefact& artefact);
void forced_response(report::Artefact& artefact);

}  // namespace wavebalance::blade
