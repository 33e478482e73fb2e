#pragma once
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The name of a state of a contact, of any of the enums that have some of them.
template <class State>
std::string state_name(State state) {
  if (state == State::open) return "open";
  if (state == State::stick) return "stick";
  return state == State::slip ? "slip" : "closed";
}

/// Results of contacts with friction. The summary has work, fractions of the period, slip, wear, and the
/// difference of the friction work from the work of the load (frequency, Hz) less damping. friction.csv has
/// the loops of force and displacement and the state at every instant.
void append_friction(Record& record, const Scene& scene, const Response& response, double frequency);

/// The damping ratio of an oscillator with the same largest kinetic energy that dissipates per cycle as
/// much as the friction per forcing period: work / (4 pi energy), relative to a moving base. Missing
/// without Response::structure and its velocities. Nothing without friction. O(entries of the mass,
/// instants).
void append_equivalent_damping(Record& record, const Scene& scene, const StructureModel& model,
                               const Response& response);

/// impact, time_fraction, contact, velocity_before_m_per_s, velocity_after_m_per_s, impulse_Ns,
/// energy_lost_J: a row for each impact of the motion's period, by time; contacts are counted from 1.
Table impacts_table(const Scene& scene, const std::vector<solvers::Impact>& impacts);

/// Results of impacts: their number, the largest impulse, the energy dissipated per forcing period,
/// impacts.csv, and without a solution the reason.
void append_impacts(Record& record, const Scene& scene, const Response& response);

}  // namespace wavebalance::app
