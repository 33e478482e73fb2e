#pragma once
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::app {

/// The stability along a backbone of an elastic mode; without points otherwise, and where analysis.stability
/// is false.
solvers::BackboneStability stability_of(const ModeStudy& study, const Backbone& curve,
                                        const Observer& observer);

}  // namespace wavebalance::app
