#pragma once
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// impact, time_fraction, contact, velocity_before_m_per_s, velocity_after_m_per_s, impulse_Ns,
/// energy_lost_J: a row for each impact of the motion's period, by time; contacts are counted from 1.
Table impacts_table(const Scene& scene, const std::vector<solvers::Impact>& impacts);

/// What impacts do in a response: how many there are, the largest impulse, the energy that they take in a
/// period of the load, impacts.csv, and where there is no such motion what happens in its place.
void append_impacts(Record& record, const Scene& scene, const Response& response);

/// The largest impulse and speed of an impact along a curve, over how many periods of the load its motions
/// repeat, and what there is in place of a first motion. Nothing of a curve without impacts.
void append_impacts(Record& record, const Sweep& sweep);

}  // namespace wavebalance::app
