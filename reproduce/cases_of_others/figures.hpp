#pragma once
#include <vector>

#include "wavebalance/report/program.hpp"

namespace wavebalance::cases {

void pyharm_onedofgap(report::Artefact& artefact);
void nlvib_example03(report::Artefact& artefact);
void oscillator_with_stop(report::Artefact& artefact);
void small_gap_bar(report::Artefact& artefact);
void lightly_damped_bar(report::Artefact& artefact);
void impact_oscillator(report::Artefact& artefact);
void slider(report::Artefact& artefact);
void den_hartog(report::Artefact& artefact);

/// What the program cases_of_others makes.
const std::vector<report::Step>& figures();

}  // namespace wavebalance::cases
