#pragma once
#include <vector>

#include "curves.hpp"

/// Statements of LL10 on the rod's frequencies, section 5.1 with its equations, and the findings.
namespace wavebalance::ll10 {

/// Adds the statements that Fig. 3 decides.
void rod_statements(report::Artefact& artefact, const RodCurves& curves);

}  // namespace wavebalance::ll10
