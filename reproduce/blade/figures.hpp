#pragma once
#include <vector>

#include "wavebalance/report/program.hpp"

/// What the blade is computed for beyond the papers, each a function that makes one figure.
namespace wavebalance::blade {

void campbell_diagram(report::Artefact& artefact);
void forced_response(report::Artefact& artefact);

/// What the program blade makes.
const std::vector<report::Step>& figures();

}  // namespace wavebalance::blade
