#pragma once
#include "convergence.hpp"

/// The statements of JL14 on Fig. 11, held against the relative errors of all pairs.
namespace wavebalance::jl14 {

/// Section 5.5, in its order.
void claim_errors(report::Artefact& artefact, const Convergence& errors);
/// Section 5.5 on the middle of the Haar cells; `midpoints` are the errors there.
void claim_midpoints(report::Artefact& artefact, const Convergence& midpoints, const Convergence& errors);
/// The abstract on the Petrov-Galerkin pairs.
void claim_abstract(report::Artefact& artefact, const Convergence& errors);

}  // namespace wavebalance::jl14
