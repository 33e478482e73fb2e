#pragma once
#include <string>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// Displacement, velocity and contact force over one period. The title of an iterate that did not converge
/// has its status, and the curves are dashed and grey.
Figure response_figure(const Scene& scene, const Response& response);

/// The motion of a nonlinear mode at `frequency`, Hz.
Figure motion_figure(const Scene& scene, const Response& response, double frequency);

/// How a scene is solved and of which size, as titles of its pictures begin.
std::string method_title(const Scene& scene);

/// A sweep over its frequency or amplitude, with its bifurcation and grazing points. The first panel is the
/// vibration of the first output or of analysis.peak_of. Without outputs it is the vibration of the
/// contacts if static loads, preloads or a rigid obstacle dominate their largest displacement. The largest
/// and rms displacement of the contacts follow with their gap, and with impacts their impulses and speeds.
Figure sweep_figure(const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs = {});

}  // namespace wavebalance::app
