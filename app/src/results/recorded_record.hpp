#pragma once
#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Gives the record of time stepping that did not repeat the statistics of the recorded periods instead of
/// the values of its last period, with their errors, the Poincare section and the spectrum. The status is
/// `aperiodic` where the motion is known to be so. `contact` is the leading direction of contact.
void append_recorded(Record& record, const RecordedMotion& motion, const Scene& scene, int contact);

}  // namespace wavebalance::app
