#pragma once
#include <string>
#include <vector>

#include "report/arguments.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// report.html: the problem, results in sentences, warnings, stability, the picture with curves that zoom,
/// the motion of a bar, all values and files. It holds all that it shows; without scripts the pictures
/// stay. `scene_text` is the scene as the record has it.
std::string report_text(const RunArguments& arguments, const Scene& scene, const std::string& scene_text,
                        const Record& record, const Summary& summary, const std::vector<RecordFile>& files);

}  // namespace wavebalance::app
