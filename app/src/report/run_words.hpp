#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

/// Results of a run in sentences: a failure first, then the motion or the curve, contact, isolas. `gap` in
/// m; NaN where contacts have different gaps or there are none. `axis` belongs to a sweep.
std::vector<std::string> finding_sentences(const Summary& summary, double gap, const SweepAxis& axis = {});

/// Why one may trust it: time and residual, the error, and whether other motions were searched for.
std::vector<std::string> accuracy_sentences(const Summary& summary);

/// Both, the solution first.
std::vector<std::string> outcome_sentences(const Summary& summary, double gap, const SweepAxis& axis = {});

/// Where each output vibrates most along a curve, or by how much in a motion, of a dozen of them.
std::vector<std::string> output_sentences(const Summary& summary, const SweepAxis& axis);

/// Stability, where it changes, and the unstable parts of branches, the most important first.
std::vector<std::string> stability_sentences(const Summary& summary, const SweepAxis& axis = {});

}  // namespace wavebalance::app
