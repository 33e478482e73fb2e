#pragma once
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What contacts with friction do: their work, shares of the period, slip and wear in the summary, and
/// friction.csv with the loops of force and displacement and the state at every instant, and how far the
/// friction work is from the work of the load (frequency, Hz) less that of the damping.
void append_friction(Record& record, const Scene& scene, const Response& response, double frequency);

/// The damping ratio of an oscillator with the same largest kinetic energy that loses as much in a cycle as
/// the friction takes in a period of the load: work / (4 pi energy), relative to a moving base. Missing
/// without Response::structure and its velocities. Nothing without friction. O(entries of the mass,
/// instants).
void append_equivalent_damping(Record& record, const Scene& scene, const StructureModel& model,
                               const Response& response);

}  // namespace wavebalance::app
