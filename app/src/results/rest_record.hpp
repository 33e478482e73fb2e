#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "wavebalance/app/compose/rest_state.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Adds the static deflection under static loads to the record's summary; nothing if it is zero.
void append_rest(Record& record, const Scene& scene, const StructureModel& model);

/// How many contacts are closed with these forces, one for each direction of contact: one contact with a
/// normal direction and tangents counts once, by its normal force.
std::int64_t closed_contacts(const Scene& scene, const std::vector<double>& forces);

/// The same in lines of text, for scenes of matrices; empty if it is zero.
std::string rest_lines(const Scene& scene);

}  // namespace wavebalance::app
