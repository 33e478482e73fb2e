#pragma once
#include <vector>

#include "wavebalance/report/program.hpp"

/// The tables of the extremes, each a function that makes it.
namespace wavebalance::extremes {

void family_table(report::Artefact& artefact);
void daubechies_table(report::Artefact& artefact);

/// What the program extremes makes.
const std::vector<report::Step>& tables();

}  // namespace wavebalance::extremes
