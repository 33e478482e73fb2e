#pragma once
#include <vector>

#include "convergence.hpp"

/// The statements of JL14 on the errors of the tip displacement, section 5.5, and on their convergence.
namespace wavebalance::jl14 {

void state_errors(report::Artefact& artefact, const std::vector<Convergence>& all);
void state_haar_errors(report::Artefact& artefact, const std::vector<Convergence>& all);
void state_similar_trends(report::Artefact& artefact, const std::vector<Convergence>& all);
void state_abstract(report::Artefact& artefact, const std::vector<Convergence>& all);
void state_conclusions(report::Artefact& artefact, const std::vector<Convergence>& all);

}  // namespace wavebalance::jl14
