#pragma once
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// With the instants at which the motion of the whole structure is computed: as needed for files, outputs,
/// energies with friction, or a bar's report.
ResponseOptions response_options(const Scene& scene, const Observer& observer);

/// The record of one response, whatever it was solved by.
Record response_record(const Scene& scene, const StructureModel& model, const Response& response);

}  // namespace wavebalance::app
