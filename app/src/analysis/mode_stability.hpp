#pragma once
#include <string>

#include "wavebalance/app/analysis/analysis.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::app {

/// The word for a rigid obstacle, at which contacts with mass have no linearised motion.
inline constexpr const char* no_law_of_impact = "no_law_of_impact";

/// The stability along a backbone of an elastic mode; without points otherwise, and where analysis.stability
/// is false.
solvers::BackboneStability stability_of(const ModeStudy& study, const Backbone& curve,
                                        const Observer& observer);

/// The columns `unstable`, missing where it is not known, and `contacts` of a backbone_table() of the same
/// points, whose first rows are the linear ones. Without effect where there is no stability.
void add_stability(Table& table, const solvers::BackboneStability& stability);

/// The fields of a curve's stability.
void append_stability(Summary& summary, const ModeStudy& study, const solvers::BackboneStability& stability);

/// Those of one motion, and a warning where it is unstable.
void append_stability(Record& record, const ModeStudy& study, const solvers::ModePoint& point);

/// Frequency over energy, unstable parts dashed, with the special points.
void draw_stability(Figure& figure, const Table& backbone, const ModeStudy& study,
                    const solvers::BackboneStability& stability);

}  // namespace wavebalance::app
