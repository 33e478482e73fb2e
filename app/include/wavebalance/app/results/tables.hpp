#pragma once
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// time_fraction, displacement_m, velocity_m_per_s, contact_force_N of one contact, 1 x points each.
Table response_table(const solvers::Motion& contact);

/// time_fraction, contact (from 1), displacement_m, contact_force_N: every contact at every time, and of
/// contacts with several directions a row for each, which the column `direction` names.
Table contacts_table(const Scene& scene, const solvers::Motion& contacts);

/// The table of a frequency sweep's record.
Table sweep_table(const solvers::FrequencySweep& curve);
/// The same with the columns `unstable`, missing where it is not known, and `contacts`; with branches also
/// `branch`, 0 on the main curve, and `period` in periods of the load, all curves one below the other. The
/// first column of an amplitude sweep is the amplitude in its unit.
Table sweep_table(const Sweep& sweep, bool with_branches = false,
                  const std::vector<SceneContact>& contacts = {});

}  // namespace wavebalance::app
