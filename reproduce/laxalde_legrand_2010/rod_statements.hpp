#pragma once
#include <vector>

#include "curves.hpp"

/// What LL10 says of the rod's frequencies, section 5.1 and the equations behind it, and what is found.
namespace wavebalance::ll10 {

/// Adds the statements that Fig. 3 decides.
void rod_statements(report::Artefact& artefact, const RodCurves& curves);

}  // namespace wavebalance::ll10
